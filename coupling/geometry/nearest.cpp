#include "coupling/geometry/nearest.hpp"

#include <limits>

namespace brisance::coupling {
namespace {

/// Metric corner of a polygon.
struct Vertex {
  Vec3 x;
  std::array<Real, 3> bary;
};

std::array<Real, 3> mix(std::array<Real, 3> const& a, std::array<Real, 3> const& b, Real s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

Nearest on_segment(Vertex const& a, Vertex const& b, Vec3 const& x) {
  Vec3 const e = b.x - a.x;
  Real const length2 = norm2(e);
  Real const s = length2 > 0 ? clamp(dot(x - a.x, e) / length2, 0, 1) : 0;
  Vec3 const p = a.x + s * e;
  return {p, mix(a.bary, b.bary, s), norm2(x - p)};
}

/// On a convex polygon: the foot of the perpendicular if it is inside all edges, else the best of the edges that have x
/// on their outer side.
Nearest on_polygon(std::span<Vertex const> v, Vec3 const& x) {
  std::size_t const n = v.size();
  if (n == 2) {  // in the plane of x: a body in 2D is the same at all z
    Vertex a = v[0], b = v[1];
    a.x.z = b.x.z = x.z;
    return on_segment(a, b, x);
  }
  Vec3 normal{};
  for (std::size_t i = 1; i + 1 < n; ++i) normal += cross(v[i].x - v[0].x, v[i + 1].x - v[0].x);
  Real const size2 = norm2(normal);
  Nearest best;
  best.distance2 = -1;
  for (std::size_t i = 0; i < n; ++i) {
    Vertex const &a = v[i], &b = v[i + 1 == n ? 0 : i + 1];
    // On a polygon without area every edge counts.
    if (size2 > 0 && dot(cross(b.x - a.x, x - a.x), normal) >= 0) continue;
    Nearest const edge = on_segment(a, b, x);
    if (best.distance2 < 0 || edge.distance2 < best.distance2) best = edge;
  }
  if (best.distance2 >= 0) return best;
  Real const height = dot(x - v[0].x, normal) / size2;
  best.point = x - height * normal;
  best.distance2 = height * height * size2;
  // Barycentric coordinates from the fan triangle that holds the foot best.
  Real inside = -1e300;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    Vec3 const &o = v[0].x, &a = v[i].x, &b = v[i + 1].x;
    Real const whole = dot(cross(a - o, b - o), normal);
    if (!(whole > 0)) continue;
    Real const s = dot(cross(best.point - o, b - o), normal) / whole;
    Real const t = dot(cross(a - o, best.point - o), normal) / whole;
    Real const least = min(min(s, t), 1 - s - t);
    if (least <= inside) continue;
    inside = least;
    for (std::size_t c = 0; c < 3; ++c)
      best.bary[c] = v[0].bary[c] + s * (v[i].bary[c] - v[0].bary[c]) + t * (v[i + 1].bary[c] - v[0].bary[c]);
  }
  return best;
}

}  // namespace

Nearest closest_point(Lattice const& lattice, SurfaceTriangle const& triangle, Vec3 const& x) {
  std::array<Vertex, 3> const v{
      {{triangle.x_new[0], {1, 0, 0}}, {triangle.x_new[1], {0, 1, 0}}, {triangle.x_new[2], {0, 0, 1}}}};
  return on_polygon({v.data(), lattice.dimension == 3 ? 3u : 2u}, x);
}

Facet facet(Lattice const& lattice, Geometry const& geometry, Piece const& piece) {
  constexpr Real endless = std::numeric_limits<Real>::infinity();
  constexpr Real wider = 1e-9;  // of a cell: beyond all rounding of closest points
  Facet f{{endless, endless, endless}, {-endless, -endless, -endless}, piece.area, piece.centroid, 0};
  f.grazing = 0.05 * norm(piece.area);
  for (Corner const& corner : geometry.corners_of(piece)) {
    Vec3 const x = lattice.position(corner.point);
    for (int d = 0; d < 3; ++d) {
      f.low[d] = min(f.low[d], x[d] - wider * lattice.spacing[d]);
      f.high[d] = max(f.high[d], x[d] + wider * lattice.spacing[d]);
    }
  }
  if (lattice.dimension == 2) f.low.z = -endless, f.high.z = endless;
  return f;
}

Nearest closest_point(Lattice const& lattice, Geometry const& geometry, Piece const& piece, Vec3 const& x) {
  std::array<Vertex, 9> v;
  auto const corners = geometry.corners_of(piece);
  for (std::size_t c = 0; c < corners.size(); ++c) v[c] = {lattice.position(corners[c].point), corners[c].bary};
  return on_polygon({v.data(), corners.size()}, x);
}

}  // namespace brisance::coupling
