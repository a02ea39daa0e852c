// Kicks, drifts and the rotation step of the particles.  Source: theory/solid.md section 10.
#include <algorithm>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

double* numbers(Pose& p) { return reinterpret_cast<double*>(&p); }
double* numbers(Motion& m) { return reinterpret_cast<double*>(&m); }
double* numbers(HalfVelocity& h) { return reinterpret_cast<double*>(&h); }
double const* numbers(Wrench const& w) { return reinterpret_cast<double const*>(&w); }

/// J and J^-1 of four particles.
struct InertiaLanes {
  Lanes tensor[6], inverse[6];
};

void transpose_eight(std::array<double const*, lanes> const& rows, Lanes* out) {
  Lanes a = Lanes::load_aligned(rows[0]), b = Lanes::load_aligned(rows[1]), c = Lanes::load_aligned(rows[2]),
        d = Lanes::load_aligned(rows[3]);
  transpose(a, b, c, d);
  out[0] = a, out[1] = b, out[2] = c, out[3] = d;
  Lanes e = Lanes::load_aligned(rows[0] + 4), f = Lanes::load_aligned(rows[1] + 4),
        g = Lanes::load_aligned(rows[2] + 4), h = Lanes::load_aligned(rows[3] + 4);
  transpose(e, f, g, h);
  out[4] = e, out[5] = f;
}

/// Half tangent y = e/e0 of the turn of a step: J y + y x J y = c (1 + |y|^2), c = dt/2 Pi.
/// Fixed point until it stands still to 2e-14; every lane stops on its own account, so its bits do not depend on the
/// others.
Triple<Lanes> half_tangent(InertiaLanes const& inertia, Triple<Lanes> const& c) {
  Triple<Lanes> y = symmetric_times(inertia.inverse, c);
  auto active = y.x == y.x;
  for (int sweep = 0; sweep < 60; ++sweep) {
    Lanes const stretch = Lanes(1.0) + dot(y, y);
    Triple<Lanes> const next =
        symmetric_times(inertia.inverse, cross_add(symmetric_times(inertia.tensor, y), y, stretch * c));
    Triple<Lanes> const change = next - y;
    y = {xsimd::select(active, next.x, y.x), xsimd::select(active, next.y, y.y), xsimd::select(active, next.z, y.z)};
    active = active & (dot(change, change) > Lanes(4e-28) * dot(next, next));
    if (!xsimd::any(active)) break;
  }
  return y;
}

InertiaLanes read_inertia(std::span<Inertia const> inertia, std::span<Index const> inertia_of,
                          std::array<std::size_t, lanes> const& p) {
  std::array<double const*, lanes> tensor, inverse;
  for (std::size_t k = 0; k < lanes; ++k) {
    Inertia const& of = inertia[static_cast<std::size_t>(inertia_of[p[k]])];
    tensor[k] = of.tensor.data();
    inverse[k] = of.inverse.data();
  }
  InertiaLanes lanes_of;
  transpose_eight(tensor, lanes_of.tensor);
  transpose_eight(inverse, lanes_of.inverse);
  return lanes_of;
}

/// Quaternions and spins of four particles become their quaternions after dt and their half-step angular velocities.
void turn_four(std::array<Lanes, lanes>& q, std::array<Lanes, lanes>& spin, InertiaLanes const& inertia, Real dt) {
  Lanes const zero(0.0);
  transpose(q[0], q[1], q[2], q[3]);
  transpose(spin[0], spin[1], spin[2], spin[3]);
  Turn<Lanes> const turn{q[0], {q[1], q[2], q[3]}};
  Rotation<Lanes> const rotation(turn);
  Triple<Lanes> const y = half_tangent(inertia, Lanes(0.5 * dt) * rotation.back({spin[0], spin[1], spin[2]}));
  Lanes const e0 = Lanes(1.0) / root(Lanes(1.0) + dot(y, y));
  Triple<Lanes> const e = e0 * y;
  Lanes const w = multiply_subtract(turn.w, e0, dot(turn.v, e));
  Triple<Lanes> const u = cross_add(turn.v, e, multiply_add(turn.w, e, e0 * turn.v));
  Lanes const fix = subtract_product(Lanes(0.5), multiply_add(w, w, dot(u, u)), Lanes(1.5));
  Triple<Lanes> const omega = (Lanes(2.0 / dt) * e0) * (rotation * e);
  q = {fix * w, fix * u.x, fix * u.y, fix * u.z};
  spin = {omega.x, omega.y, omega.z, zero};
  transpose(q[0], q[1], q[2], q[3]);
  transpose(spin[0], spin[1], spin[2], spin[3]);
}

/// Which components move: all in 3D; x, y and the turn about z in 2D; x alone in 1D.
struct Freedoms {
  Lanes force, torque;
  explicit Freedoms(int dimension)
      : force(four_values(1.0, dimension > 1 ? 1.0 : 0.0, dimension > 2 ? 1.0 : 0.0, 0.0)),
        torque(four_values(dimension > 2 ? 1.0 : 0.0, dimension > 2 ? 1.0 : 0.0, dimension > 1 ? 1.0 : 0.0, 0.0)) {}
};

}  // namespace

template <bool with_kick, bool with_drift>
void Solid::advance(Real dt) {
  if constexpr (with_kick) book_reactions(0.5 * dt);  // at the poses of the forces, before any drift
  Freedoms const freedoms(dimension_);
  Vec3 const g = gravity_.value_or(Vec3{});
  Lanes const fall = four_values(0.5 * dt * g.x, 0.5 * dt * g.y, 0.5 * dt * g.z, 0.0);
  Lanes const move = four_values(dt, dt, dt, 0.0), half_dt(0.5 * dt);
  auto kick = [&](std::size_t p, Lanes& v, Lanes& spin) {
    Motion const& m = motion_[p];
    double const *internal = numbers(wrench_[p]), *load = numbers(load_[p]);
    Lanes const force = (Lanes::load_aligned(internal) + Lanes::load_aligned(load)) * freedoms.force;
    Lanes const torque = (Lanes::load_aligned(internal + 4) + Lanes::load_aligned(load + 4)) * freedoms.torque;
    Lanes const turns(m.turns);
    v = multiply_add(force, half_dt * Lanes(m.inverse_mass), multiply_add(fall, turns, v));
    spin = multiply_add(torque, half_dt * turns, spin);
  };
  auto const four = [&](Index first) {
    std::array<std::size_t, lanes> p;  // the last group repeats the last particle and stores it once
    std::size_t const used = static_cast<std::size_t>(std::min(lanes, owned_ - first));
    for (std::size_t k = 0; k < lanes; ++k) p[k] = static_cast<std::size_t>(first) + std::min(k, used - 1);
    std::array<Lanes, lanes> v, spin;
    for (std::size_t k = 0; k < lanes; ++k) {
      double const* m = numbers(motion_[p[k]]);
      v[k] = Lanes::load_aligned(m);
      spin[k] = Lanes::load_aligned(m + 4);
      if constexpr (with_kick) kick(p[k], v[k], spin[k]);
    }
    if constexpr (with_kick)
      for (std::size_t k = 0; k < used; ++k) {
        v[k].store_aligned(numbers(motion_[p[k]]));
        spin[k].store_aligned(numbers(motion_[p[k]]) + 4);
      }
    if constexpr (with_drift) {
      std::array<Lanes, lanes> q;
      for (std::size_t k = 0; k < lanes; ++k) q[k] = Lanes::load_aligned(numbers(pose_[p[k]]) + 4);
      turn_four(q, spin, read_inertia(inertia_, inertia_of_, p), dt);
      for (std::size_t k = 0; k < used; ++k) {
        double *pose = numbers(pose_[p[k]]), *half = numbers(half_[p[k]]);
        multiply_add(move, v[k], Lanes::load_aligned(pose)).store_aligned(pose);
        q[k].store_aligned(pose + 4);
        v[k].store_aligned(half);
        spin[k].store_aligned(half + 4);
      }
    }
  };
  for (Sleep::Particles const& range : awake_particles())
    for (Index first = range.first; first < std::min(range.end, owned_); first += lanes) four(first);
  if (with_kick && sleep_) wake_moving();
  if constexpr (with_drift)
    for (Wall const& wall : walls_) pose_[static_cast<std::size_t>(wall.entry)] = wall.to;
}

void Solid::half_kick(Real dt) { advance<true, false>(dt); }
void Solid::drift(Real dt) { advance<false, true>(dt); }
void Solid::kick_and_drift(Real dt) { advance<true, true>(dt); }

void Solid::step(Real dt) {
  if (rates_) {
    half_kick(dt);
    move(dt);
  } else {
    kick_and_drift(dt);
    exchange_pose();
  }
  compute_forces();
  half_kick(dt);
}

void Solid::drift_level(std::span<Index const> particles, Real dt, Real share, bool first) {
  Lanes const move = four_values(dt, dt, dt, 0.0), part(share), zero(0.0);
  for (std::size_t from = 0; from < particles.size(); from += lanes) {
    std::array<std::size_t, lanes> p;
    std::size_t const used = std::min<std::size_t>(lanes, particles.size() - from);
    for (std::size_t k = 0; k < lanes; ++k) p[k] = static_cast<std::size_t>(particles[from + std::min(k, used - 1)]);
    std::array<Lanes, lanes> v, spin, q;
    for (std::size_t k = 0; k < lanes; ++k) {
      v[k] = Lanes::load_aligned(numbers(motion_[p[k]]));
      spin[k] = Lanes::load_aligned(numbers(motion_[p[k]]) + 4);
      q[k] = Lanes::load_aligned(numbers(pose_[p[k]]) + 4);
    }
    turn_four(q, spin, read_inertia(inertia_, inertia_of_, p), dt);
    for (std::size_t k = 0; k < used; ++k) {
      double *pose = numbers(pose_[p[k]]), *half = numbers(half_[p[k]]);
      multiply_add(move, v[k], Lanes::load_aligned(pose)).store_aligned(pose);
      q[k].store_aligned(pose + 4);
      multiply_add(part, v[k], first ? zero : Lanes::load_aligned(half)).store_aligned(half);
      multiply_add(part, spin[k], first ? zero : Lanes::load_aligned(half + 4)).store_aligned(half + 4);
    }
  }
}

void Solid::kick_rung(Rung const& rung, Real dt) {
  Freedoms const freedoms(dimension_);
  for (Index l : rung.kicked) {
    auto const p = static_cast<std::size_t>(l);
    double* m = numbers(motion_[p]);
    double const* internal = numbers(wrench_[p]);
    Lanes const force = Lanes::load_aligned(internal) * freedoms.force;
    Lanes const torque = Lanes::load_aligned(internal + 4) * freedoms.torque;
    // The fourth entries of a Motion are constants: force and torque have 0 there.
    multiply_add(force, Lanes(dt * motion_[p].inverse_mass), Lanes::load_aligned(m)).store_aligned(m);
    multiply_add(torque, Lanes(dt * motion_[p].turns), Lanes::load_aligned(m + 4)).store_aligned(m + 4);
  }
  for (Index l : rung.held) {
    auto const p = static_cast<std::size_t>(l);
    Vec3 const force = -wrench_[p].force, torque = -wrench_[p].torque;
    reactions_.add(dt, force, torque + cross(pose_[p].x, force), dot(force, motion_[p].v));
  }
  book_clamps(dt, rung.links, rung.clamps, rung.link_share);
}

void Solid::book_reactions(Real dt) {
  // Between the kicks of a step the supports balance the forces of their instant; gravity acts on free particles only.
  // Their work is done on the way of the step, so by its half velocities: then quadratic energies balance exactly.
  for (Index l : held_) {
    auto const p = static_cast<std::size_t>(l);
    Vec3 const force = -(wrench_[p].force + load_[p].force), torque = -(wrench_[p].torque + load_[p].torque);
    reactions_.add(dt, force, torque + cross(pose_[p].x, force), dot(force, half_[p].v) + dot(torque, half_[p].omega));
  }
  if (rates_) return book_clamps(dt, links_, clamps_, rates_->link_share);
  for (std::size_t c : clamps_) {
    auto const p = static_cast<std::size_t>(links_.end_i(c));
    LinkWrench<double> const w = wrench_of(c);
    Vec3 const force{w.force.x, w.force.y, w.force.z}, torque{w.torque_i.x, w.torque_i.y, w.torque_i.z};
    Real power = 0;
    for (Wall const& wall : walls_)
      if (wall.entry == links_.end_j(c))
        power = dot(force, wall.v) + dot(Vec3{w.torque_j.x, w.torque_j.y, w.torque_j.z}, wall.omega);
    reactions_.add(dt, force, torque + cross(pose_[p].x, force), power);
  }
}

void Solid::book_clamps(Real dt, LinkStore const& links, std::span<std::size_t const> clamps,
                        std::span<double const> link_share) {
  for (std::size_t c : clamps) {
    auto const p = static_cast<std::size_t>(links.end_i(c));
    LinkRest<double> rest = links.rest(c);
    rest.stiffness *= link_share[c];
    for (double& b : rest.bending) b *= link_share[c];
    LinkWrench<double> const w = link_wrench(rest, ends_of(pose_[p], pose_.back()), rates_->pressure[p], 0.0);
    Vec3 const force{w.force.x, w.force.y, w.force.z}, torque{w.torque_i.x, w.torque_i.y, w.torque_i.z};
    reactions_.add(dt, force, torque + cross(pose_[p].x, force), 0);
  }
}

void Solid::drive_walls(Index motion, WallStep const& step) {
  for (Wall& wall : walls_) {
    if (wall.motion != motion) continue;
    pose_[static_cast<std::size_t>(wall.entry)] = step.from;
    wall.to = step.to;
    wall.v = step.v;
    wall.omega = step.omega;
  }
}

void Solid::drive(Index particle, Vec3 const& v, Vec3 const& spin, HalfVelocity const& half) {
  auto const p = static_cast<std::size_t>(particle);
  Motion& m = motion_[p];
  Vec3 const impulse = mesh_.particle(id(particle)).mass * (v - m.v), turn = spin - m.spin;
  // Kinetic energies are quadratic: the change is the impulse times the mean velocity.
  Real const work = 0.5 * (dot(impulse, v + m.v) + dot(turn, omega_of(particle, spin + m.spin)));
  reactions_.add(1, impulse, turn + cross(pose_[p].x, impulse), work);
  written_ = true;
  m.v = v;
  m.spin = spin;
  half_[p] = half;
}

}  // namespace brisance::solid
