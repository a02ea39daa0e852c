#include "coupling/geometry/swept.hpp"

#include <limits>

#include "coupling/geometry/polygon.hpp"

namespace brisance::coupling {
namespace {

// The signed volume of the closed surface of a prism within cell D is the integral over D of its winding number. Along
// the last direction (z, in 2D y) this is a sum over the surface parts s above each point of the plane below: a part in
// cell k adds the volume between it and the bottom of its cell to that cell, and its projection times the height to
// every cell below. Only polygons are cut, never tetrahedra.

/// Sums of one prism, in cells relative to that of the piece.
class Columns {
 public:
  Columns(CellIndex const& low, CellIndex const& high) : low_(low) {
    for (std::size_t d = 0; d < 3; ++d) n_[d] = high[d] - low[d] + 1;
    std::size_t const count = size();
    if (count > few_.size()) many_.resize(count);
    cells_ = count > few_.size() ? many_.data() : few_.data();
    for (std::size_t i = 0; i < count; ++i) cells_[i] = {0, 0};
  }

  /// A part in cell (i, j, k): `volume` down to the bottom of its cell, `area` its projection.
  void add(Index i, Index j, Index k, Real volume, Real area) {
    Cell& c = cells_[place(i - low_[0], j - low_[1], k - low_[2])];
    c.volume += volume;
    c.area += area;
  }

  /// Calls visit(i, j, k, volume); columns run along direction `up`.
  template <class Visit>
  void finish(std::size_t up, Visit&& visit) {
    Index const step = up == 1 ? n_[0] : n_[0] * n_[1];
    for (Index k = n_[2] - 1; k >= 0; --k)
      for (Index j = n_[1] - 1; j >= 0; --j)
        for (Index i = 0; i < n_[0]; ++i) {
          if ((up == 1 ? j : k) + 1 == n_[up]) continue;
          std::size_t const c = place(i, j, k), above = c + static_cast<std::size_t>(step);
          cells_[c].volume += cells_[above].area;
          cells_[c].area += cells_[above].area;
        }
    for (Index k = 0; k < n_[2]; ++k)
      for (Index j = 0; j < n_[1]; ++j)
        for (Index i = 0; i < n_[0]; ++i) visit(low_[0] + i, low_[1] + j, low_[2] + k, cells_[place(i, j, k)].volume);
  }

 private:
  struct Cell {
    Real volume, area;
  };
  std::size_t place(Index i, Index j, Index k) const { return static_cast<std::size_t>(i + n_[0] * (j + n_[1] * k)); }
  std::size_t size() const { return static_cast<std::size_t>(n_[0] * n_[1] * n_[2]); }

  CellIndex low_{}, n_{};
  std::array<Cell, 64> few_;
  std::vector<Cell> many_;  // steps of several cells only
  Cell* cells_ = nullptr;
};

Real projection(Vec3 const& a, Vec3 const& b, Vec3 const& c) {
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

/// A polygon within one cell, its fan against the bottom z = k.
void add_part(Polygon<Vec3> const& p, Index i, Index j, Index k, Columns& sums) {
  Real volume = 0, area = 0;
  Vec3 const& o = p.corner[0];
  for (std::size_t v = 1; v + 1 < p.n; ++v) {
    Vec3 const &a = p.corner[v], &b = p.corner[v + 1];
    Real const s = projection(o, a, b);
    area += s;
    volume += s * (o.z + a.z + b.z);
  }
  sums.add(i, j, k, volume / 3 - area * k, area);
}

void add_triangle(Vec3 const& a, Vec3 const& b, Vec3 const& c, Columns& sums) {
  if (projection(a, b, c) == 0) return;
  Polygon<Vec3> whole;
  for (Vec3 const& p : {a, b, c}) whole.add(p);
  slice<0>(whole, cells_along<0>(whole), [&](Polygon<Vec3> const& in_x, Index i) {
    Span const y = cells_along<1>(in_x);
    if (y.last < y.first) return;  // in a plane across y: no projection
    slice<1>(in_x, y, [&](Polygon<Vec3> const& in_xy, Index j) {
      slice<2>(in_xy, cells_along<2>(in_xy),
               [&](Polygon<Vec3> const& in_xyz, Index k) { add_part(in_xyz, i, j, k, sums); });
    });
  });
}

/// In 2D: the part of the outline from a to b, in columns along y.
void add_segment(Vec3 const& a, Vec3 const& b, Columns& sums) {
  if (a.x == b.x) return;
  Polygon<Vec3> whole;
  whole.add(a);
  whole.add(b);
  slice<0>(whole, cells_along<0>(whole), [&](Polygon<Vec3> const& in_x, Index i) {
    slice<1>(in_x, cells_along<1>(in_x), [&](Polygon<Vec3> const& in_xy, Index j) {
      Vec3 const &p = in_xy.corner[0], &q = in_xy.corner[1];
      Real const area = p.x - q.x;
      sums.add(i, j, 0, area * (0.5 * (p.y + q.y) - j), area);
    });
  });
}

/// The quadrilateral (p0, p1, q1, q0) as four triangles through its mean point, the same for both pieces that share it.
void add_side(Vec3 const& p0, Vec3 const& p1, Vec3 const& q1, Vec3 const& q0, Columns& sums) {
  Vec3 const m = 0.25 * ((p0 + p1) + (q0 + q1));
  add_triangle(p0, p1, m, sums);
  add_triangle(p1, q1, m, sums);
  add_triangle(q1, q0, m, sums);
  add_triangle(q0, p0, m, sums);
}

}  // namespace

void swept(Lattice const& lattice, Geometry const& geometry, Piece const& piece, SurfaceTriangle const& triangle,
           std::vector<Swept>& out) {
  if (!triangle.moved(lattice.dimension)) return;
  auto const corners = geometry.corners_of(piece);
  Vec3 const base{static_cast<Real>(piece.cell[0]), static_cast<Real>(piece.cell[1]), static_cast<Real>(piece.cell[2])};
  Vec3 const x0 = lattice.grid_point(triangle.x_old[0]), edge1 = lattice.grid_point(triangle.x_old[1]) - x0;
  Vec3 const edge2 = lattice.dimension == 3 ? lattice.grid_point(triangle.x_old[2]) - x0 : Vec3{};
  Vec3 const origin = x0 - base;

  std::array<Vec3, 9> now, before;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  std::size_t const n = corners.size();
  for (std::size_t c = 0; c < n; ++c) {
    now[c] = corners[c].point - base;
    before[c] = origin + corners[c].bary[1] * edge1 + corners[c].bary[2] * edge2;
    for (int d = 0; d < 3; ++d) {
      low[d] = min(low[d], min(now[c][d], before[c][d]));
      high[d] = max(high[d], max(now[c][d], before[c][d]));
    }
  }
  CellIndex first, last;
  for (std::size_t d = 0; d < 3; ++d) {
    first[d] = static_cast<Index>(std::floor(low[static_cast<int>(d)]));
    last[d] = std::max(first[d], static_cast<Index>(std::ceil(high[static_cast<int>(d)])) - 1);
  }
  std::size_t const up = lattice.dimension == 3 ? 2 : 1;
  // A part in a plane across `up` counts in the cell above it.
  last[up] = static_cast<Index>(std::floor(high[static_cast<int>(up)]));
  Columns sums(first, last);
  Vec3 const box = high - low;
  Real noise = 16 * std::numeric_limits<Real>::epsilon() * box.x;
  bool const solid_3d = lattice.dimension == 3;
  if (solid_3d) {
    noise *= box.y * (last[2] - first[2] + 1);
    for (std::size_t c = 1; c + 1 < n; ++c) {
      add_triangle(now[0], now[c], now[c + 1], sums);
      add_triangle(before[0], before[c + 1], before[c], sums);
    }
    for (std::size_t c = 0; c < n; ++c) {
      std::size_t const next = c + 1 == n ? 0 : c + 1;
      add_side(before[c], before[next], now[next], now[c], sums);
    }
  } else {
    noise *= last[1] - first[1] + 1;
    add_segment(now[0], now[1], sums);
    add_segment(now[1], before[1], sums);
    add_segment(before[1], before[0], sums);
    add_segment(before[0], now[0], sums);
  }
  sums.finish(up, [&](Index i, Index j, Index k, Real volume) {
    if (std::abs(volume) > noise)
      out.push_back({{piece.cell[0] + i, piece.cell[1] + j, piece.cell[2] + k}, volume * lattice.cell_volume()});
  });
}

}  // namespace brisance::coupling
