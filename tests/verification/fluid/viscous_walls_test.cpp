// F26 and F27a of theory/fluid.md 8.4: Couette and Poiseuille flow between walls, and Couette flow of Sutherland's gas
// against its exact solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fluid/initial_state.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/fluid_run.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

constexpr Real speed_of_sound = 10, viscosity = 0.5, prandtl = 0.72, gamma_air = 1.4;
constexpr Real wall_temperature = speed_of_sound * speed_of_sound / gamma_air;  // gas constant 1

/// A channel of width 1 across `normal`; gas of density 1 at the temperature of the walls, both isothermal and at rest.
FlowConfig channel(int normal, int dimension, int cells, int order) {
  FlowConfig config = testing::unit_box(dimension, 8);
  config.cells[static_cast<std::size_t>(normal)] = cells;
  testing::set_boundaries(config, "periodic");
  config.euler->order = order;
  config.euler->cfl = 0.8;
  config.gas.gas_constant = 1;
  config.ambient.pressure = wall_temperature;
  config.viscosity.emplace();
  config.viscosity->law = "constant";
  config.viscosity->dynamic_viscosity = viscosity;
  std::string* const sides[3][2] = {{&config.boundary.x_low, &config.boundary.x_high},
                                    {&config.boundary.y_low, &config.boundary.y_high},
                                    {&config.boundary.z_low, &config.boundary.z_high}};
  *sides[normal][0] = *sides[normal][1] = "reflecting";
  std::optional<WallConfig>* const walls[3][2] = {{&config.wall.x_low, &config.wall.x_high},
                                                  {&config.wall.y_low, &config.wall.y_high},
                                                  {&config.wall.z_low, &config.wall.z_high}};
  for (auto* wall : walls[normal]) *wall = WallConfig{false, wall_temperature, {}, {}};
  return config;
}
WallConfig& lid(FlowConfig& config, int normal) {
  return normal == 0 ? *config.wall.x_high : normal == 1 ? *config.wall.y_high : *config.wall.z_high;
}

std::string variant(int order, int cells, std::string const& more = "") {
  return "order " + std::to_string(order) + "; " + std::to_string(cells) + " cells" + more;
}

/// Largest differences of velocity along `flow` and of temperature from a profile across `normal`.
struct Errors {
  Real velocity = 0, temperature = 0;
};
template <class Profile>
Errors errors(testing::FluidRun const& run, int normal, int flow, Profile const& profile) {
  Errors e;
  Gas const& gas = run.flow->gas();
  run.for_cells([&](CellIndex c, State const& u) {
    auto const [velocity, temperature] = profile(run.flow->grid().centre(c)[normal]);
    e.velocity = max(e.velocity, std::abs(u[static_cast<std::size_t>(1 + flow)] / u[0] - velocity));
    e.temperature = max(e.temperature, std::abs(gas.temperature(u[0], gas.pressure(u)) - temperature));
  });
  return e;
}

void expect_conserved(testing::FluidRun const& run, std::string const& id, std::string const& name,
                      std::string const& variant) {
  Conservation const& c = run.conservation();
  EXPECT_TRUE(evidence::at_most(id, name, variant, "mass defect", c.mass, 1e-13));
  EXPECT_TRUE(evidence::at_most(id, name, variant, "energy defect", c.energy, 1e-12));
  for (int d = 0; d < 3; ++d)
    EXPECT_TRUE(evidence::at_most(id, name, variant, std::string("momentum defect ") + "xyz"[d], c.momentum[d], 1e-13));
}

struct Profile {
  Real velocity, temperature;
};

/// F26: walls at rest and at speed 5; error of the temperature relative to its rise.
Real couette(int normal, int dimension, int cells, int order, std::string const& name, Real end = 6) {
  constexpr Real lid_speed = 5, heat_capacity = gamma_air / (gamma_air - 1);
  FlowConfig config = channel(normal, dimension, cells, order);
  int const flow = (normal + 1) % 3;
  lid(config, normal).velocity[flow] = lid_speed;
  testing::FluidRun run(config, end, testing::comm());
  Real const rise = prandtl * lid_speed * lid_speed / (2 * heat_capacity);
  auto const exact = [&](Real y) { return Profile{lid_speed * y, wall_temperature + rise * y * (1 - y)}; };
  Gas const& gas = run.flow->gas();
  fill(*run.flow, [&](CellIndex c) {
    Vec3 velocity;
    velocity[flow] = exact(run.flow->grid().centre(c)[normal]).velocity;
    return gas.conserved(1, velocity, wall_temperature);
  });
  run.run();
  Errors const e = errors(run, normal, flow, exact);
  EXPECT_TRUE(evidence::at_most("F26", "Couette", name, "largest error of velocity", e.velocity, 1e-11));
  expect_conserved(run, "F26", "Couette", name);
  return e.temperature / (rise / 4);
}

TEST(Couette, TemperatureIsOfSecondOrderAndTheVelocityExact) {
  for (int const order : {1, 5, 11}) {
    Real error[3];
    int const levels = evidence::full() || order == 5 ? 3 : 2;
    for (int n = 0; n < levels; ++n) {
      int const cells = 16 << n;
      error[n] = couette(0, 1, cells, order, variant(order, cells));
      Real const table = std::array{3.91e-3, 9.77e-4, 2.44e-4}[static_cast<std::size_t>(n)];
      EXPECT_TRUE(evidence::near("F26", "Couette", variant(order, cells), "error of temperature over its rise",
                                 error[n], table, 0.1 * table));
    }
    EXPECT_TRUE(evidence::near("F26", "Couette", variant(order, 32), "observed order", std::log2(error[0] / error[1]),
                               2, 0.05));
  }
}

TEST(Couette, IsTheSameAcrossTheOtherDirections) {
  for (int const normal : {1, 2}) {
    std::string const name = variant(5, 16, normal == 1 ? "; 2D across y" : "; 3D across z");
    EXPECT_TRUE(evidence::near("F26", "Couette", name, "error of temperature over its rise",
                               couette(normal, normal + 1, 16, 5, name, normal == 1 ? 6 : 3), 3.91e-3, 0.391e-3));
  }
}

/// F27a: driven by a body force of 4 along the channel, started from rest: mean error of the velocity. At Mach 0.01 the
/// heat of friction leaves the density even. The cells at the walls are worse than the mean by the last half step of
/// the force, which no friction follows: by about its gain of velocity times nu dt / h^2.
Real poiseuille(int cells, int order) {
  FlowConfig config = channel(0, 1, cells, order);
  constexpr Real hot = 100 * wall_temperature;
  config.ambient.pressure = hot;
  config.wall.x_low->temperature = config.wall.x_high->temperature = hot;
  config.gravity = GravityConfig{{0, 4, 0}, {}};
  testing::FluidRun run(config, 3, testing::comm());
  fill(*run.flow, config);
  run.run();
  expect_conserved(run, "F27a", "Poiseuille", variant(order, cells));
  Real sum = 0;
  run.for_cells([&](CellIndex c, State const& u) {
    Real const y = run.flow->grid().centre(c).x;
    sum += std::abs(u[2] / u[0] - 4 * y * (1 - y));
  });
  return sum / cells;
}

TEST(Poiseuille, VelocityIsOfSecondOrder) {
  for (int const order : {1, 5, 11}) {
    Real error[3];
    int const levels = evidence::full() || order == 5 ? 3 : 2;
    for (int n = 0; n < levels; ++n) {
      int const cells = 16 << n;
      error[n] = poiseuille(cells, order);
      Real const table = std::array{3.93e-3, 9.83e-4, 2.46e-4}[static_cast<std::size_t>(n)];
      EXPECT_TRUE(evidence::near("F27a", "Poiseuille", variant(order, cells), "mean error of velocity", error[n], table,
                                 0.1 * table));
    }
    EXPECT_TRUE(evidence::near("F27a", "Poiseuille", variant(order, 32), "observed order",
                               std::log2(error[0] / error[1]), 2, 0.05));
  }
}

/// The boundary layer of a wall set in motion at t = 0 (Stokes, Rayleigh): u = U erfc(y / 2 sqrt(nu t)), here from t_0
/// on, so slow that the gas stays as it is. Mean error over U.
Real rayleigh(int normal, int cells, int order, std::string const& time) {
  constexpr Real speed = 0.1, nu = 0.02, start = 0.2, end = 1;  // the layer grows from 0.13 to 0.28
  FlowConfig config = channel(normal, normal + 1, cells, order);
  config.viscosity->dynamic_viscosity = nu;
  config.viscosity->time = time;
  int const flow = (normal + 1) % 3;
  std::optional<WallConfig>* const wall = normal == 0 ? &config.wall.x_low : &config.wall.y_low;
  (*wall)->velocity[flow] = speed;
  testing::FluidRun run(config, end - start, testing::comm());
  auto const exact = [&](Real y, Real t) {
    Real const width = 2 * std::sqrt(nu * t);  // with the mirror image in the wall at rest at y = 1
    return speed * (std::erfc(y / width) - std::erfc((2 - y) / width));
  };
  Gas const& gas = run.flow->gas();
  fill(*run.flow, [&](CellIndex c) {
    return testing::gauss_mean(run.flow->grid(), c, [&](Vec3 const& x) {
      Vec3 velocity;
      velocity[flow] = exact(x[normal], start);
      return gas.conserved(1, velocity, wall_temperature);
    });
  });
  run.run();
  Real error = 0, count = 0;
  run.for_cells([&](CellIndex c, State const& u) {
    State const mean = testing::gauss_mean(run.flow->grid(), c, [&](Vec3 const& x) {
      return State{1, exact(x[normal], end), 0, 0, 0};
    });
    error += std::abs(u[static_cast<std::size_t>(1 + flow)] - mean[1]), count += 1;
  });
  return error / (count * speed);
}

TEST(BoundaryLayer, OfAMovingWallGrowsInSecondOrder) {
  Real const reference[3] = {9.75e-4, 2.47e-4, 6.17e-5};
  for (int const order : {1, 5, 11}) {
    Real error[3];
    for (int n = 0; n < 3; ++n) {
      error[n] = rayleigh(0, 16 << n, order, "strang");
      EXPECT_TRUE(evidence::at_most("F26", "boundary layer of a moving wall", variant(order, 16 << n),
                                    "mean error of velocity over that of the wall", error[n], 1.1 * reference[n]));
    }
    EXPECT_TRUE(evidence::near("F26", "boundary layer of a moving wall", variant(order, 64), "observed order",
                               std::log2(error[1] / error[2]), 2, 0.05));
  }
  EXPECT_TRUE(evidence::at_most("F26", "boundary layer of a moving wall", variant(5, 32, "; 2D across y"),
                                "mean error of velocity over that of the wall", rayleigh(1, 32, 5, "strang"),
                                1.1 * reference[1]));
  EXPECT_TRUE(evidence::at_most("F26", "boundary layer of a moving wall", variant(5, 64, "; lie"),
                                "mean error of velocity over that of the wall", rayleigh(0, 64, 5, "lie"), 2.64e-5));
}

/// Couette flow of a gas whose viscosity follows its temperature. The stress tau and the flux of total energy are the
/// same everywhere, so T is a quadratic of u whatever the viscosity (Crocco), and y(u) = integral of mu(T(u)) du / tau.
class SutherlandCouette {
 public:
  /// `adiabatic`: no heat through the lid, else it has the temperature `hot`.
  SutherlandCouette(Sutherland const& law, Real lid_speed, Real cold, Real hot, bool adiabatic)
      : lid_(lid_speed), cold_(cold) {
    Real const a = prandtl * (gamma_air - 1) / gamma_air;  // Pr / c_p, gas constant 1
    quadratic_ = -0.5 * a;
    linear_ = adiabatic ? a * lid_speed : (hot - cold - quadratic_ * lid_speed * lid_speed) / lid_speed;
    Real const du = lid_speed / intervals;
    place_.assign(1, 0);
    for (int i = 0; i < intervals; ++i) {
      auto const mu = [&](Real u) { return law(temperature(u)); };
      place_.push_back(place_.back() + du / 6 * (mu(i * du) + 4 * mu((i + 0.5) * du) + mu((i + 1) * du)));
    }
    stress_ = place_.back();
    for (Real& y : place_) y /= stress_;
    for (int i = 0; i <= intervals; ++i) slope_.push_back(law(temperature(i * du)) / stress_);
  }
  Real temperature(Real u) const { return cold_ + linear_ * u + quadratic_ * u * u; }
  Real stress() const { return stress_; }
  Profile operator()(Real y) const {
    auto const above = std::upper_bound(place_.begin(), place_.end() - 1, y);
    auto const i = static_cast<std::size_t>(above - place_.begin()) - 1;
    Real const du = lid_ / intervals;
    Real low = 0, high = 1;  // Hermite cubic y(u) on the interval, inverted by bisection
    for (int n = 0; n < 60; ++n) {
      Real const s = 0.5 * (low + high), h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s);
      Real const at =
          h00 * place_[i] + h10 * du * slope_[i] + (1 - h00) * place_[i + 1] - s * s * (1 - s) * du * slope_[i + 1];
      (at < y ? low : high) = s;
    }
    Real const u = (static_cast<Real>(i) + 0.5 * (low + high)) * du;
    return {u, temperature(u)};
  }

 private:
  static constexpr int intervals = 2000;
  Real lid_, cold_, linear_, quadratic_, stress_;
  std::vector<Real> place_, slope_;
};

/// A lid at Mach 2 of the cold wall. Errors relative to the speed of the lid and to the temperature of the cold wall.
Errors sutherland_couette(int cells, int order, bool adiabatic) {
  constexpr Real lid_speed = 20, hot = 1.5 * wall_temperature;
  FlowConfig config = channel(0, 1, cells, order);
  config.viscosity->law = "sutherland";
  config.viscosity->reference_temperature = wall_temperature;
  config.viscosity->sutherland_temperature = 0.4 * wall_temperature;
  lid(config, 0).velocity = {0, lid_speed, 0};
  lid(config, 0).temperature = adiabatic ? std::optional<double>() : hot;
  SutherlandCouette const exact({viscosity, wall_temperature, 0.4 * wall_temperature}, lid_speed, wall_temperature, hot,
                                adiabatic);
  testing::FluidRun run(config, 4, testing::comm());
  Gas const& gas = run.flow->gas();
  fill(*run.flow, [&](CellIndex c) {
    Profile const p = exact(run.flow->grid().centre(c).x);
    return gas.conserved(wall_temperature / p.temperature, {0, p.velocity, 0}, wall_temperature);
  });
  run.run();
  std::string const name = variant(order, cells, adiabatic ? "; Sutherland; adiabatic lid" : "; Sutherland; hot lid");
  expect_conserved(run, "F26", "Couette", name);
  Errors e = errors(run, 0, 1, exact);
  e.velocity /= lid_speed;
  e.temperature /= wall_temperature;
  return e;
}

TEST(SutherlandCouette, IsOfSecondOrder) {
  struct Case {
    bool adiabatic;
    Errors finest;  // at 64 cells
  };
  for (Case const& c : {Case{false, {4.0e-5, 9.7e-5}}, Case{true, {4.4e-5, 1.08e-4}}})
    for (int const order : {5, 11}) {
      if (order == 11 && !evidence::full()) continue;
      Errors e[2];
      for (int n = 0; n < 2; ++n) e[n] = sutherland_couette(32 << n, order, c.adiabatic);
      std::string const name =
          variant(order, 64, c.adiabatic ? "; Sutherland; adiabatic lid" : "; Sutherland; hot lid");
      auto const record = [&](std::string const& quantity, Real coarse, Real fine, Real reference) {
        EXPECT_TRUE(evidence::at_most("F26", "Couette", name, "largest error of " + quantity, fine, 1.1 * reference));
        EXPECT_TRUE(
            evidence::near("F26", "Couette", name, "observed order of " + quantity, std::log2(coarse / fine), 2, 0.05));
      };
      record("velocity over that of the lid", e[0].velocity, e[1].velocity, c.finest.velocity);
      record("temperature over that of the cold wall", e[0].temperature, e[1].temperature, c.finest.temperature);
    }
}

}  // namespace
}  // namespace brisance::fluid
