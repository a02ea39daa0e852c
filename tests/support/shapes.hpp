// Closed surfaces for the tests of the cut-cell geometry.
#pragma once
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "coupling/geometry/surface.hpp"

namespace brisance::testing {

/// Points and outward triangles, or in 2D segments with the body on the left (third index unused).
struct Shape {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> faces;

  void append(Shape const& other) {
    int const shift = static_cast<int>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (auto f : other.faces) faces.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
  }
};

/// Sphere of 20 * 4^level triangles with its corners on the sphere.
inline Shape icosphere(Vec3 centre, Real radius, int level) {
  Real const t = (1 + std::sqrt(5.0)) / 2;
  Shape s;
  s.points = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
              {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  s.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (auto& p : s.points) p = normalized(p);
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<int, int>, int> middle;
    auto const mid = [&](int a, int b) {
      auto const key = std::minmax(a, b);
      auto const [at, fresh] = middle.try_emplace(key, static_cast<int>(s.points.size()));
      if (fresh)
        s.points.push_back(normalized(s.points[static_cast<std::size_t>(a)] + s.points[static_cast<std::size_t>(b)]));
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (auto const& f : s.faces) {
      int const a = mid(f[0], f[1]), b = mid(f[1], f[2]), c = mid(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    s.faces = finer;
  }
  for (auto& p : s.points) p = centre + radius * p;
  return s;
}

inline Shape box(Vec3 low, Vec3 high) {
  Shape s;
  for (int c = 0; c < 8; ++c)
    s.points.push_back({c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z});
  s.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
             {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

/// Closed outline in 2D, counter-clockwise.
inline Shape outline(std::vector<Vec3> points) {
  Shape s;
  int const n = static_cast<int>(points.size());
  s.points = std::move(points);
  for (int i = 0; i < n; ++i) s.faces.push_back({i, (i + 1) % n, 0});
  return s;
}

inline Shape disk(Vec3 centre, Real radius, int corners, Real phase = 0) {
  std::vector<Vec3> p;
  for (int i = 0; i < corners; ++i) {
    Real const a = phase + 2 * M_PI * i / corners;
    p.push_back(centre + radius * Vec3{std::cos(a), std::sin(a), 0});
  }
  return outline(p);
}

inline Shape mapped(Shape s, std::function<Vec3(Vec3)> const& map) {
  for (auto& p : s.points) p = map(p);
  return s;
}

/// The triangles of a shape that moves from `old` to `now` (same faces).
inline std::vector<coupling::SurfaceTriangle> surface(Shape const& old, Shape const& now, int dimension) {
  std::vector<coupling::SurfaceTriangle> out;
  for (std::size_t f = 0; f < now.faces.size(); ++f) {
    coupling::SurfaceTriangle t;
    t.id = static_cast<GlobalId>(f);
    for (std::size_t v = 0; v < static_cast<std::size_t>(dimension); ++v) {
      t.vertex[v] = now.faces[f][v];
      t.x_old[v] = old.points[static_cast<std::size_t>(now.faces[f][v])];
      t.x_new[v] = now.points[static_cast<std::size_t>(now.faces[f][v])];
    }
    out.push_back(t);
  }
  return out;
}

/// Volume inside (2D: area times depth), about the mean of the points to keep its rounding small.
inline Real enclosed(Shape const& s, int dimension, Real depth = 1) {
  Vec3 mean{};
  for (auto const& p : s.points) mean += p;
  mean = mean / static_cast<Real>(s.points.size());
  long double sum = 0;
  for (auto const& f : s.faces) {
    Vec3 const a = s.points[static_cast<std::size_t>(f[0])] - mean, b = s.points[static_cast<std::size_t>(f[1])] - mean;
    if (dimension == 2)
      sum += 0.5L * (static_cast<long double>(a.x) * b.y - static_cast<long double>(b.x) * a.y) * depth;
    else
      sum += static_cast<long double>(dot(a, cross(b, s.points[static_cast<std::size_t>(f[2])] - mean))) / 6;
  }
  return static_cast<Real>(sum);
}

}  // namespace brisance::testing
