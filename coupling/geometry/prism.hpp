// The volume that a piece of the boundary sweeps as a whole, by formula.
#pragma once
#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// Signed volume [m3] of the ruled prism of `piece`, all cells together: what `swept` has to add up to (G3).
/// Source: theory/coupling.md 1.1, over the triangles of the fan; in 2D the shoelace of the quadrilateral. In grid
/// units, as the vertices of record are those tied to the grid planes.
Real prism_volume(Lattice const& lattice, Geometry const& geometry, Piece const& piece,
                  SurfaceTriangle const& triangle);

}  // namespace brisance::coupling
