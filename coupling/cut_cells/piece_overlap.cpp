#include "coupling/cut_cells/piece_overlap.hpp"

#include <cmath>

namespace brisance::coupling {
namespace {

/// A point of the plane of barycentric coordinates 1 and 2.
struct Point {
  Real x, y;
};

/// Convex; of a segment two corners. A piece has up to 9, and each of 6 planes adds one.
struct Ring {
  std::array<Point, 16> corner;
  std::size_t n = 0;
  void add(Point const& p) { corner[n++] = p; }
};

Ring ring_of(std::span<Corner const> piece) {
  Ring ring;
  for (Corner const& c : piece) ring.add({c.bary[1], c.bary[2]});
  return ring;
}

/// Where a linear function with these values at the corners of the triangle is not negative, times `side`.
Ring clipped(Ring const& ring, std::array<Real, 3> const& f, Real side) {
  auto const value = [&](Point const& p) { return side * ((1 - p.x - p.y) * f[0] + p.x * f[1] + p.y * f[2]); };
  Ring kept;
  for (std::size_t i = 0; i < ring.n; ++i) {
    Point const &p = ring.corner[i], &q = ring.corner[i + 1 == ring.n ? 0 : i + 1];
    Real const at_p = value(p), at_q = value(q);
    if (at_p >= 0) kept.add(p);
    bool const closes = ring.n == 2 && i == 1;  // a segment has one edge
    if (!closes && ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) {
      Real const s = at_p / (at_p - at_q);
      kept.add({p.x + s * (q.x - p.x), p.y + s * (q.y - p.y)});
    }
  }
  return kept;
}

TrianglePart measure(Ring const& ring, bool segment) {
  if (segment) {
    if (ring.n != 2) return {};
    Real const share = std::abs(ring.corner[1].x - ring.corner[0].x),
               middle = 0.5 * (ring.corner[0].x + ring.corner[1].x);
    return {share, {1 - middle, middle, 0}};
  }
  TrianglePart part;
  Point moment{0, 0};
  for (std::size_t i = 1; i + 1 < ring.n; ++i) {
    Point const &o = ring.corner[0], &p = ring.corner[i], &q = ring.corner[i + 1];
    Real const s = (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);  // that of the triangle is 1
    part.share += s;
    moment.x += s * (o.x + p.x + q.x);
    moment.y += s * (o.y + p.y + q.y);
  }
  if (!(part.share > 0)) return {};
  Real const x = moment.x / (3 * part.share), y = moment.y / (3 * part.share);
  part.bary = {1 - x - y, x, y};
  return part;
}

}  // namespace

TrianglePart part_of(std::span<Corner const> piece) { return measure(ring_of(piece), piece.size() == 2); }

TrianglePart part_in_cell(std::span<Corner const> piece, Lattice const& lattice, SurfaceTriangle const& triangle,
                          CellIndex const& cell) {
  Ring ring = ring_of(piece);
  bool const segment = piece.size() == 2;
  std::array<Vec3, 3> x{};
  for (std::size_t v = 0; v < piece.size() && v < 3; ++v) x[v] = lattice.grid_point(triangle.x_new[v]);
  for (int d = 0; d < lattice.dimension; ++d) {
    std::array<Real, 3> const at{x[0][d], x[1][d], segment ? x[1][d] : x[2][d]};
    Real const low = min(at[0], min(at[1], at[2])), high = max(at[0], max(at[1], at[2]));
    if (low == high && low == std::floor(low)) continue;  // in the plane
    for (int side = 0; side < 2; ++side) {
      Real const plane = cell[static_cast<std::size_t>(d)] + side;
      if (side == 0 ? low >= plane : high <= plane) continue;  // most triangles are small
      ring = clipped(ring, {at[0] - plane, at[1] - plane, at[2] - plane}, side == 0 ? 1 : -1);
    }
  }
  return measure(ring, segment);
}

}  // namespace brisance::coupling
