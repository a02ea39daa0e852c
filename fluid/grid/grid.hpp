// The global Cartesian grid and its division into blocks: a function of the scene, never of the number of ranks.
#pragma once
#include <array>
#include <vector>

#include "core/base/real.hpp"
#include "core/base/vec3.hpp"

namespace brisance::fluid {

using CellIndex = std::array<Index, 3>;  ///< global cell (i, j, k)
using State = std::array<Real, 5>;       ///< density, momentum (3), total energy: per volume

/// Uniform cells of a box. Absent directions (2D: z, 1D: y and z) have one cell of unit size and no ghosts.
/// Units: m.
struct Grid {
  int dimension = 3;
  CellIndex cells{1, 1, 1};
  Vec3 low{};             ///< corner of the box
  Vec3 spacing{1, 1, 1};  ///< cell sizes
  std::array<bool, 3> periodic{};
  std::array<std::vector<Index>, 3> cuts;  ///< first cells of the blocks along each axis, then the number of cells

  Index blocks_along(int d) const { return static_cast<Index>(cuts[static_cast<std::size_t>(d)].size()) - 1; }
  Index block_count() const { return blocks_along(0) * blocks_along(1) * blocks_along(2); }
  GlobalId cell_count() const { return GlobalId{cells[0]} * cells[1] * cells[2]; }
  GlobalId cell_id(CellIndex c) const { return c[0] + GlobalId{cells[0]} * (c[1] + GlobalId{cells[1]} * c[2]); }
  bool inside(CellIndex c) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] >= cells[d]) return false;
    return true;
  }
  Vec3 centre(CellIndex c) const {
    return {low.x + (c[0] + 0.5) * spacing.x, low.y + (c[1] + 0.5) * spacing.y, low.z + (c[2] + 0.5) * spacing.z};
  }
  Real cell_volume() const { return spacing.x * spacing.y * spacing.z; }
  Real face_area(int d) const { return cell_volume() / spacing[d]; }
  Index block_id(std::array<Index, 3> b) const { return b[0] + blocks_along(0) * (b[1] + blocks_along(1) * b[2]); }
  std::array<Index, 3> block_position(Index id) const {
    Index const nx = blocks_along(0), ny = blocks_along(1);
    return {id % nx, id / nx % ny, id / (nx * ny)};
  }
  Index block_of(CellIndex c) const;  ///< block that holds an inside cell
  /// Block beyond the low (side 0) or high (1) end of `block` in direction d, itself when it is its own periodic image;
  /// -1 at a side of the domain.
  Index neighbour(Index block, int d, int side) const;
  CellIndex block_first(Index block) const;  ///< its first cell
  CellIndex block_size(Index block) const;   ///< its number of cells along each axis
};

/// Sets the cuts: blocks of near-equal sides, each at most `largest_side` cells and at least `ghost` cells; where both
/// cannot hold, sides exceed `largest_side`.  Errors: scene error when a side of the grid is below the ghost depth.
void divide(Grid& grid, Index largest_side, Index ghost);

}  // namespace brisance::fluid
