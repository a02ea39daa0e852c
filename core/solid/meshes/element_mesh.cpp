#include "core/solid/meshes/element_mesh.hpp"

#include <algorithm>

#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

struct KindFacts {
  char const* name;
  int dimension, nodes;
};

KindFacts facts(ElementKind kind) {
  static constexpr std::array<KindFacts, 8> all{{{"", 0, 0},
                                                 {"line", 1, 2},
                                                 {"triangle", 2, 3},
                                                 {"quadrangle", 2, 4},
                                                 {"tetrahedron", 3, 4},
                                                 {"hexahedron", 3, 8},
                                                 {"prism", 3, 6},
                                                 {"pyramid", 3, 5}}};
  return all[static_cast<std::size_t>(kind)];
}

}  // namespace

char const* name(ElementKind kind) { return facts(kind).name; }
int dimension(ElementKind kind) { return facts(kind).dimension; }
int node_count(ElementKind kind) { return facts(kind).nodes; }

Index ElementMesh::group_set(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  auto const found = std::find(group_sets.begin(), group_sets.end(), names);
  if (found != group_sets.end()) return static_cast<Index>(found - group_sets.begin());
  group_sets.push_back(std::move(names));
  return static_cast<Index>(group_sets.size() - 1);
}

bool ElementMesh::in_group(MeshElement const& e, std::string const& name) const {
  auto const& names = group_sets[static_cast<std::size_t>(e.groups)];
  return std::binary_search(names.begin(), names.end(), name);
}

void mesh_error(std::string const& path, int line, std::string const& what) {
  throw Error(Failure::scene, path + (line > 0 ? ":" + std::to_string(line) : std::string()) + ": " + what);
}

}  // namespace brisance::solid
