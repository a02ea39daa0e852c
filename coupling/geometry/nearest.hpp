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

/// On one piece.
Nearest closest_point(Lattice const& lattice, Geometry const& geometry, Piece const& piece, Vec3 const& x);

}  // namespace brisance::coupling
