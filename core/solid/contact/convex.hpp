// Convex particles as contact sees them: planes, corners and radii, in the reference frame and placed in space.
#pragma once
#include <vector>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// A convex polyhedron about its mass centre.  Units: m, m2.
struct Convex {
  std::vector<Vec3> corners;
  std::vector<int> loops;     ///< corners of all faces, counter-clockwise seen from outside
  std::vector<int> first;     ///< face f: loops[first[f] .. first[f + 1])
  std::vector<Vec3> normals;  ///< planes n . y <= offset; none for slivers and for the sides of a slab
  std::vector<Real> offsets;
  std::vector<Real> areas;                  ///< of the faces in these planes, m2
  Real outer_radius = 0, inner_radius = 0;  ///< of the balls about the centre, in 2D of the circles
  Real volume = 0;
  Real largest_face = 0;     ///< area, m2
  Mat3 inverse_inertia{};    ///< at density 1, reference frame
  Real largest_inverse = 0;  ///< its largest eigenvalue over the axes that turn
};

/// In 2D and 1D the sides of the slab are corners, but no planes: both bodies have the same.
Convex make_convex(Shape const& shape, int dimension);

/// Corners and normals turned into space, relative to the mass centre.
struct PlacedConvex {
  Convex const* shape = nullptr;
  std::vector<Vec3> corners, normals;
  void place(Convex const& convex, Quaternion const& q);
};

/// Does a plane of one of two convex bodies separate them, b at `shift` from a? `hint`: the plane that did last time,
/// looked at first; it changes the time and not the answer.
bool separated_by_face(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift, int& hint);

/// The widest gap along a normal of a face: a lower bound of the distance of two bodies.
struct Gap {
  Real width = 0;  ///< m; negative when no face separates them
  Vec3 normal{};   ///< unit
};
Gap gap_along_normals(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift);

/// Largest area (m2) that a face of a body shows along a unit direction.
Real facing_area(PlacedConvex const& body, Vec3 const& direction);

}  // namespace brisance::solid
