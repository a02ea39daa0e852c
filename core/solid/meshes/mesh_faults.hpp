// What can be wrong with the elements of a mesh file, each told with its number and place.
// All functions throw Failure::scene "path: element 7 (tetrahedron) ... at (x, y, z) m ...".
#pragma once
#include "core/solid/meshes/element_mesh.hpp"
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// How far corners may lie off the plane of a face, over the size of the element: what files with six digits need.
constexpr Real plane_tolerance = 1e-6;

/// "element 7 (hexahedron)"
std::string element_text(MeshElement const& e);
Vec3 middle_of(ElementMesh const& mesh, std::span<Index const> nodes);
/// Distance of the corners of a face from its mean plane, over the size of the polyhedron.
Real warp(Polyhedron const& p, std::size_t face);

/// A face of one element only.
struct BoundaryFace {
  std::vector<Index> nodes;  ///< sorted
  Index cell = 0;
  int face = 0;  ///< of the cell
};

/// In 2D all nodes must have one z.
void require_plane(ElementMesh const& mesh, int dimension);
/// Makes nodes closer than 1e-8 of the size of the mesh one.
void merge_nodes(ElementMesh& mesh);
/// No node twice in an element.
void check_nodes(ElementMesh const& mesh, MeshElement const& e);
/// Positive volume, plane faces, convex.
void check_element(ElementMesh const& mesh, MeshElement const& e);
/// Two elements on opposite sides of their common face.
void check_sides(ElementMesh const& mesh, MeshElement const& a, MeshElement const& b, std::span<Index const> nodes);
/// Faces that should have met: coincident nodes (when `coincident` is asked for), hanging nodes, a quadrangle against
/// triangles.
void check_boundary(ElementMesh const& mesh, std::span<MeshElement const> elements, Cells const& cells,
                    std::span<BoundaryFace const> boundary, bool coincident);
/// Elements at the boundary do not lie in each other. Those that share nodes are told by their faces.
void check_overlaps(ElementMesh const& mesh, std::span<MeshElement const> elements,
                    std::span<BoundaryFace const> boundary);

}  // namespace brisance::solid
