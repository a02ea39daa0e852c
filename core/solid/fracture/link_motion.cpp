#include "core/solid/fracture/link_motion.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
Vec3 vector(Triple<double> const& t) { return {t.x, t.y, t.z}; }
Quaternion quaternion(Turn<double> const& q) { return {q.w, vector(q.v)}; }

/// Solves m a = b for a symmetric matrix by cofactors.
Vec3 solve(Mat3 const& m, Vec3 const& b) {
  Vec3 const p = cross(m[1], m[2]), q = cross(m[2], m[0]), r = cross(m[0], m[1]);
  return Vec3{dot(p, b), dot(q, b), dot(r, b)} / dot(m[0], p);
}

}  // namespace

Real stretch(Solid const& solid, std::size_t k) {
  Mesh const& mesh = solid.mesh();
  Link const& link = mesh.links[solid.mesh_link(k)];
  LinkEnds<double> const ends = solid.link_ends(k);
  Vec3 const pole_i = vector(ends.x_i) + rotate(quaternion(ends.q_i), mesh.shape(link.i).pole);
  auto const far_pole = [&] {
    if (mesh.is_mirror(link)) return mesh.far_side(link)->image(pole_i);
    // The half link to a wall ends on the face.
    Vec3 const arm = link.j == Link::wall ? vector(solid.link_store().rest(k).arm_j) : mesh.shape(link.j).pole;
    return vector(ends.x_j) + rotate(quaternion(ends.q_j), arm);
  };
  Vec3 const pole_j = far_pole();
  return norm(pole_j - pole_i) / link.rest_length - 1;
}

Real gap_speed(Solid const& solid, std::size_t k) {
  LinkEnds<double> const ends = solid.link_ends(k);
  LinkRest<double> const rest = solid.link_store().rest(k);
  auto const speed = [&](HalfVelocity const& half, Turn<double> const& q, Triple<double> const& arm) {
    return half.v + cross(half.omega, rotate(quaternion(q), vector(arm)));
  };
  return norm(speed(solid.far_half_velocity(k), ends.q_j, rest.arm_j) -
              speed(solid.half_velocity()[at(solid.link_store().end_i(k))], ends.q_i, rest.arm_i));
}

Real fibre_stress(Solid const& solid, std::size_t k) {
  Mesh const& mesh = solid.mesh();
  Link const& link = mesh.links[solid.mesh_link(k)];
  FaceGeometry const& face = mesh.face(link.i, link.face_i);
  Polyhedron const& shape = mesh.shape(link.i).polyhedron;
  LinkEnds<double> const ends = solid.link_ends(k);
  LinkRest<double> const rest = solid.link_store().rest(k);
  Quaternion const q = conjugate(quaternion(ends.q_i)) * quaternion(ends.q_j);
  Vec3 const cq = vector(symmetric_times(rest.bending, Triple<double>{q.v.x, q.v.y, q.v.z}));
  Vec3 const moment = q.w * cq + cross(q.v, cq);  // on I, in its reference axes
  // M2 is singular along the normal, which the solution does not have.
  Mat3 const second = face.second + trace(face.second) * outer(face.normal, face.normal);
  Vec3 const a = solve(second, cross(face.normal, moment));
  Real largest = 0;
  for (int const v : shape.faces[static_cast<std::size_t>(link.face_i)])
    largest = max(largest, dot(a, shape.vertices[static_cast<std::size_t>(v)] - face.centroid));
  return largest;
}

}  // namespace brisance::solid
