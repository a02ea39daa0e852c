// Small helpers on cells of the grid shared by the files of this folder.
#pragma once
#include <algorithm>
#include <cmath>

#include "coupling/geometry/cell_map.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::coupling {

inline Real smallest_spacing(fluid::Grid const& grid) {
  Real h = grid.spacing.x;
  for (int d = 1; d < grid.dimension; ++d) h = min(h, grid.spacing[d]);
  return h;
}

/// The part of v that lies in the plane across `normal`, which may have any length.
inline Vec3 beside(Vec3 const& normal, Vec3 const& v) {
  Real const n2 = norm2(normal);
  return n2 > 0 ? v - dot(v, normal) / n2 * normal : Vec3{};
}

inline CellIndex cell_of(fluid::Grid const& grid, Vec3 const& x) {
  CellIndex c{0, 0, 0};
  for (int d = 0; d < grid.dimension; ++d)
    c[static_cast<std::size_t>(d)] = static_cast<Index>(std::floor((x[d] - grid.low[d]) / grid.spacing[d]));
  return c;
}

inline CellIndex cell_from_id(fluid::Grid const& grid, GlobalId id) {
  GlobalId const nx = grid.cells[0], ny = grid.cells[1];
  return {static_cast<Index>(id % nx), static_cast<Index>(id / nx % ny), static_cast<Index>(id / (nx * ny))};
}

inline CellBox grown(fluid::Grid const& grid, CellBox r, Index by) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(grid.dimension); ++d) r.low[d] -= by, r.high[d] += by;
  return r;
}

inline CellBox box_of(fluid::Block const& block) {
  CellIndex const first = block.first();
  return {first, {first[0] + block.size()[0], first[1] + block.size()[1], first[2] + block.size()[2]}};
}

/// Calls visit(c) for the cells within `reach` of `centre` in the directions the grid has, in fixed order.
template <class Visit>
void for_neighbourhood(fluid::Grid const& grid, CellIndex centre, Index reach, Visit&& visit) {
  Index const ry = grid.dimension > 1 ? reach : 0, rz = grid.dimension > 2 ? reach : 0;
  for (Index k = -rz; k <= rz; ++k)
    for (Index j = -ry; j <= ry; ++j)
      for (Index i = -reach; i <= reach; ++i) visit(CellIndex{centre[0] + i, centre[1] + j, centre[2] + k});
}

/// Calls visit(c) for the cells at exactly `distance` cells (largest of the directions) from `centre`, in fixed order.
template <class Visit>
void for_shell(fluid::Grid const& grid, CellIndex centre, Index distance, Visit&& visit) {
  Index const ry = grid.dimension > 1 ? distance : 0, rz = grid.dimension > 2 ? distance : 0;
  for (Index k = -rz; k <= rz; ++k)
    for (Index j = -ry; j <= ry; ++j) {
      bool const whole_row = distance == 0 || (rz > 0 && std::abs(k) == rz) || (ry > 0 && std::abs(j) == ry);
      for (Index i = -distance; i <= distance; i += whole_row ? 1 : 2 * distance)
        visit(CellIndex{centre[0] + i, centre[1] + j, centre[2] + k});
    }
}

/// The cell itself, its periodic image, or nearest cell inside.
inline CellIndex into_domain(fluid::Grid const& grid, CellIndex c) {
  for (std::size_t d = 0; d < 3; ++d) {
    Index const n = grid.cells[d];
    if (grid.periodic[d])
      c[d] = ((c[d] % n) + n) % n;
    else
      c[d] = std::clamp<Index>(c[d], 0, n - 1);
  }
  return c;
}

}  // namespace brisance::coupling
