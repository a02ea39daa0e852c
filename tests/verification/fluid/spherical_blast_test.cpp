// F30 of theory/fluid.md 8.4: a spherical blast in an octant against a radial solution of the same equations.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/tables.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

constexpr Real end_time = 0.15;

FlowConfig blast(int dimension, int cells, Real length) {
  FlowConfig config = testing::unit_box(dimension, cells, length);
  config.ambient = {1, 0.1, {}};
  config.boundary.x_high = config.boundary.y_high = config.boundary.z_high = "outflow";
  RegionConfig ball;
  ball.shape = "ball";
  ball.centre = Vec3{};
  ball.radius = 0.3;
  ball.density = 1;
  ball.pressure = 10;
  config.region = {ball};
  return config;
}

/// The geometric source of spherical symmetry, -(2/r) (rho u, rho u^2, 0, 0, (E + p) u), over dt by Heun's method.
void spread(Flow& flow, Real dt) {
  auto const rate = [&](State const& u, Real r) {
    Real const v = u[1] / u[0], s = -2 / r;
    return State{s * u[1], s * u[1] * v, 0, 0, s * (u[4] + flow.gas().pressure(u)) * v};
  };
  for (Block& block : flow.blocks())
    for (Index i = 0; i < block.size()[0]; ++i) {
      Real const r = flow.grid().centre({block.first()[0] + i, 0, 0}).x;
      State const u = block.load(i, 0, 0), k1 = rate(u, r);
      State predicted, next;
      for (std::size_t q = 0; q < 5; ++q) predicted[q] = u[q] + dt * k1[q];
      State const k2 = rate(predicted, r);
      for (std::size_t q = 0; q < 5; ++q) next[q] = u[q] + 0.5 * dt * (k1[q] + k2[q]);
      block.store(i, 0, 0, next);
    }
}

/// Density over the radius at the end, one value per cell of width 1/cells.
std::vector<Real> radial_solution(int cells) {
  FlowConfig config = blast(1, cells, 1);
  config.block = cells;
  auto const comm = parallel::serial();
  auto const flow = testing::make_flow(config, *comm);
  fill(*flow, config);
  Real t = 0;
  for (std::int64_t step = 0; t < end_time; ++step) {
    Real const cfl = courant_number(1, step, 0.8);
    PairStep const s = shorten(t, end_time, acoustic_time_step(flow->grid(), signal_speeds(*flow), cfl), 1);
    spread(*flow, s.dt / 2);
    EXPECT_EQ(flow->sweep(0, s.dt).health, 0u);
    spread(*flow, s.dt / 2);
    t = s.reaches_end ? end_time : t + s.dt;
  }
  std::vector<Real> density;
  for (Index i = 0; i < cells; ++i) density.push_back(flow->blocks()[0].load(i, 0, 0)[0]);
  return density;
}

Real at(std::vector<Real> const& profile, Real r) {
  Real const x = r * static_cast<Real>(profile.size()) - 0.5;
  std::size_t const i = static_cast<std::size_t>(clamp(std::floor(x), 0, static_cast<Real>(profile.size()) - 2));
  Real const share = clamp(x - static_cast<Real>(i), 0, 1);
  return (1 - share) * profile[i] + share * profile[i + 1];
}

/// As the theory's table was made, or with the program's defaults.
Real mean_error(std::vector<Real> const& radial, int cells, int order, bool defaults) {
  FlowConfig config = blast(3, cells, 1);
  config.euler->order = order;
  if (!defaults) config.euler->hybrid = false, config.euler->shear_dissipation = 0;
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, config);
  FlowClock clock;
  advance(*flow, clock, {.end = end_time, .cfl = 0.8});
  Real error = 0;
  int count = 0;
  for (Block const& block : flow->blocks())
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j)
        for (Index i = 0; i < block.size()[0]; ++i) {
          CellIndex const first = block.first();
          Real const r = norm(flow->grid().centre({first[0] + i, first[1] + j, first[2] + k}));
          if (r >= 0.95) continue;
          error += std::abs(block.load(i, j, k)[0] - at(radial, r));
          ++count;
        }
  return error / count;
}

TEST(SphericalBlast, FollowsTheRadialSolution) {
  std::vector<Real> const radial = radial_solution(2000);
  struct Point {
    Real r, density;
  };
  // The self-difference of the theory's own reference.
  for (Point const p :
       {Point{0.1, 0.0303}, Point{0.2, 0.0306}, Point{0.3, 0.1304}, Point{0.4, 0.1914}, Point{0.5, 0.2238}})
    EXPECT_NEAR(at(radial, p.r), p.density, 3e-3 * p.density) << "radial solution at " << p.r;
  Real const table[2][6] = {{.200, .124, .113, .109, .107, .106}, {.162, .0754, .0657, .0639, .0633, .0630}};
  for (int fine = 0; fine < (evidence::full() ? 2 : 1); ++fine)
    for (int o = 0; o < 6; ++o) {
      int const order = testing::orders[o], cells = fine ? 48 : 24;
      for (bool const defaults : {false, true})
        EXPECT_TRUE(evidence::at_most(
            "F30", "spherical blast",
            testing::variant(order) + " " + std::to_string(cells) + "^3" + (defaults ? "" : " without sensor"),
            "mean abs(density - radial)", mean_error(radial, cells, order, defaults),
            testing::allowance * table[fine][o]));
    }
}

}  // namespace
}  // namespace brisance::fluid
