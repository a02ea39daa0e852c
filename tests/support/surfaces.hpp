// Closed surfaces for tests, written as STL or OFF.
#pragma once
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <sstream>

#include "core/solid/meshes/surface_file.hpp"
#include "tests/support/msh.hpp"

namespace brisance::testing {

using solid::TriangleSurface;

/// Quadrangles are cut into two triangles.
inline void add_quadrangle(TriangleSurface& s, Index a, Index b, Index c, Index d) {
  s.facets.push_back({a, b, c});
  s.facets.push_back({a, c, d});
}

/// A prism over a polygon (counter-clockwise) with the triangles of its base given by hand.
inline TriangleSurface prism_surface(std::vector<Vec3> const& base, std::vector<std::array<Index, 3>> const& triangles,
                                     Real height) {
  TriangleSurface s;
  s.vertices = base;
  Index const n = static_cast<Index>(base.size());
  for (Vec3 const& x : base) s.vertices.push_back(x + Vec3{0, 0, height});
  for (auto const& [a, b, c] : triangles) {
    s.facets.push_back({a, c, b});
    s.facets.push_back({a + n, b + n, c + n});
  }
  for (Index k = 0; k < n; ++k) add_quadrangle(s, k, (k + 1) % n, (k + 1) % n + n, k + n);
  return s;
}

inline TriangleSurface box_surface(Vec3 const& size) {
  return prism_surface({{0, 0, 0}, {size.x, 0, 0}, {size.x, size.y, 0}, {0, size.y, 0}}, {{0, 1, 2}, {0, 2, 3}},
                       size.z);
}

/// An angle of two legs 1 wide and 3 long, 1 thick: volume 5.
inline TriangleSurface angle_surface() {
  return prism_surface({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
                       {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}, 1);
}

/// An icosahedron with every triangle cut into four `times` times, on the sphere of radius 1.
inline TriangleSurface ball_surface(int times, Vec3 const& centre = {}) {
  TriangleSurface s;
  Real const g = (1 + std::sqrt(5.0)) / 2;
  for (Real a : {-1.0, 1.0})
    for (Real b : {-g, g})
      for (Vec3 const& x : {Vec3{0, a, b}, Vec3{a, b, 0}, Vec3{b, 0, a}}) s.vertices.push_back(normalized(x));
  for (Index i = 0; i < 12; ++i)
    for (Index j = i + 1; j < 12; ++j)
      for (Index k = j + 1; k < 12; ++k) {
        Vec3 const &a = s.vertices[i], &b = s.vertices[j], &c = s.vertices[k];
        Real const edge = 1.06;
        if (norm(a - b) > edge || norm(b - c) > edge || norm(c - a) > edge) continue;
        if (dot(cross(b - a, c - a), a) > 0)
          s.facets.push_back({i, j, k});
        else
          s.facets.push_back({i, k, j});
      }
  for (int t = 0; t < times; ++t) {
    std::map<std::pair<Index, Index>, Index> middle;
    auto between = [&](Index a, Index b) {
      auto const [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(s.vertices.size()));
      if (fresh) s.vertices.push_back(normalized(s.vertices[a] + s.vertices[b]));
      return it->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (auto const& [a, b, c] : s.facets) {
      Index const d = between(a, b), e = between(b, c), f = between(c, a);
      finer.insert(finer.end(), {{a, d, f}, {d, b, e}, {f, e, c}, {d, e, f}});
    }
    s.facets = finer;
  }
  for (Vec3& x : s.vertices) x += centre;
  return s;
}

/// A torus about z: ring radius 1, tube radius `r`.
inline TriangleSurface torus_surface(Index around, Index across, Real r) {
  TriangleSurface s;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      Real const a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      Real const q = 1 + r * std::cos(b);
      s.vertices.push_back({q * std::cos(a), q * std::sin(a), r * std::sin(b)});
    }
  auto id = [&](Index i, Index j) { return (i % around) * across + j % across; };
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) add_quadrangle(s, id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
  return s;
}

/// Both surfaces in one, the second turned inside out: a cavity.
inline TriangleSurface with_cavity(TriangleSurface outer, TriangleSurface const& inner) {
  Index const shift = static_cast<Index>(outer.vertices.size());
  outer.vertices.insert(outer.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (auto const& [a, b, c] : inner.facets) outer.facets.push_back({a + shift, c + shift, b + shift});
  return outer;
}

inline std::string write_stl(std::string const& name, TriangleSurface const& s, bool binary) {
  std::ostringstream out;
  if (binary) {
    out << std::string(80, ' ');
    auto const count = static_cast<std::uint32_t>(s.facets.size());
    out.write(reinterpret_cast<char const*>(&count), 4);
  } else {
    out << "solid thing\n";
  }
  for (auto const& facet : s.facets) {
    if (binary) {
      std::array<float, 12> x{};
      for (std::size_t k = 0; k < 3; ++k)
        for (int d = 0; d < 3; ++d)
          x[3 + 3 * k + static_cast<std::size_t>(d)] =
              static_cast<float>(s.vertices[static_cast<std::size_t>(facet[k])][d]);
      out.write(reinterpret_cast<char const*>(x.data()), 48);
      out.write("\0\0", 2);
      continue;
    }
    out << " facet normal 0 0 0\n  outer loop\n";
    out.precision(17);
    for (Index v : facet) {
      Vec3 const& x = s.vertices[static_cast<std::size_t>(v)];
      out << "   vertex " << x.x << " " << x.y << " " << x.z << "\n";
    }
    out << "  endloop\n endfacet\n";
  }
  if (!binary) out << "endsolid thing\n";
  return temporary_file(name + ".stl", out.str());
}

inline std::string write_off(std::string const& name, TriangleSurface const& s) {
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n# a comment\n" << s.vertices.size() << " " << s.facets.size() << " 0\n";
  for (Vec3 const& x : s.vertices) out << x.x << " " << x.y << " " << x.z << "\n";
  for (auto const& [a, b, c] : s.facets) out << "3 " << a << " " << b << " " << c << " 255 0 0\n";
  return temporary_file(name + ".off", out.str());
}

}  // namespace brisance::testing
