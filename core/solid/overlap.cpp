#include "core/solid/overlap.hpp"

#include <algorithm>

namespace brisance::solid {
namespace {

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(Vec3 const& p) {
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], p[d]), high[d] = max(high[d], p[d]);
  }
};

bool meet(Box const& a, Box const& b, int dimension) {
  for (int d = 0; d < dimension; ++d)
    if (a.low[d] >= b.high[d] || b.low[d] >= a.high[d]) return false;
  return true;
}

Box box_of(Mesh const& mesh, GlobalId p) {
  Box box;
  for (Vec3 const& v : mesh.shape(p).polyhedron.vertices) box.add(mesh.particle(p).centre + v);
  return box;
}

Polyhedron placed(Mesh const& mesh, GlobalId p) {
  return translated(mesh.shape(p).polyhedron, mesh.particle(p).centre);
}

}  // namespace

std::optional<Overlap> find_overlap(Mesh const& mesh) {
  if (mesh.bodies.size() < 2) return std::nullopt;
  std::vector<Box> bodies(mesh.bodies.size());
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    Box const box = box_of(mesh, p);
    bodies[static_cast<std::size_t>(mesh.particle(p).body)].add(box.low);
    bodies[static_cast<std::size_t>(mesh.particle(p).body)].add(box.high);
  }
  struct Candidate {
    GlobalId id;
    Box box;
  };
  std::vector<Candidate> candidates;
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    Box const box = box_of(mesh, p);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (b != static_cast<std::size_t>(mesh.particle(p).body) && meet(box, bodies[b], mesh.dimension)) {
        candidates.push_back({p, box});
        break;
      }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](Candidate const& a, Candidate const& b) { return a.box.low.x < b.box.low.x; });
  std::optional<Overlap> found;
  std::pair<GlobalId, GlobalId> first{};
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size() && candidates[b].box.low.x < candidates[a].box.high.x; ++b) {
      GlobalId const p = std::min(candidates[a].id, candidates[b].id), q = std::max(candidates[a].id, candidates[b].id);
      if (mesh.particle(p).body == mesh.particle(q).body || !meet(candidates[a].box, candidates[b].box, mesh.dimension))
        continue;
      if (found && first < std::pair(p, q)) continue;
      Real const depth = overlap_depth(placed(mesh, p), placed(mesh, q));
      Real const size = std::cbrt(min(mesh.shape(p).volume, mesh.shape(q).volume));
      if (depth <= 1e-6 * size) continue;
      first = {p, q};
      found = Overlap{mesh.particle(p).body, mesh.particle(q).body,
                      0.5 * (mesh.particle(p).centre + mesh.particle(q).centre), depth};
    }
  if (found && found->body_a > found->body_b) std::swap(found->body_a, found->body_b);
  return found;
}

}  // namespace brisance::solid
