// What stops a thin body that is hit edge or corner first, where the energy of the overlap runs out.
#pragma once
#include "core/solid/contact/intersection.hpp"

namespace brisance::solid {

/// Which way out of an overlap is, and where depth is counted from. Chosen anew from the overlap itself while that is
/// shallow, and kept while it is deep: past the middle of a thin body the overlap alone points out on the far side.
struct DepthAxis {
  Vec3 outward{};    ///< unit, in the frame of the body it is fixed to; 0: none yet
  Real surface = 0;  ///< outward . y of that body's surface there, y from its centre, m
  Real start = 0;    ///< depth below which the barrier does nothing, m
  bool of_b = false;
  explicit operator bool() const { return norm2(outward) > 0; }
};

/// E = w(V) K x^3 / (3 h): x the mean depth of the overlap beyond `start`, w = V / (V + `sliver`) so that an overlap
/// that slips off sideways lets go smoothly. With K the stiffness of the thinner body across its thickness, h a quarter
/// of that: a plate is stopped at 0.2 c0 within half its thickness, whatever part of it touches first.
struct BarrierLaw {
  Real thickness = 0;  ///< of the thinner body, m
  Real stiffness = 0;  ///< K, N/m
  Real sliver = 0;     ///< m3
};

/// Of one overlap. The slopes of its depth are those of `BarrierForce`'s direction: by a shift and turns of the ends.
struct Barrier {
  Real energy = 0;                       ///< J
  Real stiffness = 0;                    ///< its slope by the depth until the next look, N/m; 0: not engaged
  Vec3 slope{}, slope_a{}, slope_b{};    ///< of the depth: by a shift of A (of B: opposite), by turns of A and B
  Vec3 force{}, torque_a{}, torque_b{};  ///< on A; about the centres; N, N m
};

/// The axis for this step. `before`: that of the last, none when the pair overlaps for the first time; an overlap that
/// is deep when first seen has its barrier start at that depth.
DepthAxis choose_axis(DepthAxis const& before, BarrierLaw const& law, Intersection const& overlap,
                      PlacedConvex const& a, PlacedConvex const& b, Quaternion const& qa, Quaternion const& qb,
                      Vec3 const& shift);

/// Energy and forces, the exact gradient. `clipper` has just found `overlap`.
Barrier find_barrier(DepthAxis const& axis, BarrierLaw const& law, Intersection const& overlap, Clipper const& clipper,
                     Quaternion const& qa, Quaternion const& qb, Vec3 const& shift);

}  // namespace brisance::solid
