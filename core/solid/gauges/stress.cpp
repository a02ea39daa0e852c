#include "core/solid/gauges/stress.hpp"

namespace brisance::solid {
namespace {

Vec3 vector(Triple<double> const& t) { return {t.x, t.y, t.z}; }

/// Sum of arm x force over the links of a particle.
Mat3 link_moments(Solid const& solid, Index particle) {
  Mesh const& mesh = solid.mesh();
  GlobalId const id = solid.id(particle);
  Quaternion const& q = solid.pose()[static_cast<std::size_t>(particle)].q;
  Mat3 sum{};
  for (std::size_t const l : mesh.links_of(id)) {
    auto const k = solid.local_link(l);
    if (!k) continue;
    LinkRest<double> const rest = solid.link_store().rest(*k);
    Vec3 const force = vector(solid.wrench_of(*k).force);
    bool const first = mesh.links[l].i == id;
    sum = sum + (first ? outer(rotate(q, vector(rest.arm_i)), force) : outer(rotate(q, vector(rest.arm_j)), -force));
  }
  return sum;
}

Mat3 face_moment(Solid const& solid, FaceTractions::Face const& face) {
  Quaternion const& q = solid.pose()[static_cast<std::size_t>(face.particle)].q;
  return outer(rotate(q, face.arm), rotate(q, face.area * face.traction));
}

Mat3 stress_of(Solid const& solid, Index particle, Mat3 const& moments) {
  Mesh const& mesh = solid.mesh();
  GlobalId const id = solid.id(particle);
  Mat3 stress = (0.5 / mesh.shape(id).volume) * (moments + transpose(moments));
  Real const nu = mesh.material(id).poisson_ratio;
  if (mesh.dimension == 2) stress[2].z = nu * (stress[0].x + stress[1].y);
  if (mesh.dimension == 1) stress[1].y = stress[2].z = nu / (1 - nu) * stress[0].x;
  return stress;
}

}  // namespace

Mat3 mean_stress(Solid const& solid, Index particle) {
  Mat3 moments = link_moments(solid, particle);
  for (FaceTractions::Face const& face : solid.face_tractions().faces())
    if (face.particle == particle) moments = moments + face_moment(solid, face);
  return stress_of(solid, particle, moments);
}

std::vector<Mat3> mean_stresses(Solid const& solid) {
  std::vector<Mat3> all(static_cast<std::size_t>(solid.owned()));
  for (Index p = 0; p < solid.owned(); ++p) all[static_cast<std::size_t>(p)] = link_moments(solid, p);
  for (FaceTractions::Face const& face : solid.face_tractions().faces()) {
    if (face.particle >= solid.owned()) continue;
    Mat3& moments = all[static_cast<std::size_t>(face.particle)];
    moments = moments + face_moment(solid, face);
  }
  for (Index p = 0; p < solid.owned(); ++p) {
    Mat3& of = all[static_cast<std::size_t>(p)];
    of = stress_of(solid, p, of);
  }
  return all;
}

Mat3 elastic_strain(Material const& material, Mat3 const& stress) {
  Real const nu = material.poisson_ratio, e = material.young_modulus;
  return ((1 + nu) / e) * stress - (nu / e * trace(stress)) * Mat3::identity();
}

}  // namespace brisance::solid
