// What a boundary law may know of the ghost it makes.
#pragma once
#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// A ghost cell beyond a side of the domain.
struct GhostCell {
  int direction;       ///< 0, 1, 2: axis the side is normal to
  int side;            ///< 0 low, 1 high
  CellIndex global{};  ///< its place on the grid, continued beyond the side
  /// +1 where +direction points out of the domain, else -1.
  Real outwards() const { return side == 0 ? -1 : 1; }
  /// Component of a State that holds the momentum normal to the side.
  std::size_t normal() const { return 1 + static_cast<std::size_t>(direction); }
};

}  // namespace brisance::fluid
