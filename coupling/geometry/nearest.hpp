// Closest points on the boundary: for the mirror states.
#pragma once
#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// The point of a triangle, segment or piece closest to a given one.
struct Nearest {
  Vec3 point{};                ///< [m]
  std::array<Real, 3> bary{};  ///< barycentric coordinates of the point in its triangle
  Real distance2 = 0;          ///< squared distance [m2]
};

/// On the whole triangle at t_new (2D: segment).
Nearest closest_point(Lattice const& lattice, SurfaceTriangle const& triangle, Vec3 const& x);

/// What a piece tells before its closest point is asked for: where it lies at most, and which way it faces.
struct Facet {
  Vec3 low, high;    ///< of a box around it, 1e-9 of a cell wider; 2D: without ends along z [m]
  Vec3 area;         ///< as in Piece [m2]
  Vec3 centroid;     ///< [m]
  Real grazing = 0;  ///< component of `area` up to which it does not face a direction [m2]

  /// Squared distance of x from the box: no point of the piece is closer [m2].
  Real closest2(Vec3 const& x) const {
    Vec3 const gap{max(0, max(low.x - x.x, x.x - high.x)), max(0, max(low.y - x.y, x.y - high.y)),
                   max(0, max(low.z - x.z, x.z - high.z))};
    return norm2(gap);
  }
  /// Does it look to the low (-1) or high (1) side of a direction?
  bool faces(int direction, int side) const { return area[direction] * side > grazing; }
};
Facet facet(Lattice const& lattice, Geometry const& geometry, Piece const& piece);

/// On one piece.
Nearest closest_point(Lattice const& lattice, Geometry const& geometry, Piece const& piece, Vec3 const& x);

}  // namespace brisance::coupling
