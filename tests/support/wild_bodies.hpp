// Random bodies in the places where cut-cell geometry fails: faces, edges and corners on the planes, lines and nodes of
// the unit lattice, bodies that touch, gaps and plates thinner than rounding, folded and collapsed surfaces.
#pragma once
#include "tests/support/shapes.hpp"

namespace brisance::testing {

enum class Wild { plain, pile, gap, plate, folded, crumbs, crack, collapsed, rounded, count };

inline char const* name(Wild w) {
  constexpr char const* names[] = {"plain",  "pile",  "gap",       "plate",  "folded",
                                   "crumbs", "crack", "collapsed", "rounded"};
  return names[static_cast<int>(w)];
}

class WildBodies {
 public:
  explicit WildBodies(unsigned seed) : random_(seed) {}

  Real uniform(Real low, Real high) { return std::uniform_real_distribution<Real>(low, high)(random_); }
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  /// A coordinate near x: as it is, on a plane of the lattice, on a half or third of it, or off these by 1e-17 to 1e-6.
  Real snapped(Real x) {
    Real const on = std::nearbyint(x);
    switch (pick(6)) {
      case 0:
        return x;
      case 1:
        return on + (pick(2) ? 1 : -1) * std::pow(10.0, uniform(-17, -6));
      case 2:
        return std::nearbyint(2 * x) / 2;
      case 3:
        return std::nearbyint(3 * x) / 3;
      default:
        return on;
    }
  }
  Vec3 snapped(Vec3 p) { return {snapped(p.x), snapped(p.y), snapped(p.z)}; }
  Vec3 anywhere(Real r) { return {uniform(-r, r), uniform(-r, r), uniform(-r, r)}; }

  Shape body(Wild kind) {
    Vec3 const at = snapped(anywhere(2));
    switch (kind) {
      case Wild::plain:
        return one(at);
      case Wild::pile: {  // boxes on boxes, their faces coincident in part
        Shape s = box(at, at + size());
        int const d = pick(3);
        Vec3 low = at;
        for (int n = 1 + pick(3); n > 0; --n) {
          Real top = -1e300;
          for (auto const& p : s.points) top = max(top, p[d]);
          for (int e = 0; e < 3; ++e) low[e] = e == d ? top : snapped(at[e] + uniform(-1, 1));
          s.append(box(low, low + size()));
        }
        return s;
      }
      case Wild::gap: {  // two bodies face to face, 1e-17 to 0.1 of a cell apart
        Shape s = pick(2) ? box(at, at + size()) : icosphere(at, uniform(0.3, 1.5), pick(2));
        int const d = pick(3);
        Real top = -1e300;
        for (auto const& p : s.points) top = max(top, p[d]);
        Shape const other = mapped(s, [&](Vec3 p) {
          p[d] = 2 * top - p[d] + gap_;
          return p;
        });
        gap_ = pick(4) ? std::pow(10.0, uniform(-17, -1)) : 0;
        Shape mirrored = other;
        for (auto& f : mirrored.faces) std::swap(f[1], f[2]);
        s.append(mirrored);
        return s;
      }
      case Wild::plate: {
        Vec3 edge = size();
        edge[pick(3)] = std::pow(10.0, uniform(-15, -1));
        if (pick(3) == 0) edge[pick(3)] = std::pow(10.0, uniform(-15, -1));
        Shape s = box(at, at + edge);
        if (pick(2)) s = turned(s, at);
        return s;
      }
      case Wild::folded: {
        Shape s = icosphere(at, uniform(0.3, 1.5), 1 + pick(2));
        Real const size = pick(2) ? 0.3 : 1.0;
        return mapped(s, [&](Vec3 p) { return pick(2) ? p : pick(2) ? p + anywhere(size) : snapped(p); });
      }
      case Wild::crumbs: {
        Shape s;
        for (int n = 3 + pick(5); n > 0; --n) {
          Vec3 const corner = std::floor(at.x) * Vec3{1, 0, 0} + Vec3{0, at.y, at.z} +
                              Vec3{0.25 * n + uniform(0, 0.02), uniform(0, 0.5), uniform(0, 0.5)};
          s.append(pick(2) ? icosphere(corner, uniform(0.01, 0.1), 0)
                           : box(corner, corner + Vec3{uniform(0.01, 0.2), uniform(0.01, 0.4), uniform(0.01, 0.4)}));
        }
        return s;
      }
      case Wild::crack: {  // a box in two halves whose faces along the crack coincide
        Vec3 const edge = size();
        Vec3 middle = edge;
        int const d = pick(3);
        middle[d] = snapped(0.5 * edge[d]);
        if (!(middle[d] > 0.05 && middle[d] < edge[d] - 0.01)) middle[d] = 0.5 * edge[d];
        Shape s = box(at, at + middle);
        Vec3 low{};
        low[d] = middle[d];
        s.append(box(at + low, at + edge));
        return pick(2) ? s : turned(s, at);
      }
      case Wild::collapsed: {  // triangles without area, corners that coincide or lie on edges
        Shape s = one(at);
        for (int n = 0; n < 4; ++n) split_edge(s);
        return s;
      }
      case Wild::rounded:
      case Wild::count:
        break;
    }
    Shape const s = icosphere(at, uniform(0.5, 2.5), pick(2));
    Real const grid = pick(2) ? 1 : 2;
    return mapped(s, [&](Vec3 p) {
      for (int d = 0; d < 3; ++d) p[d] = std::nearbyint(grid * p[d]) / grid;
      return p;
    });
  }

  /// The body after a step: all corners less than a cell away.
  Shape moved(Shape const& s) {
    Vec3 const by = pick(3) ? anywhere(0.5) : 0.5 * Vec3{Real(pick(3) - 1), Real(pick(3) - 1), Real(pick(3) - 1)};
    Vec3 const spin = pick(2) ? anywhere(0.1) : Vec3{};
    bool const shaken = pick(4) == 0, on_lattice = pick(5) == 0;
    Shape out = s;
    for (auto& p : out.points) {
      Vec3 const r = p - s.points[0];
      p += by + cross(spin, r);
      if (shaken) p += anywhere(0.2);
      if (on_lattice) p = snapped(p);
    }
    return out;
  }

 private:
  Vec3 size() {
    Vec3 const e{snapped(uniform(0.2, 2.5)), snapped(uniform(0.2, 2.5)), snapped(uniform(0.2, 2.5))};
    return {max(e.x, 0.1), max(e.y, 0.1), max(e.z, 0.1)};
  }
  Shape one(Vec3 at) {
    switch (pick(4)) {
      case 0:
        return icosphere(at, uniform(0.1, 2), pick(3));
      case 1:
        return box(at, at + size());
      case 2: {
        Shape const s = box(at, at + size());
        return mapped(s, [&](Vec3 p) { return snapped(p); });
      }
      default: {
        Shape s;
        s.points = {at, snapped(at + Vec3{uniform(1, 3), uniform(-0.2, 0.2), 0}),
                    snapped(at + Vec3{uniform(-0.2, 0.2), uniform(1, 3), uniform(-0.2, 0.2)}),
                    snapped(at + Vec3{0, uniform(-0.2, 0.2), uniform(1, 3)})};
        s.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        return s;
      }
    }
  }
  Shape turned(Shape const& s, Vec3 about) {
    Vec3 const axis = normalized(anywhere(1) + Vec3{1e-3, 0, 0});
    Real const angle = pick(3) ? uniform(-3, 3) : std::pow(10.0, uniform(-16, -2));
    return mapped(s, [&](Vec3 p) {
      Vec3 const r = p - about;
      return about + std::cos(angle) * r + std::sin(angle) * cross(axis, r) +
             (1 - std::cos(angle)) * dot(axis, r) * axis;
    });
  }
  /// A new corner on an edge, maybe at one of its ends or off it by rounding, maybe on a plane of the lattice.
  void split_edge(Shape& s) {
    auto const f = static_cast<std::size_t>(pick(static_cast<int>(s.faces.size())));
    auto const k = static_cast<std::size_t>(pick(3));
    int const a = s.faces[f][k], b = s.faces[f][(k + 1) % 3];
    Vec3 const &p = s.points[static_cast<std::size_t>(a)], &q = s.points[static_cast<std::size_t>(b)];
    Real const t = pick(3) == 0 ? 0 : pick(2) ? 1 : uniform(0, 1);
    Vec3 m = p + t * (q - p);
    if (pick(4) == 0) m = snapped(m);
    int const c = static_cast<int>(s.points.size());
    s.points.push_back(m);
    for (std::size_t g = 0, n = s.faces.size(); g < n; ++g)
      for (std::size_t e = 0; e < 3; ++e) {
        int const u = s.faces[g][e], v = s.faces[g][(e + 1) % 3], w = s.faces[g][(e + 2) % 3];
        if (!((u == a && v == b) || (u == b && v == a))) continue;
        s.faces[g] = {u, c, w};
        s.faces.push_back({c, v, w});
        break;
      }
  }

  std::mt19937 random_;
  Real gap_ = 0;
};

}  // namespace brisance::testing
