// What a piece of a triangle has in common with a cell at another time: the pieces of the boundary at both ends of a
// step, refined to parts that lie in one cell before and in one cell after (theory/coupling.md 1.8, `explicit`).
#pragma once
#include <array>
#include <span>

#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// A part of a triangle (2D: of a segment).
struct TrianglePart {
  Real share = 0;              ///< of its area; shares of parts that tile it sum to 1 to round-off
  std::array<Real, 3> bary{};  ///< barycentric coordinates of the centroid
};

/// The whole of a piece.
TrianglePart part_of(std::span<Corner const> piece);

/// The part of `piece` that lies in `cell` once its triangle is `triangle`. Where that lies in a grid plane the cell is
/// taken for the one that has it. The polygon is cut by the planes as linear functions on the whole triangle, the same
/// for the cells on both sides: edges of pieces may be shorter than rounding, and have no direction then.
TrianglePart part_in_cell(std::span<Corner const> piece, Lattice const& lattice, SurfaceTriangle const& triangle,
                          CellIndex const& cell);

}  // namespace brisance::coupling
