#include "fluid/flow.hpp"

#include <gtest/gtest.h>

#include "fluid/initial_state.hpp"
#include "parallel/comm.hpp"
#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

/// Sweeps one block as the kernel would, and notes what it was shown.
struct Spy : BlockSweeper {
  Spy(Flow& flow_, Index mine_) : flow(flow_), mine(mine_) {}
  bool handles(Index block) const override { return block == mine; }
  bool is_fluid(Block const&, Index, Index, Index) const override { return true; }
  void prepare(int direction, Real) override {
    ++prepared;
    // A state set here, in the block's last cells, must reach the ghosts of its neighbours.
    if (direction == 0) flow.find(mine)->store(flow.find(mine)->size()[0] - 1, 2, 0, mark);
  }
  SweepReport sweep(Block& block, int direction, Real dt) override {
    EXPECT_EQ(block.id(), mine);
    ++swept;
    SweepReport report =
        sweep_box(flow.order(), box_of(block, 2), direction, dt / flow.grid().spacing[direction], flow.gas());
    report.health = health;
    report.where = {1, 2, 0};
    return report;
  }
  Flow& flow;
  Index mine;
  State mark{1.5, 0, 0, 0, 2.5};
  std::uint64_t health = 0;
  int prepared = 0, swept = 0;
};

FlowConfig two_blocks() {
  FlowConfig config = testing::unit_box(2, 16);
  config.block = 8;
  return config;
}

TEST(Flow, ASweeperActsOnItsBlocksAfterItPreparedTheirStates) {
  auto const comm = parallel::serial();
  FlowConfig const config = two_blocks();
  auto const flow = testing::make_flow(config, *comm);
  Spy spy(*flow, 0);
  flow->set_sweeper(&spy);
  flow->sweep(0, 1e-3);
  EXPECT_EQ(spy.prepared, 1);
  EXPECT_EQ(spy.swept, 1);
  EXPECT_EQ(flow->find(1)->load(-1, 2, 0), spy.mark);
  // The sides of its block are its own affair: only block 2 reports to the ledger at x_low, with the impulse p dt dy.
  BoundaryLedger::Totals const crossed = flow->ledger().totals(*comm);
  EXPECT_NEAR(crossed.through[0][1], 1e-3 * 0.5, 1e-15);
  EXPECT_NEAR(crossed.through[1][1], -1e-3, 1e-15);
  EXPECT_NEAR(crossed.impulse, 1.5e-3, 1e-15);
  flow->sweep(1, 1e-3);
  EXPECT_EQ(spy.swept, 2);
}

TEST(Flow, ReportsTheFirstBadCellByItsGlobalIndex) {
  auto const comm = parallel::serial();
  FlowConfig const config = two_blocks();
  auto const flow = testing::make_flow(config, *comm);
  Spy spy(*flow, 3);
  spy.mark = {1, 0, 0, 0, 2.5};
  spy.health = 4;
  flow->set_sweeper(&spy);
  SweepReport report = flow->sweep(0, 1e-3);
  EXPECT_EQ(report.health, 4u);
  EXPECT_EQ(report.where, (CellIndex{9, 10, 0}));
  flow->find(2)->store(3, 1, 0, {1, 0, 0, 0, -1});
  report = flow->sweep(1, 1e-3);
  EXPECT_NE(report.health & static_cast<std::uint64_t>(Health::negative_energy), 0u);
  EXPECT_EQ(report.where[0], 3);
  EXPECT_LE(report.where[1], 9);
}

TEST(Flow, FindsOnlyItsOwnBlocks) {
  auto const comm = parallel::serial();
  FlowConfig const config = two_blocks();
  Grid const grid = make_grid(config);
  Flow flow(config, grid, {0, 1, 0, 1}, *comm);
  ASSERT_EQ(flow.blocks().size(), 2u);
  EXPECT_EQ(flow.find(2), &flow.blocks()[1]);
  EXPECT_EQ(flow.find(1), nullptr);
  EXPECT_EQ(flow.owner(3), 1);
}

TEST(BoundaryLedger, TakeGivesWhatCameSinceTheLastTake) {
  auto const comm = parallel::serial();
  BoundaryLedger ledger;
  ledger.add(1, 0, 0.5, 2, {1, 2, -3, 4, 5});
  ledger.add(1, 1, 0.5, 2, {0.25, 0, 0, 0, 1});
  BoundaryLedger::Crossed crossed = ledger.take();
  EXPECT_EQ(crossed.gained[0].value(), 0.75);
  EXPECT_EQ(crossed.gained[4].value(), 4);
  EXPECT_EQ(crossed.energy_size.value(), 6);
  EXPECT_EQ(crossed.impulse.value(), 3);
  EXPECT_EQ(ledger.take().energy_size.value(), 0);
  EXPECT_EQ(ledger.totals(*comm).through[3][4], -1);
  EXPECT_EQ(ledger.totals(*comm).gained[4], 4);
}

}  // namespace
}  // namespace brisance::fluid
