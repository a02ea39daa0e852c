// The nearest point of the wall to a cell centre: of the pieces in the cells around it only those are looked at that a
// bound leaves over. The bound comes from a piece nearby and decides what is looked at, never what is found.
#include <bit>
#include <limits>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

Projection WallRecord::project(CellIndex c, int direction, int side, Index& hint,
                               std::function<bool(Index)> const& eligible) const {
  Vec3 const centre = grid_->centre(c);
  Real const h = smallest_spacing(*grid_);
  Real best = std::numeric_limits<Real>::max();
  Index nearest = -1, shell = reach + 1;
  Nearest found;
  auto const faces = [&](Facet const& f) {  // the run, and has the centre behind it
    return direction < 0 || (f.faces(direction, side) && !(dot(centre - f.centroid, f.area) > 0));
  };
  // A flat piece lies within a disc about its centroid; 1e-9 less, beyond all rounding of well-shaped ones.
  auto const disc2 = [&](Facet const& f) {
    Vec3 const apart = centre - f.centroid;
    Vec3 const half{max(f.high.x - f.centroid.x, f.centroid.x - f.low.x),
                    max(f.high.y - f.centroid.y, f.centroid.y - f.low.y),
                    max(f.high.z - f.centroid.z, f.centroid.z - f.low.z)};
    Real const height2 = square(dot(apart, f.area) / (20 * f.grazing)), beside2 = norm2(apart) - height2;
    Real const radius2 = norm2(half);
    return beside2 > radius2 ? (1 - 1e-9) * (height2 + square(std::sqrt(beside2) - std::sqrt(radius2))) : 0;
  };
  auto const closest = [&](Index f, Real bound) {
    Nearest n = closest_point(lattice_, geometry, geometry.pieces[static_cast<std::size_t>(f)], centre);
    n.distance2 = max(n.distance2, bound);  // however degenerate: leaving out by bounds then changes nothing
    return n;
  };

  Nearest hinted;
  bool use_hint = false;
  if (hint >= 0 && hint < static_cast<Index>(facets_.size())) {
    auto const at = static_cast<std::size_t>(hint);
    CellIndex const& n = geometry.pieces[at].cell;
    use_hint =
        std::max({std::abs(n[0] - c[0]), std::abs(n[1] - c[1]), std::abs(n[2] - c[2])}) <= reach && faces(facets_[at]);
    if (use_hint) hinted = closest(hint, max(facets_[at].closest2(centre), disc2(facets_[at])));
    if (use_hint) best = hinted.distance2;
  }

  auto const look_into = [&](CutCell const& cell) {
    Index const distance =
        std::max({std::abs(cell.cell[0] - c[0]), std::abs(cell.cell[1] - c[1]), std::abs(cell.cell[2] - c[2])});
    for (Index f = cell.first_piece; f < cell.last_piece; ++f) {
      Facet const& facet = facets_[static_cast<std::size_t>(f)];
      Real bound = facet.closest2(centre);
      if (bound > best || !faces(facet) || (eligible && !eligible(f))) continue;
      bound = max(bound, disc2(facet));
      if (bound > best) continue;
      Nearest const n = use_hint && f == hint ? hinted : closest(f, bound);
      // Of equals the one in the inner shell, there the first one.
      if (n.distance2 < best || (n.distance2 == best && distance < shell))
        best = n.distance2, nearest = f, shell = distance, found = n;
    }
  };
  CellBits const& cells = facing_[static_cast<std::size_t>(direction < 0 ? 6 : 2 * direction + (side > 0))];
  auto const gap2 = [&](std::size_t d, Index offset) { return gap2_[d][static_cast<std::size_t>(std::abs(offset))]; };
  Index done = -1;  // all cells within are done with
  for (Index const within : {1, 2, 3, reach}) {
    Real const seen2 = square((within + 0.5) * h);  // no piece beyond these cells is closer
    Index const ry = grid_->dimension > 1 ? within : 0, rz = grid_->dimension > 2 ? within : 0;
    for (Index k = -rz; k <= rz; ++k)
      for (Index j = -ry; j <= ry; ++j) {
        Real const beside2 = gap2(2, k) + gap2(1, j);
        if (beside2 > best) continue;
        std::uint64_t row = cells.around({c[0], c[1] + j, c[2] + k}, within);
        if (std::abs(j) <= done && std::abs(k) <= done)
          row &= ~(((std::uint64_t{2} << (2 * done)) - 1) << (within - done));
        for (; row != 0; row &= row - 1) {
          Index const i = std::countr_zero(row) - within;
          if (beside2 + gap2(0, i) <= best) look_into(cut(map_.at({c[0] + i, c[1] + j, c[2] + k})));
        }
      }
    if (nearest >= 0 && best <= seen2) break;
    done = within;
  }
  if (nearest < 0) return {};
  hint = nearest;
  Piece const& piece = geometry.pieces[static_cast<std::size_t>(nearest)];
  Projection p{true, found.point, {}, wall_velocity(piece.triangle, found.bary)};
  Vec3 const towards = found.point - centre;
  p.normal = norm(towards) > 1e-9 * h ? normalized(towards) : normalized(piece.area);
  return p;
}

bool WallRecord::oblique_near(CellIndex const& c) const {
  constexpr Index within = 2;
  auto const dimension = static_cast<std::size_t>(grid_->dimension);
  // The ranks on either side of a periodic side know different walls.
  for (std::size_t d = 0; d < dimension; ++d)
    if (grid_->periodic[d] && (c[d] < within || c[d] >= grid_->cells[d] - within)) return false;
  Index const ry = dimension > 1 ? within : 0, rz = dimension > 2 ? within : 0;
  for (Index k = -rz; k <= rz; ++k)
    for (Index j = -ry; j <= ry; ++j) {
      std::uint64_t facing = 0;  // cells of the row whose pieces face an earlier direction
      for (std::size_t d = 0; d < dimension; ++d) {
        CellIndex const row{c[0], c[1] + j, c[2] + k};
        std::uint64_t const here = facing_[2 * d].around(row, within) | facing_[2 * d + 1].around(row, within);
        if (facing & here) return true;
        facing |= here;
      }
    }
  return false;
}

}  // namespace brisance::coupling
