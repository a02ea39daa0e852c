// Keeping states of a mixture admissible: density, both partial masses, both volume fractions and the internal energy
// above the cold curves. All six are concave in the seven unknowns. Source: theory/fluid.md 1.4, 4.2.
#pragma once
#include "fluid/flux/mixture_face.hpp"

namespace brisance::fluid {

/// How a face changes one of its cells beyond the low-order flux: the conserved six and alpha, signs of the side left
/// out.
template <class V>
struct MixtureDifference {
  V flux[6];
  V left, right;  ///< of alpha: what leaves the left cell, what enters the right cell negatively
};

/// Lanes where one side stays inside its bounds after twice its part of the difference; false for NaN. `twice_sigma`
/// carries the sign of the side: minus for the left cell, plus for the right one; `fraction` is the part of alpha.
template <class V>
BRISANCE_INLINE Mask<V> stays_admissible(MixtureFace<V> const& side, MixtureDifference<V> const& d, V fraction,
                                         V twice_sigma, MixtureConstants<V> const& k) {
  V const zero(0.0), one(1.0), kept(kept_share), slack(fraction_slack);
  V const* const low = side.low_state;
  V z[7];
  BRISANCE_UNROLL for (int n = 0; n < 6; ++n) z[n] = fma(twice_sigma, d.flux[n], low[n]);
  z[6] = fma(twice_sigma, fraction, low[6]);
  V const trace = fma(slack, low[0], fnma(kept, low[5], z[5]));
  V const rest = fma(slack, low[0], fnma(kept, low[0] - low[5], z[0] - z[5]));
  V const share = fnma(kept, low[6], z[6]) + slack, empty = fnma(kept, one - low[6], one - z[6]) + slack;
  return (fnma(kept, low[0], z[0]) >= zero) & (trace >= zero) & (rest >= zero) & (share >= zero) & (empty >= zero) &
         (thermal_energy(z, k) >= side.energy_floor);
}

/// Largest share in [0, 1] of the difference that leaves a low-order state inside its bounds; `change` is the whole of
/// it, sign of the side included.
Real limited_share(MixtureState const& low, MixtureState const& change, Mixture const& mixture);

/// Health bits of one new state, as `judge` of one gas. Source: theory/fluid.md 4.4.
std::uint64_t judge(MixtureState const& x, Mixture const& mixture);

/// Scales the difference in the lanes named by `asked`; returns the lanes that kept less than all of it.
template <class V>
[[gnu::noinline, gnu::cold]] std::uint32_t limit_face(MixtureDifference<V>& d, MixtureFace<V> const& left,
                                                      MixtureFace<V> const& right, Real twice_sigma,
                                                      Mixture const& mixture, std::uint32_t asked) {
  constexpr int lanes = lanes_of<V>;
  Real part[8][lanes], low[2][7][lanes];
  for (int n = 0; n < 6; ++n) store(part[n], d.flux[n]);
  store(part[6], d.left), store(part[7], d.right);
  for (int n = 0; n < 7; ++n) store(low[0][n], left.low_state[n]), store(low[1][n], right.low_state[n]);
  std::uint32_t limited = 0;
  for (int lane = 0; lane < lanes; ++lane) {
    if (!(asked >> lane & 1)) continue;
    bool flat = true;
    for (auto const& x : part) flat = flat && x[lane] == 0;
    if (flat) continue;  // vacuum faces: their flux is the low-order one
    Real share = 1;
    for (int side = 0; side < 2; ++side) {
      MixtureState state, change;
      Real const step = side == 0 ? -twice_sigma : twice_sigma;
      for (std::size_t n = 0; n < 7; ++n) state[n] = low[side][n][lane];
      for (std::size_t n = 0; n < 6; ++n) change[n] = share * step * part[n][lane];
      change[6] = share * step * (side == 0 ? part[6][lane] : -part[7][lane]);
      share *= limited_share(state, change, mixture);
    }
    if (share >= 1) continue;
    limited |= 1u << lane;
    for (auto& x : part) x[lane] = share == 0 ? 0 : x[lane] * share;
  }
  for (int n = 0; n < 6; ++n) d.flux[n] = load<V>(part[n]);
  d.left = load<V>(part[6]), d.right = load<V>(part[7]);
  return limited;
}

}  // namespace brisance::fluid
