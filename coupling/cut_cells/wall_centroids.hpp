// Where the fluid of a cut cell and the open part of a face have their centroids: exact sums over the pieces.
#pragma once
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// Centroid of the fluid of a cell, m from its centre; 0 for a cell without pieces. By the divergence theorem, from
/// the pieces alone: integral of x over the fluid = 1/2 sum over pieces of S_x (h^2/4 - mean of x^2).
Vec3 fluid_centroid(WallRecord const& record, CellIndex c);

/// Centroid of the open part of the face of `c` on the low (0) or high (1) side along d, m from the centre of the
/// face; 0 when it is open or closed throughout. From the edges of the pieces that lie in the plane of the face.
Vec3 aperture_centroid(WallRecord const& record, CellIndex c, int d, int side);

}  // namespace brisance::coupling
