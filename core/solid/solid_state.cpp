// Saving, measuring, hashing and packing the state of a rank.
#include <algorithm>

#include "core/solid/solid.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr std::uint32_t particle_kind = 0x50415254;  // "PART"
constexpr std::uint32_t link_kind = 0x4c494e4b;      // "LINK"

Mat3 symmetric_matrix(std::array<double, 8> const& t) {
  return {{Vec3{t[0], t[3], t[4]}, Vec3{t[3], t[1], t[5]}, Vec3{t[4], t[5], t[2]}}};
}

std::array<Real, 3> components(Vec3 const& v) { return {v.x, v.y, v.z}; }

}  // namespace

void Solid::save(Saved& to) const {
  to.pose = pose_;
  to.motion = motion_;
  to.half = half_;
  to.wrench = wrench_;
  to.load = load_;
  to.opened = opened_;
  to.pressure = pressure_;
  to.intact = intact_;
  if (consistent_) to.consistent = consistent_->pull();
  to.reactions = reactions_;
}

void Solid::restore(Saved const& from, Restore what) {
  written_ = true;
  pose_ = from.pose;
  motion_ = from.motion;
  half_ = from.half;
  wrench_ = from.wrench;
  opened_ = from.opened;
  pressure_ = from.pressure;
  reactions_ = from.reactions;
  if (consistent_) consistent_->set_pull(from.consistent);
  for (std::size_t k = 0; k < intact_.size(); ++k)
    if (intact_[k] != from.intact[k]) weaken(k, from.intact[k]);
  if (what == Restore::state_and_load) load_ = from.load;
}

std::size_t Solid::bytes() const {
  return at(count_) * (sizeof(Pose) + sizeof(Motion) + sizeof(HalfVelocity) + 2 * sizeof(Wrench) + 4 * sizeof(double)) +
         inertia_.size() * sizeof(Inertia) + owner_.size() * (sizeof(int) + sizeof(Index));
}

std::size_t Solid::link_bytes() const {
  return links_.bytes() + (consistent_ ? consistent_->bytes() : 0) + (rates_ ? rates_->bytes() : 0);
}

Real Solid::kinetic_energy(Index particle) const {
  Motion const& m = motion_[at(particle)];
  Vec3 const body_spin = rotate(conjugate(pose_[at(particle)].q), m.spin);
  Vec3 const rate = symmetric_matrix(inertia_[at(inertia_of_[at(particle)])].inverse) * body_spin;
  return 0.5 * (dot(mesh_.particle(id(particle)).mass * m.v, m.v) + dot(body_spin, rate));
}

Real Solid::plastic_extension(FaceTractions::Face const& face) const {
  if (!plastic_) return 0;
  Real const reach = 2 * mesh_.material(id(face.particle)).shear() * face.compliance;  // S d
  return reach * dot(face.normal, plastic_->strain()[at(face.particle)] * face.normal);
}

void Solid::driving_stress(std::span<Symmetric> to, bool same_poses) {
  plastic_->driving_stress(pose_, pressure_, to, same_poses);
  for (FaceTractions::Face const& face : face_tractions_.faces()) {
    auto const p = at(face.particle);
    Real const reach = 2 * mesh_.material(id(face.particle)).shear() * face.compliance;
    if (p < to.size()) to[p] = to[p] + (reach * face.normal_traction()) * dyad(face.normal);
  }
}

Vec3 Solid::spin_of(Index particle, Vec3 const& omega) const {
  Quaternion const& q = pose_[at(particle)].q;
  return rotate(q, symmetric_matrix(inertia_[at(inertia_of_[at(particle)])].tensor) * rotate(conjugate(q), omega));
}

Vec3 Solid::omega_of(Index particle, Vec3 const& spin) const {
  Quaternion const& q = pose_[at(particle)].q;
  return rotate(q, symmetric_matrix(inertia_[at(inertia_of_[at(particle)])].inverse) * rotate(conjugate(q), spin));
}

Index Solid::end_j(std::size_t link) const {
  Index const entry = links_.end_j(link);
  if (entry < count_) return entry;
  auto const image = std::lower_bound(images_.begin(), images_.end(), entry,
                                      [](Image const& of, Index wanted) { return of.entry < wanted; });
  return image != images_.end() && image->entry == entry ? image->of : count_;
}

HalfVelocity Solid::far_half_velocity(std::size_t link) const {
  Index const entry = links_.end_j(link), particle = end_j(link);
  if (particle == count_) {
    HalfVelocity of_wall;
    for (Wall const& wall : walls_)
      if (wall.entry == entry) of_wall.v = wall.v, of_wall.omega = wall.omega;
    return of_wall;
  }
  HalfVelocity half = half_[at(particle)];
  Link const& of = mesh_.links[mesh_link_[link]];
  if (mesh_.is_mirror(of)) {
    Vec3 const n = mesh_.far_side(of)->vector;
    half.v -= (2 * dot(n, half.v)) * n;
    half.omega = (2 * dot(n, half.omega)) * n - half.omega;
  }
  return half;
}

LinkEnds<double> Solid::link_ends(std::size_t link) const {
  return ends_of(pose_[at(links_.end_i(link))], pose_[at(links_.end_j(link))]);
}

LinkWrench<double> Solid::wrench_of(std::size_t link) const {
  LinkEnds<double> const ends = link_ends(link);
  LinkWrench<double> w =
      link_wrench(links_.rest(link), ends, pressure_[at(links_.end_i(link))], pressure_[at(links_.end_j(link))]);
  auto const add = [&w](LinkWrench<double> const& other) {
    w.force = w.force + other.force;
    w.torque_i = w.torque_i + other.torque_i;
    w.torque_j = w.torque_j + other.torque_j;
  };
  if (consistent_) add(consistent_->wrench(link, ends));
  if (plastic_) add(plastic_->wrench(link, ends));
  return w;
}

Real Solid::link_energy(std::size_t link) const {
  Real const share = mesh_.is_mirror(mesh_.links[mesh_link_[link]]) ? 0.5 : 1;
  LinkEnds<double> const ends = link_ends(link);
  Real const elastic = solid::link_energy(links_.rest(link), ends);
  return share * (plastic_ ? elastic + plastic_->link_energy(link, ends) : elastic);
}

Reactions Solid::take_reactions() {
  Reactions const taken = reactions_;
  reactions_ = {};
  return taken;
}

void Solid::add_load_work(Real dt, parallel::ExactSum& to) const {
  for (Index l = 0; l < owned_; ++l)
    to.add(dt * (dot(load_[at(l)].force, half_[at(l)].v) + dot(load_[at(l)].torque, half_[at(l)].omega)));
}

void Solid::add_load_impulse(Real dt, std::span<parallel::ExactSum, 3> to) const {
  for (Index l = 0; l < owned_; ++l)
    for (int d = 0; d < 3; ++d) to[static_cast<std::size_t>(d)].add(dt * load_[at(l)].force[d]);
}

void Solid::digest(parallel::Digest& to) const {
  std::array<double, 13> bits{};
  for (Index l = 0; l < owned_; ++l) {
    Pose const& p = pose_[at(l)];
    Motion const& m = motion_[at(l)];
    bits = {p.x.x, p.x.y, p.x.z, p.q.w, p.q.v.x, p.q.v.y, p.q.v.z, m.v.x, m.v.y, m.v.z, m.spin.x, m.spin.y, m.spin.z};
    to.add(particle_kind, id(l), bits);
  }
  for (std::size_t k = 0; k < intact_.size(); ++k)
    if (links_.end_i(k) < owned_ && intact_[k] != 1)
      to.add(link_kind, static_cast<GlobalId>(mesh_link_[k]), std::span(&intact_[k], 1));
}

std::vector<double> Solid::pack() const {
  std::vector<double> rows;
  rows.reserve(at(owned_) * row_size);
  for (Index l = 0; l < owned_; ++l) {
    Pose const& p = pose_[at(l)];
    rows.insert(rows.end(), {p.x.x, p.x.y, p.x.z, p.q.w, p.q.v.x, p.q.v.y, p.q.v.z});
    for (Vec3 const& v : {motion_[at(l)].v, motion_[at(l)].spin, wrench_[at(l)].force, wrench_[at(l)].torque,
                          load_[at(l)].force, load_[at(l)].torque, half_[at(l)].v, half_[at(l)].omega}) {
      auto const c = components(v);
      rows.insert(rows.end(), c.begin(), c.end());
    }
  }
  return rows;
}

void Solid::unpack(std::span<GlobalId const> ids, std::span<double const> rows) {
  require(rows.size() == ids.size() * row_size, Failure::system,
          "solid rows of a checkpoint have another length than their numbers: the file belongs to another version.");
  written_ = true;
  for (std::size_t r = 0; r < ids.size(); ++r) {
    if (ids[r] < 0 || ids[r] >= mesh_.size()) continue;
    Index const l = local(ids[r]);
    if (l < 0) continue;
    double const* in = rows.data() + r * row_size;
    Pose& p = pose_[at(l)];
    p.x = {in[0], in[1], in[2]};
    p.q = {in[3], {in[4], in[5], in[6]}};
    in += 7;
    for (Vec3* v : {&motion_[at(l)].v, &motion_[at(l)].spin, &wrench_[at(l)].force, &wrench_[at(l)].torque,
                    &load_[at(l)].force, &load_[at(l)].torque, &half_[at(l)].v, &half_[at(l)].omega}) {
      *v = {in[0], in[1], in[2]};
      in += 3;
    }
  }
}

}  // namespace brisance::solid
