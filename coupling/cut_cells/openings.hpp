// What a part of a cell opens to.
#pragma once
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// The cell so many further along a direction.
inline CellIndex beside(CellIndex c, int direction, int by) {
  c[static_cast<std::size_t>(direction)] += by;
  return c;
}

/// Calls visit(neighbour, its part, direction, area) for what a part of a cell opens to.
template <class Visit>
void for_openings(WallRecord const& record, CellIndex c, std::size_t part, Visit&& visit) {
  for (int d = 0; d < record.lattice().dimension; ++d)
    for (int side = 0; side < 2; ++side) {
      CellIndex const other = beside(c, d, side == 0 ? -1 : 1), low = side == 0 ? other : c;
      if (!record.parts.find(c) && !record.parts.find(other)) {
        Real const area = record.aperture(c, d, side);
        if (area > 0) visit(other, std::size_t{0}, d, area);
        continue;
      }
      for (Opening const& o : record.parts.through(low, d))
        if ((side == 0 ? o.high_part : o.low_part) == part)
          visit(other, std::size_t{side == 0 ? o.low_part : o.high_part}, d, o.area);
    }
}

}  // namespace brisance::coupling
