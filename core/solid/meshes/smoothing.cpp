#include "core/solid/meshes/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

/// Flat ones that show two faces: what is left is closed as before and hardly smaller.
void peel(ElementMesh& mesh) {
  constexpr Real flat = 0.1;
  for (bool again = true; again;) {
    auto const count = count_sides(mesh);
    again = std::erase_if(mesh.elements, [&](MeshElement const& e) {
              int shown = 0;
              for (std::size_t s = 0; s < 4; ++s) shown += count.at(side_of(e, s)) == 1;
              return shown == 2 && quality(mesh, e) < flat;
            }) > 0;
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
