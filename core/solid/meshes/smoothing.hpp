// Better tetrahedra with the same neighbours.
#pragma once
#include "core/solid/meshes/element_mesh.hpp"

namespace brisance::solid {

/// Volume over that of a regular tetrahedron with the same root-mean-square edge: 1 at best, 0 when flat.
Real tetrahedron_quality(Vec3 const& a, Vec3 const& b, Vec3 const& c, Vec3 const& d);

/// Takes flat tetrahedra off the boundary and out of the inside, and moves inner nodes so that the worst tetrahedron
/// around each gets better. The same on every rank: places and numbers decide, no addresses of memory.
void improve_tetrahedra(ElementMesh& mesh);

}  // namespace brisance::solid
