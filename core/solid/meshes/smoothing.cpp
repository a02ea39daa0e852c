#include "core/solid/meshes/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr std::array<std::array<std::size_t, 3>, 4> sides{{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

std::array<Index, 3> side_of(MeshElement const& e, std::size_t side) {
  std::array<Index, 3> n{e.node[sides[side][0]], e.node[sides[side][1]], e.node[sides[side][2]]};
  std::sort(n.begin(), n.end());
  return n;
}

Real quality(ElementMesh const& mesh, MeshElement const& e) {
  auto const x = [&](std::size_t k) -> Vec3 const& { return mesh.nodes[at(e.node[k])]; };
  return tetrahedron_quality(x(0), x(1), x(2), x(3));
}

std::map<std::array<Index, 3>, int> count_sides(ElementMesh const& mesh) {
  std::map<std::array<Index, 3>, int> count;
  for (MeshElement const& e : mesh.elements)
    for (std::size_t s = 0; s < 4; ++s) ++count[side_of(e, s)];
  return count;
}

/// Flat ones that show two faces, and those without volume that lie in the surface: what is left is closed as before
/// and hardly smaller.
void peel(ElementMesh& mesh) {
  constexpr Real flat = 0.1, no_volume = 1e-6;
  for (bool again = true; again;) {
    auto const count = count_sides(mesh);
    again = std::erase_if(mesh.elements, [&](MeshElement const& e) {
              int shown = 0;
              for (std::size_t s = 0; s < 4; ++s) shown += count.at(side_of(e, s)) == 1;
              Real const q = quality(mesh, e);
              return (shown == 2 && q < flat) || (shown > 0 && q < no_volume);
            }) > 0;
  }
}

/// Four nodes as a tetrahedron that is not inside out.
MeshElement tetrahedron(ElementMesh const& mesh, MeshElement const& like, std::array<Index, 4> n) {
  MeshElement e = like;
  std::copy(n.begin(), n.end(), e.node.begin());
  if (quality(mesh, e) < 0) std::swap(e.node[2], e.node[3]);
  return e;
}

Real volume(ElementMesh const& mesh, MeshElement const& e) {
  auto const x = [&](std::size_t k) -> Vec3 const& { return mesh.nodes[at(e.node[k])]; };
  return std::abs(dot(cross(x(1) - x(0), x(2) - x(0)), x(3) - x(0))) / 6;
}

/// The nodes around an inner edge in order, and the tetrahedra that have it; no nodes when they do not close.
struct Ring {
  std::vector<Index> nodes;
  std::vector<std::size_t> elements;
};
Ring ring_around(ElementMesh const& mesh, Index a, Index c) {
  Ring ring;
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    std::vector<Index> others;
    for (Index n : mesh.elements[k].nodes())
      if (n != a && n != c) others.push_back(n);
    if (others.size() != 2) continue;
    ring.elements.push_back(k);
    pairs.push_back({others[0], others[1]});
  }
  std::vector<Index> nodes{pairs[0][0], pairs[0][1]};
  pairs.erase(pairs.begin());
  while (!pairs.empty()) {
    auto const next = std::find_if(pairs.begin(), pairs.end(),
                                   [&](auto const& p) { return p[0] == nodes.back() || p[1] == nodes.back(); });
    if (next == pairs.end()) return ring;
    nodes.push_back((*next)[0] == nodes.back() ? (*next)[1] : (*next)[0]);
    pairs.erase(next);
  }
  if (nodes.back() == nodes.front()) nodes.pop_back(), ring.nodes = nodes;
  return ring;
}

/// A flat one whose edges a-c and b-d cross gets a node there: those around either edge are halved, and it is gone.
bool split_flat(ElementMesh& mesh, std::size_t flat) {
  std::array<Index, 8> const n = mesh.elements[flat].node;
  constexpr std::array<std::array<std::size_t, 4>, 3> crossings{{{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}};
  for (auto const& [a, c, b, d] : crossings) {
    Vec3 const x = mesh.nodes[at(n[a])], u = mesh.nodes[at(n[c])] - x, y = mesh.nodes[at(n[b])],
               v = mesh.nodes[at(n[d])] - y, w = y - x;
    // Nearest points x + s u and y + t v of the two lines.
    Real const uu = norm2(u), uv = dot(u, v), vv = norm2(v), det = uu * vv - uv * uv;
    if (!(det > 1e-6 * uu * vv)) continue;
    Real const s = (dot(w, u) * vv - dot(w, v) * uv) / det, t = (dot(w, u) * uv - dot(w, v) * uu) / det;
    if (min(s, t) < 0.1 || max(s, t) > 0.9) continue;
    Index const middle = static_cast<Index>(mesh.nodes.size());
    mesh.nodes.push_back(0.5 * ((x + s * u) + (y + t * v)));
    mesh.node_tag.push_back(static_cast<std::int64_t>(middle) + 1);
    mesh.elements.erase(mesh.elements.begin() + static_cast<std::ptrdiff_t>(flat));
    std::vector<MeshElement> halves;
    for (auto const& [from, to] : {std::pair{n[a], n[c]}, std::pair{n[b], n[d]}})
      for (MeshElement& e : mesh.elements) {
        auto const last = e.node.begin() + 4;
        auto const i = std::find(e.node.begin(), last, from), j = std::find(e.node.begin(), last, to);
        if (i == last || j == last) continue;
        MeshElement half = e;
        *i = middle;
        half.node[static_cast<std::size_t>(j - e.node.begin())] = middle;
        halves.push_back(half);
      }
    mesh.elements.insert(mesh.elements.end(), halves.begin(), halves.end());
    return true;
  }
  return false;
}

/// Flat ones inside, as four nodes on a circle make them: one of their edges is taken out, and the ring of nodes around
/// it is filled with two tetrahedra to a triangle, when they fill the same space and the worst is better.
void flip_flat(ElementMesh& mesh) {
  constexpr Real flat = 1e-3;
  constexpr std::size_t widest = 7;
  for (std::size_t f = 0; f < mesh.elements.size(); ++f) {
    MeshElement const e = mesh.elements[f];
    if (quality(mesh, e) >= flat) continue;
    Real best = flat;
    std::vector<std::size_t> gone;
    std::vector<MeshElement> come;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t c = a + 1; c < 4; ++c) {
        Ring const ring = ring_around(mesh, e.node[a], e.node[c]);
        std::size_t const m = ring.nodes.size();
        if (m < 3 || m > widest) continue;
        Real before = 0;
        for (std::size_t k : ring.elements) before += volume(mesh, mesh.elements[k]);
        for (std::size_t fan = 0; fan < m; ++fan) {
          std::vector<MeshElement> filled;
          Real after = 0, worst = 1;
          for (std::size_t t = 1; t + 1 < m; ++t)
            for (Index const end : {e.node[a], e.node[c]}) {
              filled.push_back(tetrahedron(
                  mesh, e, {ring.nodes[fan], ring.nodes[(fan + t) % m], ring.nodes[(fan + t + 1) % m], end}));
              after += volume(mesh, filled.back());
              worst = min(worst, quality(mesh, filled.back()));
            }
          if (std::abs(after - before) > 1e-9 * before || worst <= best) continue;
          best = worst, gone = ring.elements, come = filled;
        }
      }
    if (gone.empty()) {
      if (split_flat(mesh, f)) f = static_cast<std::size_t>(-1);
      continue;
    }
    for (auto k = gone.rbegin(); k != gone.rend(); ++k)
      mesh.elements.erase(mesh.elements.begin() + static_cast<std::ptrdiff_t>(*k));
    mesh.elements.insert(mesh.elements.end(), come.begin(), come.end());
    f = static_cast<std::size_t>(-1);  // places have changed: from the start
  }
}

}  // namespace

Real tetrahedron_quality(Vec3 const& a, Vec3 const& b, Vec3 const& c, Vec3 const& d) {
  Real const volume = dot(cross(b - a, c - a), d - a) / 6;
  Real const edge2 = (norm2(b - a) + norm2(c - a) + norm2(d - a) + norm2(c - b) + norm2(d - b) + norm2(d - c)) / 6;
  return 6 * std::sqrt(2.0) * volume / (edge2 * std::sqrt(edge2));
}

void improve_tetrahedra(ElementMesh& mesh) {
  peel(mesh);
  flip_flat(mesh);
  std::vector<char> inner(mesh.nodes.size(), 1);
  for (auto const& [side, count] : count_sides(mesh))
    if (count == 1)
      for (Index n : side) inner[at(n)] = 0;
  std::vector<std::vector<std::size_t>> around(mesh.nodes.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (Index n : mesh.elements[e].nodes()) around[at(n)].push_back(e);
  auto worst = [&](std::size_t n) {
    Real q = 1;
    for (std::size_t e : around[n]) q = min(q, quality(mesh, mesh.elements[e]));
    return q;
  };
  // Hill climbing: to the mean of the tetrahedra around, then along 14 directions by shrinking steps.
  std::vector<Vec3> directions;
  for (int d = 0; d < 3; ++d)
    for (Real s : {-1.0, 1.0}) {
      Vec3 v{};
      v[d] = s;
      directions.push_back(v);
    }
  for (Real x : {-1.0, 1.0})
    for (Real y : {-1.0, 1.0})
      for (Real z : {-1.0, 1.0}) directions.push_back(normalized({x, y, z}));
  for (int sweep = 0; sweep < 12; ++sweep)
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      if (!inner[n] || around[n].empty()) continue;
      Vec3 mean{};
      Real reach = 1e300;
      for (std::size_t e : around[n])
        for (Index m : mesh.elements[e].nodes()) {
          mean += mesh.nodes[at(m)] / static_cast<Real>(4 * around[n].size());
          if (at(m) != n) reach = min(reach, norm(mesh.nodes[at(m)] - mesh.nodes[n]));
        }
      Real best = worst(n);
      auto try_place = [&](Vec3 const& x) {
        Vec3 const old = mesh.nodes[n];
        mesh.nodes[n] = x;
        Real const q = worst(n);
        if (q > best)
          best = q;
        else
          mesh.nodes[n] = old;
      };
      try_place(mean);
      for (Real const step : {0.3, 0.1, 0.03})
        for (Vec3 const& v : directions) try_place(mesh.nodes[n] + (step * reach) * v);
    }
}

}  // namespace brisance::solid
