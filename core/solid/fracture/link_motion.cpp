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
  bool const wall = link.j == Link::wall;
  Vec3 const pole_i = vector(ends.x_i) + rotate(quaternion(ends.q_i), mesh.shape(link.i).pole);
  Vec3 const pole_j = wall ? mesh.particle(link.i).centre + mesh.face(link.i, link.face_i).centroid
                           : vector(ends.x_j) + rotate(quaternion(ends.q_j), mesh.shape(link.j).pole);
  return norm(pole_j - pole_i) / link.rest_length - 1;
}

Real gap_speed(Solid const& solid, std::size_t k) {
  LinkEnds<double> const ends = solid.link_ends(k);
  LinkRest<double> const rest = solid.link_store().rest(k);
  auto const half = solid.half_velocity();
  Index const i = solid.link_store().end_i(k), j = solid.end_j(k);
  auto const speed = [&](Index p, Turn<double> const& q, Triple<double> const& arm) {
    return half[at(p)].v + cross(half[at(p)].omega, rotate(quaternion(q), vector(arm)));
  };
  Vec3 const speed_i = speed(i, ends.q_i, rest.arm_i);
  return norm(j == solid.count() ? speed_i : speed(j, ends.q_j, rest.arm_j) - speed_i);
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
