// From the elements of a mesh file to the cells of a body: selected, checked, joined through their faces.
#pragma once
#include "core/solid/meshes/element_mesh.hpp"
#include "core/solid/meshes/mesh_file_config.hpp"
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// A face of an element as places in its node list, counter-clockwise seen from outside.
using LocalFace = std::vector<int>;
/// The faces of a kind, in the numbering of Gmsh; of triangles and quadrangles their edges, counter-clockwise.
std::vector<LocalFace> const& faces_of(ElementKind kind);

/// The element as a closed polyhedron; in 2D (triangles, quadrangles) a prism over 0 <= z <= 1 whose first faces are
/// its edges, in order.
Polyhedron polyhedron_of(ElementMesh const& mesh, MeshElement const& e);

/// Keeps the elements of `group` (all without one) that have the dimension of the run, and the elements one dimension
/// lower, which are boundary faces. An element that the file repeats in several groups becomes one.
/// Errors: no such group, none of this dimension, the same element twice in one group.
struct Selection {
  std::vector<MeshElement> cells, sides;
};
Selection select(ElementMesh& mesh, std::optional<std::string> const& group, int dimension);

/// Replaces every element that has a face which is not plane by pyramids and tetrahedra about its middle; a face is cut
/// from its node of lowest index, so that both of its elements cut it alike. Returns how many were replaced.
int split_warped(ElementMesh& mesh, std::vector<MeshElement>& elements);

/// Elements to cells with neighbours, regions (physical volumes) and face groups (physical surfaces).
/// Errors: Failure::scene naming file, element and place: repeated nodes, no or negative volume, faces that are not
/// plane, not convex, three elements at a face, elements on the same side of a face, coincident nodes, hanging nodes,
/// elements in each other, a boundary element that is no face of any element.
Cells cells_of(ElementMesh mesh, MeshFileConfig const& config, int dimension);

}  // namespace brisance::solid
