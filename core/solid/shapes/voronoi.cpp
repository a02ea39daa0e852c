// Voronoi cells by half-space clipping, fitted to the boundary, with Lloyd sweeps.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {
namespace {

/// A convex cell being cut; tag[f] tells what lies behind face f (-1: boundary).
struct Cut {
  Polyhedron shape;
  std::vector<Index> tag;

  Cut(Vec3 const& low, Vec3 const& high) : tag(6, -1) {
    for (int c = 0; c < 8; ++c)
      shape.vertices.push_back({c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z});
    shape.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  }

  Real reach(Vec3 const& from) const {
    Real r = 0;
    for (Vec3 const& v : shape.vertices) r = max(r, norm2(v - from));
    return std::sqrt(r);
  }

  /// Keeps the part behind the plane through `point`. Vertices nearer to it than `slack` count as lying on it.
  void clip(Vec3 const& point, Vec3 const& normal, Index behind, Real slack) {
    std::vector<int> side(shape.vertices.size());
    std::vector<Real> distance(side.size());
    bool any = false;
    for (std::size_t v = 0; v < side.size(); ++v) {
      distance[v] = dot(shape.vertices[v] - point, normal);
      side[v] = distance[v] > slack ? 1 : distance[v] < -slack ? -1 : 0;
      any = any || side[v] > 0;
    }
    if (!any) return;
    std::map<std::pair<int, int>, int> crossing;
    auto cross_edge = [&](int a, int b) {
      auto const [it, fresh] = crossing.try_emplace(std::minmax(a, b), static_cast<int>(shape.vertices.size()));
      if (fresh) {
        auto const [p, q] = it->first;
        Real const dp = distance[static_cast<std::size_t>(p)], dq = distance[static_cast<std::size_t>(q)];
        Vec3 const x = shape.vertices[static_cast<std::size_t>(p)], y = shape.vertices[static_cast<std::size_t>(q)];
        shape.vertices.push_back(x + (dp / (dp - dq)) * (y - x));
      }
      return it->second;
    };
    std::vector<std::vector<int>> faces;
    std::vector<Index> tags;
    std::vector<int> rim;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      std::vector<int> loop;
      auto const& face = shape.faces[f];
      for (std::size_t k = 0; k < face.size(); ++k) {
        int const a = face[k], b = face[(k + 1) % face.size()];
        int const sa = side[static_cast<std::size_t>(a)], sb = side[static_cast<std::size_t>(b)];
        if (sa <= 0) loop.push_back(a);
        if (sa == 0) rim.push_back(a);
        if (sa * sb < 0) {
          loop.push_back(cross_edge(a, b));
          rim.push_back(loop.back());
        }
      }
      if (loop.size() >= 3 && std::any_of(loop.begin(), loop.end(), [&](int v) {
            return static_cast<std::size_t>(v) < side.size() && side[static_cast<std::size_t>(v)] < 0;
          })) {
        faces.push_back(loop);
        tags.push_back(tag[f]);
      }
    }
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    if (rim.size() >= 3) {
      faces.push_back(around(rim, normal));
      tags.push_back(behind);
    }
    shape.faces = faces;
    tag = tags;
    compact();
  }

 private:
  /// The points of a convex plane loop, counter-clockwise about `normal`.
  std::vector<int> around(std::vector<int> points, Vec3 const& normal) const {
    Vec3 middle{};
    for (int p : points) middle += shape.vertices[static_cast<std::size_t>(p)];
    middle = middle / static_cast<Real>(points.size());
    Mat3 const frame = frame_about(normal);
    auto angle = [&](int p) {
      Vec3 const y = shape.vertices[static_cast<std::size_t>(p)] - middle;
      return std::atan2(dot(y, frame[1]), dot(y, frame[0]));
    };
    std::sort(points.begin(), points.end(), [&](int a, int b) { return angle(a) < angle(b); });
    return points;
  }

  void compact() {
    std::vector<int> number(shape.vertices.size(), -1);
    std::vector<Vec3> kept;
    for (auto& face : shape.faces)
      for (int& v : face) {
        int& n = number[static_cast<std::size_t>(v)];
        if (n < 0) {
          n = static_cast<int>(kept.size());
          kept.push_back(shape.vertices[static_cast<std::size_t>(v)]);
        }
        v = n;
      }
    shape.vertices = kept;
  }
};

/// Points in buckets about a mean spacing wide, visited ring by ring.
class Buckets {
 public:
  Buckets(std::vector<Vec3> const& points, Real width) : width_(width) {
    for (std::size_t p = 0; p < points.size(); ++p) map_[place(points[p])].push_back(p);
  }
  template <class Visit>
  void ring(Vec3 const& centre, int r, Visit visit) const {
    auto const c = place(centre);
    for (int z = -r; z <= r; ++z)
      for (int y = -r; y <= r; ++y) {
        int const step = std::abs(z) == r || std::abs(y) == r ? 1 : 2 * r;
        for (int x = -r; x <= r; x += std::max(step, 1)) {
          auto const found = map_.find({c[0] + x, c[1] + y, c[2] + z});
          if (found == map_.end()) continue;
          for (std::size_t p : found->second) visit(p);
        }
      }
  }

 private:
  std::array<int, 3> place(Vec3 const& p) const {
    return {static_cast<int>(std::floor(p.x / width_)), static_cast<int>(std::floor(p.y / width_)),
            static_cast<int>(std::floor(p.z / width_))};
  }
  Real width_;
  std::map<std::array<int, 3>, std::vector<std::size_t>> map_;
};

/// Points thrown so far, to be kept apart.
class Spread {
 public:
  explicit Spread(Real width) : width_(width) {}
  void add(Vec3 const& p) { map_[place(p)].push_back(p); }
  /// Is a point closer than `distance` (at most the width)?
  bool near(Vec3 const& p, Real distance) const {
    auto const c = place(p);
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          auto const found = map_.find({c[0] + x, c[1] + y, c[2] + z});
          if (found == map_.end()) continue;
          for (Vec3 const& q : found->second)
            if (norm2(q - p) < square(distance)) return true;
        }
    return false;
  }

 private:
  std::array<int, 3> place(Vec3 const& p) const {
    return {static_cast<int>(std::floor(p.x / width_)), static_cast<int>(std::floor(p.y / width_)),
            static_cast<int>(std::floor(p.z / width_))};
  }
  Real width_;
  std::map<std::array<int, 3>, std::vector<Vec3>> map_;
};

/// Closest that two generators may be, in mean spacings: slivers between closer ones would set the time step.
/// Source: theory/solid.md section 11.
constexpr Real closest = 0.3;

struct Generators {
  std::vector<Vec3> points;
  Real spacing = 0;  ///< (volume / number)^(1/dimension), m
};

/// Uniformly random points, none closer to another than `closest` spacings. Source: dart throwing.
Generators random_points(Domain const& domain, int count, std::int64_t seed, int dimension) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  // Uniform doubles by hand: the distributions of the library differ between implementations.
  auto uniform = [&] { return static_cast<Real>(random() >> 11) * 0x1p-53; };
  Vec3 const low = domain.low(), size = domain.high() - low;
  Real measure = 1;
  for (int d = 0; d < dimension; ++d) measure *= size[d];
  auto next = [&] {
    Vec3 p{low.x + size.x * uniform(), low.y + size.y * uniform(), low.z + size.z * uniform()};
    for (int d = dimension; d < 3; ++d) p[d] = 0.5;
    return p;
  };
  // The share of the box that the body fills, from the points that hit it.
  std::int64_t inside = 0, thrown = 0;
  for (; thrown < 1000 || inside < 100; ++thrown) inside += domain.contains(next());
  Generators g;
  g.spacing = std::pow(measure * static_cast<Real>(inside) / static_cast<Real>(thrown) / count, 1.0 / dimension);
  Spread taken(g.spacing);
  // Balls of 0.3 spacings fill an eighth of the space at most, so that a place is soon found; the limit is for bodies
  // thinner than that.
  for (int misses = 0; static_cast<int>(g.points.size()) < count;) {
    Vec3 const p = next();
    if (!domain.contains(p)) continue;
    if (taken.near(p, closest * g.spacing) && ++misses < 1000) continue;
    misses = 0;
    taken.add(p);
    g.points.push_back(p);
  }
  return g;
}

std::vector<Cut> diagram(Domain const& domain, std::vector<Vec3> const& generators, Real spacing) {
  std::vector<Vec3> points = generators;
  for (Vec3 const& g : generators)
    for (Vec3 const& image : domain.images(g)) points.push_back(image);
  Buckets const buckets(points, spacing);
  auto const walls = domain.walls();
  auto const depth = [](Domain::Wall const& wall, Vec3 const& x) { return dot(wall.point - x, wall.normal); };
  std::vector<std::size_t> order(walls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Vec3 const margin{spacing, spacing, spacing};
  Vec3 const low = domain.low() - margin, high = domain.high() + margin;
  Real const slack = 1e-10 * spacing;
  int const farthest = static_cast<int>(norm(high - low) * 2 / spacing) + 2;
  std::vector<Cut> cells;
  for (std::size_t g = 0; g < generators.size(); ++g) {
    Vec3 const& x = generators[g];
    Cut cell(low, high);
    // The nearest walls bound the search for neighbours; of a finely facetted surface, most lie out of reach of what
    // the neighbours leave.
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(depth(walls[a], x), a) < std::pair(depth(walls[b], x), b);
    });
    std::size_t const first_walls = std::min<std::size_t>(6, order.size());
    auto clip_by = [&](std::size_t w) { cell.clip(walls[w].point, walls[w].normal, -1, slack); };
    for (std::size_t k = 0; k < first_walls; ++k) clip_by(order[k]);
    for (int r = 0; r <= farthest && (r - 1) * spacing < 2 * cell.reach(x); ++r)
      buckets.ring(x, r, [&](std::size_t p) {
        if (p == g || norm2(points[p] - x) > 4 * square(cell.reach(x))) return;
        Index const behind = p < generators.size() ? static_cast<Index>(p) : -1;
        cell.clip(0.5 * (points[p] + x), normalized(points[p] - x), behind, slack);
      });
    for (std::size_t k = first_walls; k < order.size() && depth(walls[order[k]], x) < cell.reach(x); ++k)
      clip_by(order[k]);
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace

Cells voronoi(Domain const& domain, int particles, std::int64_t seed, int lloyd, int dimension) {
  auto [generators, spacing] = random_points(domain, particles, seed, dimension);
  std::vector<Cut> cuts = diagram(domain, generators, spacing);
  for (int sweep = 0; sweep < lloyd; ++sweep) {
    for (std::size_t g = 0; g < generators.size(); ++g) {
      Vec3 to = moments(cuts[g].shape).centre;
      for (int d = dimension; d < 3; ++d) to[d] = 0.5;
      // Early cells reach over a curved boundary: a generator outside would be mirrored to the wrong side.
      for (int halving = 0; halving < 4 && !domain.contains(to); ++halving) to = 0.5 * (to + generators[g]);
      if (domain.contains(to)) generators[g] = to;
    }
    cuts = diagram(domain, generators, spacing);
  }
  Cells cells;
  cells.whole_volume = domain.volume();
  for (std::size_t g = 0; g < generators.size(); ++g) cells.add(cuts[g].shape, cuts[g].tag, generators[g]);
  return cells;
}

}  // namespace brisance::solid
