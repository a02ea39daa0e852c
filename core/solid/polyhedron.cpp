#include "core/solid/polyhedron.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace brisance::solid {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3 mean(std::vector<Vec3> const& points) {
  Vec3 sum{};
  for (Vec3 const& p : points) sum += p;
  return sum / static_cast<Real>(points.size());
}

Real size_of(Polyhedron const& p) {
  Vec3 const c = mean(p.vertices);
  Real r = 0;
  for (Vec3 const& v : p.vertices) r = max(r, norm(v - c));
  return r;
}

/// Smallest and largest projection of the vertices on an axis.
std::pair<Real, Real> extent(Polyhedron const& p, Vec3 const& axis) {
  Real low = dot(p.vertices[0], axis), high = low;
  for (Vec3 const& v : p.vertices) {
    Real const s = dot(v, axis);
    low = min(low, s), high = max(high, s);
  }
  return {low, high};
}

std::vector<Vec3> edge_directions(Polyhedron const& p) {
  std::vector<Vec3> directions;
  for (auto const& face : p.faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      int const a = face[k], b = face[(k + 1) % face.size()];
      if (a > b) continue;
      Vec3 const d = normalized(p.vertices[at(b)] - p.vertices[at(a)]);
      bool const known =
          std::any_of(directions.begin(), directions.end(), [&](Vec3 const& e) { return norm2(cross(d, e)) < 1e-20; });
      if (!known) directions.push_back(d);
    }
  return directions;
}

}  // namespace

Moments moments(Polyhedron const& p) {
  // Tetrahedra from one inner point to the fanned faces; the fan point of a face is its first vertex (faces are plane).
  Vec3 const apex = mean(p.vertices);
  auto for_each_tetrahedron = [&](auto&& visit) {
    for (auto const& face : p.faces)
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        visit(p.vertices[at(face[0])], p.vertices[at(face[k])], p.vertices[at(face[k + 1])]);
  };
  Moments m;
  Vec3 first{};
  for_each_tetrahedron([&](Vec3 const& a, Vec3 const& b, Vec3 const& c) {
    Real const v = dot(a - apex, cross(b - apex, c - apex)) / 6;
    m.volume += v;
    first += (v / 4) * ((a - apex) + (b - apex) + (c - apex));
  });
  m.centre = apex + first / m.volume;
  for_each_tetrahedron([&](Vec3 const& a, Vec3 const& b, Vec3 const& c) {
    Real const v = dot(a - apex, cross(b - apex, c - apex)) / 6;
    Vec3 const y0 = apex - m.centre, y1 = a - m.centre, y2 = b - m.centre, y3 = c - m.centre;
    Vec3 const s = y0 + y1 + y2 + y3;
    m.second = m.second + (v / 20) * (outer(y0, y0) + outer(y1, y1) + outer(y2, y2) + outer(y3, y3) + outer(s, s));
  });
  return m;
}

FaceGeometry face_geometry(Polyhedron const& p, std::size_t face) {
  auto const& corners = p.faces[face];
  auto corner = [&](std::size_t k) -> Vec3 const& { return p.vertices[at(corners[k])]; };
  FaceGeometry g;
  Vec3 const o = corner(0);
  Vec3 vector{};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) vector += 0.5 * cross(corner(k) - o, corner(k + 1) - o);
  g.area = norm(vector);
  g.normal = vector / g.area;
  Vec3 first{};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    Real const a = 0.5 * dot(cross(corner(k) - o, corner(k + 1) - o), g.normal);
    first += (a / 3) * ((corner(k) - o) + (corner(k + 1) - o));
  }
  g.centroid = o + first / g.area;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    Real const a = 0.5 * dot(cross(corner(k) - o, corner(k + 1) - o), g.normal);
    Vec3 const y0 = o - g.centroid, y1 = corner(k) - g.centroid, y2 = corner(k + 1) - g.centroid;
    Vec3 const s = y0 + y1 + y2;
    g.second = g.second + (a / 12) * (outer(y0, y0) + outer(y1, y1) + outer(y2, y2) + outer(s, s));
  }
  return g;
}

std::optional<ShapeFault> fault(Polyhedron const& p, Real tolerance) {
  if (p.vertices.size() < 4 || p.faces.size() < 4)
    return ShapeFault{"fewer than four vertices or faces", p.vertices.empty() ? Vec3{} : p.vertices[0]};
  std::map<std::pair<int, int>, int> edges;
  for (auto const& face : p.faces) {
    if (face.size() < 3) return ShapeFault{"a face with fewer than three vertices", p.vertices[0]};
    for (std::size_t k = 0; k < face.size(); ++k) ++edges[{face[k], face[(k + 1) % face.size()]}];
  }
  for (auto const& [edge, count] : edges) {
    auto const back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1)
      return ShapeFault{"not closed at an edge", p.vertices[at(edge.first)]};
  }
  Moments const m = moments(p);
  if (!(m.volume > 0)) return ShapeFault{"no volume, or faces turned inward", m.centre};
  Real const size = size_of(p), slack = tolerance * size;
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    FaceGeometry const g = face_geometry(p, f);
    if (g.area <= 1e-10 * square(size)) continue;  // a sliver has no direction to judge by
    for (int c : p.faces[f])
      if (std::abs(dot(p.vertices[at(c)] - g.centroid, g.normal)) > slack)
        return ShapeFault{"a face that is not plane", p.vertices[at(c)]};
    // Each corner of a face must turn left; looked at on all faces first, since it names the notch itself.
    auto const& face = p.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      Vec3 const &a = p.vertices[at(face[k])], &b = p.vertices[at(face[(k + 1) % face.size()])],
                 &c = p.vertices[at(face[(k + 2) % face.size()])];
      if (dot(cross(b - a, c - b), g.normal) < -slack * norm(b - a)) return ShapeFault{"not convex", b};
    }
  }
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    FaceGeometry const g = face_geometry(p, f);
    if (g.area <= 1e-10 * square(size)) continue;
  }
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    FaceGeometry const g = face_geometry(p, f);
    if (g.area <= 1e-10 * square(size)) continue;
    for (Vec3 const& v : p.vertices)
      if (dot(v - g.centroid, g.normal) > slack) return ShapeFault{"not convex", v};
  }
  return std::nullopt;
}

Polyhedron translated(Polyhedron p, Vec3 const& shift) {
  for (Vec3& v : p.vertices) v += shift;
  return p;
}

Real overlap_depth(Polyhedron const& a, Polyhedron const& b) {
  Real depth = 1e300;
  auto try_axis = [&](Vec3 const& axis) {
    auto const [a0, a1] = extent(a, axis);
    auto const [b0, b1] = extent(b, axis);
    depth = min(depth, min(a1 - b0, b1 - a0));
    return depth > 0;
  };
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    if (!try_axis(face_geometry(a, f).normal)) return depth;
  for (std::size_t f = 0; f < b.faces.size(); ++f)
    if (!try_axis(face_geometry(b, f).normal)) return depth;
  auto const da = edge_directions(a), db = edge_directions(b);
  for (Vec3 const& u : da)
    for (Vec3 const& v : db) {
      Vec3 const axis = cross(u, v);
      if (norm2(axis) > 1e-12 && !try_axis(normalized(axis))) return depth;
    }
  return depth;
}

}  // namespace brisance::solid
