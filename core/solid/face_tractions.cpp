#include "core/solid/face_tractions.hpp"

#include "parallel/error.hpp"

namespace brisance::solid {

void FaceTractions::add(Mesh const& mesh, GlobalId particle, int face, Index local, Vec3 const& traction) {
  FaceGeometry const& geometry = mesh.face(particle, face);
  Real distance = 0;
  for (FreeFace const& f : mesh.free_faces_of(particle))
    if (f.face == face && !f.clamped) distance = f.distance;
  require(distance != 0, Failure::internal,
          "a traction acts on face " + std::to_string(face) + " of particle " + std::to_string(particle) +
              ", which is not free");
  faces_.push_back({local, face, traction, geometry.normal, geometry.centroid, geometry.area,
                    geometry.area * distance / (2 * mesh.material(particle).shear())});
}

void FaceTractions::open(std::span<double> opening) const {
  for (Face const& f : faces_) opening[static_cast<std::size_t>(f.particle)] = 0;
  for (Face const& f : faces_) opening[static_cast<std::size_t>(f.particle)] += f.compliance * f.normal_traction();
}

void FaceTractions::add_wrench(std::span<Pose const> pose, std::span<Wrench> wrench) const {
  for (Face const& f : faces_) {
    auto const p = static_cast<std::size_t>(f.particle);
    Vec3 const force = rotate(pose[p].q, f.area * f.traction);
    wrench[p].force += force;
    wrench[p].torque += cross(rotate(pose[p].q, f.arm), force);
  }
}

}  // namespace brisance::solid
