// Sleeping blocks change no bit: neither of the cells nor of what is told about them, on any number of ranks.
#include <gtest/gtest.h>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

struct Result {
  std::string digest;
  State through{};
  Real impulse = 0, energy = 0, courant = 0, time = 0;
  std::int64_t fallback_faces = 0, rejected = 0;
  bool operator==(Result const&) const = default;
};

struct Case {
  Result result;
  Real share = 0;  // of the cell-sweeps that were skipped
};

Case run(FlowConfig config, bool sleep, std::int64_t steps) {
  config.sleep = sleep;
  parallel::Comm& comm = testing::comm();
  auto const flow = testing::make_flow(config, comm);
  fill(*flow, config);
  FlowClock clock;
  advance(*flow, clock, {.end = 1e9, .cfl = config.euler->cfl, .steps = steps});
  parallel::Digest digest;
  add_cells(digest, *flow);
  comm.sum(digest);
  Flow::Saved const saved = flow->saved_by_sleep();
  std::int64_t counts[2] = {saved.cell_sweeps_skipped, saved.cell_sweeps};
  comm.sum(std::span(counts));
  BoundaryLedger::Totals const crossed = flow->ledger().totals(comm);
  return {{digest.hex(), crossed.gained, crossed.impulse, totals(*flow).energy, clock.courant_max, clock.time,
           clock.fallback_faces, clock.retry.rejected()},
          static_cast<Real>(counts[0]) / static_cast<Real>(counts[1])};
}

/// The share of work saved, after a comparison of all that is told with the same run awake.
Real saved_share(FlowConfig const& config, std::int64_t steps = 12) {
  Case const asleep = run(config, true, steps), awake = run(config, false, steps);
  EXPECT_EQ(asleep.result.digest, awake.result.digest);
  EXPECT_TRUE(asleep.result == awake.result);
  EXPECT_EQ(awake.share, 0);
  return asleep.share;
}

RegionConfig ball(Vec3 centre, Real radius, Real density, Real pressure) {
  RegionConfig region;
  region.shape = "ball";
  region.centre = centre;
  region.radius = radius;
  region.density = density;
  region.pressure = pressure;
  return region;
}

/// Blocks of 8 cells and a blast in the middle of one of them: most of the box has not heard of it after 12 steps.
FlowConfig blast(int dimension, int order, Vec3 velocity = {}) {
  FlowConfig config = testing::unit_box(dimension, dimension == 3 ? 40 : dimension == 2 ? 96 : 400);
  config.block = 8;
  config.euler->order = order;
  for (int d = 0; d < dimension; ++d) config.ambient.velocity[d] = velocity[d];
  Real const h = 1.0 / config.cells[0];
  config.region = {ball({12 * h, 12 * h, 12 * h}, 2.5 * h, 5, 100)};
  return config;
}

TEST(Sleep, ABlastInABoxWithWalls) {
  EXPECT_GT(saved_share(blast(1, 5)), 0.8);
  EXPECT_GT(saved_share(blast(2, 1)), 0.8);
  EXPECT_GT(saved_share(blast(2, 5)), 0.7);
  EXPECT_GT(saved_share(blast(2, 11)), 0.5);
  EXPECT_GT(saved_share(blast(3, 5), 6), 0.5);
}

TEST(Sleep, APeriodicBoxInWhichAllTheGasMoves) {
  for (int dimension : {1, 2, 3}) {
    FlowConfig config = blast(dimension, 5, {0.4, -0.7, 0.2});
    testing::set_boundaries(config, "periodic");
    EXPECT_GT(saved_share(config, 6), 0.4) << dimension;
  }
}

TEST(Sleep, GasThatRunsAgainstAWallWakesTheBlocksThere) {
  FlowConfig config = testing::unit_box(2, 64);
  config.block = 8;
  config.ambient.velocity = {0.5, 0, 0};
  Real const share = saved_share(config, 6);
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 0.9);
  config.boundary.y_low = config.boundary.y_high = "periodic";
  config.boundary.x_low = config.boundary.x_high = "outflow";
  EXPECT_EQ(saved_share(config, 6), 1) << "nothing ever happens";
}

TEST(Sleep, AnInflowOfTheGasThatIsThereAndOfAnother) {
  FlowConfig config = testing::unit_box(2, 64);
  config.block = 8;
  config.ambient.velocity = {0.5, 0, 0};
  config.boundary.x_low = "inflow";
  config.boundary.x_high = "outflow";
  config.inflow.x_low = config.ambient;
  EXPECT_EQ(saved_share(config, 6), 1);
  config.inflow.x_low->pressure = 1.5;
  Real const share = saved_share(config, 6);
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 1);
}

TEST(Sleep, AnInflowThatChangesWithTimeWakesItsSideWhenItDoes) {
  FlowConfig config = testing::unit_box(2, 64);
  config.block = 8;
  config.ambient.velocity = {0.5, 0, 0};
  config.boundary.x_low = "inflow";
  config.boundary.x_high = "outflow";
  TimedState still;
  still.density = still.pressure = 1;
  still.velocity = config.ambient.velocity;
  TimedState later = still, risen = still;
  later.time = 0.02;
  risen.time = 0.03;
  risen.pressure = 1.4;
  config.inflow.x_low.emplace().history = {still, later, risen};
  EXPECT_EQ(saved_share(config, 4), 1);
  Real const share = saved_share(config, 20);
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 1);
}

TEST(Sleep, APatchOfASideWakesTheBlocksBesideItAlone) {
  FlowConfig config = testing::unit_box(2, 64);
  config.block = 8;
  config.ambient.velocity = {0.5, 0, 0};
  config.boundary.x_low = config.boundary.x_high = "outflow";
  PatchConfig patch;
  patch.side = "x_high";
  patch.law = "reflecting";
  patch.low = Vec3{0, 0.3, 0};
  patch.high = Vec3{1, 0.4, 0};
  config.patch = {patch};
  Real const share = saved_share(config, 6);
  EXPECT_GT(share, 0.7);
  EXPECT_LT(share, 1);
}

TEST(Sleep, VacuumSleepsUntilGasArrives) {
  for (int dimension : {1, 2}) {
    FlowConfig config = blast(dimension, 5);
    config.ambient = {0, 0, {}};
    Real const share = saved_share(config, 40);
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 1);
  }
}

TEST(Sleep, ABlockThatBecomesUniformSleepsAgain) {
  auto const flow = testing::make_flow(blast(2, 5), testing::comm());
  auto const skipped = [&] { return flow->saved_by_sleep().block_sweeps_skipped; };
  auto const blocks = static_cast<std::int64_t>(std::as_const(*flow).blocks().size());
  Index const last = flow->grid().block_count() - 1;
  bool const mine = flow->owner(last) == flow->comm().rank();
  if (mine) flow->find(last)->store(4, 4, 0, {1, 0, 0, 0, 2.6});
  flow->sweep(0, 1e-4);
  EXPECT_EQ(skipped(), blocks - mine) << "the waves are still inside one block";
  if (mine) flow->find(last)->fill(flow->gas().conserved(1, {}, 1));
  flow->sweep(1, 1e-4);
  EXPECT_EQ(skipped(), 2 * blocks - mine);
}

TEST(Sleep, ARejectedPairIsTakenBackWhereItWokeBlocks) {
  FlowConfig config = blast(2, 5);
  config.euler->cfl = 1.6;  // beyond what a scene may ask for: pairs after the slow start are rejected
  EXPECT_GT(run(config, true, 40).result.rejected, 3);
  EXPECT_GT(saved_share(config, 40), 0.3);
}

TEST(Sleep, CellsWrittenFromOutsideWakeTheirBlock) {
  FlowConfig const config = blast(2, 5);
  Result results[2];
  for (bool const sleep : {true, false}) {
    FlowConfig c = config;
    c.sleep = sleep;
    auto const flow = testing::make_flow(c, testing::comm());
    fill(*flow, c);
    for (int s = 0; s < 6; ++s) flow->sweep(s % 2, 1e-4);
    Index const far = flow->grid().block_count() - 1;
    if (Block* const block = flow->find(far)) block->store(3, 3, 0, {1, 0.1, 0, 0, 3});
    for (int s = 0; s < 6; ++s) flow->sweep(s % 2, 1e-4);
    parallel::Digest digest;
    add_cells(digest, *flow);
    testing::comm().sum(digest);
    results[sleep].digest = digest.hex();
  }
  EXPECT_EQ(results[0].digest, results[1].digest);
}

TEST(Sleep, AnEffectCanKeepAllAwake) {
  auto const flow = testing::make_flow(blast(2, 5), testing::comm());
  flow->sweep(0, 1e-4);
  std::int64_t const skipped = flow->saved_by_sleep().block_sweeps_skipped;
  EXPECT_GT(skipped, 0);
  flow->keep_awake();
  flow->sweep(1, 1e-4);
  EXPECT_EQ(flow->saved_by_sleep().block_sweeps_skipped, skipped);
}

}  // namespace
}  // namespace brisance::fluid
