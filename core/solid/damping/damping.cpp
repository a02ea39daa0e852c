#include "core/solid/damping/damping.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"
#include "parallel/archive.hpp"

namespace brisance::solid {
namespace {

constexpr std::uint32_t damping_kind = 0x44414d50;  // "DAMP"

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The solution of a symmetric system: the angular velocity of a body of inertia j with spin l.
Vec3 solve(Mat3 const& j, Vec3 const& l, int dimension) {
  if (dimension == 1) return {};
  if (dimension == 2) return {0, 0, l.z / j[2].z};
  Vec3 const a = cross(j[1], j[2]), b = cross(j[2], j[0]), c = cross(j[0], j[1]);
  return (1 / dot(j[0], a)) *
         Vec3{dot(Vec3{a.x, b.x, c.x}, l), dot(Vec3{a.y, b.y, c.y}, l), dot(Vec3{a.z, b.z, c.z}, l)};
}

}  // namespace

void DampingConfig::keys(Keys<DampingConfig>& k) {
  k("law", &DampingConfig::law, "",
    "viscous: velocities decay by exp(-rate t); kinetic: all motion stops whenever the kinetic energy has passed a "
    "maximum")
      .one_of({"viscous", "kinetic"});
  k("relative_to", &DampingConfig::relative_to, "",
    "what is left in the end: ground: rest; bodies: the rigid motion of every body that no support holds")
      .one_of({"ground", "bodies"});
  k("rate", &DampingConfig::rate, "1/s", "viscous: alpha of -alpha v; critical for a frequency omega at 2 omega")
      .above(0);
  k("until", &DampingConfig::until, "s", "when the damping ends; not given: never").above(0);
  k("residual", &DampingConfig::residual, "1",
    "the damping ends when the net forces have fallen to this share of their largest value so far")
      .above(0)
      .below(1);
}

Damping::Damping(DampingConfig const& config, SolidConfig const& solid_config, Solid& solid, parallel::Comm& comm)
    : config_(config), gravity_(solid_config.gravity.value_or(Vec3{})), solid_(solid), comm_(comm) {
  bool const viscous = config.law == "viscous";
  require(viscous == config.rate.has_value(), config.at,
          viscous
              ? "solid.damping: viscous damping needs a `rate`, in 1/s; or take law = \"kinetic\", which needs none."
              : "solid.damping: kinetic damping has no `rate`: leave it out, or take law = \"viscous\".");
  Mesh const& mesh = solid.mesh();
  for (int d = mesh.dimension; d < 3; ++d) gravity_[d] = 0;
  floats_.assign(mesh.bodies.size(), config.relative_to == "bodies");
  for (Particle const& p : mesh.particles)
    if (p.freedom != Freedom::free) floats_[at(p.body)] = 0;
  for (Link const& link : mesh.links)
    if (link.j == Link::wall) floats_[at(mesh.particle(link.i).body)] = 0;
}

void Damping::join(Plan& plan) {
  plan.effect("solid.damping", [] { return sizeof(Damping); });
  if (config_.rate) {
    plan.at(Stage::set_off, [this](Clock const& c) {
      if (!over(c.time)) half_decay(c.dt);
    });
    plan.at(Stage::kick_again, [this](Clock const& c) {
      if (!over(c.time)) half_decay(c.dt);
    });
  } else {
    plan.at(Stage::kick_again, [this](Clock const& c) {
      if (!over(c.time)) stop_at_maximum();
    });
  }
  if (config_.residual)
    plan.at(Stage::kick_again, [this](Clock const& c) {
      if (!over(c.time)) watch_residual();
    });
  plan.account([this](Ledger& ledger) {
    ledger.add(Entry::dissipated, dissipated_);
    Vec3 taken;
    for (std::size_t d = 0; d < 3; ++d) {
      ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), impulse_[d]);
      taken[static_cast<int>(d)] = impulse_[d].value();
    }
    ledger.add(Entry::pressure_impulse, norm(taken));
    dissipated_ = {};
    impulse_ = {};
  });
  auto saved = std::make_shared<State>();
  Plan::Keep keep;
  keep.save = [this, saved] { *saved = state_; };
  keep.restore = [this, saved] {
    state_ = *saved;
    dissipated_ = {};
    impulse_ = {};
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    file.attribute("solid.damping.largest_force", state_.largest_force);
    file.attribute("solid.damping.stop_again", static_cast<std::int64_t>(state_.stop_again));
    file.attribute("solid.damping.done", static_cast<std::int64_t>(state_.done));
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    state_ = {file.real("solid.damping.largest_force"), file.integer("solid.damping.stop_again") != 0,
              file.integer("solid.damping.done") != 0};
  };
  keep.digest = [this](parallel::Digest& digest) {
    std::array<double, 3> const bits{state_.largest_force, state_.stop_again ? 1.0 : 0.0, state_.done ? 1.0 : 0.0};
    if (comm_.rank() == 0) digest.add(damping_kind, 0, bits);
  };
  plan.keep(std::move(keep));
}

std::vector<Damping::BodyMotion> Damping::body_motions() const {
  Mesh const& mesh = solid_.mesh();
  std::vector<BodyMotion> motions(mesh.bodies.size());
  if (std::find(floats_.begin(), floats_.end(), 1) == floats_.end()) return motions;
  // Per body: first moment and momentum; then, about the mass centre, spin and inertia.
  auto for_each_particle = [&](auto&& visit) {
    for (Index l = 0; l < solid_.owned(); ++l) {
      Particle const& p = mesh.particle(solid_.id(l));
      if (floats_[at(p.body)]) visit(at(p.body), p, solid_.pose()[at(l)], solid_.motion()[at(l)], l);
    }
  };
  std::vector<parallel::ExactSum> first(6 * motions.size()), second(9 * motions.size());
  for_each_particle([&](std::size_t b, Particle const& p, Pose const& pose, Motion const& m, Index) {
    for (int d = 0; d < 3; ++d) {
      first[6 * b + static_cast<std::size_t>(d)].add(p.mass * pose.x[d]);
      first[6 * b + 3 + static_cast<std::size_t>(d)].add(p.mass * m.v[d]);
    }
  });
  comm_.sum(std::span(first));
  for (std::size_t b = 0; b < motions.size(); ++b)
    for (int d = 0; d < 3; ++d) {
      motions[b].centre[d] = first[6 * b + static_cast<std::size_t>(d)].value() / mesh.bodies[b].mass;
      motions[b].v[d] = first[6 * b + 3 + static_cast<std::size_t>(d)].value() / mesh.bodies[b].mass;
    }
  for_each_particle([&](std::size_t b, Particle const& p, Pose const& pose, Motion const& m, Index l) {
    Vec3 const arm = pose.x - motions[b].centre, spin = m.spin + p.mass * cross(arm, m.v - motions[b].v);
    Mat3 const r = matrix(pose.q);
    Mat3 const j =
        r * mesh.inertia(solid_.id(l)) * transpose(r) + p.mass * (norm2(arm) * Mat3::identity() - outer(arm, arm));
    std::array<Real, 9> const all{spin.x, spin.y, spin.z, j[0].x, j[1].y, j[2].z, j[0].y, j[0].z, j[1].z};
    for (std::size_t k = 0; k < 9; ++k) second[9 * b + k].add(all[k]);
  });
  comm_.sum(std::span(second));
  for (std::size_t b = 0; b < motions.size(); ++b) {
    if (!floats_[b]) continue;
    std::array<Real, 9> s{};
    for (std::size_t k = 0; k < 9; ++k) s[k] = second[9 * b + k].value();
    Mat3 const j{{Vec3{s[3], s[6], s[7]}, Vec3{s[6], s[4], s[8]}, Vec3{s[7], s[8], s[5]}}};
    motions[b].omega = solve(j, {s[0], s[1], s[2]}, mesh.dimension);
  }
  return motions;
}

void Damping::keep_share(Real share) {
  Mesh const& mesh = solid_.mesh();
  std::vector<BodyMotion> const bodies = body_motions();
  for (Index l = 0; l < solid_.owned(); ++l) {
    Motion& m = solid_.motion()[at(l)];
    if (m.turns == 0) continue;
    Particle const& p = mesh.particle(solid_.id(l));
    BodyMotion const& body = bodies[at(p.body)];
    Vec3 const frame_v = body.v + cross(body.omega, solid_.pose()[at(l)].x - body.centre);
    Vec3 const frame_spin = solid_.spin_of(l, body.omega);
    Vec3 const v = frame_v + share * (m.v - frame_v), spin = frame_spin + share * (m.spin - frame_spin);
    Vec3 const impulse = p.mass * (v - m.v), turn = spin - m.spin;
    dissipated_.add(-0.5 * dot(impulse, v + m.v));
    dissipated_.add(-0.5 * dot(turn, solid_.omega_of(l, spin + m.spin)));
    for (int d = 0; d < 3; ++d) impulse_[static_cast<std::size_t>(d)].add(impulse[d]);
    m.v = v;
    m.spin = spin;
  }
}

void Damping::half_decay(Real dt) { keep_share(std::exp(-0.5 * *config_.rate * dt)); }

Vec3 Damping::net_force(Index particle) const {
  return solid_.internal()[at(particle)].force + solid_.load()[at(particle)].force +
         solid_.mesh().particle(solid_.id(particle)).mass * gravity_;
}

Real Damping::power() const {
  Mesh const& mesh = solid_.mesh();
  std::vector<BodyMotion> const bodies = body_motions();
  parallel::ExactSum sum;
  for (Index l = 0; l < solid_.owned(); ++l) {
    Motion const& m = solid_.motion()[at(l)];
    if (m.turns == 0) continue;
    Particle const& p = mesh.particle(solid_.id(l));
    BodyMotion const& body = bodies[at(p.body)];
    Vec3 const arm = solid_.pose()[at(l)].x - body.centre, w = body.omega;
    // In the frame of the body centrifugal forces work too; those of its accelerations do not, nor does Coriolis'.
    Vec3 const force = net_force(l) - p.mass * cross(w, cross(w, arm));
    Vec3 const torque = solid_.internal()[at(l)].torque + solid_.load()[at(l)].torque - cross(w, solid_.spin_of(l, w));
    sum.add(dot(force, m.v - body.v - cross(w, arm)) + dot(torque, solid_.omega_of(l, m.spin) - w));
  }
  comm_.sum(std::span(&sum, 1));
  return sum.value();
}

void Damping::stop_at_maximum() {
  // By the power, not by comparing energies: that sees a maximum a step late, when fast modes have swung through and
  // have no kinetic energy left to take away.
  // Modes whose quarter period is about one step stand still when they are caught after two: the stop one step after
  // each stop takes their energy, and costs the slow modes one step.
  bool const falls = !state_.stop_again && power() < 0;
  if (falls || state_.stop_again) keep_share(0);
  state_.stop_again = falls;
}

void Damping::watch_residual() {
  parallel::ExactSum sum;
  for (Index l = 0; l < solid_.owned(); ++l) {
    if (solid_.motion()[at(l)].turns == 0) continue;
    sum.add(norm2(net_force(l)));
  }
  comm_.sum(std::span(&sum, 1));
  Real const force = std::sqrt(sum.value());
  state_.largest_force = max(state_.largest_force, force);
  if (force > *config_.residual * state_.largest_force) return;
  state_.done = true;
  if (!config_.rate) keep_share(0);  // what comes next starts from rest
}

}  // namespace brisance::solid
