// Pieces of the boundary, cut cells with apertures and fluid volumes, and the solid cells: a pure function of the
// triangles and of the grid planes.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/geometry/surface.hpp"

namespace brisance::coupling {

/// A corner of a piece: position in grid units (cells from the low corner of the lattice) and barycentric coordinates
/// in its triangle. Bits agree between pieces that share the corner.
struct Corner {
  Vec3 point;
  std::array<Real, 3> bary;
};

/// A triangle of the boundary within one cell: a convex polygon of up to 9 corners, in 2D a segment.
struct Piece {
  Index triangle = 0;  ///< place in the span given to build()
  CellIndex cell{};
  Index first_corner = 0, corners = 0;  ///< range in Geometry::corners
  Vec3 area{};                          ///< area vector, from solid to fluid [m2]
  Vec3 centroid{};                      ///< [m]
  std::array<Real, 3> bary_centroid{};  ///< barycentric coordinates of the centroid
};

/// A cell that holds pieces.
struct CutCell {
  CellIndex cell{};
  Index first_piece = 0, last_piece = 0;          ///< range [first, last) in Geometry::pieces
  Vec3 area{};                                    ///< sum of the area vectors [m2]
  std::array<std::array<Real, 2>, 3> aperture{};  ///< fluid area of the low and high face per direction [m2]; 2D: z 0
  Real volume = 0;                                ///< fluid volume [m3], not clamped: may be -1e-17 of a cell
};

/// Solid cells without pieces, in a row along x.
struct SolidRun {
  CellIndex first{};
  Index count = 0;
};

/// The cut-cell geometry of one instant. Pieces are sorted by (cell, triangle id), cells and runs by (k, j, i).
struct Geometry {
  std::vector<Piece> pieces;
  std::vector<Corner> corners;  ///< shared pool; may hold corners of pieces that were not kept
  std::vector<CutCell> cells;
  std::vector<SolidRun> solid;
  Real residual = 0;          ///< largest defect of closure, in faces, before the apertures are snapped
  CellIndex residual_cell{};  ///< where, and along which direction
  int residual_direction = 0;
  Real volume_mismatch = 0;  ///< largest difference of the x, y and z volumes [cell volumes]
  Index overlapped = 0;      ///< rows of solid cells inside two bodies at once (counted as solid)
  Index inverted = 0;        ///< rows of cells inside a surface that is inside out or folded through itself (fluid)

  std::span<Corner const> corners_of(Piece const& p) const {
    return {corners.data() + p.first_corner, static_cast<std::size_t>(p.corners)};
  }
  /// Place of `c` in `cells`, or -1. Cost: a binary search.
  Index find(CellIndex const& c) const;

  // Work arrays kept for their capacity: after the first steps build() does not allocate.
  struct Clipped {
    Index triangle, first_corner, corners, flat;  ///< flat: direction of the grid plane that holds the piece, or -1
    CellIndex cell;
    Vec3 area, moment;  ///< grid units; integrals of (x - x_low) n_x and alike
    std::array<Real, 3> bary_centroid;
  };
  struct Row {
    std::uint64_t key;
    Index place;
  };
  struct Sum {
    CellIndex cell;
    Index first, last;  ///< range in `order`
    bool kept;
    Vec3 area, moment;
    std::array<std::array<Real, 2>, 3> aperture;
  };
  std::vector<Clipped> clipped;
  std::vector<Row> order, rows, flats;
  std::vector<Sum> sums;
  std::vector<std::array<Index, 2>> intervals;
};

/// Fills `out` from the positions x_new of `triangles`. Every closed body adds, along each grid line from its low end,
/// the area vectors of its pieces to the aperture: a(i+1/2) = a(i-1/2) + N_x(i), full fluid before the first; the
/// apertures are snapped to closed or open at cells without pieces. Volumes by the divergence theorem. `keep` is the
/// union of boxes for whose cells pieces, cut cells and solid runs are returned. Source: theory/coupling.md 2.2 to 2.4.
/// Expects: `triangles` sorted by id; bodies closed; all triangles whose closed box meets a row of cells through a kept
/// box, along x, y or z, are given (the others change nothing). Results do not depend on what else is given.
void build(Lattice const& lattice, std::span<SurfaceTriangle const> triangles, std::span<CellBox const> keep,
           Geometry& out);

constexpr Real tightness = 1e-10;  ///< residual of closure, in faces, above which a boundary has a hole

/// Errors: numerical error that names the place when the boundary is not watertight.
void require_closed(Lattice const& lattice, Geometry const& geometry);

}  // namespace brisance::coupling
