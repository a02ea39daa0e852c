// The correction of one characteristic field and its monotonicity bounds: the heart of OSMP, for a wave of any system.
// Source: theory/fluid.md 2.1 (coefficients), 2.4 (semi-local form), 2.5 (bounds).
#pragma once
#include <array>

#include "fluid/flux/pack.hpp"

namespace brisance::fluid {

/// Widths of the stencil around a face: K = (order - 1)/2 faces either side carry the accuracy, two the bounds.
template <int Order>
struct Stencil {
  static_assert(Order == 1 || Order == 3 || Order == 5 || Order == 7 || Order == 9 || Order == 11);
  static constexpr int half = (Order - 1) / 2;
  static constexpr int reach = half < 2 ? 2 : half;
  static constexpr int ghosts = reach + 1;
  static constexpr int levels = half < 2 ? 1 : half;  ///< pairs of orders (2q, 2q+1), q = 1..half
};

/// What the fields of one wave speed share at a face. `room` belongs to the upwind face, all else to the face itself.
template <int Order, class V>
struct Wave {
  Mask<V> leftward;                                     ///< the wave runs towards lower indices
  V sign;                                               ///< any number with the sign of the wave speed
  V half_speed;                                         ///< modified speed / 2, m/s
  V second;                                             ///< half_speed (1 - nu)
  V room;                                               ///< (1 - nu_up) / (2 sigma)
  std::array<V, 2 * Stencil<Order>::levels + 2> ratio;  ///< kappa_o / kappa_{o-1}, o = 4..Order
};

/// Fills the ratios (nu - q)/2q and (nu + q)/(2q + 1).
template <int Order, class V>
BRISANCE_INLINE void set_ratios(Wave<Order, V>& wave, V nu) {
  BRISANCE_UNROLL for (int o = 4; o <= Order; ++o) {
    Real const q = o / 2;
    wave.ratio[static_cast<std::size_t>(o)] = fma(V(1.0 / o), nu, V((o % 2 ? q : -q) / o));
  }
}

/// Central difference of order 2q - 2 from the middle value and the sums x(z) + x(-z), z = 1..q-1.
template <class V>
BRISANCE_INLINE V even_difference(int q, V middle, V const* sum) {
  switch (q) {
    case 2:
      return fnma(V(2.0), middle, sum[1]);
    case 3:
      return fma(V(6.0), middle, fnma(V(4.0), sum[1], sum[2]));
    case 4:
      return fnma(V(20.0), middle, fma(V(15.0), sum[1], fnma(V(6.0), sum[2], sum[3])));
    default:
      return fma(V(70.0), middle, fnma(V(56.0), sum[1], fma(V(28.0), sum[2], fnma(V(8.0), sum[3], sum[4]))));
  }
}

/// Keeps every pair of orders: what a face of full order does.
struct AllOrders {
  template <class V>
  BRISANCE_INLINE V operator()(int, V sum) const {
    return sum;
  }
};

/// A field without the terms of `smooth` (smooth.hpp).
struct NoSmoothTerms {
  static constexpr bool present = false;
};

/// Orders 3 and up: sign-free part of G - second, from the window y(z) of third-order corrections p/2 seen from this
/// face, upwind side at negative z. Horner's rule over the pairs (2q, 2q+1): sum_q = E_q + r_{2q+1} (dE_q + r_{2q+2}
/// sum_{q+1}). `keep(q, sum)` gives 0 instead of the sum where a face stops below order 2q + 1. Source:
/// theory/fluid.md 2.4, step 3. `smooth.excess` is what its
/// fourth-order term has beyond nu/4 E_2.
template <int Order, class V, class Keep, class Smooth>
BRISANCE_INLINE V higher_orders(Wave<Order, V> const& wave, V const* y, Keep keep, Smooth const& smooth) {
  V result = y[-1] - y[0];
  if constexpr (Order >= 5) {
    constexpr int top = Stencil<Order>::half;
    V here[top + 1], upwind[top + 1], sum;
    BRISANCE_UNROLL for (int z = 1; z < top; ++z) {
      here[z] = y[z] + y[-z];
      upwind[z] = y[z - 1] + y[-z - 1];
    }
    BRISANCE_UNROLL for (int q = top; q >= 2; --q) {
      auto const o = static_cast<std::size_t>(2 * q);
      V const middle = even_difference(q, y[0], here), change = even_difference(q, y[-1], upwind) - middle;
      if (q == top)
        sum = fma(wave.ratio[o + 1], change, middle);
      else
        sum = fma(wave.ratio[o + 1], fma(wave.ratio[o + 2], sum, change), middle);
      sum = keep(q, sum);
    }
    result = fma(wave.ratio[4], sum, result);
    if constexpr (Smooth::present) {
      V const quarter_nu = wave.ratio[4] + V(0.5);
      result = result + smooth.excess(quarter_nu * even_difference(2, y[0], here), wave.sign);
    }
  }
  return result;
}

/// Dissipative part of one field, G - |a| jump / 2, with G inside its bounds. `jump(z)` and `third(z)` give the jump
/// and the third-order correction p/2 (sign of the wave included in neither) of the face z away, as seen from this
/// face. Source: theory/fluid.md 2.4, 2.5. The bounds are written about the middle of [0, AV] and [0, UL], so that min
/// and max of three values become one max of magnitudes; `smooth` widens them.
template <int Order, class V, class Jump, class Third, class Keep, class Smooth = NoSmoothTerms>
BRISANCE_INLINE V field_flux(Wave<Order, V> const& wave, V jump_here, Jump jump, Third third, Keep keep,
                             Smooth const& smooth = {}) {
  V const centre = wave.half_speed * jump_here;
  if constexpr (Order == 1) {
    return -centre;
  } else {
    constexpr int half = Stencil<Order>::half;
    V window[2 * half + 1];
    V* const y = window + half;
    y[0] = third(0);
    BRISANCE_UNROLL for (int z = 1; z <= half; ++z) {
      V const low = third(-z), high = third(z);
      y[-z] = select(wave.leftward, high, low);
      if (z < half) y[z] = select(wave.leftward, low, high);
    }
    V const correction = fma(wave.second, jump_here, flip(higher_orders<Order>(wave, y, keep, smooth), wave.sign));

    V const low = jump(-1), high = jump(1);
    V const up = select(wave.leftward, high, low), down = select(wave.leftward, low, high);
    V const up2 = select(wave.leftward, jump(2), jump(-2));
    V const middle = wave.half_speed * curvature(jump_here - up, down - jump_here);
    V const leaving = wave.room * up, large = wave.room * curvature(up - up2, jump_here - up);
    V const size = abs(centre), size_up = abs(leaving);
    V lowest = max(centre - max(size, middle), leaving - max(size_up, -large));
    V highest = min(centre + max(size, -middle), leaving + max(size_up, large));
    if constexpr (Smooth::present) lowest = lowest - smooth.widening, highest = highest + smooth.widening;
    return min(max(correction, lowest), highest) - centre;
  }
}

}  // namespace brisance::fluid
