#include "core/solid/contact/barrier.hpp"

#include <cmath>

namespace brisance::solid {
namespace {

/// The barrier starts at this share of the thickness: flat contacts are half of it deep then.
constexpr Real start_share = 0.25;

/// An axis as it lies in space.
struct Placed {
  Vec3 outward;  ///< unit
  Vec3 centre;   ///< of its body, from that of A
};

Placed placed(DepthAxis const& axis, Quaternion const& qa, Quaternion const& qb, Vec3 const& shift) {
  return {rotate(axis.of_b ? qb : qa, axis.outward), axis.of_b ? shift : Vec3{}};
}

Real depth_along(DepthAxis const& axis, Placed const& at, Vec3 const& point) {
  return axis.surface - dot(at.outward, point - at.centre);
}

Real extent(PlacedConvex const& body, Vec3 const& n) {
  Real low = 1e300, high = -1e300;
  for (Vec3 const& v : body.corners) {
    Real const h = dot(n, v);
    low = min(low, h), high = max(high, h);
  }
  return high - low;
}

}  // namespace

DepthAxis choose_axis(DepthAxis const& before, BarrierLaw const& law, Intersection const& overlap,
                      PlacedConvex const& a, PlacedConvex const& b, Quaternion const& qa, Quaternion const& qb,
                      Vec3 const& shift) {
  Real const start = start_share * law.thickness;
  if (before && depth_along(before, placed(before, qa, qb, shift), overlap.centroid) > before.start) return before;
  Real const area = norm(overlap.area);
  if (!(area * law.thickness > 1e-3 * overlap.volume)) return before;  // one inside the other: no direction
  Vec3 const n = (1 / area) * overlap.area;                            // from A to B
  // Counted from the body that is longer along it, depth grows until that body is all through the other.
  DepthAxis axis;
  axis.of_b = extent(b, n) > extent(a, n);
  axis.outward = axis.of_b ? rotate(conjugate(qb), -n) : rotate(conjugate(qa), n);
  axis.surface = axis.of_b ? dot(n, shift) - overlap.low : overlap.high;
  Real const depth = depth_along(axis, placed(axis, qa, qb, shift), overlap.centroid);
  if (before && depth > start) return before;
  axis.start = max(start, depth);
  return axis;
}

Barrier find_barrier(DepthAxis const& axis, BarrierLaw const& law, Intersection const& overlap, Clipper const& clipper,
                     Quaternion const& qa, Quaternion const& qb, Vec3 const& shift) {
  Barrier barrier;
  if (!axis || !(overlap.volume > 0)) return barrier;
  Placed const at = placed(axis, qa, qb, shift);
  Real const depth = depth_along(axis, at, overlap.centroid), x = depth - axis.start;
  if (x <= 0) return barrier;
  // The depth field goes with its body; the surface of the other, where it bounds the overlap, moves through it.
  SurfaceMoments const of_other = clipper.moments(axis.of_b, at.outward, overlap.centroid);
  Vec3 const by_shift = (1 / overlap.volume) * of_other.force;  // of the other
  Vec3 const about_a = (1 / overlap.volume) * of_other.moment;
  barrier.slope = axis.of_b ? by_shift : -by_shift;
  if (axis.of_b) {
    barrier.slope_a = about_a;
    barrier.slope_b = cross(shift, barrier.slope) - barrier.slope_a;
  } else {
    barrier.slope_b = about_a - cross(shift, by_shift);
    barrier.slope_a = cross(shift, barrier.slope) - barrier.slope_b;
  }
  Real const soft = start_share * law.thickness, k = law.stiffness / soft;
  Real const whole = k * x * x * x / 3, push = k * x * x;
  Real const share = overlap.volume / (overlap.volume + law.sliver),
             by_volume = law.sliver / square(overlap.volume + law.sliver);
  barrier.energy = share * whole;
  Real const ahead = x + 0.1 * law.thickness;  // no more than that is covered in a step
  barrier.stiffness = 2 * k * ahead * (share + by_volume * norm(overlap.area) * ahead);
  Vec3 const moment_b = cross(shift, overlap.area) - overlap.moment;
  barrier.force = -share * push * barrier.slope - by_volume * whole * overlap.area;
  barrier.torque_a = -share * push * barrier.slope_a - by_volume * whole * overlap.moment;
  barrier.torque_b = -share * push * barrier.slope_b - by_volume * whole * moment_b;
  return barrier;
}

}  // namespace brisance::solid
