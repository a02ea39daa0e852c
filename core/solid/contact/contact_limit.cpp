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

/// Squares of the frequency (1/s2) that contacts give a particle: of their normal forces, and with friction.
struct Frequency {
  Real normal = 0, all = 0;
  void operator+=(Frequency const& f) { normal += f.normal, all += f.all; }
  void at_least(Frequency const& f) { normal = max(normal, f.normal), all = max(all, f.all); }
};
Frequency operator*(Real s, Frequency const& f) { return {s * f.normal, s * f.all}; }

Real turning(ContactActor const& of) { return of.shape->largest_inverse / of.density; }

/// Of a flat contact of this area (squared) as it begins.
Frequency flat_contact(PairLaw const& law, ContactActor const& of, Real area2) {
  if (of.held) return {};
  Real const normal = law.stiffness * area2 / of.mass;
  Real const shear = law.shear_ratio * law.stiffness * area2;
  return {normal, normal + shear * (1 / of.mass + turning(of) * square(of.shape->inner_radius))};
}

/// Of an overlap as it is: g M^-1 g with the gradient g of its volume, and friction at its centre.
Frequency contact_now(PairLaw const& law, Intersection const& common, ContactActor const& of, Pose const& pose,
                      Vec3 const& moment, Vec3 const& arm) {
  if (of.held) return {};
  Vec3 const m = rotate(conjugate(pose.q), moment);
  Real const slope = law.slope(common.volume), area2 = norm2(common.area);
  Real const normal = slope * (area2 / of.mass + dot(m, of.shape->inverse_inertia * m) / of.density);
  Real const shear = law.shear_ratio * slope * area2;
  return {normal, normal + shear * (1 / of.mass + turning(of) * norm2(arm))};
}

/// Of the barrier of an overlap as it is. `turn`: slope of its depth by a turn of this end.
Frequency barrier_now(Barrier const& barrier, ContactActor const& of, Pose const& pose, Vec3 const& turn) {
  if (of.held || barrier.stiffness == 0) return {};
  Vec3 const m = rotate(conjugate(pose.q), turn);
  Real const normal =
      barrier.stiffness * (norm2(barrier.slope) / of.mass + dot(m, of.shape->inverse_inertia * m) / of.density);
  return {normal, normal};
}

/// Area that a flat contact across `normal` may have while the overlap is no thicker than `depth`: of the faces that
/// look that way, and of what else of the overlap's sides is left. m2.
Real flat_area(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& normal, Real depth) {
  Real const facing = min(facing_area(a, normal), facing_area(b, normal));
  Real const sides = 2 * depth * min(a.shape->outer_radius, b.shape->outer_radius);
  return min(std::sqrt(square(facing) + square(sides)), min(a.shape->largest_face, b.shape->largest_face));
}

}  // namespace

/// Of an owned particle, in the dimensions of the run.
Vec3 Contact::acceleration_of(Index local) const {
  Motion const& m = solid_.motion()[at(local)];
  if (m.turns == 0) return {};
  Vec3 a = m.inverse_mass * (solid_.internal()[at(local)].force + solid_.load()[at(local)].force) +
           gravity_.value_or(Vec3{});
  for (int d = solid_.mesh().dimension; d < 3; ++d) a[d] = 0;
  return a;
}

/// Velocity, acceleration and how fast the outermost point turns, of one owned particle.
std::array<double, 8> Contact::motion_row(Index local) {
  Motion const& m = solid_.motion()[at(local)];
  Convex const& shape = list_.shape(local);
  Wrench const &in = solid_.internal()[at(local)], &load = solid_.load()[at(local)];
  Quaternion const back = conjugate(solid_.pose()[at(local)].q);
  Real const scale = shape.outer_radius / solid_.mesh().material(solid_.id(local)).density;
  auto const turning = [&](Vec3 const& spin) { return scale * norm(shape.inverse_inertia * rotate(back, spin)); };
  Real const up = m.turns > 0 && shape.largest_inverse > 0 ? turning(in.torque + load.torque) : 0;
  Vec3 const a = acceleration_of(local);
  return {m.v.x, m.v.y, m.v.z, turning(m.spin), a.x, a.y, a.z, up};
}

Real Contact::time_step() {
  Real const seen = sight();
  return min(seen, step_within(std::nullopt));
}

Real Contact::sight() {
  // Links may have broken since the forces were computed; a run that starts here would see it.
  if (solid_.damageable() && refresh()) measure();
  // Nothing may come near and pass before it is listed: at most half a reach a step.
  Real dt = unlimited;
  for (Index const l : list_.candidates()) {
    Motion const& m = solid_.motion()[at(l)];
    dt = min(dt, time_to_cover(0.5 * ContactList::reach(list_.shape(l)), norm(m.v), norm(acceleration_of(l))));
  }
  return dt;
}

Real Contact::sub_step(Real horizon) { return step_within(horizon); }

/// Without a horizon: a step that may end before they meet.
Real Contact::step_within(std::optional<Real> horizon) {
  Real dt = unlimited;
  auto const& actors = list_.actors();
  rows_.assign(width * actors.size(), 0);
  for (std::size_t k = 0; k < actors.size(); ++k) {
    if (actors[k].local < 0) continue;
    auto const row = motion_row(actors[k].local);
    std::copy(row.begin(), row.end(), rows_.begin() + static_cast<std::ptrdiff_t>(width * k));
  }
  list_.exchange_rows(rows_, width);
  // Of each actor: all contacts it has; and the stiffest that any near pair may become before the next look.
  std::vector<Frequency> present(actors.size()), expected(actors.size());
  for (std::size_t k = 0; k < overlaps_.size(); ++k) {
    ContactPair const& p = list_.pairs()[k];
    if (!list_.near(p)) continue;
    Overlap const& o = overlaps_[k];
    ContactActor const &a = actors[at(p.a)], &b = actors[at(p.b)];
    MotionRow const ma(&rows_[width * at(p.a)]), mb(&rows_[width * at(p.b)]);
    Real speed = norm(ma.v - mb.v) + ma.turning + mb.turning;
    Real const acceleration = norm(ma.a - mb.a) + ma.turning_up + mb.turning_up;

    // Both ends of a moving pair see twice its stiffness (|u - v|^2 <= 2 |u|^2 + 2 |v|^2), a wall stands still.
    Real const shared = a.held || b.held ? 1 : 2;
    Vec3 const shift = list_.pose(p.b).x - list_.pose(p.a).x;
    Vec3 const moment_b = cross(shift, o.common.area) - o.common.moment;
    Real const depth = 0.2 * min(a.shape->inner_radius, b.shape->inner_radius);
    Gap gap;
    Real area = min(a.shape->largest_face, b.shape->largest_face);
    if (!o.active) {
      gap = gap_along_normals(list_.placed(p.a), list_.placed(p.b), shift);
      area = flat_area(list_.placed(p.a), list_.placed(p.b), gap.normal, depth + max(0, -gap.width));
      gap.width = max(0, gap.width);
    } else if (Real const size = norm(o.common.area); size > 0) {
      area = flat_area(list_.placed(p.a), list_.placed(p.b), (1 / size) * o.common.area,
                       o.common.high - o.common.low + depth);
    }
    Frequency const flat_a = shared * flat_contact(o.law, a, square(area)),
                    flat_b = shared * flat_contact(o.law, b, square(area));
    if (!o.active) {
      Real const touch = time_to_cover(gap.width, speed, acceleration);
      if (horizon ? touch > *horizon : touch > config_.cfl * 2 / std::sqrt(max(flat_a.normal, flat_b.normal))) {
        if (!horizon) dt = min(dt, touch);  // a step that ends before they meet needs no regard for their stiffness
        continue;
      }
      // Sub-steps end anywhere: in the one in which they meet they are as fast as they can be by then.
      if (horizon) gap.width = 0, speed += acceleration * touch;
    }
    dt = min(dt, time_to_cover(gap.width + depth, speed, acceleration));
    expected[at(p.a)].at_least(flat_a);
    expected[at(p.b)].at_least(flat_b);
    if (!o.active) continue;
    present[at(p.a)] += shared * contact_now(o.law, o.common, a, list_.pose(p.a), o.common.moment, o.common.centroid);
    present[at(p.a)] += shared * barrier_now(o.barrier, a, list_.pose(p.a), o.barrier.slope_a);
    present[at(p.b)] += shared * barrier_now(o.barrier, b, list_.pose(p.b), o.barrier.slope_b);
    present[at(p.b)] += shared * contact_now(o.law, o.common, b, list_.pose(p.b), moment_b, o.common.centroid - shift);
  }
  for (std::size_t k = 0; k < actors.size(); ++k) {
    if (actors[k].local < 0) continue;
    Frequency f = present[k];
    f.at_least(expected[k]);
    if (f.all == 0) continue;
    Real const links = square(2 / solid_.link_limit_of(actors[k].local));
    dt = min(dt, min(config_.cfl * 2 / std::sqrt(f.normal), link_cfl_ * 2 / std::sqrt(f.all + links)));
  }
  return dt;
}

}  // namespace brisance::solid
