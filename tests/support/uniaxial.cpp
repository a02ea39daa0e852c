#include "tests/support/uniaxial.hpp"

namespace brisance::testing {
namespace {

AffineFit affine_fit(std::vector<Vec3> const& points, std::vector<Vec3> const& shifts) {
  auto const n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd at(n, 4), shift(n, 3);
  for (Eigen::Index p = 0; p < n; ++p) {
    Vec3 const &x = points[static_cast<std::size_t>(p)], &u = shifts[static_cast<std::size_t>(p)];
    at.row(p) << x.x, x.y, x.z, 1;
    shift.row(p) << u.x, u.y, u.z;
  }
  Eigen::MatrixXd const fit = (at.transpose() * at).ldlt().solve(at.transpose() * shift);
  AffineFit out;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) out.gradient[r][c] = fit(c, r);
  out.scatter = (shift - at * fit).norm() / std::sqrt(static_cast<Real>(n));
  return out;
}

/// Pulls at the ends x = low and high of a body.
void pull(Lone& body, Real low, Real high, Real stress) {
  std::vector<solid::FaceLoad> loads;
  for (solid::FreeFace const& f : body.mesh.free_faces) {
    solid::FaceGeometry const& face = body.mesh.face(f.particle, f.face);
    Real const x = body.mesh.particle(f.particle).centre.x + face.centroid.x;
    if (std::abs(face.normal.x) > 0.5 && min(std::abs(x - low), std::abs(x - high)) < 1e-9)
      loads.push_back({f.particle, f.face, {stress * face.normal.x, 0, 0}});
  }
  body.solid.load_faces(loads);
}

}  // namespace

AffineFit small_strain(Lone& body, Real low, Real high) {
  auto const linear = linearise(body.solid);  // before the loads, which turn with their faces
  pull(body, low, high, 1);
  Eigen::VectorXd const u = response(body.solid, linear, 1e-6);
  std::vector<Vec3> shifts;
  for (std::size_t s = 0; s < linear.count(); ++s) shifts.push_back(linear.pole_shift(u, s));
  return affine_fit(linear.pole, shifts);
}

AffineFit finite_strain(Lone& body, Real low, Real high, Real stress) {
  pull(body, low, high, stress);
  balance(body.solid, 3e-12 * stress, 1e-7);
  std::vector<Vec3> points, shifts;
  for (GlobalId p = 0; p < body.mesh.size(); ++p) {
    points.push_back(body.mesh.particle(p).centre);
    shifts.push_back(body.solid.pose()[static_cast<std::size_t>(p)].x - points.back());
  }
  return affine_fit(points, shifts);
}

}  // namespace brisance::testing
