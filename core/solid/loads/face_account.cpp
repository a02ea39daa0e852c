#include "core/solid/loads/face_account.hpp"

namespace brisance::solid {

void FaceAccount::follow(Solid& solid, std::size_t first, std::size_t last) {
  solid_ = &solid;
  offset_ = first;
  normal_.assign(last - first, 0);
  extension_.assign(last - first, 0);
  auto const faces = solid.face_tractions().faces();
  for (std::size_t k = first; k < last; ++k) {
    if (faces[k].particle >= solid.owned()) continue;
    if (loaded_.empty() || loaded_.back().particle != faces[k].particle)
      loaded_.push_back({faces[k].particle, k, k, {}, {}, {}});
    loaded_.back().last_face = k + 1;
  }
}

void FaceAccount::start() { measure_wrenches(); }

void FaceAccount::before_first_kick() {
  for (Loaded& l : loaded_) {
    l.first = l.second;
    l.velocity.begin(*solid_, l.particle);
  }
}

void FaceAccount::after_first_kick() {
  for (Loaded& l : loaded_) l.velocity.take(*solid_, l.particle, l.first);
}

void FaceAccount::before_change() {
  auto const faces = solid_->face_tractions().faces();
  for (Loaded const& l : loaded_) {
    Real const pressure = solid_->pressure()[static_cast<std::size_t>(l.particle)];
    for (std::size_t k = l.first_face; k < l.last_face; ++k) {
      normal_[k - offset_] = faces[k].normal_traction();
      extension_[k - offset_] = FaceTractions::extension(faces[k], pressure) + solid_->plastic_extension(faces[k]);
    }
  }
}

void FaceAccount::measure_wrenches() {
  auto const faces = solid_->face_tractions().faces();
  for (Loaded& l : loaded_) {
    Vec3 force{}, torque{};
    for (std::size_t k = l.first_face; k < l.last_face; ++k) {
      Vec3 const f = faces[k].area * faces[k].traction;
      force += f;
      torque += cross(faces[k].arm, f);
    }
    Quaternion const& q = solid_->pose()[static_cast<std::size_t>(l.particle)].q;
    l.second.force = rotate(q, force);
    l.second.torque = rotate(q, torque);
  }
}

void FaceAccount::after_second_kick(Real dt, LoadAccount& account) {
  measure_wrenches();
  auto const faces = solid_->face_tractions().faces();
  for (Loaded& l : loaded_) {
    l.velocity.take(*solid_, l.particle, l.second);
    Real const pressure = solid_->pressure()[static_cast<std::size_t>(l.particle)];
    Real at_rest = 0;  // a changing t_n changes the energy of a face at fixed positions
    for (std::size_t k = l.first_face; k < l.last_face; ++k)
      at_rest -= 0.5 *
                 (extension_[k - offset_] + FaceTractions::extension(faces[k], pressure) +
                  solid_->plastic_extension(faces[k])) *
                 (faces[k].normal_traction() - normal_[k - offset_]);
    account.add(dt, l.first, l.second, at_rest);
  }
}

}  // namespace brisance::solid
