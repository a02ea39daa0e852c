#include "coupling/cut_cells/wall_centroids.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::coupling {
namespace {

/// Corner of a piece, m from the centre of its cell.
Vec3 from_centre(Corner const& corner, CellIndex const& c, Vec3 const& h) {
  return {(corner.point.x - c[0] - 0.5) * h.x, (corner.point.y - c[1] - 0.5) * h.y,
          (corner.point.z - c[2] - 0.5) * h.z};
}

/// Mean of x^2 over a segment from a to b.
Real mean_square(Real a, Real b) { return (a * a + a * b + b * b) / 3; }
/// Over a triangle.
Real mean_square(Real a, Real b, Real c) { return (a * a + b * b + c * c + a * b + a * c + b * c) / 6; }

Vec3 mean_square(Vec3 const& a, Vec3 const& b) {
  return {mean_square(a.x, b.x), mean_square(a.y, b.y), mean_square(a.z, b.z)};
}
Vec3 mean_square(Vec3 const& a, Vec3 const& b, Vec3 const& c) {
  return {mean_square(a.x, b.x, c.x), mean_square(a.y, b.y, c.y), mean_square(a.z, b.z, c.z)};
}

/// Moment about the centre of a face of its open part, over the pieces of one of the two cells beside it.
Vec3 face_moment(WallRecord const& record, CutCell const& cut, int d, int side) {
  fluid::Grid const& grid = record.grid();
  Vec3 const h = grid.spacing;
  auto const dir = static_cast<std::size_t>(d);
  Real const plane = static_cast<Real>(cut.cell[dir] + side);
  Vec3 axis;
  axis[d] = 1;
  Vec3 moment;
  auto const add = [&](Vec3 const& open, Vec3 const& mean) {  // an edge, with its length on the side of the fluid
    for (int t = 0; t < grid.dimension; ++t)
      if (t != d) moment[t] += 0.5 * open[t] * (0.25 * square(h[t]) - mean[t]);
  };
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
    auto const corners = record.geometry.corners_of(piece);
    auto const inside = [&](Corner const& c) { return c.point[d] == plane; };
    if (grid.dimension == 2) {
      if (inside(corners[0]) == inside(corners[1])) continue;
      Vec3 const x = from_centre(inside(corners[0]) ? corners[0] : corners[1], cut.cell, h);
      Vec3 open;
      for (int t = 0; t < 2; ++t) open[t] = std::copysign(h.z, piece.area[t]);
      add(open, mean_square(x, x));
      continue;
    }
    if (std::all_of(corners.begin(), corners.end(), inside)) continue;  // along the plane: it has no edge across it
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Corner const &p = corners[i], &q = corners[i + 1 == corners.size() ? 0 : i + 1];
      if (!inside(p) || !inside(q)) continue;
      Vec3 const a = from_centre(p, cut.cell, h), b = from_centre(q, cut.cell, h);
      Vec3 open = cross(axis, b - a);
      if (dot(open, piece.area) < 0) open = -open;
      add(open, mean_square(a, b));
    }
  }
  return moment;
}

}  // namespace

Vec3 fluid_centroid(WallRecord const& record, CellIndex c) {
  Index const index = record.cut_index(c);
  if (index < 0) return {};
  fluid::Grid const& grid = record.grid();
  CutCell const& cut = record.cut(index);
  Vec3 const h = grid.spacing;
  if (cut.volume <= covered_fraction * grid.cell_volume()) return {};
  Vec3 moment;
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
    auto const corners = record.geometry.corners_of(piece);
    Vec3 const o = from_centre(corners[0], c, h);
    Vec3 mean;
    if (grid.dimension == 2) {
      mean = mean_square(o, from_centre(corners[1], c, h));
    } else {
      Real size = 0;
      for (std::size_t v = 1; v + 1 < corners.size(); ++v) {
        Vec3 const a = from_centre(corners[v], c, h), b = from_centre(corners[v + 1], c, h);
        Real const part = norm(cross(a - o, b - o));
        size += part;
        mean += part * mean_square(o, a, b);
      }
      if (!(size > 0)) continue;
      mean = mean / size;
    }
    for (int d = 0; d < grid.dimension; ++d) moment[d] += 0.5 * piece.area[d] * (0.25 * square(h[d]) - mean[d]);
  }
  Vec3 centroid = moment / cut.volume;
  Real const room = 0.5 * (1 - min(1, cut.volume / grid.cell_volume()));  // no part of a cell has its centroid beyond
  for (int d = 0; d < grid.dimension; ++d) centroid[d] = clamp(centroid[d], -room * h[d], room * h[d]);
  return centroid;
}

Vec3 aperture_centroid(WallRecord const& record, CellIndex c, int d, int side) {
  fluid::Grid const& grid = record.grid();
  Real const open = record.aperture(c, d, side), share = open / grid.face_area(d);
  if (!(share > 0 && share < 1)) return {};
  CellIndex beside = c;
  beside[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
  // The pieces of the cell on the low side, so that both cells beside the face find the same bits.
  CellIndex const low = side == 0 ? beside : c, high = side == 0 ? c : beside;
  Vec3 centroid;
  if (Index const i = record.cut_index(low); i >= 0)
    centroid = face_moment(record, record.cut(i), d, 1) / open;
  else if (Index const j = record.cut_index(high); j >= 0)
    centroid = face_moment(record, record.cut(j), d, 0) / open;
  Real const room = 0.5 * (1 - share);
  for (int t = 0; t < grid.dimension; ++t)
    centroid[t] = t == d ? 0 : clamp(centroid[t], -room * grid.spacing[t], room * grid.spacing[t]);
  return centroid;
}

}  // namespace brisance::coupling
