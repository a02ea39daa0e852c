#include "fluid/grid/block.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace brisance::fluid {
namespace {

Block block_of(int dimension, CellIndex cells, Index ghost) {
  Grid grid;
  grid.dimension = dimension;
  grid.cells = cells;
  divide(grid, 64, ghost);
  return Block(grid, 0, ghost);
}

TEST(Block, RowsAreWholeVectorsOnCacheLines) {
  for (Index n : {6, 7, 8, 9, 33, 64}) {
    Block const block = block_of(3, {n, 9, 7}, 6);
    for (int q = 0; q < 5; ++q)
      for (Index k : {-6, 0, 12})
        for (Index j : {-6, 0, 14})
          EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block.component(q) + block.at(0, j, k)) % 64, 0u);
    EXPECT_GE(block.stride()[1], (n + 7) / 8 * 8 + 2 * Block::row_pad);
  }
}

TEST(Block, ArraysStartAtDifferentDistancesModuloAPage) {
  Block const block = block_of(3, {64, 64, 64}, 3);
  std::set<std::uintptr_t> distances;
  for (int q = 0; q < 5; ++q) distances.insert(reinterpret_cast<std::uintptr_t>(block.component(q)) % 4096);
  EXPECT_EQ(distances.size(), 5u);
}

TEST(Block, FillReachesEveryCellWithGhostsAndPadding) {
  Block block = block_of(3, {11, 9, 7}, 6);
  block.fill({1, 2, 3, 4, 5});
  auto const size = block.size();
  Index const padded = (size[0] + 7) / 8 * 8 + Block::row_pad;
  for (Index k = -6; k < size[2] + 6; ++k)
    for (Index j = -6; j < size[1] + 6; ++j)
      for (Index i = -Block::row_pad; i < padded; ++i) ASSERT_EQ(block.load(i, j, k), (State{1, 2, 3, 4, 5}));
}

TEST(Block, CellsDoNotOverlap) {
  Block block = block_of(2, {13, 10, 1}, 3);
  EXPECT_EQ(block.ghost(), (std::array<Index, 3>{3, 3, 0}));
  Real tag = 0;
  auto const each = [&](auto const& act) {
    tag = 0;
    for (Index j = -3; j < 13; ++j)
      for (Index i = -3; i < 16; ++i) act(i, j, tag += 5);
  };
  each([&](Index i, Index j, Real t) { block.store(i, j, 0, {t, t + 1, t + 2, t + 3, t + 4}); });
  each([&](Index i, Index j, Real t) { ASSERT_EQ(block.load(i, j, 0), (State{t, t + 1, t + 2, t + 3, t + 4})); });
}

}  // namespace
}  // namespace brisance::fluid
