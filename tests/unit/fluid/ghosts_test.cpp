#include "fluid/ghosts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "fluid/initial_state.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

State tagged(Grid const& grid, CellIndex c) {
  Real const t = 1 + static_cast<Real>(grid.cell_id(c));
  return {t, t + 0.125, t + 0.25, t + 0.375, t + 0.5};
}

/// Every ghost in the transverse range of every block holds what the one grid without blocks would say.
void expect_ghosts(FlowConfig const& config) {
  auto const flow = testing::make_flow(config, testing::comm());
  Grid const& grid = flow->grid();
  fill(*flow, [&](CellIndex c) { return tagged(grid, c); });
  for (int d = 0; d < grid.dimension; ++d) {
    flow->ghosts().start(d);
    flow->ghosts().finish(d);
    std::size_t const s = static_cast<std::size_t>(d);
    for (Block const& block : flow->blocks()) {
      CellIndex low{0, 0, 0}, high = block.size();
      low[s] -= block.ghost()[s];
      high[s] += block.ghost()[s];
      for (Index k = low[2]; k < high[2]; ++k)
        for (Index j = low[1]; j < high[1]; ++j)
          for (Index i = low[0]; i < high[0]; ++i) {
            CellIndex c{block.first()[0] + i, block.first()[1] + j, block.first()[2] + k};
            Index const n = grid.cells[s];
            bool mirrored = false;
            if (grid.periodic[s]) c[s] = (c[s] + n) % n;
            if (c[s] < 0) mirrored = true, c[s] = -1 - c[s];
            if (c[s] >= n) mirrored = true, c[s] = 2 * n - 1 - c[s];
            State expected = tagged(grid, c);
            if (mirrored) expected[1 + s] = -expected[1 + s];
            ASSERT_EQ(block.load(i, j, k), expected) << "block " << block.id() << " direction " << d;
          }
    }
  }
}

TEST(Ghosts, EqualTheCellsOfTheGridInOneTwoAndThreeDimensions) {
  for (int dimension : {1, 2, 3})
    for (int order : {5, 11})
      for (int block : {7, 13, 48})
        for (char const* law : {"reflecting", "periodic"}) {
          FlowConfig config = testing::unit_box(dimension, 27);
          config.euler->order = order;
          config.block = block;
          testing::set_boundaries(config, law);
          expect_ghosts(config);
        }
}

TEST(Ghosts, BlocksAreEitherReadyOrWaiting) {
  FlowConfig config = testing::unit_box(2, 40);
  config.block = 10;
  auto const flow = testing::make_flow(config, testing::comm());
  for (int d = 0; d < 2; ++d) {
    std::set<std::size_t> all(flow->ghosts().ready(d).begin(), flow->ghosts().ready(d).end());
    all.insert(flow->ghosts().waiting(d).begin(), flow->ghosts().waiting(d).end());
    EXPECT_EQ(all.size(), flow->blocks().size());
    EXPECT_EQ(flow->ghosts().ready(d).size() + flow->ghosts().waiting(d).size(), flow->blocks().size());
    EXPECT_TRUE(testing::comm().size() > 1 || flow->ghosts().waiting(d).empty());
  }
}

TEST(Ghosts, SentCellsMayChangeBetweenStartAndFinish) {
  FlowConfig config = testing::unit_box(2, 40);
  config.block = 10;
  testing::set_boundaries(config, "periodic");
  auto const flow = testing::make_flow(config, testing::comm());
  Grid const& grid = flow->grid();
  fill(*flow, [&](CellIndex c) { return tagged(grid, c); });
  flow->ghosts().start(0);
  fill(*flow, [&](CellIndex) { return State{}; });
  flow->ghosts().finish(0);
  for (Block const& block : flow->blocks()) {
    CellIndex const c{(block.first()[0] + 39) % 40, block.first()[1] + 4, 0};
    EXPECT_EQ(block.load(-1, 4, 0), tagged(grid, c));
  }
}

}  // namespace
}  // namespace brisance::fluid
