// Cartesian and polar tessellations: cells whose corners lie on a regular grid of parameters.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {
namespace {

/// Hexahedron of corners numbered x fastest; degenerate corners are merged by `convex_hexahedron` below.
constexpr std::array<std::array<int, 4>, 6> hexahedron_faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// Hexahedron whose corners may coincide (wedges at an axis, pyramids at a centre): repeated corners become one, and
/// faces left with fewer than three of them vanish.
Polyhedron collapsed_hexahedron(std::array<Vec3, 8> const& corners, Real tolerance) {
  Polyhedron p;
  std::array<int, 8> id{};
  for (std::size_t c = 0; c < 8; ++c) {
    int found = -1;
    for (std::size_t v = 0; v < p.vertices.size() && found < 0; ++v)
      if (norm(p.vertices[v] - corners[c]) <= tolerance) found = static_cast<int>(v);
    if (found < 0) {
      found = static_cast<int>(p.vertices.size());
      p.vertices.push_back(corners[c]);
    }
    id[c] = found;
  }
  for (auto const& face : hexahedron_faces) {
    std::vector<int> loop;
    for (int c : face) {
      int const v = id[static_cast<std::size_t>(c)];
      if ((loop.empty() || loop.back() != v) && (loop.empty() || loop.front() != v)) loop.push_back(v);
    }
    if (loop.size() >= 3) p.faces.push_back(loop);
  }
  return p;
}

Polyhedron brick(Vec3 const& low, Vec3 const& high) {
  Polyhedron p;
  for (int c = 0; c < 8; ++c)
    p.vertices.push_back({c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z});
  for (auto const& face : hexahedron_faces) p.faces.push_back({face.begin(), face.end()});
  return p;
}

/// Bricks of one shape on a grid; `place` maps grid coordinates (0..n) to space.
template <class Place>
Cells bricks(Shape const& shape, std::array<Index, 3> const& n, Place place) {
  Cells cells;
  cells.shapes.push_back(shape);
  auto id = [&](Index i, Index j, Index k) { return i + n[0] * (j + n[1] * k); };
  for (Index k = 0; k < n[2]; ++k)
    for (Index j = 0; j < n[1]; ++j)
      for (Index i = 0; i < n[0]; ++i) {
        cells.shape.push_back(0);
        cells.centre.push_back(place(i + 0.5, j + 0.5, k + 0.5));
        cells.neighbour.push_back(i > 0 ? id(i - 1, j, k) : -1);
        cells.neighbour.push_back(i + 1 < n[0] ? id(i + 1, j, k) : -1);
        cells.neighbour.push_back(j > 0 ? id(i, j - 1, k) : -1);
        cells.neighbour.push_back(j + 1 < n[1] ? id(i, j + 1, k) : -1);
        cells.neighbour.push_back(k > 0 ? id(i, j, k - 1) : -1);
        cells.neighbour.push_back(k + 1 < n[2] ? id(i, j, k + 1) : -1);
        cells.first.push_back(cells.neighbour.size());
      }
  return cells;
}

}  // namespace

Cells graded_box(std::array<std::vector<Real>, 3> const& cuts) {
  std::array<Index, 3> n{};
  for (std::size_t d = 0; d < 3; ++d) n[d] = static_cast<Index>(cuts[d].size()) - 1;
  auto cut = [&](std::size_t d, Real at) { return cuts[d][static_cast<std::size_t>(at)]; };
  auto middle = [&](std::size_t d, Real at) { return 0.5 * (cut(d, at) + cut(d, at + 1)); };
  Cells cells = bricks({}, n, [&](Real i, Real j, Real k) { return Vec3{middle(0, i), middle(1, j), middle(2, k)}; });
  // Layers of one thickness share their shape: cut 0.3 and 1.0 - 0.7 are the same to rounding.
  std::vector<std::pair<Vec3, Index>> known;
  cells.shapes.clear();
  for (std::size_t c = 0; c < cells.count(); ++c) {
    auto const at = static_cast<Index>(c);
    Index const i = at % n[0], j = at / n[0] % n[1], k = at / (n[0] * n[1]);
    Vec3 const size{cut(0, i + 1) - cut(0, i), cut(1, j + 1) - cut(1, j), cut(2, k + 1) - cut(2, k)};
    auto const same = [&](std::pair<Vec3, Index> const& s) { return norm(s.first - size) <= 1e-12 * norm(size); };
    auto const found = std::find_if(known.begin(), known.end(), same);
    if (found != known.end()) {
      cells.shape[c] = found->second;
      continue;
    }
    cells.shape[c] = static_cast<Index>(cells.shapes.size());
    known.emplace_back(size, cells.shape[c]);
    cells.shapes.push_back(make_shape(brick(-0.5 * size, 0.5 * size)).first);
  }
  return cells;
}

Cells cartesian_box(Vec3 const& low, Vec3 const& high, std::array<Index, 3> const& n) {
  Vec3 const size = high - low;
  Vec3 const h{size.x / n[0], size.y / n[1], size.z / n[2]};
  Shape const shape = make_shape(brick(-0.5 * h, 0.5 * h)).first;
  return bricks(shape, n, [&](Real i, Real j, Real k) {
    return Vec3{low.x + size.x * (i / n[0]), low.y + size.y * (j / n[1]), low.z + size.z * (k / n[2])};
  });
}

Cells cartesian_plate(BodyConfig const& body) {
  Mat3 const frame = frame_about(body.axis);
  auto const& n = body.cells;
  Vec3 const size{*body.length, *body.width, *body.thickness};
  Vec3 const h{size.x / n[0], size.y / n[1], size.z / n[2]};
  auto turned = [&](Vec3 const& y) { return y.x * frame[0] + y.y * frame[1] + y.z * frame[2]; };
  Polyhedron p = brick(-0.5 * h, 0.5 * h);
  for (Vec3& v : p.vertices) v = turned(v);
  return bricks(make_shape(p).first, n, [&](Real i, Real j, Real k) {
    return *body.centre + turned({size.x * (i / n[0] - 0.5), size.y * (j / n[1] - 0.5), size.z * (k / n[2] - 0.5)});
  });
}

Cells prism(BodyConfig const& body, Real low, Real high) {
  Polyhedron p;
  int const n = static_cast<int>(body.corners.size() / 2);
  std::vector<int> bottom, top;
  for (int k = 0; k < n; ++k) {
    auto const at = static_cast<std::size_t>(2 * k);
    p.vertices.push_back({body.corners[at], body.corners[at + 1], low});
    top.push_back(n + k);
    bottom.insert(bottom.begin(), k);
  }
  for (int k = 0; k < n; ++k) {
    Vec3 const v = p.vertices[static_cast<std::size_t>(k)];
    p.vertices.push_back({v.x, v.y, high});
    p.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  p.faces.push_back(bottom);
  p.faces.push_back(top);
  Cells cells;
  cells.add(p, {});
  return cells;
}

Cells polar_tube(Vec3 const& centre, Vec3 const& axis, Real inner, Real outer, Real length, Real phase,
                 std::array<Index, 3> const& n) {
  Mat3 const frame = frame_about(axis);
  auto corner = [&](Index r, Index a, Index z) {
    Real const radius = inner + (outer - inner) * r / n[0];
    Real const angle = phase + 2 * std::numbers::pi * (a % n[1]) / n[1];
    Real const height = length * (static_cast<Real>(z) / n[2] - 0.5);
    return centre + (radius * std::cos(angle)) * frame[0] + (radius * std::sin(angle)) * frame[1] + height * frame[2];
  };
  Cells cells;
  for (Index z = 0; z < n[2]; ++z)
    for (Index a = 0; a < n[1]; ++a)
      for (Index r = 0; r < n[0]; ++r) {
        std::array<Vec3, 8> c;
        for (int k = 0; k < 8; ++k)
          c[static_cast<std::size_t>(k)] = corner(r + (k & 1), a + (k >> 1 & 1), z + (k >> 2 & 1));
        cells.add(collapsed_hexahedron(c, 1e-12 * outer), {});
      }
  match_faces(cells);
  return cells;
}

Cells polar_shell(Vec3 const& centre, Vec3 const& axis, Real inner, Real outer, Real phase,
                  std::array<Index, 3> const& n) {
  Mat3 const frame = frame_about(axis);
  auto corner = [&](Index r, Index a, Index l) {
    Real const radius = inner + (outer - inner) * r / n[0];
    Real const angle = phase + 2 * std::numbers::pi * (a % n[1]) / n[1];
    // The poles exactly on the axis, so that their corners coincide.
    bool const pole = l == 0 || l == n[2];
    Real const latitude = std::numbers::pi * (static_cast<Real>(l) / n[2] - 0.5);
    Real const flat = pole ? 0 : radius * std::cos(latitude);
    Real const height = pole ? (l == 0 ? -radius : radius) : radius * std::sin(latitude);
    return centre + (flat * std::cos(angle)) * frame[0] + (flat * std::sin(angle)) * frame[1] + height * frame[2];
  };
  Cells cells;
  for (Index l = 0; l < n[2]; ++l)
    for (Index a = 0; a < n[1]; ++a)
      for (Index r = 0; r < n[0]; ++r) {
        std::array<Vec3, 8> c;
        for (int k = 0; k < 8; ++k)
          c[static_cast<std::size_t>(k)] = corner(r + (k & 1), a + (k >> 1 & 1), l + (k >> 2 & 1));
        cells.add(collapsed_hexahedron(c, 1e-12 * outer), {});
      }
  match_faces(cells);
  return cells;
}

}  // namespace brisance::solid
