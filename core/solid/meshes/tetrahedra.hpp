// Tetrahedra inside a closed surface.
#pragma once
#include "core/solid/meshes/surface_file.hpp"
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// Delaunay tetrahedra, about `particles` of them, sharp edges kept, improved by moving inner nodes.
/// Source: CGAL, 3D Mesh Generation.  Expects: check_closed(surface).
/// The same on every rank: one thread, fixed seed, no optimiser of CGAL.
/// Errors: Failure::scene when no tetrahedra of that size fit.
Cells tetrahedra_in(TriangleSurface const& surface, int particles);

}  // namespace brisance::solid
