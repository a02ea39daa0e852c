#include "core/solid/contact/convex.hpp"

// Scalar Eigen: done once per shape, and GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>

namespace brisance::solid {

Convex make_convex(Shape const& shape, int dimension) {
  Convex c;
  c.corners = shape.polyhedron.vertices;
  c.volume = shape.volume;
  for (Vec3 const& v : c.corners) {
    Vec3 in_plane = v;
    for (int d = dimension; d < 3; ++d) in_plane[d] = 0;
    c.outer_radius = max(c.outer_radius, norm(in_plane));
  }
  c.inner_radius = c.outer_radius;
  c.first.push_back(0);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    auto const& loop = shape.polyhedron.faces[f];
    c.loops.insert(c.loops.end(), loop.begin(), loop.end());
    c.first.push_back(static_cast<int>(c.loops.size()));
    FaceGeometry const& face = shape.faces[f];
    bool const sliver = !(face.area > 1e-10 * square(c.outer_radius));  // has no direction; its neighbours bound it
    if (sliver || is_side_of_slab(face, dimension)) continue;
    c.normals.push_back(face.normal);
    c.offsets.push_back(dot(face.normal, face.centroid));
    c.areas.push_back(face.area);
    c.inner_radius = min(c.inner_radius, c.offsets.back());
    c.largest_face = max(c.largest_face, face.area);
  }
  Mat3 const inertia = shape.inertia(1);
  Eigen::Matrix3d j;
  for (int r = 0; r < 3; ++r) j.row(r) << inertia[r].x, inertia[r].y, inertia[r].z;
  Eigen::Matrix3d const inverse = j.inverse();
  for (int r = 0; r < 3; ++r) c.inverse_inertia[r] = {inverse(r, 0), inverse(r, 1), inverse(r, 2)};
  if (dimension == 3)
    c.largest_inverse = 1 / Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(j, Eigen::EigenvaluesOnly).eigenvalues()(0);
  else if (dimension == 2)
    c.largest_inverse = 1 / inertia[2].z;
  return c;
}

void PlacedConvex::place(Convex const& convex, Quaternion const& q) {
  shape = &convex;
  Mat3 const r = matrix(q);
  corners.resize(convex.corners.size());
  normals.resize(convex.normals.size());
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = r * convex.corners[k];
  for (std::size_t k = 0; k < normals.size(); ++k) normals[k] = r * convex.normals[k];
}

namespace {

/// Widest gap between a plane of `a` and the corners of `b`.
Gap gap_to_planes(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift) {
  Gap widest{-1e300, {}};
  for (std::size_t f = 0; f < a.normals.size(); ++f) {
    Vec3 const& n = a.normals[f];
    Real const base = dot(n, shift) - a.shape->offsets[f];
    if (base <= widest.width) continue;  // the corners lie around the centre: most planes need no look at them
    Real nearest = 1e300;
    for (Vec3 const& v : b.corners) nearest = min(nearest, dot(n, v));
    if (base + nearest > widest.width) widest = {base + nearest, n};
  }
  return widest;
}

/// Are all corners of `b` outside plane `f` of `a`?
bool separates(PlacedConvex const& a, std::size_t f, PlacedConvex const& b, Vec3 const& shift) {
  Vec3 const& n = a.normals[f];
  Real const base = dot(n, shift) - a.shape->offsets[f];
  if (base <= 0) return false;  // the corners lie around the centre
  if (base >= b.shape->outer_radius) return true;
  for (Vec3 const& v : b.corners)
    if (base + dot(n, v) < 0) return false;
  return true;
}

}  // namespace

bool separated_by_face(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift, int& hint) {
  std::size_t const planes_a = a.normals.size(), planes = planes_a + b.normals.size();
  auto const try_plane = [&](std::size_t f) {
    return f < planes_a ? separates(a, f, b, shift) : separates(b, f - planes_a, a, -shift);
  };
  if (static_cast<std::size_t>(hint) < planes && try_plane(static_cast<std::size_t>(hint))) return true;
  for (std::size_t f = 0; f < planes; ++f)
    if (try_plane(f)) {
      hint = static_cast<int>(f);
      return true;
    }
  return false;
}

Gap gap_along_normals(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift) {
  Gap const of_a = gap_to_planes(a, b, shift), of_b = gap_to_planes(b, a, -shift);
  return of_a.width >= of_b.width ? of_a : of_b;
}

Real facing_area(PlacedConvex const& body, Vec3 const& direction) {
  Real largest = 0;
  for (std::size_t f = 0; f < body.normals.size(); ++f)
    largest = max(largest, body.shape->areas[f] * std::abs(dot(body.normals[f], direction)));
  return largest;
}

}  // namespace brisance::solid
