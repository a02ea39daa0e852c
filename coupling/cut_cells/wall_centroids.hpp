// Where the fluid of a cut cell and the open part of a face lie: exact moments, sums over the pieces.
#pragma once
#include <functional>

#include "coupling/cut_cells/moments.hpp"
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// Moments of a whole cell about its centre; nothing along axes that the grid does not have.
Moments cell_moments(fluid::Grid const& grid);
/// Of a whole face across d about its centre.
Moments face_moments(fluid::Grid const& grid, int d);

/// Moments of the fluid of a cell about its centre; those of the whole cell without pieces. By the divergence theorem,
/// from the pieces alone: the integrals of x, x^2, x y over the fluid are sums over the pieces of S_x times the means
/// of (h^2/4 - x^2)/2, h^2 x/12 - x^3/3 (and the volume times h^2/12), y (h^2/4 - x^2)/2.
Moments fluid_moments(WallRecord const& record, CellIndex c);

/// Where a piece ends in the plane of a face of the grid, from a to b about the centre of the face; 2D: a point.
struct OpenEdge {
  Piece const& piece;
  Vec3 open;  ///< in the plane, across the edge, from solid to fluid: its length times the depth [m2 per m across]
  Vec3 a, b;
};
void for_open_edges(WallRecord const& record, CellIndex c, int d, int side,
                    std::function<void(OpenEdge const&)> const& visit);

/// Moments of the open part of the face of `c` on the low (0) or high (1) side along d, about the centre of the face;
/// those of the whole face when it is open or closed throughout. From the edges of the pieces in the plane of the face.
Moments aperture_moments(WallRecord const& record, CellIndex c, int d, int side);

}  // namespace brisance::coupling
