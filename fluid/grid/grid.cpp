#include "fluid/grid/grid.hpp"

#include <algorithm>
#include <string>

#include "parallel/error.hpp"

namespace brisance::fluid {
namespace {

Index cut_before(std::vector<Index> const& cuts, Index cell) {
  return static_cast<Index>(std::upper_bound(cuts.begin(), cuts.end() - 1, cell) - cuts.begin()) - 1;
}

}  // namespace

Index Grid::block_of(CellIndex c) const {
  return block_id({cut_before(cuts[0], c[0]), cut_before(cuts[1], c[1]), cut_before(cuts[2], c[2])});
}

Index Grid::neighbour(Index block, int d, int side) const {
  std::array<Index, 3> b = block_position(block);
  Index& along = b[static_cast<std::size_t>(d)];
  Index const count = blocks_along(d);
  along += side == 0 ? -1 : 1;
  if (along < 0 || along >= count) {
    if (!periodic[static_cast<std::size_t>(d)]) return -1;
    along = (along + count) % count;
  }
  return block_id(b);
}

CellIndex Grid::block_first(Index block) const {
  std::array<Index, 3> const b = block_position(block);
  CellIndex first{};
  for (std::size_t d = 0; d < 3; ++d) first[d] = cuts[d][static_cast<std::size_t>(b[d])];
  return first;
}

CellIndex Grid::block_size(Index block) const {
  std::array<Index, 3> const b = block_position(block);
  CellIndex size{};
  for (std::size_t d = 0; d < 3; ++d)
    size[d] = cuts[d][static_cast<std::size_t>(b[d]) + 1] - cuts[d][static_cast<std::size_t>(b[d])];
  return size;
}

void divide(Grid& grid, Index largest_side, Index ghost) {
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<Index>& cuts = grid.cuts[d];
    Index const cells = grid.cells[d];
    Index count = 1;
    if (static_cast<int>(d) < grid.dimension) {
      require(cells >= ghost, Failure::scene,
              "fluid.cells[" + std::to_string(d) + "] = " + std::to_string(cells) + " is below the " +
                  std::to_string(ghost) +
                  " cells that the stencil of this order reaches. Use more cells or a lower fluid.euler.order.");
      count = std::clamp<Index>((cells + largest_side - 1) / largest_side, 1, cells / ghost);
    }
    cuts.resize(static_cast<std::size_t>(count) + 1);
    for (Index b = 0; b <= count; ++b)
      cuts[static_cast<std::size_t>(b)] = static_cast<Index>(GlobalId{cells} * b / count);
  }
}

}  // namespace brisance::fluid
