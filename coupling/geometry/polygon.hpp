// Convex polygons cut by grid planes, one plane at a time; both sides go on.
#pragma once
#include <memory>

#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// Corners in order. A triangle cut by two planes per direction has at most 9; a segment is a polygon of 2. Places that
/// hold no corner stay unwritten: clearing them costs as much as a cut.
template <class Point>
struct Polygon {
  Polygon() {}
  union {
    std::array<Point, 9> corner;
  };
  std::size_t n = 0;
  void add(Point const& p) { std::construct_at(&corner[n++], p); }
};

template <int D>
Real along(Vec3 const& p) {
  if constexpr (D == 0) return p.x;
  if constexpr (D == 1) return p.y;
  return p.z;
}
template <int D>
Real along(Corner const& c) {
  return along<D>(c.point);
}
template <int D>
void place_on(Vec3& p, Real plane) {
  (D == 0 ? p.x : D == 1 ? p.y : p.z) = plane;
}
template <int D>
void place_on(Corner& c, Real plane) {
  place_on<D>(c.point, plane);
}

/// a + s (b - a), from the nearer end so that no coordinate leaves the range of the two ends; t = 1 - s.
inline Real between(Real a, Real b, Real s, Real t) { return s <= 0.5 ? a + s * (b - a) : b - t * (b - a); }
inline Vec3 between(Vec3 const& a, Vec3 const& b, Real s, Real t) {
  return {between(a.x, b.x, s, t), between(a.y, b.y, s, t), between(a.z, b.z, s, t)};
}
inline Corner between(Corner const& a, Corner const& b, Real s, Real t) {
  return {
      between(a.point, b.point, s, t),
      {between(a.bary[0], b.bary[0], s, t), between(a.bary[1], b.bary[1], s, t), between(a.bary[2], b.bary[2], s, t)}};
}

/// Splits `p` at coordinate D = `plane`: corners below it to `low`, the others to `high`, the cut points to both. The
/// two sides share one chord whatever the rounding, also where the polygon lies in the plane up to noise: areas add up.
/// A cut point is interpolated from the low to the high end, whichever way the edge runs: two polygons that share the
/// edge get the same bits.
template <int D, class Point>
void split(Polygon<Point> const& p, Real plane, Polygon<Point>& low, Polygon<Point>& high) {
  low.n = high.n = 0;
  Real d = along<D>(p.corner[0]) - plane;
  for (std::size_t i = 0; i < p.n; ++i) {
    Point const& a = p.corner[i];
    Point const& b = p.corner[i + 1 == p.n ? 0 : i + 1];
    Real const e = along<D>(b) - plane;
    (d < 0 ? low : high).add(a);
    if ((d < 0) != (e < 0) && (p.n > 2 || i == 0)) {
      if (d == 0 || e == 0) {
        low.add(d == 0 ? a : b);
      } else {
        Real const width = d < 0 ? e - d : d - e;
        Point q = d < 0 ? between(a, b, -d / width, e / width) : between(b, a, -e / width, d / width);
        place_on<D>(q, plane);
        low.add(q);
        high.add(q);
      }
    }
    d = e;
  }
}

/// Cells along D that a polygon meets: first to last, or last = first - 1 when it lies in the plane `first`.
struct Span {
  Index first, last;
};
template <int D, class Point>
Span cells_along(Polygon<Point> const& p) {
  Real low = along<D>(p.corner[0]), high = low;
  for (std::size_t i = 1; i < p.n; ++i) {
    Real const x = along<D>(p.corner[i]);
    low = min(low, x);
    high = max(high, x);
  }
  return {static_cast<Index>(std::floor(low)), static_cast<Index>(std::ceil(high)) - 1};
}

/// Calls visit(part, cell) for the part of `p` in each cell along D.
template <int D, class Point, class Visit>
void slice(Polygon<Point> const& p, Span cells, Visit&& visit) {
  if (cells.last <= cells.first) return visit(p, cells.first);
  Polygon<Point> low, rest[2];
  Polygon<Point> const* whole = &p;
  for (Index c = cells.first; c < cells.last; ++c) {
    Polygon<Point>& high = rest[(c - cells.first) & 1];
    split<D>(*whole, static_cast<Real>(c + 1), low, high);
    visit(low, c);
    whole = &high;
  }
  visit(*whole, cells.last);
}

}  // namespace brisance::coupling
