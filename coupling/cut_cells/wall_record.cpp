#include "coupling/cut_cells/wall_record.hpp"

#include <limits>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/geometry/nearest.hpp"

namespace brisance::coupling {

void WallRecord::set_grid(fluid::Grid const& grid) {
  grid_ = &grid;
  lattice_ = {grid.dimension, grid.low, grid.spacing};
  map_.cover({}, uncut_fluid);
  cell_volume_ = grid.cell_volume();
  for (int d = 0; d < 3; ++d) face_area_[d] = grid.face_area(d);
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

Projection WallRecord::project(CellIndex c, int direction, int side) const {
  constexpr Index reach = 6;
  Vec3 const centre = grid_->centre(c);
  Real const h = smallest_spacing(*grid_);
  Real best = std::numeric_limits<Real>::max();
  Piece const* nearest = nullptr;
  Nearest found;
  for (Index shell = 0; shell <= reach; ++shell) {
    for_shell(*grid_, c, shell, [&](CellIndex n) {
      Index const i = cut_index(n);
      if (i < 0) return;
      Real gap = 0;  // squared distance to the cell: a lower bound for its pieces
      for (int d = 0; d < grid_->dimension; ++d) {
        auto const at = static_cast<std::size_t>(d);
        gap += square(max(0, std::abs(n[at] - c[at]) - 0.5 - 1e-9) * grid_->spacing[d]);
      }
      if (gap > best) return;
      for (Index f = cut(i).first_piece; f < cut(i).last_piece; ++f) {
        Piece const& piece = geometry.pieces[static_cast<std::size_t>(f)];
        if (direction >= 0) {
          if (piece.area[direction] * side <= 0.05 * norm(piece.area)) continue;
          if (dot(centre - piece.centroid, piece.area) > 0) continue;
        }
        Nearest const candidate = closest_point(lattice_, geometry, piece, centre);
        if (candidate.distance2 < best) best = candidate.distance2, nearest = &piece, found = candidate;
      }
    });
    if (nearest && std::sqrt(best) <= (shell + 0.5) * h) break;
  }
  if (!nearest) return {};
  Projection p{true, found.point, {}, wall_velocity(nearest->triangle, found.bary)};
  Vec3 const towards = found.point - centre;
  p.normal = norm(towards) > 1e-9 * h ? normalized(towards) : normalized(nearest->area);
  return p;
}

}  // namespace brisance::coupling
