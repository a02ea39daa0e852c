#include "fluid/rows.hpp"

#include <gtest/gtest.h>

#include "fluid/initial_state.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

State tagged(Grid const& grid, CellIndex c) {
  Real const t = 1 + static_cast<Real>(grid.cell_id(c));
  return {t, t / 2, t / 4, 0, 10 * t};
}

TEST(CellRows, NumberTheCellsOfAllBlocksOnceAndComeBackUnchanged) {
  FlowConfig config = testing::unit_box(2, 30);
  config.block = 11;
  auto const flow = testing::make_flow(config, testing::comm());
  Grid const& grid = flow->grid();
  fill(*flow, [&](CellIndex c) { return tagged(grid, c); });
  auto const ranges = block_rows(*flow);
  ASSERT_EQ(ranges.size(), flow->blocks().size());
  std::int64_t rows = 0, expected_first = 0;
  std::size_t mine = 0;
  for (Index b = 0; b < grid.block_count(); ++b) {
    std::int64_t const count = std::int64_t{grid.block_size(b)[0]} * grid.block_size(b)[1];
    if (flow->owner(b) == testing::comm().rank()) {
      EXPECT_EQ(ranges[mine].first, expected_first);
      EXPECT_EQ(ranges[mine++].count, count);
      rows += count;
    }
    expected_first += count;
  }
  std::vector<double> const data = pack_cells(*flow);
  ASSERT_EQ(data.size(), static_cast<std::size_t>(5 * rows));
  fill(*flow, [&](CellIndex) { return State{}; });
  unpack_cells(*flow, data);
  for (Block const& block : flow->blocks())
    for (Index j = 0; j < block.size()[1]; ++j)
      for (Index i = 0; i < block.size()[0]; ++i)
        ASSERT_EQ(block.load(i, j, 0), tagged(grid, {block.first()[0] + i, block.first()[1] + j, 0}));
}

}  // namespace
}  // namespace brisance::fluid
