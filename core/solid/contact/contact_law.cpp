#include "core/solid/contact/contact_law.hpp"

#include <algorithm>
#include <numbers>

namespace brisance::solid {
namespace {

/// Rate of the overlap and how it changes: V'' = push - compliance p, p the plain pressure of this pair.
struct Closing {
  Real rate = 0, push = 0, compliance = 0;
};

Closing closing(Intersection const& o, Vec3 const& shift, PairEnd const& a, PairEnd const& b, Real pressure) {
  Vec3 const moment_b = cross(shift, o.area) - o.moment;
  auto const along = [&](Vec3 const& va, Vec3 const& wa, Vec3 const& vb, Vec3 const& wb) {
    return dot(o.area, va - vb) + dot(o.moment, wa) + dot(moment_b, wb);
  };
  return {along(a.v, a.omega, b.v, b.omega), along(a.free_a, a.free_turn, b.free_a, b.free_turn),
          -along(a.contact_a, a.contact_turn, b.contact_a, b.contact_turn) / pressure};
}

/// The volume where the linear motion leads to `linear`. Going in, it grows as depth^order; coming out, it is that of a
/// layer whose thickness goes linearly from `thin` to `thick` (order 2: a wedge), and of higher order a corner.
Real moved_volume(Real volume, Real linear, Real order) {
  Real const thick = 1 + (linear - volume) / (order * volume);  // what is left of the largest thickness, over it
  if (thick <= 0) return 0;
  if (thick > 1 || order >= 2) return volume * std::pow(thick, order);
  Real const thin = 2 / order - 1;
  return 1 - thick <= thin ? linear : volume * order * square(thick) / (2 * (1 - thin));
}

/// The pressure without the kink where contact begins or ends. Over the two half steps around it, it does the work
/// P (V_{k+1} - V_{k-1}) / 2 of the true volumes, 0 outside, where the linear motion would have others. `before`:
/// V_{k-1}. Where contact goes on the two hardly differ, and at the turning point both vanish.
Real without_kink(Real pressure, Intersection const& o, Closing const& c, Real dt, Real before) {
  Real const volume = o.volume, order = std::clamp(o.order, 1.0, 3.0);
  Real const last = volume - dt * c.rate, straight = volume + dt * (c.rate + dt * c.push),
             pull = dt * dt * c.compliance;
  if (!(pull > 0)) return pressure;
  auto const after = [&](Real p) { return moved_volume(volume, straight - pull * p, order); };
  Real const left = after(pressure);
  bool const begins = before == 0, ends = before > volume && (left == 0 || (order < 2 && left < 0.5 * volume));
  if (begins == ends) return pressure;
  Real const sign = begins ? 1 : -1;
  auto const excess = [&](Real p) {
    return sign * (p * (straight - pull * p - last) - pressure * (after(p) - before));
  };
  Real low = 0, high = 2 * pressure;
  if (begins) high = min(high, (straight - last) / pull);
  if (!(excess(low) < 0 && excess(high) > 0)) return pressure;
  for (int n = 0; n < 60; ++n) {
    Real const middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return low;
}

Real cap(Real value, Real limit) { return std::clamp(value, -limit, limit); }

Vec3 capped(Vec3 const& v, Real limit) {
  Real const size = norm(v);
  return size > limit ? (limit / size) * v : v;
}

/// A spring whose stiffness changes keeps its force when it stiffens and its stretch when it softens: it never gains
/// energy.
Real carried(Real stiffness_before, Real stiffness) {
  return stiffness < stiffness_before ? stiffness / stiffness_before : 1;
}

}  // namespace

Real PairLaw::energy(Real volume) const {
  Real const low = min(volume, knee);
  Real energy = 0.5 * stiffness * low * low;
  if (volume > knee) energy += stiffness * (volume * volume * volume - knee * knee * knee) / (3 * knee);
  return energy;
}

Real damping_for(Real restitution) {
  if (restitution >= 1) return 0;
  auto const open = [&](Real c) { return std::log((1 + c) / (1 - c * restitution)) - c * (1 + restitution); };
  Real low = 0, high = 1 / restitution;
  for (int n = 0; n < 200; ++n) {
    Real const middle = 0.5 * (low + high);
    (open(middle) < 0 ? low : high) = middle;
  }
  return low;
}

std::array<double, PairMemory::size> PairMemory::pack() const {
  std::array<double, size> row{};
  std::size_t to = 0;
  for (Vec3 const& v : {shear, force, torque_a, torque_b, axis.outward})
    for (int d = 0; d < 3; ++d) row[to++] = v[d];
  for (Real const value : {shear_stiffness, twist, twist_stiffness, impact_speed, phase, volume, axis.surface,
                           axis.start, axis.of_b ? 1.0 : 0.0})
    row[to++] = value;
  return row;
}

PairMemory PairMemory::unpack(double const* row) {
  PairMemory m;
  for (Vec3* v : {&m.shear, &m.force, &m.torque_a, &m.torque_b, &m.axis.outward})
    for (int d = 0; d < 3; ++d) (*v)[d] = *row++;
  for (Real* value : {&m.shear_stiffness, &m.twist, &m.twist_stiffness, &m.impact_speed, &m.phase, &m.volume,
                      &m.axis.surface, &m.axis.start})
    *value = *row++;
  m.axis.of_b = *row != 0;
  return m;
}

Real PairMemory::stored() const {
  Real energy = 0;
  if (shear_stiffness > 0) energy += norm2(shear) / (2 * shear_stiffness);
  if (twist_stiffness > 0) energy += twist * twist / (2 * twist_stiffness);
  return energy;
}

PairForce contact_force(PairLaw const& law, Intersection const& overlap, Vec3 const& shift, PairEnd const& a,
                        PairEnd const& b, Real dt, PairMemory const* before) {
  PairForce f;
  Real const area = norm(overlap.area);
  f.energy = law.energy(overlap.volume);
  if (area == 0) return f;  // one inside the other: no way out is nearer than another
  Vec3 const n = overlap.area / area;
  Real const slope = law.slope(overlap.volume);
  PairMemory& now = f.memory;

  Real pressure = law.pressure(overlap.volume);
  Closing const c = closing(overlap, shift, a, b, pressure);
  pressure = without_kink(pressure, overlap, c, dt, before ? before->volume : 0);
  now.volume = overlap.volume;

  Real damped = pressure, dashpot = 0;  // dashpot: N s/m, of the normal force
  if (law.damping > 0) {
    Real const u = c.rate / area, frequency = std::sqrt(slope * (a.compliance + b.compliance));
    now.impact_speed = before ? before->impact_speed : 0;
    now.phase = before ? before->phase : 0;
    if (now.phase == 0 && u < 0) now.phase = 1;
    if (now.phase == 1 && u > 0) now.phase = 2;
    // A contact that lasts forgets its impact, so that small motions die out as large ones do; damping that is more
    // than critical would hold bodies apart.
    if (now.phase == 2) now.impact_speed *= std::exp(-dt * frequency / std::numbers::pi);
    now.impact_speed = max(now.impact_speed, u);
    Real const scale = max(now.impact_speed, 0.5 * law.damping * frequency * overlap.volume / area);
    if (scale > 0) {
      damped = pressure * max(0, 1 + law.damping * u / scale);
      dashpot = pressure * area * law.damping / scale;
    }
  }

  Vec3 shear{};
  Real twist = 0;
  if (law.friction > 0) {
    Vec3 const arm_a = overlap.centroid, arm_b = overlap.centroid - shift;
    Vec3 slip = a.v + cross(a.omega, arm_a) - b.v - cross(b.omega, arm_b);
    slip -= dot(slip, n) * n;
    now.shear_stiffness = law.shear_ratio * slope * area * area;
    now.twist_stiffness = now.shear_stiffness * area / (2 * std::numbers::pi);  // of a disk of this area
    if (before) {
      shear = carried(before->shear_stiffness, now.shear_stiffness) * rotate(a.q, before->shear);
      shear -= dot(shear, n) * n;
      now.twist = carried(before->twist_stiffness, now.twist_stiffness) * before->twist;
    }
    Real const most = law.friction * damped * area, arm2 = area / (2 * std::numbers::pi);
    Real const most_twist = most * (2.0 / 3) * std::sqrt(2 * arm2), spin = dot(n, a.omega - b.omega);
    shear = capped(shear - (now.shear_stiffness * dt) * slip, most);
    now.twist = cap(now.twist - now.twist_stiffness * dt * spin, most_twist);
    now.shear = rotate(conjugate(a.q), shear);
    // The springs are damped as the pressure is: what sticks would ring for ever, and creep.
    shear = capped(shear - (law.shear_ratio * dashpot) * slip, most);
    twist = cap(now.twist - law.shear_ratio * dashpot * arm2 * spin, most_twist);
    f.energy += now.stored();
  }

  now.force = (pressure - damped) * overlap.area + shear;
  now.torque_a = (pressure - damped) * overlap.moment + cross(overlap.centroid, shear) + twist * n;
  now.torque_b = cross(shift, now.force) - now.torque_a;
  f.force = now.force - pressure * overlap.area;
  f.torque_a = now.torque_a - pressure * overlap.moment;
  f.torque_b = cross(shift, f.force) - f.torque_a;
  return f;
}

}  // namespace brisance::solid
