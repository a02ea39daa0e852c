// The boundary of a volume mesh as a surface, and its physical surfaces on other cells.
#pragma once
#include "core/solid/meshes/surface_file.hpp"
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// The faces without a neighbour as triangles, with the names of their groups.
TriangleSurface boundary_of(Cells const& cells, std::string const& path);

/// Gives every boundary face of `cells` the groups of the nearest facet that looks the same way (within 60 degrees).
void name_faces(TriangleSurface const& surface, Cells& cells);

/// The point of facet f nearest to p.
Vec3 nearest_point(TriangleSurface const& surface, std::size_t f, Vec3 const& p);

}  // namespace brisance::solid
