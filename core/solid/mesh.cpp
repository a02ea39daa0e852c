#include "core/solid/mesh.hpp"

#include <cmath>

#include "core/base/errors.hpp"

namespace brisance::solid {

Vec3 on_grain(Mesh const& mesh, Vec3 const& v) {
  Vec3 snapped;
  for (int d = 0; d < 3; ++d) snapped[d] = mesh.grain * std::nearbyint(v[d] / mesh.grain) + 0.0;
  return snapped;
}

bool is_side_of_slab(FaceGeometry const& face, int dimension) {
  for (int d = dimension; d < 3; ++d)
    if (std::abs(face.normal[d]) > 0.5) return true;
  return false;
}

void require_face_group(Mesh const& mesh, std::string const& name, Location const& at, std::string const& of) {
  if (mesh.face_groups.contains(name)) return;
  std::vector<std::string> known;
  for (auto const& [other, faces] : mesh.face_groups) known.push_back(other);
  scene_error(at, of + ": no mesh file has a physical surface \"" + name + "\"" +
                      (known.empty() ? "" : "; the nearest is \"" + nearest(name, known) + "\"") +
                      ". Name one, or select faces by a box.");
}

Real face_distance(Mesh const& mesh, Link const& link, GlobalId p) {
  FaceGeometry const& f = mesh.face(link.i, link.face_i);
  Real const near = dot(f.centroid - mesh.shape(link.i).pole, f.normal);
  return p == link.i ? near : link.rest_length - near;
}

Mat3 bending_tensor(Mesh const& mesh, Link const& link) {
  FaceGeometry const& f = mesh.face(link.i, link.face_i);
  Real const polar = trace(f.second);
  Mat3 const nn = outer(f.normal, f.normal);
  auto const tensor = [&](Real shear, Real young) {
    return (mesh.torsion_ratio * shear * polar) * nn + young * (polar * (Mat3::identity() - nn) - f.second);
  };
  Material const& m = mesh.material(link.i);
  Mat3 c = tensor(m.shear(), m.young_modulus);
  if (link.j != Link::wall && mesh.particle(link.i).material != mesh.particle(link.j).material) {
    // Two half links in series: a modulus is the harmonic mean of both, by distance from the face.
    Material const& other = mesh.material(link.j);
    Real const share = face_distance(mesh, link, link.i) / link.rest_length;
    auto const mean = [&](Real a, Real b) { return 1 / (share / a + (1 - share) / b); };
    c = tensor(mean(m.shear(), other.shear()), mean(m.young_modulus, other.young_modulus));
  }
  return (2 / link.rest_length) * c;
}

}  // namespace brisance::solid
