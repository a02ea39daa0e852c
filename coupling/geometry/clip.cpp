#include "coupling/geometry/clip.hpp"

#include <algorithm>

#include "coupling/geometry/polygon.hpp"
#include "parallel/error.hpp"

namespace brisance::coupling::detail {
namespace {

/// Area vector of a part, its first moments against the low planes of its cell, and its centroid, all in grid units.
/// False if the part covers nothing of its triangle. (A degenerate triangle without area keeps its pieces: it may
/// sweep.)
bool measure(Polygon<Corner> const& p, CellIndex const& cell, Geometry::Clipped& piece) {
  Vec3 const base{static_cast<Real>(cell[0]), static_cast<Real>(cell[1]), static_cast<Real>(cell[2])};
  if (p.n == 2) {
    Corner const &a = p.corner[0], &b = p.corner[1];
    if (std::abs(b.bary[1] - a.bary[1]) <= 1e-20) return false;
    piece.area = {b.point.y - a.point.y, a.point.x - b.point.x, 0};
    Vec3 const mean = 0.5 * ((a.point - base) + (b.point - base));
    piece.moment = {piece.area.x * mean.x, piece.area.y * mean.y, 0};
    for (std::size_t v = 0; v < 3; ++v) piece.bary_centroid[v] = 0.5 * (a.bary[v] + b.bary[v]);
    return true;
  }
  Corner const& o = p.corner[0];
  Vec3 const x0 = o.point - base;
  Vec3 area, moment;
  std::array<Real, 3> bary{};
  Real covered = 0;
  for (std::size_t i = 1; i + 1 < p.n; ++i) {
    Corner const &a = p.corner[i], &b = p.corner[i + 1];
    Vec3 const s = 0.5 * cross(a.point - o.point, b.point - o.point);
    Vec3 const mean = (x0 + (a.point - base) + (b.point - base)) / 3;
    Real const part =
        (a.bary[1] - o.bary[1]) * (b.bary[2] - o.bary[2]) - (a.bary[2] - o.bary[2]) * (b.bary[1] - o.bary[1]);
    area += s;
    moment += Vec3{s.x * mean.x, s.y * mean.y, s.z * mean.z};
    covered += part;
    for (std::size_t v = 0; v < 3; ++v) bary[v] += part * (o.bary[v] + a.bary[v] + b.bary[v]);
  }
  if (!(covered > 1e-20)) return false;
  piece.area = area;
  piece.moment = moment;
  for (std::size_t v = 0; v < 3; ++v) piece.bary_centroid[v] = bary[v] / (3 * covered);
  return true;
}

void store(Polygon<Corner> const& p, CellIndex cell, int flat, Index triangle, Geometry& out) {
  Geometry::Clipped piece;
  if (!measure(p, cell, piece)) return;
  if (flat >= 0) {
    auto const d = static_cast<std::size_t>(flat);
    std::array<Index, 3> const& face = cell;
    out.flats.push_back(
        {(static_cast<std::uint64_t>(flat) << 60) | cell_key(face, 2, 1, 0), static_cast<Index>(out.clipped.size())});
    if (piece.area[flat] < 0) {  // towards the low side: one cell down, where the plane is the high face
      cell[d] -= 1;
      piece.moment[flat] = piece.area[flat];
    }
  }
  piece.triangle = triangle;
  piece.flat = flat;
  piece.cell = cell;
  piece.first_corner = static_cast<Index>(out.corners.size());
  piece.corners = static_cast<Index>(p.n);
  out.corners.insert(out.corners.end(), p.corner.begin(), p.corner.begin() + p.n);
  out.clipped.push_back(piece);
}

/// Two bodies that meet in a grid plane: their coincident faces would each close the same cell face, once from either
/// side, and leave it an aperture of -1. Where faces of both signs cover each other, both are given to the high cell.
void share_planes(Geometry& out) {
  auto& flats = out.flats;
  std::sort(flats.begin(), flats.end(),
            [](auto const& a, auto const& b) { return a.key != b.key ? a.key < b.key : a.place < b.place; });
  for (std::size_t i = 0, end = 0; i < flats.size(); i = end) {
    Real up = 0, down = 0;
    for (end = i; end < flats.size() && flats[end].key == flats[i].key; ++end) {
      auto const& piece = out.clipped[static_cast<std::size_t>(flats[end].place)];
      Real const s = piece.area[piece.flat];
      (s > 0 ? up : down) += std::abs(s);
    }
    bool const both = up > 0 && down > 0;
    if (!both || !(std::abs(up - down) <= 1e-9 || up + down > 1 + 1e-9)) continue;
    for (std::size_t f = i; f < end; ++f) {
      auto& piece = out.clipped[static_cast<std::size_t>(flats[f].place)];
      if (piece.area[piece.flat] >= 0) continue;
      piece.cell[static_cast<std::size_t>(piece.flat)] += 1;
      piece.moment[piece.flat] = 0;
    }
  }
}

}  // namespace

void clip(Lattice const& lattice, std::span<SurfaceTriangle const> triangles, Geometry& out) {
  out.corners.clear();
  out.clipped.clear();
  out.flats.clear();
  std::size_t const corners = lattice.dimension == 3 ? 3 : 2;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    auto const triangle = static_cast<Index>(t);
    Polygon<Corner> whole;
    for (std::size_t v = 0; v < corners; ++v) {
      Corner c{lattice.grid_point(triangles[t].x_new[v]), {0, 0, 0}};
      c.bary[v] = 1;
      for (int d = 0; d < 3; ++d)
        require(std::abs(c.point[d]) < far_away, Failure::numerical,
                "a boundary vertex of triangle " + std::to_string(triangles[t].id) + " left for infinity");
      whole.add(c);
    }
    Span const x = cells_along<0>(whole);
    slice<0>(whole, x, [&](Polygon<Corner> const& in_x, Index i) {
      Span const y = cells_along<1>(in_x);
      slice<1>(in_x, y, [&](Polygon<Corner> const& in_xy, Index j) {
        int const flat = x.last < x.first ? 0 : y.last < y.first ? 1 : -1;
        if (corners == 2) return store(in_xy, {i, j, 0}, flat, triangle, out);
        Span const z = cells_along<2>(in_xy);
        slice<2>(in_xy, z, [&](Polygon<Corner> const& in_xyz, Index k) {
          store(in_xyz, {i, j, k}, flat >= 0 || z.last >= z.first ? flat : 2, triangle, out);
        });
      });
    });
  }
  share_planes(out);
}

}  // namespace brisance::coupling::detail
