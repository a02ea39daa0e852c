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

/// Sums of the boundary integrals over parts of the boundary whose area vectors point into the region.
class BoundarySum {
 public:
  BoundarySum(Vec3 const& h, int dimension) : h_(h), dimension_(dimension) {}

  /// The part of `area` at x; exact for parts that are points of a quadrature of third degree.
  void add(Vec3 const& area, Vec3 const& x) {
    Vec3 half;  // integrals of x, up to what the faces of the cell cancel
    for (int d = 0; d < dimension_; ++d) {
      half[d] = 0.5 * area[d] * (0.25 * square(h_[d]) - square(x[d]));
      sum_.mean[d] += half[d];
      sum_.product[static_cast<std::size_t>(d)] += area[d] * x[d] * (square(h_[d]) / 12 - square(x[d]) / 3);
    }
    // Along either axis: the mean of both keeps the symmetry.
    for (std::size_t k = 3; k < 6; ++k) {
      auto const [a, b] = product_axes[k];
      if (a < dimension_ && b < dimension_) sum_.product[k] += 0.5 * (half[a] * x[b] + half[b] * x[a]);
    }
  }
  void add_segment(Vec3 const& area, Vec3 const& a, Vec3 const& b) {  // Simpson
    add(area / 6.0, a);
    add(area / 6.0, b);
    add(4 * area / 6.0, 0.5 * (a + b));
  }
  void add_triangle(Vec3 const& area, Vec3 const& a, Vec3 const& b, Vec3 const& c) {
    for (Vec3 const& x : {a, b, c}) add(3 * area / 60.0, x);
    for (Vec3 const& x : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) add(8 * area / 60.0, x);
    add(27 * area / 60.0, (a + b + c) / 3.0);
  }
  /// Within a face across this axis.
  void within_face(int axis) { across_ = axis; }

  /// Means over a region of this size; it is a part `share` of the box.
  Moments means(Real size, Real share) const {
    Moments m = 1 / size * sum_;
    for (int d = 0; d < dimension_; ++d)
      if (d != across_) m.product[static_cast<std::size_t>(d)] += square(h_[d]) / 12;
    // No part of a cell has its centroid beyond.
    Real const room = 0.5 * (1 - min(1, share));
    for (int d = 0; d < 3; ++d) m.mean[d] = clamp(m.mean[d], -room * h_[d], room * h_[d]);
    for (std::size_t k = 0; k < 6; ++k) {
      auto const [a, b] = product_axes[k];
      Real const most = 0.25 * h_[a] * h_[b];
      m.product[k] = clamp(m.product[k], k < 3 ? 0 : -most, most);
    }
    return m;
  }

 private:
  Vec3 h_;
  int dimension_, across_ = -1;
  Moments sum_;
};

}  // namespace

Moments cell_moments(fluid::Grid const& grid) {
  Vec3 h = grid.spacing;
  for (int d = grid.dimension; d < 3; ++d) h[d] = 0;
  return moments_of_box(h);
}

Moments face_moments(fluid::Grid const& grid, int d) {
  Moments m = cell_moments(grid);
  m.product[static_cast<std::size_t>(d)] = 0;
  return m;
}

Moments fluid_moments(WallRecord const& record, CellIndex c) {
  fluid::Grid const& grid = record.grid();
  Index const index = record.cut_index(c);
  if (index < 0) return cell_moments(grid);
  CutCell const& cut = record.cut(index);
  Vec3 const h = grid.spacing;
  if (cut.volume <= covered_fraction * grid.cell_volume()) return cell_moments(grid);
  BoundarySum sum(h, grid.dimension);
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
    auto const corners = record.geometry.corners_of(piece);
    Vec3 const o = from_centre(corners[0], c, h);
    if (grid.dimension == 2) {
      sum.add_segment(piece.area, o, from_centre(corners[1], c, h));
      continue;
    }
    Real size = 0;
    for (std::size_t v = 1; v + 1 < corners.size(); ++v)
      size += norm(cross(from_centre(corners[v], c, h) - o, from_centre(corners[v + 1], c, h) - o));
    if (!(size > 0)) continue;
    for (std::size_t v = 1; v + 1 < corners.size(); ++v) {
      Vec3 const a = from_centre(corners[v], c, h), b = from_centre(corners[v + 1], c, h);
      sum.add_triangle(norm(cross(a - o, b - o)) / size * piece.area, o, a, b);
    }
  }
  return sum.means(cut.volume, cut.volume / grid.cell_volume());
}

void for_open_edges(WallRecord const& record, CellIndex c, int d, int side,
                    std::function<void(OpenEdge const&)> const& visit) {
  fluid::Grid const& grid = record.grid();
  Vec3 const h = grid.spacing;
  auto const dir = static_cast<std::size_t>(d);
  // The pieces of the cell on the low side, so that both cells beside the face find the same bits.
  CellIndex low = c;
  low[dir] += side - 1;
  CellIndex high = low;
  ++high[dir];
  Index index = record.cut_index(low);
  if (index < 0) index = record.cut_index(high);
  if (index < 0) return;
  CutCell const& cut = record.cut(index);
  Real const plane = static_cast<Real>(high[dir]);
  Vec3 axis;
  axis[d] = 1;
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
    auto const corners = record.geometry.corners_of(piece);
    auto const inside = [&](Corner const& x) { return x.point[d] == plane; };
    auto const place = [&](Corner const& x) {
      Vec3 y = from_centre(x, cut.cell, h);
      y[d] = 0;
      return y;
    };
    if (grid.dimension == 2) {
      if (inside(corners[0]) == inside(corners[1])) continue;
      Vec3 open;
      for (int t = 0; t < 2; ++t)
        if (t != d) open[t] = std::copysign(h.z, piece.area[t]);
      Vec3 const x = place(inside(corners[0]) ? corners[0] : corners[1]);
      visit({piece, open, x, x});
      continue;
    }
    if (std::all_of(corners.begin(), corners.end(), inside)) continue;  // along the plane: it has no edge across it
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Corner const &p = corners[i], &q = corners[i + 1 == corners.size() ? 0 : i + 1];
      if (!inside(p) || !inside(q)) continue;
      Vec3 const a = place(p), b = place(q);
      Vec3 open = cross(axis, b - a);
      if (dot(open, piece.area) < 0) open = -open;
      visit({piece, open, a, b});
    }
  }
}

Moments aperture_moments(WallRecord const& record, CellIndex c, int d, int side) {
  fluid::Grid const& grid = record.grid();
  Real const open = record.aperture(c, d, side), share = open / grid.face_area(d);
  if (!(share > 0 && share < 1)) return face_moments(grid, d);
  BoundarySum sum(grid.spacing, grid.dimension);
  sum.within_face(d);
  bool any = false;
  for_open_edges(record, c, d, side, [&](OpenEdge const& e) {
    sum.add_segment(e.open, e.a, e.b);
    any = true;
  });
  return any ? sum.means(open, share) : face_moments(grid, d);
}

}  // namespace brisance::coupling
