// Who wakes the sleeping parts of the solid, and forces of the others.
#include <algorithm>
#include <bit>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// All bits zero: a -0 would become +0 in a step.
bool nothing(Vec3 const& v) {
  return (std::bit_cast<std::uint64_t>(v.x) | std::bit_cast<std::uint64_t>(v.y) | std::bit_cast<std::uint64_t>(v.z)) ==
         0;
}
bool nothing(Wrench const& w) { return nothing(w.force) && nothing(w.torque); }
bool nothing(Motion const& m) { return nothing(m.v) && nothing(m.spin); }

}  // namespace

/// Is a particle where and how the mesh put it, under no load?
bool Solid::undisturbed(Index l) const {
  Pose const& p = pose_[at(l)];
  bool const placed = p.q.w == 1 && nothing(p.q.v) && p.x == mesh_.particle(id(l)).centre;
  return placed && nothing(motion_[at(l)]) && nothing(load_[at(l)]) && nothing(wrench_[at(l)]) &&
         face_opening_[at(l)] == 0;
}

void Solid::let_sleep() {
  if (!sleep_allowed_ || sleep_) return;
  sleep_ = std::make_unique<Sleep>(links_, count_);
  written_ = true;
}

void Solid::wake_written() {
  if (!written_) return;
  written_ = false;
  for (Index c = 0; c < sleep_->chunks(); ++c) {
    if (sleep_->moved(c)) continue;
    Sleep::Particles const range = sleep_->particles(c);
    for (Index l = range.first; l < range.end; ++l)
      if (!undisturbed(l)) {
        sleep_->wake(c);
        break;
      }
  }
  for (FaceTractions::Face const& face : std::as_const(face_tractions_).faces())
    sleep_->wake(face.particle / Sleep::chunk);
}

void Solid::wake_moving() {
  for (Index c = 0; c < sleep_->chunks(); ++c) {
    if (sleep_->moved(c) || !sleep_->awake(c)) continue;
    Sleep::Particles const range = sleep_->particles(c);
    for (Index l = range.first; l < std::min(range.end, owned_); ++l)
      if (!nothing(motion_[at(l)])) {
        sleep_->wake(c);
        break;
      }
  }
}

void Solid::wake_moved_ghosts() {
  for (Index c = owned_ / Sleep::chunk; c < sleep_->chunks(); ++c) {
    if (sleep_->moved(c)) continue;
    Sleep::Particles const range = sleep_->particles(c);
    for (Index l = std::max(range.first, owned_); l < range.end; ++l) {
      Pose const& p = pose_[at(l)];
      if (p.q.w == 1 && nothing(p.q.v) && p.x == mesh_.particle(id(l)).centre) continue;
      sleep_->wake(c);
      break;
    }
  }
}

std::span<Sleep::Particles const> Solid::awake_particles() {
  if (!sleep_) return std::span(&everything_, 1);
  wake_written();
  sleep_->update();
  return sleep_->awake();
}

void Solid::compute_strains_awake() {
  wake_written();
  sleep_->update();
  if (!volumetric_) return;
  for (Sleep::Particles const& r : sleep_->strained())
    std::copy(face_opening_.begin() + r.first, face_opening_.begin() + r.end, opened_.begin() + r.first);
  for (LinkStore::Range const& r : sleep_->opening()) links_.add_opened_volume(pose_, opened_, r);
  for (Sleep::Particles const& r : sleep_->strained())
    for (std::size_t p = at(r.first); p < at(r.end); ++p) pressure_[p] = bulk_[p] * opened_[p];
}

void Solid::add_wrench_awake() {
  for (Sleep::Particles const& r : sleep_->awake())
    std::fill(wrench_.begin() + r.first, wrench_.begin() + r.end, Wrench{});
  for (LinkStore::Range const& r : sleep_->pulling())
    if (damageable())
      links_.add_wrench(pose_, pressure_, wrench_, gaps_, r);
    else
      links_.add_wrench(pose_, pressure_, wrench_, r);
}

std::int64_t Solid::link_updates() const {
  if (rates_) return rates_->link_updates;
  return sleep_ ? std::min(sleep_->pulling_links(), static_cast<std::int64_t>(links_.count()))
                : static_cast<std::int64_t>(links_.count());
}

}  // namespace brisance::solid
