#include "coupling/cut_cells/piece_overlap.hpp"

#include <algorithm>

namespace brisance::coupling {
namespace {

/// A point of the plane of barycentric coordinates 1 and 2.
struct Point {
  Real x, y;
};

Real area(Point const& o, Point const& a, Point const& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Two convex polygons of up to 9 corners meet in one of 18 at most.
struct Ring {
  std::array<Point, 20> corner;
  std::size_t n = 0;
  void add(Point const& p) { corner[n++] = p; }
};

/// What lies to the left of the line from `from` to `to`.
Ring left_of(Ring const& ring, Point const& from, Point const& to) {
  Ring kept;
  for (std::size_t i = 0; i < ring.n; ++i) {
    Point const &p = ring.corner[i], &q = ring.corner[i + 1 == ring.n ? 0 : i + 1];
    Real const at_p = area(from, to, p), at_q = area(from, to, q);
    if (at_p >= 0) kept.add(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      Real const s = at_p / (at_p - at_q);
      kept.add({p.x + s * (q.x - p.x), p.y + s * (q.y - p.y)});
    }
  }
  return kept;
}

TrianglePart overlap_of_segments(std::span<Corner const> a, std::span<Corner const> b) {
  auto const [a0, a1] = std::minmax(a[0].bary[1], a[1].bary[1]);
  auto const [b0, b1] = std::minmax(b[0].bary[1], b[1].bary[1]);
  Real const low = max(a0, b0), high = min(a1, b1);
  if (!(high > low)) return {};
  Real const middle = 0.5 * (low + high);
  return {high - low, {1 - middle, middle, 0}};
}

}  // namespace

TrianglePart overlap(std::span<Corner const> a, std::span<Corner const> b) {
  if (a.size() == 2) return overlap_of_segments(a, b);
  Ring ring;
  for (Corner const& c : a) ring.add({c.bary[1], c.bary[2]});
  for (std::size_t i = 0; i < b.size() && ring.n > 2; ++i) {
    Corner const &from = b[i], &to = b[i + 1 == b.size() ? 0 : i + 1];
    ring = left_of(ring, {from.bary[1], from.bary[2]}, {to.bary[1], to.bary[2]});
  }
  TrianglePart part;
  Point moment{0, 0};
  for (std::size_t i = 1; i + 1 < ring.n; ++i) {
    Point const &o = ring.corner[0], &p = ring.corner[i], &q = ring.corner[i + 1];
    Real const s = area(o, p, q);  // twice the area; that of the triangle is 1/2
    part.share += s;
    moment.x += s * (o.x + p.x + q.x);
    moment.y += s * (o.y + p.y + q.y);
  }
  if (!(part.share > 0)) return {};
  Real const x = moment.x / (3 * part.share), y = moment.y / (3 * part.share);
  part.bary = {1 - x - y, x, y};
  return part;
}

}  // namespace brisance::coupling
