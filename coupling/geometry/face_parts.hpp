// The open components of one face of a cut cell: intervals of an edge in 2D, polygons of a square in 3D.
#pragma once
#include <vector>

#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// A connected open component of a face, and what bounds it.
struct FacePart {
  Real area = 0;              ///< in faces
  std::vector<Index> pieces;  ///< those of the cell that end on its outline, places in Geometry::pieces
  unsigned corners = 0;       ///< corners of the cell on its outline: bit x + 2 y + 4 z
};

/// Components of the face `side` along `d` of `cell`, from the ends of its pieces in the plane; empty when it is
/// closed. Both cells of a face find the same components, bit for bit and in the same order, if the same pieces meet
/// there. False where the ends do not bound an area, as of bodies that overlap.
bool open_parts(Lattice const& lattice, Geometry const& geometry, CutCell const& cell, int d, int side,
                std::vector<FacePart>& parts);

}  // namespace brisance::coupling
