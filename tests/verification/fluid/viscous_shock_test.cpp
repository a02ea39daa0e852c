// F27b of theory/fluid.md 8.4: the structure of a viscous shock (Becker), also with Sutherland's viscosity, carried
// through the grid.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "fluid/initial_state.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/fluid_run.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

constexpr Real gamma_air = 1.4, mach = 2, frame = -0.3, end = 0.5;

/// The steady shock of Prandtl number 3/4 in its own frame: rho u = 1, total enthalpy constant whatever the viscosity,
/// and 4/3 mu u' = u - 1 + p - p_0. Tabulated by Runge-Kutta from u half way between both ends at x = 0.
class ShockProfile {
 public:
  /// `viscosity`: of the temperature over that of the unit upstream state (rho 1, u 1, p 1 / (gamma M^2)).
  explicit ShockProfile(std::function<Real(Real)> viscosity) : viscosity_(std::move(viscosity)) {
    Real const half = 0.5 * (1 + downstream());
    up_ = table(half, -step);
    down_ = table(half, step);
  }
  static Real downstream() { return ((gamma_air - 1) * mach * mach + 2) / ((gamma_air + 1) * mach * mach); }
  /// Velocity in the frame of the shock; density is its inverse.
  Real velocity(Real x) const {
    std::vector<Real> const& t = x < 0 ? up_ : down_;
    Real const s = std::abs(x) / step;
    auto const i = static_cast<std::size_t>(s);
    if (i + 1 >= t.size()) return t.back();
    Real const f = s - static_cast<Real>(i), h = x < 0 ? -step : step, a = t[i], b = t[i + 1];
    Real const h00 = (1 + 2 * f) * (1 - f) * (1 - f);
    return h00 * a + (1 - h00) * b + f * (1 - f) * h * ((1 - f) * slope(a) - f * slope(b));
  }
  /// p of a velocity, by the constant total enthalpy.
  static Real pressure(Real u) {
    Real const enthalpy = 1 / ((gamma_air - 1) * mach * mach) + 0.5;
    return (gamma_air - 1) / gamma_air * (enthalpy - 0.5 * u * u) / u;
  }

 private:
  static constexpr Real step = 1e-4;
  Real slope(Real u) const {
    Real const p0 = 1 / (gamma_air * mach * mach), p = pressure(u);
    return 0.75 / viscosity_(p * u / p0) * (u - 1 + p - p0);
  }
  std::vector<Real> table(Real u, Real h) const {
    std::vector<Real> t{u};
    for (int n = 0; n < 8000; ++n) {
      Real const a = slope(u), b = slope(u + 0.5 * h * a), c = slope(u + 0.5 * h * b), d = slope(u + h * c);
      t.push_back(u += h / 6 * (a + 2 * b + 2 * c + d));
    }
    return t;
  }
  std::function<Real(Real)> viscosity_;
  std::vector<Real> up_, down_;
};

struct Setting {
  std::string law;
  int max_substeps;
};

/// L1 of density after the shock moved from x = 0 to frame * end through [-0.5, 0.5], of values at the cell centres.
Real shock_error(int cells, int order, Setting const& setting) {
  constexpr Real mu = 0.01, warmth = 0.4;                  // Sutherland's constant over the temperature upstream
  Real const temperature = 1 / (gamma_air * mach * mach);  // upstream, gas constant 1
  Sutherland const law{mu, temperature, warmth * temperature};
  bool const sutherland = setting.law == "sutherland";
  ShockProfile const profile([&](Real ratio) { return sutherland ? law(ratio * temperature) : mu; });
  FlowConfig config = testing::unit_box(1, cells);
  config.low.x = -0.5;
  config.high.x = 0.5;
  config.euler->order = order;
  config.gas.gas_constant = 1;
  config.viscosity.emplace();
  config.viscosity->law = setting.law;
  config.viscosity->dynamic_viscosity = mu;
  config.viscosity->reference_temperature = law.reference;
  config.viscosity->sutherland_temperature = law.constant;
  config.viscosity->prandtl = 0.75;
  config.viscosity->max_substeps = setting.max_substeps;
  // Eleven and more thicknesses away from the shock the gas is uniform to 1e-6.
  config.boundary.x_low = config.boundary.x_high = "inflow";
  Real const v = ShockProfile::downstream();
  config.inflow.x_low = GasState{1, ShockProfile::pressure(1), {1 + frame, 0, 0}};
  config.inflow.x_high = GasState{1 / v, ShockProfile::pressure(v), {v + frame, 0, 0}};
  testing::FluidRun run(config, end, testing::comm());
  auto const exact = [&](CellIndex c, Real t) {
    Real const u = profile.velocity(run.flow->grid().centre(c).x - frame * t);
    return run.flow->gas().conserved(1 / u, {u + frame, 0, 0}, ShockProfile::pressure(u));
  };
  fill(*run.flow, [&](CellIndex c) { return exact(c, 0); });
  run.run();
  Real error = 0;
  run.for_cells([&](CellIndex c, State const& u) { error += std::abs(u[0] - exact(c, end)[0]) / cells; });
  std::string const variant =
      "order " + std::to_string(order) + "; " + std::to_string(cells) + " cells; " + setting.law;
  EXPECT_TRUE(evidence::at_most("F27b", "viscous shock", variant, "energy defect", run.conservation().energy, 1e-13));
  EXPECT_TRUE(evidence::at_most("F27b", "viscous shock", variant, "mass defect", run.conservation().mass, 1e-13));
  return error;
}

std::string variant(int order, int cells, std::string const& more) {
  return "order " + std::to_string(order) + "; " + std::to_string(cells) + " cells; " + more;
}

/// The table was made with steps that keep the limit of the viscous terms.
TEST(ViscousShock, HasTheErrorOfTheTable) {
  struct Row {
    int order;
    Real error[4];  // 50, 100, 200, 400 cells
  };
  for (Row const& row : {Row{1, {2.55e-2, 1.45e-2, 7.8e-3, 4.1e-3}}, Row{3, {2.08e-3, 5.66e-4, 1.26e-4, 2.77e-5}},
                         Row{5, {1.69e-3, 4.79e-4, 1.06e-4, 2.47e-5}}, Row{11, {2.03e-3, 4.84e-4, 1.06e-4, 2.47e-5}}}) {
    Real error[4];
    for (int n = 0; n < 4; ++n) {
      int const cells = 50 << n;
      error[n] = shock_error(cells, row.order, {"constant", 1});
      EXPECT_TRUE(evidence::at_most("F27b", "viscous shock", variant(row.order, cells, "constant"), "L1 density",
                                    error[n], 1.1 * row.error[n]));
    }
    if (row.order < 5) continue;
    EXPECT_TRUE(evidence::near("F27b", "viscous shock", variant(row.order, 400, "constant"), "observed order",
                               std::log2(error[2] / error[3]), 2.1, 0.1));
  }
}

TEST(ViscousShock, SubCyclingKeepsTheError) {
  EXPECT_TRUE(evidence::at_most("F27b", "viscous shock", variant(5, 400, "constant; sub-cycled"), "L1 density",
                                shock_error(400, 5, {"constant", 50}), 1.1 * 2.47e-5));
}

TEST(ViscousShock, OfSutherlandsGasIsOfSecondOrder) {
  for (int const order : {5, 11}) {
    Real const coarse = shock_error(200, order, {"sutherland", 50}), fine = shock_error(400, order, {"sutherland", 50});
    EXPECT_TRUE(
        evidence::at_most("F27b", "viscous shock", variant(order, 200, "sutherland"), "L1 density", coarse, 8.6e-5));
    EXPECT_TRUE(
        evidence::at_most("F27b", "viscous shock", variant(order, 400, "sutherland"), "L1 density", fine, 2.13e-5));
    EXPECT_TRUE(evidence::near("F27b", "viscous shock", variant(order, 400, "sutherland"), "observed order",
                               std::log2(coarse / fine), 2, 0.1));
  }
}

/// With the viscosity constant the table of the test is Becker's closed solution.
TEST(ViscousShock, ProfileIsBeckers) {
  constexpr Real mu = 0.01;
  ShockProfile const profile([&](Real) { return mu; });
  Real const r = ShockProfile::downstream(), length = 8 * gamma_air / (3 * (gamma_air + 1)) * mu;
  auto const place = [&](Real v) { return length / (1 - r) * (std::log(1 - v) - r * std::log(v - r)); };
  for (Real const x : {-0.05, -0.02, -0.003, 0.004, 0.02, 0.03})
    EXPECT_NEAR(place(profile.velocity(x)) - place(0.5 * (1 + r)), x, 1e-9);
}

}  // namespace
}  // namespace brisance::fluid
