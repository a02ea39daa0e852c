// Reader of Gmsh .msh files, formats 2.2 and 4.1, ASCII and binary.
#pragma once
#include "core/solid/meshes/element_mesh.hpp"

namespace brisance::solid {

/// Nodes, lines, triangles, quadrangles, tetrahedra, hexahedra, prisms and pyramids with their physical groups, as in
/// the file (points are left out; coordinates in units of the file). Source: Gmsh reference manual, "MSH file format".
/// Errors: Failure::scene "path:line: ...": other formats, elements of higher order (by name), partitioned meshes,
/// unknown nodes, repeated tags, a file that is cut off.
ElementMesh read_gmsh(std::string const& path);

}  // namespace brisance::solid
