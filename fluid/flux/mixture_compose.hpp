// From the characteristic parts of a face to its flux: which substance the waves carry, and how much of it the cells
// can give. Source: theory/fluid.md 1.4; Larrouturou 1991, J. Comput. Phys. 95, 59.
#pragma once
#include "fluid/flux/mixture_positivity.hpp"

namespace brisance::fluid {

/// Share of a cell's content that may leave through the face with this outward velocity, beside the face on its far
/// side.
template <class V>
BRISANCE_INLINE V outflow_share(V outward, V outward_beyond) {
  V const zero(0.0), out = max(outward, zero) + V(1e-30);
  return out / (out + max(outward_beyond, zero));
}

/// Largest share in [0, 1] of `gain` with which the flux `base` takes at most `left` from the left cell and `right`
/// from the right one.
template <class V>
BRISANCE_INLINE V affordable(V base, V gain, V left, V right) {
  V const zero(0.0), one(1.0), upper = left - base, lower = -right - base;
  Mask<V> const over = (gain > upper) & (gain > zero), under = (gain < lower) & (gain < zero);
  Mask<V> const limited = over | under;
  V const share = select(over, upper, lower) / select(limited, gain, one);
  return select(limited, min(max(share, zero), one), one);
}

/// The difference from the low-order flux. What the acoustic waves carry is composed like the cell the flow comes from:
/// a trace that falls by decades from cell to cell would else be drained or flooded by its neighbour's, and the guard
/// against that (limit_face) would cost the waves their order. The corrections of the contact family share one factor,
/// which keeps what a cell can give, and the pressure across a contact. `parts`: acoustic left, alpha, products, rest,
/// two shears, acoustic right; `low_u`: velocity of the face before; `next`: the face behind.
template <class V>
BRISANCE_INLINE void compose(MixtureFace<V> const& f, V* part, V low_u, MixtureFace<V> const& next,
                             MixtureConstants<V> const& k, MixtureDifference<V>& d) {
  V const speed0 = V(0.5) * abs(f.u), both = part[0] + part[6], apart = f.sound * (part[6] - part[0]);
  V correction[3];  // G of theory/fluid.md 2.4
  BRISANCE_UNROLL for (int n = 0; n < 3; ++n) correction[n] = fma(speed0, f.strength[1 + n], part[1 + n]);
  V const trace_gain = fma(f.density1, correction[0], correction[1]);
  V const rest_gain = fnma(f.density2, correction[0], correction[2]);
  V const mean_mass = f.low_flux[0] + f.above_low[0], mean_trace = f.low_flux[5] + f.above_low[5];
  V const contact = fma(f.density1 - f.density2, f.strength[1], f.strength[2] + f.strength[3]);
  V const carried = fnma(speed0, contact, both), upwind_mass = mean_mass + carried;
  V const trace = f.upwind_share * upwind_mass, rest = upwind_mass - trace;

  V const from_left = outflow_share(f.u, -low_u) * k.inv_sigma, from_right = outflow_share(-f.u, next.u) * k.inv_sigma;
  V const kept = min(affordable(trace, trace_gain, from_left * f.trace, from_right * next.trace),
                     affordable(rest, rest_gain, from_left * f.rest, from_right * next.rest));
  BRISANCE_UNROLL for (int n = 0; n < 3; ++n) part[1 + n] = fnma(speed0, f.strength[1 + n], kept * correction[n]);

  V const products = fma(kept, trace_gain, trace), mass = fma(kept, trace_gain + rest_gain, carried);
  // products beyond what the eigenvectors carry bring the energy of their cold curve
  V const linear = mean_trace + fma(f.density1, part[1], fma(f.share, both, part[2]));
  V const cold = f.slope * (part[2] + (products - linear));
  d.flux[0] = f.above_low[0] + mass;
  d.flux[1] = f.above_low[1] + fma(f.u, mass, apart);
  d.flux[2] = f.above_low[2] + fma(f.v, mass, part[4]);
  d.flux[3] = f.above_low[3] + fma(f.w, mass, part[5]);
  V const shears = fma(f.v, part[4], f.w * part[5]), slow = fma(f.q, mass - both, fms(f.contact, part[1], cold));
  d.flux[4] = f.above_low[4] + fma(f.enthalpy, both, fma(f.u, apart, slow + shears));
  d.flux[5] = f.full * (products - f.low_flux[5]);
  d.left = f.above_left + part[1];
  d.right = f.above_right - part[1];
}

/// Part of the volume fraction inside the narrower bounds that make it a mean of neighbours (theory/fluid.md 2.5, TVD):
/// no other test has to keep it in [0, 1]. `leaving`: (1 - nu)/sigma times the jump of the upwind face.
template <class V>
BRISANCE_INLINE V monotone_fraction(MixtureFace<V> const& f, V part, V leaving) {
  V const zero(0.0), centre = V(0.5) * abs(f.u) * f.strength[1], whole = centre + centre;
  V const lowest = max(min(whole, zero), min(leaving, zero)), highest = min(max(whole, zero), max(leaving, zero));
  return min(max(part + centre, lowest), highest) - centre;
}

}  // namespace brisance::fluid
