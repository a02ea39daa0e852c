// Convex polyhedra: exact volume, centre, moments, faces; the reference shape of a rigid particle.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/mat3.hpp"

namespace brisance::solid {

/// Closed polyhedron; each face lists its vertices counter-clockwise seen from outside.  Units: m.
struct Polyhedron {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;
};

/// Volume V (m3), mass centre X (m) and second moment K = int y y^T dV about X (m5).
/// Source: theory/solid.md section 2.
struct Moments {
  Real volume = 0;
  Vec3 centre{};
  Mat3 second{};
};

/// Area S (m2), unit outward normal n, centroid G (m) and M2 = int y y^T dS about G (m4) of a plane face.
struct FaceGeometry {
  Real area = 0;
  Vec3 normal{}, centroid{};
  Mat3 second{};
};

Moments moments(Polyhedron const& p);
FaceGeometry face_geometry(Polyhedron const& p, std::size_t face);

/// What is wrong with a polyhedron that ought to be closed and convex, and where.
struct ShapeFault {
  std::string what;
  Vec3 place{};
};
/// Nothing if `p` is closed (every edge has its opposite), turned outward, with plane faces and convex, all to
/// `tolerance` times its size.
std::optional<ShapeFault> fault(Polyhedron const& p, Real tolerance = 1e-9);

/// `p` moved by `shift`.
Polyhedron translated(Polyhedron p, Vec3 const& shift);

/// Depth (m) by which two convex polyhedra overlap along their best separating axis: negative or zero when apart or
/// touching. Source: separating axes (face normals and cross products of edges).
Real overlap_depth(Polyhedron const& a, Polyhedron const& b);

}  // namespace brisance::solid
