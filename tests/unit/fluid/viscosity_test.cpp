// The viscous operator: exact on quadratics, the same bits for any division into blocks and ranks, blind to what is
// uniform; and the accounts of gravity and of walls.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "parallel/error.hpp"
#include "tests/support/fluid_run.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

FlowConfig viscous_box(int dimension, int cells, std::string const& law = "constant") {
  FlowConfig config = testing::unit_box(dimension, cells);
  config.gas.gas_constant = 1;
  config.viscosity.emplace();
  config.viscosity->law = law;
  config.viscosity->dynamic_viscosity = 0.3;
  config.viscosity->reference_temperature = 1;
  config.viscosity->sutherland_temperature = 0.4;
  return config;
}

/// One Euler stage on a single block whose ghosts hold `exact` too.
template <class Exact>
Block stage_of(Grid const& grid, Transport const& transport, Real tau, Exact const& exact) {
  Block block(grid, 0, 3);
  CellIndex low{0, 0, 0}, high = block.size();
  for (std::size_t d = 0; d < 3; ++d) low[d] -= block.ghost()[d], high[d] += block.ghost()[d];
  for (Index k = low[2]; k < high[2]; ++k)
    for (Index j = low[1]; j < high[1]; ++j)
      for (Index i = low[0]; i < high[0]; ++i) block.store(i, j, k, exact(grid.centre({i, j, k})));
  BlockStage stage(transport, grid);
  std::array<State, 6> through{};
  EXPECT_EQ(stage.run(block, tau, DiffusionStage::euler, {}, {}, through), 0);
  return block;
}

/// With rho = 1 and mu constant: mu (laplacian u + grad div u / 3), which all difference formulas get exactly.
TEST(ViscousOperator, IsExactForQuadraticVelocities) {
  for (int dimension : {1, 2, 3}) {
    FlowConfig const config = viscous_box(dimension, 9);
    Grid const grid = make_grid(config);
    Gas const gas = make_gas(config);
    // u_a = sum_bc h[a][b][c] x_b x_c, symmetric in b and c.
    auto const h = [](int a, int b, int c) { return 0.1 * (1 + a) + 0.07 * (b + c) - 0.05 * a * b * c; };
    auto const velocity = [&](Vec3 const& x) {
      Vec3 u;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < dimension; ++b)
          for (int c = 0; c < dimension; ++c) u[a] += h(a, b, c) * x[b] * x[c];
      return u;
    };
    Real const tau = 1e-3, mu = config.viscosity->dynamic_viscosity;
    Block const block = stage_of(grid, Transport(*config.viscosity, gas), tau,
                                 [&](Vec3 const& x) { return gas.conserved(1, velocity(x), 50); });
    for (int a = 0; a < 3; ++a) {
      Real laplacian = 0, gradient = 0;
      for (int b = 0; b < dimension; ++b) laplacian += 2 * h(a, b, b);
      if (a < dimension)
        for (int b = 0; b < dimension; ++b) gradient += 2 * h(b, a, b);
      Index const last = block.size()[2] - 1;
      for (CellIndex c : {CellIndex{0, 0, 0}, CellIndex{4, dimension > 1 ? 8 : 0, last}, CellIndex{8, 0, 0}}) {
        Real const change = block.load(c[0], c[1], c[2])[static_cast<std::size_t>(1 + a)] - velocity(grid.centre(c))[a];
        EXPECT_NEAR(change, tau * mu * (laplacian + gradient / 3), 1e-13) << dimension << "D, component " << a;
      }
    }
  }
}

/// Conduction alone: rho = 1, gas at rest, T quadratic: the energy gains kappa laplacian T, kappa = mu c_p / Pr.
TEST(ViscousOperator, ConductsHeat) {
  FlowConfig const config = viscous_box(3, 9);
  Grid const grid = make_grid(config);
  Gas const gas = make_gas(config);
  auto const temperature = [](Vec3 const& x) { return 3 + x.x * x.x - 2 * x.y * x.y + 3 * x.z * x.z + x.x * x.y; };
  Real const tau = 1e-3, kappa = 0.3 * 3.5 / 0.72;
  Block const block = stage_of(grid, Transport(*config.viscosity, gas), tau,
                               [&](Vec3 const& x) { return gas.conserved(1, {}, temperature(x)); });
  for (Index i : {0, 3, 8}) {
    State const u = block.load(i, 8 - i, i / 2);
    EXPECT_NEAR(u[4] - temperature(grid.centre({i, 8 - i, i / 2})) / 0.4, tau * kappa * 4, 1e-12);
    for (std::size_t q : {1u, 2u, 3u}) EXPECT_EQ(u[q], 0);
  }
}

TEST(ViscousOperator, LeavesUniformFlowAlone) {
  for (int dimension : {1, 2, 3}) {
    FlowConfig config = viscous_box(dimension, 12, "sutherland");
    testing::set_boundaries(config, "periodic");
    config.block = 6;
    auto const flow = testing::make_flow(config, testing::comm());
    Viscosity viscosity(config, *flow);
    State const u = flow->gas().conserved(0.7, {0.3, -1.1, 0.2}, 1.3);
    fill(*flow, [&](CellIndex) { return u; });
    viscosity.advance(0.01, 3);
    for (Block const& b : flow->blocks()) EXPECT_EQ(b.load(1, 0, 0), u);
  }
}

/// Vacuum passes neither momentum nor heat, and true vacuum stays it.
TEST(ViscousOperator, StopsAtVacuum) {
  FlowConfig config = viscous_box(1, 12);
  auto const flow = testing::make_flow(config, testing::comm());
  Viscosity viscosity(config, *flow);
  fill(*flow, [&](CellIndex c) {
    return c[0] < 6 ? flow->gas().conserved(1, {0, 1, 0}, 2) : c[0] < 9 ? State{} : flow->gas().conserved(1, {}, 1);
  });
  State const gas = flow->gas().conserved(1, {0, 1, 0}, 2);
  EXPECT_EQ(std::isfinite(viscosity.stable_step()), !flow->blocks().empty());
  viscosity.advance(0.001, 2);
  for (Block const& b : flow->blocks()) {
    EXPECT_EQ(b.load(5, 0, 0), gas);
    EXPECT_EQ(b.load(7, 0, 0), State{});
  }
}

std::string digest_of(FlowConfig const& config, parallel::Comm& comm) {
  testing::FluidRun run(config, 0.05, comm);
  fill(*run.flow, config);
  run.run();
  EXPECT_LT(run.conservation().mass, 1e-13);
  EXPECT_LT(run.conservation().energy, 1e-13);
  for (int d = 0; d < 3; ++d) EXPECT_LT(run.conservation().momentum[d], 1e-13);
  return run.simulation->digest().hex();
}

/// A ball of hot gas next to walls of all kinds, through the corners of many blocks, with gravity.
TEST(Viscosity, BlocksAndRanksDoNotChangeTheBits) {
  for (char const* time : {"strang", "lie"})
    for (int dimension : {1, 2, 3}) {
      FlowConfig config = viscous_box(dimension, dimension == 3 ? 18 : 27, "sutherland");
      config.viscosity->dynamic_viscosity = 0.01;
      config.viscosity->time = time;
      config.gravity = GravityConfig{{0.5, -1, 0.25}, {}};
      config.boundary.x_low = "outflow";
      config.wall.x_high = WallConfig{false, 1.5, {0, 0.3, 0}, {}};
      if (dimension > 1) config.wall.y_low = WallConfig{false, {}, {}, {}};
      if (dimension > 1) config.wall.y_high = WallConfig{true, 0.8, {}, {}};
      if (dimension > 2) config.boundary.z_low = config.boundary.z_high = "periodic";
      RegionConfig ball;
      ball.shape = "ball";
      ball.centre = Vec3{0.6, 0.45, 0.5};
      ball.radius = 0.25;
      ball.density = 1.5;
      ball.pressure = 5;
      ball.velocity = {0.4, -0.3, 0};
      config.region = {ball};
      auto const alone = parallel::serial();
      std::string const expected = digest_of(config, *alone);
      for (int block : {5, 9, 48}) {
        config.block = block;
        EXPECT_EQ(digest_of(config, *alone), expected) << time << " " << dimension << "D, blocks of " << block;
      }
      config.block = 5;
      EXPECT_EQ(digest_of(config, testing::comm()), expected) << time << " " << dimension << "D, all ranks";
    }
}

TEST(Viscosity, SubCyclesInsteadOfShorteningTheStep) {
  FlowConfig config = viscous_box(1, 64);
  config.viscosity->dynamic_viscosity = 0.2;
  auto const steps = [&](int substeps) {
    config.viscosity->max_substeps = substeps;
    testing::FluidRun run(config, 0.1, testing::comm());
    fill(*run.flow, config);
    run.run();
    return run.simulation->statistics();
  };
  EXPECT_TRUE(steps(1).limited_by.contains("fluid.viscous"));
  EXPECT_FALSE(steps(1000).limited_by.contains("fluid.viscous"));
}

/// Far beyond its limit a step overshoots: the cell is named, so that the pair is taken back.
TEST(Viscosity, RaisesItsHealthWhereTheEnergyTurnsNegative) {
  FlowConfig config = viscous_box(2, 12);
  config.viscosity->time = "lie";
  testing::FluidRun run(config, 1, testing::comm());
  fill(*run.flow, [&](CellIndex c) { return run.flow->gas().conserved(1, {}, c == CellIndex{7, 3, 0} ? 10 : 1); });
  auto const verdict = [&] { return run.plan.judges().back()({}); };
  run.viscosity->advance(0.4 * run.viscosity->stable_step(), 1);
  EXPECT_TRUE(verdict().good);
  run.viscosity->advance(20 * run.viscosity->stable_step(), 1);
  EXPECT_EQ(verdict().good, run.flow->blocks().empty());
  EXPECT_TRUE(verdict().good || verdict().message.find("after a viscous step in cell (") != std::string::npos);
}

/// Falling freely, gas gains g t and loses height: its energy grows by the work of the force, to the last digit.
TEST(Gravity, WorksExactlyOnGasInFreeFall) {
  FlowConfig config = testing::unit_box(2, 12);
  testing::set_boundaries(config, "periodic");
  Vec3 const g{3, -7, 0};
  config.gravity = GravityConfig{g, {}};
  testing::FluidRun run(config, 0.5, testing::comm());
  fill(*run.flow, config);
  run.run();
  run.for_cells([&](CellIndex, State const& u) {
    EXPECT_NEAR(u[1], 0.5 * g.x, 1e-13);
    EXPECT_NEAR(u[2], 0.5 * g.y, 1e-13);
    EXPECT_NEAR(u[4], 1 / 0.4 + 0.125 * norm2(g), 1e-12);
  });
  EXPECT_LT(run.conservation().energy, 1e-14);
  EXPECT_LT(run.conservation().momentum.y, 1e-14);
}

std::string complaint(FlowConfig const& config) {
  try {
    check(config);
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    return e.what();
  }
  return "";
}

TEST(ViscosityConfig, RefusesWhatHasNoMeaning) {
  auto const expect = [](std::string const& words, auto&& change) {
    FlowConfig config = viscous_box(2, 12);
    change(config);
    EXPECT_NE(complaint(config).find(words), std::string::npos) << complaint(config);
  };
  expect("only an ideal gas", [](FlowConfig& c) { c.gas.law = "stiffened"; });
  expect("needs the effect fluid.euler", [](FlowConfig& c) { c.euler.reset(); });
  expect("needs the effect fluid.viscosity", [](FlowConfig& c) { c.viscosity.reset(), c.wall.x_low.emplace(); });
  expect("only reflecting sides are walls",
         [](FlowConfig& c) { c.boundary.y_low = "outflow", c.wall.y_low.emplace(); });
  expect("in its own plane only", [](FlowConfig& c) { c.wall.y_low = WallConfig{false, {}, {0, 1, 0}, {}}; });
  expect("leave out `velocity` or `slip`", [](FlowConfig& c) { c.wall.y_low = WallConfig{true, {}, {1, 0, 0}, {}}; });
  expect("no cells along z", [](FlowConfig& c) { c.wall.z_low.emplace(); });
}

}  // namespace
}  // namespace brisance::fluid
