// Volumes swept by the pieces of the boundary during a step, cell by cell.
#pragma once
#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// Signed volume [m3] of the prism of a piece within a cell: positive where solid replaces fluid.
struct Swept {
  CellIndex cell{};
  Real volume = 0;
};

/// Appends w_{f,D} for every cell D that the ruled prism of `piece` meets, its own included; the prism joins the piece
/// at t_new to the points of the same barycentric coordinates at t_old. Nothing if the triangle did not move (same
/// bits). The side surfaces are the four triangles through the mean point of each side. Source:
/// theory/coupling.md 1.1, 2.5. In 2D the swept area times the depth.
void swept(Lattice const& lattice, Geometry const& geometry, Piece const& piece, SurfaceTriangle const& triangle,
           std::vector<Swept>& out);

}  // namespace brisance::coupling
