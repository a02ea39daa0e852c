#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

void WallRecord::set_grid(fluid::Grid const& grid) {
  grid_ = &grid;
  lattice_ = {grid.dimension, grid.low, grid.spacing};
  map_.cover({}, uncut_fluid);
  for (CellBits& cells : facing_) cells.cover({});
  cell_volume_ = grid.cell_volume();
  for (int d = 0; d < 3; ++d) {
    face_area_[d] = grid.face_area(d);
    // 1e-8 of a cell less, so that no piece within the cells is closer.
    for (std::size_t n = 1; n <= reach && d < grid.dimension; ++n)
      gap2_[static_cast<std::size_t>(d)][n] = square((static_cast<Real>(n) - 0.5 - 1e-8) * grid.spacing[d]);
  }
}

bool WallRecord::touches(CellBox const& range) const {
  CellBox const& known = map_.range();
  CellIndex c;
  for (c[2] = std::max(range.low[2], known.low[2]); c[2] < std::min(range.high[2], known.high[2]); ++c[2])
    for (c[1] = std::max(range.low[1], known.low[1]); c[1] < std::min(range.high[1], known.high[1]); ++c[1])
      for (c[0] = std::max(range.low[0], known.low[0]); c[0] < std::min(range.high[0], known.high[0]); ++c[0])
        if (map_.at(c) != uncut_fluid) return true;
  return false;
}

}  // namespace brisance::coupling
