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

/// The pressure without the kink where contact begins or ends; V_{k-1} and V_{k+1} are extrapolated.
Real without_kink(Real pressure, Real volume, Closing const& c, Real dt, bool begins) {
  Real const last = volume - dt * c.rate, straight = volume + dt * (c.rate + dt * c.push),
             pull = dt * dt * c.compliance;
  if (!(pull > 0)) return pressure;
  if (begins && last < 0) {
    Real const half = 0.5 * (straight - last + pull * pressure), root = half * half - pull * pressure * straight;
    if (!(root > 0)) return pressure;
    Real const weighted = (half - std::sqrt(root)) / pull;
    return straight - pull * weighted > 0 ? weighted : pressure;
  }
  if (!begins && straight - pull * pressure < 0 && last > 0) {
    Real const half = 0.5 * (last - straight);
    return (std::sqrt(half * half + pull * pressure * last) - half) / pull;
  }
  return pressure;
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
  return {shear.x,
          shear.y,
          shear.z,
          shear_stiffness,
          twist,
          twist_stiffness,
          impact_speed,
          phase,
          force.x,
          force.y,
          force.z,
          torque_a.x,
          torque_a.y,
          torque_a.z,
          torque_b.x,
          torque_b.y,
          torque_b.z,
          axis.outward.x,
          axis.outward.y,
          axis.outward.z,
          axis.surface,
          axis.start,
          axis.of_b ? 1.0 : 0.0};
}

PairMemory PairMemory::unpack(double const* r) {
  return {{r[0], r[1], r[2]},
          r[3],
          r[4],
          r[5],
          r[6],
          r[7],
          {r[8], r[9], r[10]},
          {r[11], r[12], r[13]},
          {r[14], r[15], r[16]},
          {{r[17], r[18], r[19]}, r[20], r[21], r[22] != 0}};
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
  // The force of an edge or a corner sets in smoothly.
  Real const flat = std::clamp(3 - 2 * overlap.order, 0.0, 1.0);
  if (flat > 0) pressure += flat * (without_kink(pressure, overlap.volume, c, dt, before == nullptr) - pressure);

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
