// F27c and F27d of theory/fluid.md 8.4: a shear wave and Taylor-Green vortices decay as they should.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "fluid/initial_state.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/fluid_run.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

constexpr Real turn = 2 * std::numbers::pi;

FlowConfig periodic_box(int dimension, int cells, int order, Real viscosity) {
  FlowConfig config = testing::unit_box(dimension, cells);
  testing::set_boundaries(config, "periodic");
  config.euler->order = order;
  config.euler->cfl = 0.8;
  config.viscosity.emplace();
  config.viscosity->law = "constant";
  config.viscosity->dynamic_viscosity = viscosity;
  config.gas.gas_constant = 1;
  return config;
}

std::string variant(int order, int cells, std::string const& more = "") {
  return "order " + std::to_string(order) + "; " + std::to_string(cells) + " cells" + more;
}

void record_order(std::string const& id, std::string const& name, int order, Real coarse, Real fine) {
  EXPECT_TRUE(
      evidence::near(id, name, "order " + std::to_string(order), "observed order", std::log2(coarse / fine), 2, 0.1));
}

/// F27d: v = 0.1 sin(2 pi x) carried by u = 0.5, speed of sound 10: amplitude at t = 1 over the exact one, minus 1.
Real shear_wave(int order, int cells, std::string const& time = "strang") {
  FlowConfig config = periodic_box(1, cells, order, 0.02);
  config.viscosity->time = time;
  testing::FluidRun run(config, 1, testing::comm());
  Gas const& gas = run.flow->gas();
  fill(*run.flow, [&](CellIndex c) {
    return testing::gauss_mean(run.flow->grid(), c, [&](Vec3 const& x) {
      return gas.conserved(1, {0.5, 0.1 * std::sin(turn * x.x), 0}, 100 / gas.gamma);
    });
  });
  run.run();
  Real sine = 0, cosine = 0;
  run.for_cells([&](CellIndex c, State const& u) {
    Real const x = turn * run.flow->grid().centre(c).x;
    sine += u[2] * std::sin(x), cosine += u[2] * std::cos(x);
  });
  Real const half = 0.5 * turn / cells;  // cell means of a sine are sin(half) / half times its values
  Real const amplitude = 2.0 / cells * std::hypot(sine, cosine) * half / std::sin(half);
  return amplitude / (0.1 * std::exp(-0.02 * turn * turn)) - 1;
}

void expect_shear_wave(int order, int cells, Real table) {
  Real const got = shear_wave(order, cells);
  EXPECT_TRUE(evidence::near("F27d", "shear wave", variant(order, cells), "amplitude over exact; minus 1", got, table,
                             0.1 * std::abs(table)));
}

TEST(ShearWave, DecaysAsInTheTableAndInSecondOrder) {
  struct Row {
    int order;
    Real error[3];  // 16, 32, 64 cells
  };
  for (Row const& row : {Row{1, {-0.44, -0.25, -0.14}}, Row{3, {-5.1e-3, 6.0e-4, 3.9e-4}},
                         Row{5, {9.7e-3, 2.5e-3, 6.3e-4}}, Row{11, {1.0e-2, 2.5e-3, 6.3e-4}}})
    for (int n = 0; n < 3; ++n) expect_shear_wave(row.order, 16 << n, row.error[n]);
  for (int const order : {5, 11})
    record_order("F27d", "shear wave", order, shear_wave(order, 32), shear_wave(order, 64));
}

TEST(ShearWave, LieIsMoreAccurateHereAsTheTheorySays) {
  EXPECT_TRUE(evidence::near("F27d", "shear wave", variant(5, 64, "; lie"), "amplitude over exact; minus 1",
                             shear_wave(5, 64, "lie"), 2.6e-4, 0.26e-4));
}

/// F27c: energy of Taylor-Green vortices of Mach 0.1, isothermal at the start, at t = 1 over the exact one, minus 1.
Real taylor_green(int order, int cells) {
  Real const viscosity = 0.02;
  FlowConfig const config = periodic_box(2, cells, order, viscosity);
  testing::FluidRun run(config, 1, testing::comm());
  Gas const& gas = run.flow->gas();
  fill(*run.flow, [&](CellIndex c) {
    return testing::gauss_mean(run.flow->grid(), c, [&](Vec3 const& p) {
      Real const x = turn * p.x, y = turn * p.y;
      Real const mean = 100 / gas.gamma, pressure = mean + 0.25 * (std::cos(2 * x) + std::cos(2 * y));
      return gas.conserved(pressure / mean, {std::sin(x) * std::cos(y), -std::cos(x) * std::sin(y), 0}, pressure);
    });
  });
  auto const energy = [&] {
    Real sum = 0;
    run.for_cells([&](CellIndex, State const& u) { sum += 0.5 * (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / u[0]; });
    return sum;
  };
  Real const before = energy();
  run.run();
  for (int d = 0; d < 2; ++d)
    EXPECT_TRUE(evidence::at_most("F27c", "Taylor-Green vortices", variant(order, cells),
                                  std::string("momentum defect ") + "xy"[d], run.conservation().momentum[d], 1e-13));
  EXPECT_TRUE(evidence::at_most("F27c", "Taylor-Green vortices", variant(order, cells), "energy defect",
                                run.conservation().energy, 1e-13));
  return energy() / (before * std::exp(-4 * viscosity * turn * turn)) - 1;
}

void expect_taylor_green(int order, int cells, Real table) {
  EXPECT_TRUE(evidence::near("F27c", "Taylor-Green vortices", variant(order, cells), "energy over exact; minus 1",
                             taylor_green(order, cells), table, 0.1 * std::abs(table)));
}

TEST(TaylorGreen, EnergyDecaysAsInTheTable) {
  struct Row {
    int order;
    Real error[3];  // 16, 32, 64 cells
  };
  for (Row const& row : {Row{1, {-0.997, -0.946, -0.776}}, Row{3, {-0.150, -0.0147, 0.0017}},
                         Row{5, {0.0168, 0.0083, 0.0046}}, Row{11, {0.0244, 0.0085, 0.0047}}})
    for (int n = 0; n < (evidence::full() ? 3 : 2); ++n) expect_taylor_green(row.order, 16 << n, row.error[n]);
}

/// A plane wave along (1, 1, 1) in 3D: `state` of the phase. Velocity amplitude along `direction` at the end over that
/// at the start.
template <class Make>
Real oblique_wave(int cells, Real viscosity, Real end, Vec3 const& direction, Make const& state) {
  FlowConfig config = periodic_box(3, cells, 11, viscosity);
  config.block = 12;
  config.euler->cfl = 0.2;  // that of the first steps, so that the step falls with the cells throughout
  testing::FluidRun run(config, end, testing::comm());
  auto const phase = [](Vec3 const& x) { return turn * (x.x + x.y + x.z); };
  fill(*run.flow, [&](CellIndex c) {
    return testing::gauss_mean(run.flow->grid(), c, [&](Vec3 const& x) { return state(run.flow->gas(), phase(x)); });
  });
  auto const amplitude = [&] {
    Real sine = 0, cosine = 0;
    run.for_cells([&](CellIndex c, State const& u) {
      Real const p = phase(run.flow->grid().centre(c)), v = dot(Vec3{u[1], u[2], u[3]}, direction);
      sine += v * std::sin(p), cosine += v * std::cos(p);
    });
    return std::hypot(sine, cosine);
  };
  Real const before = amplitude();
  run.run();
  return amplitude() / before;
}

/// Linear sound of wave number k in a gas with rho = p = R = 1: the size of the velocity at `end` of a wave that starts
/// as the simple wave of the gas without viscosity.
Real exact_sound(Real k, Real viscosity, Real prandtl, Real gamma, Real end) {
  using Complex = std::complex<Real>;
  using Wave = std::array<Complex, 3>;  // density, velocity, pressure
  Complex const ik(0, k);
  Real const heat = viscosity * gamma / prandtl * k * k;  // (gamma - 1) kappa k^2
  auto const rate = [&](Wave const& w) {
    return Wave{-ik * w[1], -ik * w[2] - 4.0 / 3 * viscosity * k * k * w[1], -gamma * ik * w[1] - heat * (w[2] - w[0])};
  };
  auto const plus = [](Wave w, Real s, Wave const& r) {
    for (std::size_t q = 0; q < 3; ++q) w[q] += s * r[q];
    return w;
  };
  Real const c = std::sqrt(gamma);
  Wave w{1 / c, 1, c};
  constexpr int steps = 4000;
  Real const h = end / steps;
  for (int n = 0; n < steps; ++n) {
    Wave const a = rate(w), b = rate(plus(w, 0.5 * h, a)), d = rate(plus(w, 0.5 * h, b)), e = rate(plus(w, h, d));
    for (std::size_t q = 0; q < 3; ++q) w[q] += h / 6 * (a[q] + 2.0 * b[q] + 2.0 * d[q] + e[q]);
  }
  return std::abs(w[1]);
}

/// All derivatives of the stress tensor are at work: across the wave only shear counts, along it 4/3 of it and the
/// conduction of heat.
TEST(ObliqueWave, ShearAndSoundDecayInThreeDimensions) {
  constexpr Real viscosity = 0.02, end = 0.3;
  Real const k = std::sqrt(3.0) * turn;
  Vec3 const across = normalized({1, -1, 0}), along = normalized({1, 1, 1});
  auto const shear = [&](Gas const& gas, Real p) { return gas.conserved(1, 0.01 * std::sin(p) * across, 1); };
  auto const sound = [&](Gas const& gas, Real p) {
    Real const c = std::sqrt(gas.gamma), m = 1e-5 * std::sin(p);
    return gas.conserved(1 + m / c, m * along, 1 + c * m);
  };
  Real const exact[2] = {std::exp(-viscosity * k * k * end), exact_sound(k, viscosity, 0.72, 1.4, end)};
  char const* const names[2] = {"oblique shear wave; 3D", "oblique sound wave; 3D"};
  Real const reference[2][3] = {{1.10e-2, 2.72e-3, 6.80e-4}, {2.08e-2, 5.26e-3, 1.31e-3}};  // 12, 24, 48 cells
  for (int wave = 0; wave < 2; ++wave) {
    Real error[3];
    int const levels = evidence::full() ? 3 : 2;
    for (int n = 0; n < levels; ++n) {
      int const cells = 12 << n;
      Real const got = wave == 0 ? oblique_wave(cells, viscosity, end, across, shear)
                                 : oblique_wave(cells, viscosity, end, along, sound);
      error[n] = std::abs(got / exact[wave] - 1);
      EXPECT_TRUE(evidence::at_most("F27d", names[wave], variant(11, cells), "amplitude over exact; minus 1", error[n],
                                    1.1 * reference[wave][n]));
    }
    EXPECT_TRUE(evidence::near("F27d", names[wave], variant(11, 12 << (levels - 1)), "observed order",
                               std::log2(error[levels - 2] / error[levels - 1]), 2, 0.05));
  }
}

}  // namespace
}  // namespace brisance::fluid
