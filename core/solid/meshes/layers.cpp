#include "core/solid/meshes/layers.hpp"

#include <algorithm>
#include <vector>

namespace brisance::solid {
namespace {

/// More are not told from a bulky body.
constexpr int most_layers = 64;

/// Particles on the straight way from a boundary face to the other side.
int particles_below(Mesh const& mesh, FreeFace const& from) {
  Vec3 const inward = -mesh.face(from.particle, from.face).normal;
  GlobalId at = from.particle;
  for (int count = 1; count <= most_layers; ++count) {
    GlobalId next = -1;
    Real best = 0.8;  // the cosine: Voronoi cells are askew
    for (std::size_t const l : mesh.links_of(at)) {
      Link const& link = mesh.links[l];
      if (link.j == Link::wall || mesh.is_mirror(link)) continue;
      Vec3 const normal = mesh.face(link.i, link.face_i).normal;
      Real const along = dot(link.i == at ? normal : -normal, inward);
      if (along > best) best = along, next = link.i == at ? link.j : link.i;
    }
    if (next < 0) return count;
    at = next;
  }
  return most_layers;
}

}  // namespace

int layers_across_a_rod(Mesh const& mesh, Index body) {
  if (mesh.dimension != 3) return 0;
  std::vector<int> counts;
  for (FreeFace const& face : mesh.free_faces)
    if (mesh.particle(face.particle).body == body) counts.push_back(particles_below(mesh, face));
  if (counts.empty()) return 0;
  std::sort(counts.begin(), counts.end());
  int const across = counts[counts.size() / 2], along = counts.back();
  if (along < 4 * across) return 0;
  // Of n x n x L particles a rod shows 4 n L faces on its sides, a plate of n layers 2 L^2 of n L^2.
  auto const sides = std::count_if(counts.begin(), counts.end(), [&](int n) { return 2 * n < 3 * across; });
  Real const per_face =
      static_cast<Real>(mesh.bodies[static_cast<std::size_t>(body)].particles) / (static_cast<Real>(sides) * across);
  return per_face < 0.37 ? across : 0;
}

Real stiffening_of_a_rod(Real nu, int layers) {
  if (layers < 2) return 0;
  Real const share = (3.55 + 0.9 * nu) * nu * nu / ((1 + nu) * (layers * layers + 2.7));
  return share / (1 + 0.16 * share);
}

}  // namespace brisance::solid
