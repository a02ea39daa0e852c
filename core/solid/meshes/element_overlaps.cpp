// Elements of a body that lie in each other without sharing nodes.
#include <algorithm>

#include "core/base/place.hpp"
#include "core/solid/meshes/elements.hpp"
#include "core/solid/meshes/mesh_faults.hpp"

namespace brisance::solid {
namespace {

struct Candidate {
  std::size_t cell;
  Vec3 low, high;
  Polyhedron shape;
};

bool meet(Candidate const& a, Candidate const& b) {
  for (int d = 0; d < 3; ++d)
    if (a.low[d] >= b.high[d] || b.low[d] >= a.high[d]) return false;
  return true;
}

bool share_node(MeshElement const& a, MeshElement const& b) {
  auto const nodes = b.nodes();
  return std::any_of(a.nodes().begin(), a.nodes().end(),
                     [&](Index n) { return std::find(nodes.begin(), nodes.end(), n) != nodes.end(); });
}

}  // namespace

void check_overlaps(ElementMesh const& mesh, std::span<MeshElement const> elements,
                    std::span<BoundaryFace const> boundary) {
  std::vector<Candidate> candidates;
  for (BoundaryFace const& f : boundary) candidates.push_back({static_cast<std::size_t>(f.cell), {}, {}, {}});
  auto const by_cell = [](Candidate const& a, Candidate const& b) { return a.cell < b.cell; };
  std::sort(candidates.begin(), candidates.end(), by_cell);
  candidates.erase(std::unique(candidates.begin(), candidates.end(),
                               [](Candidate const& a, Candidate const& b) { return a.cell == b.cell; }),
                   candidates.end());
  for (Candidate& c : candidates) {
    c.shape = polyhedron_of(mesh, elements[c.cell]);
    c.low = c.high = c.shape.vertices[0];
    for (Vec3 const& v : c.shape.vertices)
      for (int d = 0; d < 3; ++d) c.low[d] = min(c.low[d], v[d]), c.high[d] = max(c.high[d], v[d]);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](Candidate const& a, Candidate const& b) { return a.low.x < b.low.x; });
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size() && candidates[b].low.x < candidates[a].high.x; ++b) {
      Candidate const &p = candidates[a], &q = candidates[b];
      if (!meet(p, q) || share_node(elements[p.cell], elements[q.cell])) continue;
      Real const depth = overlap_depth(p.shape, q.shape), size = min(norm(p.high - p.low), norm(q.high - q.low));
      if (depth <= plane_tolerance * size) continue;
      mesh_error(mesh.path, 0,
                 "elements " + std::to_string(elements[p.cell].tag) + " and " + std::to_string(elements[q.cell].tag) +
                     " overlap by " + std::to_string(depth) + " m at " +
                     place_text(0.5 * (middle_of(mesh, elements[p.cell].nodes()) +
                                       middle_of(mesh, elements[q.cell].nodes()))) +
                     ". Remesh there.");
    }
}

}  // namespace brisance::solid
