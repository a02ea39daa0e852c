// A mesh as a file gives it: nodes, elements of the lowest order, physical groups.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec3.hpp"

namespace brisance::solid {

/// Kinds of elements with straight edges; the numbers are those of Gmsh.
enum class ElementKind : int { line = 1, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid };

char const* name(ElementKind kind);
int dimension(ElementKind kind);
int node_count(ElementKind kind);

struct MeshElement {
  ElementKind kind = ElementKind::tetrahedron;
  std::int64_t tag = 0;         ///< its number in the file
  std::array<Index, 8> node{};  ///< indices into ElementMesh::nodes, in the order of Gmsh
  Index groups = 0;             ///< index into ElementMesh::group_sets
  std::span<Index const> nodes() const { return std::span(node).first(static_cast<std::size_t>(node_count(kind))); }
};

struct ElementMesh {
  std::string path;
  std::vector<Vec3> nodes;  ///< m, once scaled by the unit of the scene
  std::vector<std::int64_t> node_tag;
  std::vector<MeshElement> elements;
  /// Names of the physical groups that elements belong to, sorted; 0 = none. A group without a name bears its number.
  std::vector<std::vector<std::string>> group_sets{{}};

  /// The index of a set of names, added when new.
  Index group_set(std::vector<std::string> names);
  bool in_group(MeshElement const& e, std::string const& name) const;
};

/// Throws the scene error "path[:line]: what".
[[noreturn]] void mesh_error(std::string const& path, int line, std::string const& what);

}  // namespace brisance::solid
