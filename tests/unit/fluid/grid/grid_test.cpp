#include "fluid/grid/grid.hpp"

#include <gtest/gtest.h>

#include "parallel/error.hpp"

namespace brisance::fluid {
namespace {

Grid grid_of(CellIndex cells, int dimension, Index largest, Index ghost) {
  Grid grid;
  grid.dimension = dimension;
  grid.cells = cells;
  divide(grid, largest, ghost);
  return grid;
}

TEST(Divide, SidesAreNearEqualAndWithinTheirLimits) {
  for (Index ghost : {2, 3, 6})
    for (Index largest : {16, 24, 48, 64})
      for (Index n = ghost; n < 300; ++n) {
        Grid const grid = grid_of({n, 1, 1}, 1, largest, ghost);
        auto const& cuts = grid.cuts[0];
        ASSERT_EQ(cuts.front(), 0);
        ASSERT_EQ(cuts.back(), n);
        Index smallest = n, widest = 0;
        for (std::size_t b = 1; b < cuts.size(); ++b) {
          smallest = std::min(smallest, cuts[b] - cuts[b - 1]);
          widest = std::max(widest, cuts[b] - cuts[b - 1]);
        }
        ASSERT_LE(widest, largest);
        ASSERT_GE(smallest, ghost);
        ASSERT_LE(widest - smallest, 1);
      }
}

TEST(Divide, AbsentDirectionsHaveOneCellAndOneBlock) {
  Grid const grid = grid_of({100, 40, 1}, 2, 32, 3);
  EXPECT_EQ(grid.blocks_along(0), 4);
  EXPECT_EQ(grid.blocks_along(1), 2);
  EXPECT_EQ(grid.blocks_along(2), 1);
}

TEST(Divide, TheGhostDepthWinsOverTheLargestSide) {
  Grid const grid = grid_of({7, 1, 1}, 1, 6, 6);
  EXPECT_EQ(grid.blocks_along(0), 1);
}

TEST(Divide, FewerCellsThanTheStencilIsASceneError) {
  try {
    grid_of({100, 5, 1}, 2, 64, 6);
    FAIL();
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    EXPECT_NE(std::string(e.what()).find("fluid.cells[1] = 5"), std::string::npos) << e.what();
  }
}

TEST(Grid, BlockOfFindsTheBlockThatHoldsACell) {
  Grid const grid = grid_of({50, 31, 20}, 3, 16, 3);
  for (Index b = 0; b < grid.block_count(); ++b) {
    CellIndex const first = grid.block_first(b), size = grid.block_size(b);
    EXPECT_EQ(grid.block_of(first), b);
    EXPECT_EQ(grid.block_of({first[0] + size[0] - 1, first[1] + size[1] - 1, first[2] + size[2] - 1}), b);
  }
}

TEST(Grid, NeighboursAreMutualAndPeriodicOnlyWhereAsked) {
  Grid grid = grid_of({50, 31, 20}, 3, 16, 3);
  grid.periodic = {false, true, false};
  for (Index b = 0; b < grid.block_count(); ++b)
    for (int d = 0; d < 3; ++d)
      for (int side = 0; side < 2; ++side) {
        Index const n = grid.neighbour(b, d, side);
        Index const along = grid.block_position(b)[static_cast<std::size_t>(d)];
        bool const at_end = along == (side == 0 ? 0 : grid.blocks_along(d) - 1);
        EXPECT_EQ(n < 0, at_end && d != 1);
        if (n >= 0) {
          EXPECT_EQ(grid.neighbour(n, d, 1 - side), b);
        }
      }
}

}  // namespace
}  // namespace brisance::fluid
