// Keeping states admissible: the cheap test of a face, and the rare path that finds the share of a flux a face may
// keep. Source: theory/fluid.md 4.2 (blending), 4.4 (bands of finite precision).
#pragma once
#include <cstdint>

#include "fluid/flux/face.hpp"

namespace brisance::fluid {

/// Density and density * energy a side may be left with, as shares of its low-order state: 1 % of each, of the product
/// 1e-4.
inline constexpr Real kept_share = 1e-2;

/// Smallest margin of one side after twice its part of the flux difference; negative (or NaN) asks for `limit_face`.
/// `twice_sigma` carries the sign of the side: minus for the left cell, plus for the right one.
template <class V, class Curve>
BRISANCE_INLINE V positivity_margin(V const* low_state, V energy_floor, V const* difference, V twice_sigma,
                                    SweepConstants<V, Curve> const& k) {
  V z[5];
  BRISANCE_UNROLL for (int n = 0; n < 5; ++n) z[n] = fma(twice_sigma, difference[n], low_state[n]);
  // the order matters: min gives its second argument when one is NaN, and the energy is NaN whenever a component is
  return min(fnma(V(kept_share), low_state[0], z[0]), density_energy(z, k) - energy_floor);
}

/// Largest share in [0, 1] of `difference` that leaves both low-order states above their floors: one secant for
/// density, two for internal energy, which is concave, so that a secant never overshoots.
Real limited_share(State const& left, State const& right, State const& difference, Real twice_sigma, Gas const& gas);

/// Scales `difference` in the lanes named by `asked`; returns the lanes that kept less than all of it.
template <class V>
[[gnu::noinline, gnu::cold]] std::uint32_t limit_face(V* difference, V const* left, V const* right, Gas const& gas,
                                                      V sigma, std::uint32_t asked) {
  constexpr int lanes = lanes_of<V>;
  Real d[5][lanes], low[2][5][lanes];
  for (int k = 0; k < 5; ++k) {
    store(d[k], difference[k]);
    store(low[0][k], left[k]);
    store(low[1][k], right[k]);
  }
  Real sigmas[lanes];
  store(sigmas, sigma);
  std::uint32_t limited = 0;
  for (int lane = 0; lane < lanes; ++lane) {
    if (!(asked >> lane & 1)) continue;
    State one[3];
    bool flat = true;
    for (std::size_t k = 0; k < 5; ++k) {
      one[0][k] = low[0][k][lane], one[1][k] = low[1][k][lane], one[2][k] = d[k][lane];
      flat = flat && one[2][k] == 0;
    }
    if (flat) continue;  // vacuum faces: their flux is the low-order one
    Real const share = limited_share(one[0], one[1], one[2], 2 * sigmas[lane], gas);
    if (share >= 1) continue;
    limited |= 1u << lane;
    for (int k = 0; k < 5; ++k) d[k][lane] *= share;
  }
  for (int k = 0; k < 5; ++k) difference[k] = load<V>(d[k]);
  return limited;
}

/// Lanes whose new state may be outside the bands: a cheap test, `judge` decides.
template <class V, class Curve>
BRISANCE_INLINE Mask<V> suspect(V const* x, SweepConstants<V, Curve> const& k) {
  V energy = x[4] * V(1 + 1e-13);
  if constexpr (Curve::curved) energy = energy - curve_at(x[0], k.curve, k.vacuum_density).energy;
  V const margin = fnma(V(0.5), fma(x[1], x[1], fma(x[2], x[2], x[3] * x[3])), x[0] * energy);
  return !((min(x[0], margin) >= V(0.0)) & (margin < V(1e300)));
}
/// Health bits of one new state. Source: theory/fluid.md 4.4: density >= -1e-13 reference density, internal energy
/// >= -1e-13 |E|.
std::uint64_t judge(State const& u, Gas const& gas);

}  // namespace brisance::fluid
