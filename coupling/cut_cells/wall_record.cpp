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

void WallRecord::rebuild() {
  // Forget the cells of the last build before the geometry that lists them is overwritten.
  for (CutCell const& c : geometry.cells)
    if (map_.range().holds(c.cell)) map_.set(c.cell, uncut_fluid);
  for (SolidRun const& run : geometry.solid)
    for (Index i = 0; i < run.count; ++i) {
      CellIndex const c{run.first[0] + i, run.first[1], run.first[2]};
      if (map_.range().holds(c)) map_.set(c, uncut_fluid);
    }
  build(lattice_, triangles, region_, geometry);
  require_closed(lattice_, geometry);

  CellBox box{
      {std::numeric_limits<Index>::max(), std::numeric_limits<Index>::max(), std::numeric_limits<Index>::max()},
      {std::numeric_limits<Index>::min(), std::numeric_limits<Index>::min(), std::numeric_limits<Index>::min()}};
  auto const enclose = [&](CellIndex c, Index count) {
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], c[d]);
      box.high[d] = std::max(box.high[d], c[d] + (d == 0 ? count : 1));
    }
  };
  for (CutCell const& c : geometry.cells) enclose(c.cell, 1);
  for (SolidRun const& run : geometry.solid) enclose(run.first, run.count);
  if (empty(box)) return;
  if (!contains(map_.range(), box)) map_.cover(grown(*grid_, box, 4), uncut_fluid);
  for (SolidRun const& run : geometry.solid)
    for (Index i = 0; i < run.count; ++i) map_.set({run.first[0] + i, run.first[1], run.first[2]}, uncut_solid);
  for (std::size_t i = 0; i < geometry.cells.size(); ++i) map_.set(geometry.cells[i].cell, static_cast<Index>(i));
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
