#include "coupling/geometry/bench.hpp"

#include "coupling/geometry/nearest.hpp"
#include "coupling/geometry/swept.hpp"

namespace brisance::coupling {
namespace {

constexpr Real cells = bench_cells, radius = 0.3 * cells;
Vec3 const centre{0.503 * cells, 0.497 * cells, 0.511 * cells};

/// Four triangles out of one, `level` times; both triangles of an edge compute the same middle.
void refine(std::array<Vec3, 3> const& t, int level, std::vector<SurfaceTriangle>& out) {
  if (level == 0) {
    SurfaceTriangle triangle;
    triangle.id = static_cast<GlobalId>(out.size());
    for (std::size_t v = 0; v < 3; ++v) triangle.x_old[v] = triangle.x_new[v] = centre + radius * t[v];
    out.push_back(triangle);
    return;
  }
  Vec3 const a = normalized(t[1] + t[2]), b = normalized(t[2] + t[0]), c = normalized(t[0] + t[1]);
  refine({t[0], c, b}, level - 1, out);
  refine({c, t[1], a}, level - 1, out);
  refine({b, a, t[2]}, level - 1, out);
  refine({a, b, c}, level - 1, out);
}

constexpr CellBox everywhere{{-1000, -1000, -1000}, {1000, 1000, 1000}};

}  // namespace

std::vector<SurfaceTriangle> bench_sphere() {
  Real const golden = (1 + std::sqrt(5.0)) / 2, s = 1 / std::sqrt(1 + golden * golden), g = golden * s;
  std::array<Vec3, 12> const p{{{-s, g, 0},
                                {s, g, 0},
                                {-s, -g, 0},
                                {s, -g, 0},
                                {0, -s, g},
                                {0, s, g},
                                {0, -s, -g},
                                {0, s, -g},
                                {g, 0, -s},
                                {g, 0, s},
                                {-g, 0, -s},
                                {-g, 0, s}}};
  constexpr std::size_t faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::vector<SurfaceTriangle> out;
  for (auto const& f : faces) refine({p[f[0]], p[f[1]], p[f[2]]}, 4, out);
  return out;
}

GeometryRate bench_cut_cells() {
  Lattice const lattice;
  auto triangles = bench_sphere();
  Geometry geometry;
  std::vector<Swept> parts;
  return best_rate([&] {
    std::size_t items = 0;
    for (int step = 0; step < 4; ++step) {
      for (auto& t : triangles)
        for (std::size_t v = 0; v < 3; ++v) {
          t.x_old[v] = t.x_new[v];
          t.x_new[v].x += 0.3;
        }
      build(lattice, triangles, std::span(&everywhere, 1), geometry);
      parts.clear();
      for (auto const& p : geometry.pieces)
        swept(lattice, geometry, p, triangles[static_cast<std::size_t>(p.triangle)], parts);
      items += geometry.cells.size();
    }
    return items;
  });
}

GeometryRate bench_closest_points() {
  Lattice const lattice;
  auto const triangles = bench_sphere();
  Geometry geometry;
  build(lattice, triangles, std::span(&everywhere, 1), geometry);
  Real farthest = 0;  // keeps the work
  auto rate = best_rate([&] {
    std::size_t items = 0;
    for (std::size_t c = 1; c + 1 < geometry.cells.size(); ++c) {
      auto const& cell = geometry.cells[c].cell;
      Vec3 const x{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5};
      for (Index p = geometry.cells[c - 1].first_piece; p < geometry.cells[c + 1].last_piece; ++p, ++items)
        farthest =
            max(farthest, closest_point(lattice, geometry, geometry.pieces[static_cast<std::size_t>(p)], x).distance2);
    }
    return items;
  });
  if (!(farthest > 0)) rate.items = 0;
  return rate;
}

}  // namespace brisance::coupling
