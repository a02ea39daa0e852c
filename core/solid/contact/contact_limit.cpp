// The step that contacts allow.  Source: theory/solid.md section 15: stability and no tunnelling.
#include <cmath>
#include <limits>

#include "core/solid/contact/contact.hpp"

namespace brisance::solid {
namespace {

constexpr Real unlimited = 1e300;
constexpr std::size_t width = 8;  // velocity 3, speed of turning at the outer radius, the same of accelerations

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Time to cover a distance from a speed under an acceleration, s.
Real time_to_cover(Real distance, Real speed, Real acceleration) {
  Real const reached = speed + std::sqrt(speed * speed + 2 * acceleration * distance);
  return reached > 0 ? 2 * distance / reached : distance > 0 ? unlimited : 0;
}

struct MotionRow {
  Vec3 v{}, a{};
  Real turning = 0, turning_up = 0;
  explicit MotionRow(double const* r) : v{r[0], r[1], r[2]}, a{r[4], r[5], r[6]}, turning(r[3]), turning_up(r[7]) {}
};

}  // namespace

/// Velocities and accelerations of owned actors, then of all.
void Contact::add_motion_rows() {
  auto const& actors = list_.actors();
  motion_rows_.assign(width * actors.size(), 0);
  for (std::size_t k = 0; k < actors.size(); ++k) {
    if (actors[k].local < 0) continue;
    auto const row = motion_row(actors[k].local);
    std::copy(row.begin(), row.end(), motion_rows_.begin() + static_cast<std::ptrdiff_t>(width * k));
  }
  list_.exchange_rows(motion_rows_, width);
}

std::array<double, 8> Contact::motion_row(Index local) {
  Motion const& m = solid_.motion()[at(local)];
  if (m.turns == 0) return {m.v.x, m.v.y, m.v.z, 0, 0, 0, 0, 0};
  Convex const& shape = list_.shape(local);
  Wrench const &in = solid_.internal()[at(local)], &load = solid_.load()[at(local)];
  Vec3 const a = m.inverse_mass * (in.force + load.force) + gravity_.value_or(Vec3{});
  Quaternion const back = conjugate(solid_.pose()[at(local)].q);
  Real const scale = shape.outer_radius / solid_.mesh().material(solid_.id(local)).density;
  auto const turning = [&](Vec3 const& spin) { return scale * norm(shape.inverse_inertia * rotate(back, spin)); };
  Real const up = shape.largest_inverse > 0 ? turning(in.torque + load.torque) : 0;
  Vec3 moves = a;
  for (int d = solid_.mesh().dimension; d < 3; ++d) moves[d] = 0;
  return {m.v.x, m.v.y, m.v.z, turning(m.spin), moves.x, moves.y, moves.z, up};
}

Real Contact::time_step() {
  // Links may have broken since the forces were computed; a run that starts here would see it.
  if (solid_.damageable() && refresh()) measure();
  Real dt = unlimited;
  // Nothing may come near and pass before it is listed: at most half a reach a step.
  for (Index const l : list_.candidates()) {
    auto const row = motion_row(l);
    MotionRow const m(row.data());
    dt = min(dt, time_to_cover(0.5 * ContactList::reach(list_.shape(l)), norm(m.v), norm(m.a)));
  }
  add_motion_rows();
  auto const& actors = list_.actors();
  std::vector<Real> squared(actors.size(), 0);  // of the frequency of the contacts of an actor
  for (std::size_t k = 0; k < overlaps_.size(); ++k) {
    ContactPair const& p = list_.pairs()[k];
    if (!list_.near(p)) continue;
    Overlap const& o = overlaps_[k];
    ContactActor const &a = actors[at(p.a)], &b = actors[at(p.b)];
    MotionRow const ma(&motion_rows_[width * at(p.a)]), mb(&motion_rows_[width * at(p.b)]);
    Real const speed = norm(ma.v - mb.v) + ma.turning + mb.turning;
    Real const acceleration = norm(ma.a - mb.a) + ma.turning_up + mb.turning_up;

    // Both ends of a moving pair see twice its stiffness (|u - v|^2 <= 2 |u|^2 + 2 |v|^2), a wall stands still.
    Real const shared = a.held || b.held ? 1 : 2;
    Real const face = min(a.shape->largest_face, b.shape->largest_face);
    auto const frequency2 = [&](ContactActor const& of, Vec3 const& moment, Vec3 const& arm, Pose const& pose) {
      if (of.held) return 0.0;
      Real const turning = of.shape->largest_inverse / of.density;
      Real const shear = o.law.shear_ratio;
      Real worst = o.law.stiffness * face * face *
                   (1 / of.mass + shear * (1 / of.mass + turning * square(of.shape->outer_radius)));
      if (o.active) {
        Vec3 const m = rotate(conjugate(pose.q), moment);
        Real const normal = norm2(o.common.area) / of.mass + dot(m, of.shape->inverse_inertia * m) / of.density;
        Real const tangential = shear * norm2(o.common.area) * (1 / of.mass + turning * norm2(arm));
        worst = max(worst, o.law.slope(o.common.volume) * (normal + tangential));
      }
      return shared * worst;
    };
    Vec3 const shift = list_.pose(p.b).x - list_.pose(p.a).x;
    Vec3 const moment_b = cross(shift, o.common.area) - o.common.moment;
    Real const wa = frequency2(a, o.common.moment, o.common.centroid, list_.pose(p.a));
    Real const wb = frequency2(b, moment_b, o.common.centroid - shift, list_.pose(p.b));

    Real gap = 0;
    Real const depth = 0.2 * min(a.shape->inner_radius, b.shape->inner_radius);
    if (!o.active) {
      gap = max(0, gap_along_normals(list_.placed(p.a), list_.placed(p.b), shift));
      if (Real const touch = time_to_cover(gap, speed, acceleration); touch > 2 / std::sqrt(max(wa, wb))) {
        dt = min(dt, touch);  // a step that ends before they meet needs no regard for their stiffness
        continue;
      }
    }
    dt = min(dt, time_to_cover(gap + depth, speed, acceleration));
    squared[at(p.a)] += wa;
    squared[at(p.b)] += wb;
  }
  for (std::size_t k = 0; k < actors.size(); ++k) {
    if (actors[k].local < 0 || squared[k] == 0) continue;
    Real const links = square(2 / solid_.link_limit_of(actors[k].local));
    dt = min(dt, min(config_.cfl * 2 / std::sqrt(squared[k]), link_cfl_ * 2 / std::sqrt(squared[k] + links)));
  }
  return dt;
}

}  // namespace brisance::solid
