#include "core/solid/meshes/refill.hpp"

namespace brisance::solid {
namespace {

/// The point of a triangle nearest to p.  Source: Ericson, Real-Time Collision Detection, 5.1.5.
Vec3 nearest_point(Vec3 const& a, Vec3 const& b, Vec3 const& c, Vec3 const& p) {
  Vec3 const ab = b - a, ac = c - a, ap = p - a;
  Real const d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  Vec3 const bp = p - b;
  Real const d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  Real const vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  Vec3 const cp = p - c;
  Real const d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  Real const vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  Real const va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  Real const whole = 1 / (va + vb + vc);
  return a + (vb * whole) * ab + (vc * whole) * ac;
}

}  // namespace

Vec3 nearest_point(TriangleSurface const& s, std::size_t f, Vec3 const& p) {
  auto const corner = [&](std::size_t k) -> Vec3 const& {
    return s.vertices[static_cast<std::size_t>(s.facets[f][k])];
  };
  return nearest_point(corner(0), corner(1), corner(2), p);
}

TriangleSurface boundary_of(Cells const& cells, std::string const& path) {
  std::vector<std::vector<std::string>> names_at(cells.neighbour.size());
  for (auto const& [name, slots] : cells.face_groups)
    for (std::size_t slot : slots) names_at[slot].push_back(name);
  std::vector<Vec3> corners;
  std::vector<std::vector<std::string>> names;
  for (std::size_t c = 0; c < cells.count(); ++c) {
    Polyhedron const& p = cells.shapes[static_cast<std::size_t>(cells.shape[c])].polyhedron;
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
      if (cells.neighbour[cells.first[c] + f] >= 0) continue;
      auto const& loop = p.faces[f];
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        for (int v : {loop[0], loop[k], loop[k + 1]})
          corners.push_back(cells.centre[c] + p.vertices[static_cast<std::size_t>(v)]);
        names.push_back(names_at[cells.first[c] + f]);
      }
    }
  }
  TriangleSurface surface;
  surface.path = path;
  weld(corners, surface);
  for (std::int64_t const n : surface.number) surface.groups.push_back(names[static_cast<std::size_t>(n - 1)]);
  return surface;
}

void name_faces(TriangleSurface const& s, Cells& cells) {
  if (s.groups.empty()) return;
  std::vector<Vec3> normal;
  for (auto const& [a, b, c] : s.facets) {
    auto const at = [&](Index v) -> Vec3 const& { return s.vertices[static_cast<std::size_t>(v)]; };
    normal.push_back(normalized(cross(at(b) - at(a), at(c) - at(a))));
  }
  for (std::size_t c = 0; c < cells.count(); ++c) {
    Shape const& shape = cells.shapes[static_cast<std::size_t>(cells.shape[c])];
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      if (cells.neighbour[cells.first[c] + f] >= 0) continue;
      Vec3 const x = cells.centre[c] + shape.faces[f].centroid;
      Real least = 1e300;
      std::size_t nearest = s.facets.size();
      for (std::size_t g = 0; g < s.facets.size(); ++g) {
        if (dot(normal[g], shape.faces[f].normal) < 0.5) continue;
        Real const distance = norm2(nearest_point(s, g, x) - x);
        if (distance < least) least = distance, nearest = g;
      }
      if (nearest == s.facets.size()) continue;
      for (std::string const& name : s.groups[nearest]) cells.face_groups[name].push_back(cells.first[c] + f);
    }
  }
}

}  // namespace brisance::solid
