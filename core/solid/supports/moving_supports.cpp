#include "core/solid/supports/moving_supports.hpp"

#include "parallel/archive.hpp"

namespace brisance::solid {
namespace {

Pose pose_of(RigidMotion::State const& s) {
  Pose pose;
  pose.x = s.x;
  pose.q = s.q;
  return pose;
}

/// Vector e of the turn from q to `to` in the body frame, with e0 >= 0.
Vec3 turn_between(Quaternion const& q, Quaternion const& to, Real& e0) {
  Quaternion const turn = conjugate(q) * to;
  Real const sign = turn.w < 0 ? -1 : 1;
  e0 = sign * turn.w;
  return sign * turn.v;
}

}  // namespace

void MovingSupports::join(Plan& plan) {
  plan.effect("solid.supports", [this] { return solid_.mesh().motions.size() * sizeof(RigidMotion); });
  plan.at(Stage::set_off, [this](Clock const& c) { set_off(c.time, c.dt); });
  plan.at(Stage::kick_again, [this](Clock const& c) { arrive(c.time + c.dt); });
  Plan::Keep keep;
  keep.save = [] {};
  keep.restore = [] {};
  keep.write = [](parallel::ArchiveWriter&) {};
  keep.read = [this](parallel::ArchiveReader& file) {
    place_walls(file.real("time"));
    solid_.compute_strains();
  };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void MovingSupports::set_off(Real time, Real dt) {
  Mesh const& mesh = solid_.mesh();
  std::vector<RigidMotion::State> ends;
  for (std::size_t m = 0; m < mesh.motions.size(); ++m) {
    RigidMotion::State const from = mesh.motions[m].at(time), to = mesh.motions[m].at(time + dt);
    ends.push_back(to);
    Real e0 = 1;
    Vec3 const e = turn_between(from.q, to.q, e0);
    solid_.drive_walls(static_cast<Index>(m),
                       {pose_of(from), pose_of(to), (to.x - from.x) / dt, (2 * e0 / dt) * rotate(from.q, e)});
  }
  for (Index const p : solid_.held()) {
    Particle const& particle = mesh.particle(solid_.id(p));
    if (particle.motion < 0) continue;
    auto const m = static_cast<std::size_t>(particle.motion);
    Pose const& pose = solid_.pose()[static_cast<std::size_t>(p)];
    Real e0 = 1;
    Vec3 const e = turn_between(pose.q, ends[m].q, e0);
    // The spin whose drift makes this turn (theory/solid.md section 10): Pi dt/2 = e0 J e + e x J e.
    Vec3 const je = mesh.inertia(solid_.id(p)) * e;
    HalfVelocity half;
    half.v = (ends[m].place(particle.centre - mesh.motions[m].centre()) - pose.x) / dt;
    half.omega = (2 * e0 / dt) * rotate(pose.q, e);
    solid_.drive(p, half.v, (2 / dt) * rotate(pose.q, e0 * je + cross(e, je)), half);
  }
}

void MovingSupports::arrive(Real time) {
  Mesh const& mesh = solid_.mesh();
  for (Index const p : solid_.held()) {
    Particle const& particle = mesh.particle(solid_.id(p));
    if (particle.motion < 0) continue;
    RigidMotion const& motion = mesh.motions[static_cast<std::size_t>(particle.motion)];
    RigidMotion::State const now = motion.at(time);
    solid_.drive(p, now.velocity(particle.centre - motion.centre()), solid_.spin_of(p, now.omega),
                 solid_.half_velocity()[static_cast<std::size_t>(p)]);
  }
}

void MovingSupports::place_walls(Real time) {
  for (std::size_t m = 0; m < solid_.mesh().motions.size(); ++m) {
    Pose const here = pose_of(solid_.mesh().motions[m].at(time));
    solid_.drive_walls(static_cast<Index>(m), {here, here, {}, {}});
  }
}

}  // namespace brisance::solid
