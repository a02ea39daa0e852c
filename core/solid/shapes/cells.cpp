#include "core/solid/shapes/cells.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace brisance::solid {

std::pair<Shape, Vec3> make_shape(Polyhedron const& absolute) {
  Vec3 const centre = moments(absolute).centre;
  Shape s;
  s.polyhedron = translated(absolute, -centre);
  Moments const m = moments(s.polyhedron);
  s.volume = m.volume;
  s.second = m.second;
  for (std::size_t f = 0; f < s.polyhedron.faces.size(); ++f) s.faces.push_back(face_geometry(s.polyhedron, f));
  return {s, centre};
}

void Cells::add(Polyhedron const& absolute, std::vector<Index> const& neighbours) {
  auto [s, c] = make_shape(absolute);
  shape.push_back(static_cast<Index>(shapes.size()));
  shapes.push_back(std::move(s));
  centre.push_back(c);
  if (neighbours.empty())
    neighbour.resize(neighbour.size() + absolute.faces.size(), -1);
  else
    neighbour.insert(neighbour.end(), neighbours.begin(), neighbours.end());
  first.push_back(neighbour.size());
}

void Cells::add(Polyhedron const& absolute, std::vector<Index> const& neighbours, Vec3 const& pole) {
  add(absolute, neighbours);
  shapes.back().pole = pole - centre.back();
}

void match_faces(Cells& cells) {
  struct Face {
    Index cell;
    std::size_t slot;
    Vec3 centroid, normal;
    Real size;
  };
  std::vector<Face> faces;
  Real smallest = 1e300;
  for (std::size_t c = 0; c < cells.count(); ++c) {
    Shape const& s = cells.shapes[static_cast<std::size_t>(cells.shape[c])];
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      Real const size = std::sqrt(s.faces[f].area);
      faces.push_back(
          {static_cast<Index>(c), cells.first[c] + f, cells.centre[c] + s.faces[f].centroid, s.faces[f].normal, size});
      smallest = min(smallest, size);
    }
  }
  // Buckets of a hundredth of the smallest face: a partner lies in the same bucket or in one of its neighbours.
  Real const bucket = 0.01 * smallest;
  auto key = [](std::int64_t a, std::int64_t b, std::int64_t c) {
    auto const mix = [](std::int64_t x) { return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ull; };
    return (mix(a) ^ (mix(b) << 21 | mix(b) >> 43)) + (mix(c) << 42 | mix(c) >> 22);
  };
  auto cell_of = [&](Real x) { return static_cast<std::int64_t>(std::floor(x / bucket)); };
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> map;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Vec3 const& g = faces[f].centroid;
    auto const x = cell_of(g.x), y = cell_of(g.y), z = cell_of(g.z);
    for (std::int64_t a = x - 1; a <= x + 1; ++a)
      for (std::int64_t b = y - 1; b <= y + 1; ++b)
        for (std::int64_t c = z - 1; c <= z + 1; ++c) {
          auto const found = map.find(key(a, b, c));
          if (found == map.end()) continue;
          for (std::size_t other : found->second) {
            Face const& o = faces[other];
            if (cells.neighbour[o.slot] >= 0 || cells.neighbour[faces[f].slot] >= 0) continue;
            if (norm(o.centroid - g) > bucket || dot(o.normal, faces[f].normal) > -0.999) continue;
            if (std::abs(o.size - faces[f].size) > 1e-6 * o.size) continue;
            cells.neighbour[o.slot] = faces[f].cell;
            cells.neighbour[faces[f].slot] = o.cell;
          }
        }
    map[key(x, y, z)].push_back(f);
  }
}

Mat3 frame_about(Vec3 const& axis) {
  Vec3 const w = normalized(axis);
  // The helper is x unless the axis is nearly x, so that the frame of z is exactly (x, y, z).
  Vec3 const helper = std::abs(w.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 const u = normalized(helper - dot(helper, w) * w);
  return {{u, cross(w, u), w}};
}

}  // namespace brisance::solid
