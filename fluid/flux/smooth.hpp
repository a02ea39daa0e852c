// What `smooth` adds to a sweep where neither shock nor vacuum is near: room in the bounds for waves that drive each
// other, the third-order term of that driving, and the time part of the fourth-order term with the coefficients of
// every face. All vanish for constant coefficients, so nothing changes about linear stability. Derivation and
// measurements: fluid/README.md.
#pragma once
#include "fluid/flux/face.hpp"

namespace brisance::fluid {

/// What these terms read of a face, beside `Face` and `Jump`.
template <class V>
struct SmoothFace {
  V size;         ///< magnitudes of its waves added up, kg/m3; negative where the pressure jumps by more than 20 %
  V inv_density;  ///< m3/kg, of a mean of the two cells
  V fourth[5];    ///< Q/8, Q = 1/3 sum of a nu (1 - nu^2) strength r over the waves; orders >= 5
};

/// From a finished face; also beside vacuum, where strengths are 0 and any gas differs by more than 20 % in pressure.
template <int Order, class V, class Curve>
BRISANCE_INLINE void form_smooth_face(Cell<V, Curve> const& l, Cell<V, Curve> const& r, Face<V, Curve> const& f,
                                      SmoothFace<V>& s, SweepConstants<V, Curve> const& k) {
  V const* const a = f.strength;
  V const pressures = abs(a[0]) + abs(a[4]), shears = abs(a[2]) + abs(a[3]);
  V jump, scale;
  if constexpr (Curve::curved)
    jump = r.curve.pressure - l.curve.pressure, scale = min(l.curve.scale, r.curve.scale);
  else
    jump = r.energy - l.energy, scale = min(l.energy, r.energy);
  s.size = select(abs(jump) > V(0.2) * scale, V(-1.0), fma(f.inv_sound, shears, pressures + abs(a[1])));
  V const inverse = V(2.0) / (l.root + r.root);
  s.inv_density = inverse * inverse;
  if constexpr (Order >= 5) {
    V const one(1.0), share(1.0 / 24), speed0 = abs(f.u);
    V const nu1 = min(k.sigma * f.speed1, one), nu0 = min(k.sigma * speed0, one), nu5 = min(k.sigma * f.speed5, one);
    V const factor0 = share * speed0 * nu0 * fnma(nu0, nu0, one);
    V const h[5] = {share * f.speed1 * nu1 * fnma(nu1, nu1, one) * a[0], factor0 * a[1], factor0 * a[2], factor0 * a[3],
                    share * f.speed5 * nu5 * fnma(nu5, nu5, one) * a[4]};
    V q_entropy = V(0.5) * fma(f.u, f.u, fma(f.v, f.v, f.w * f.w));
    if constexpr (Curve::curved) q_entropy = q_entropy - f.bend;
    assemble(h, f, q_entropy, s.fourth);
  }
}

/// The terms of one field; lanes that are `frozen` (the acoustic waves of `hybrid`) keep their fourth-order term.
template <bool Mixed, class V>
struct SmoothField {
  static constexpr bool present = true;
  V fourth, widening;
  Mask<V> frozen;
  BRISANCE_INLINE V excess(V usual, V sign) const {
    V const more = flip(fourth, sign) - usual;
    if constexpr (Mixed) return select(frozen, V(0.0), more);
    return more;
  }
};

/// The terms of all fields of a face, seen in its frame.
template <int Order, class V>
struct SmoothWindow {
  V curvature[5];  ///< second difference of Q/8
  Acoustic<V> acoustic;
  V slack;  ///< kg/m3: strength that others may lend to a wave, as a share of second order
  V signal;

  /// `least`: smallest size of the five faces around.
  template <class Curve>
  BRISANCE_INLINE SmoothWindow(V least, SmoothFace<V> const& low, SmoothFace<V> const& here, SmoothFace<V> const& high,
                               Face<V, Curve> const& f, Frame<V> const& frame) {
    V const size = max(least, V(0.0));
    slack = V(0.2) * size * size * here.inv_density;
    signal = abs(f.u) + f.sound;
    if constexpr (Order >= 5) {
      BRISANCE_UNROLL for (int n = 0; n < 5; ++n) curvature[n] =
          fnma(V(2.0), here.fourth[n], low.fourth[n] + high.fourth[n]);
      acoustic = project(curvature, frame);
    }
  }
  /// The bounds of a wave at rest, to rounding of its speed, stay as they are: no mass passes a wall.
  template <bool Mixed, class Component>
  BRISANCE_INLINE SmoothField<Mixed, V> field(Wave<Order, V> const& wave, Component const& component,
                                              Mask<V> frozen) const {
    V const widening = select(wave.half_speed > V(1e-10) * signal, slack * signal, V(0.0));
    if constexpr (Order >= 5) return {component(acoustic, curvature), widening, frozen};
    return {V(0.0), widening, frozen};
  }
};
struct NoSmoothWindow {
  template <bool Mixed, class Wave, class Component, class Mask>
  BRISANCE_INLINE NoSmoothTerms field(Wave const&, Component const&, Mask const&) const {
    return {};
  }
};

/// Adds dt^2/6 [F''(F_x, F_x) - F''(U_x, A F_x)], by which F_tt differs from (A^3 U_x)_x when several families meet, in
/// lanes where `least` is not negative. No mass, and nothing for a wave alone. Exact for ideal and stiffened gas; of
/// other curves it lacks the term of f''.
template <class V, class Curve>
BRISANCE_INLINE void add_coupling(Face<V, Curve> const& f, SmoothFace<V> const& s, V least, V q,
                                  SweepConstants<V, Curve> const& k, V* x) {
  V const *const a = f.strength, c = f.sound;
  V const sigma2 = V(1.0 / 6) * k.sigma * k.sigma;
  V const scale = select(least >= V(0.0), sigma2 * s.inv_density * (c * c * c), V(0.0));
  V const drift = scale * (a[4] - a[0]);
  V const pressure = fnma(V(4.0), k.kappa, V(8.0)) * (scale * c) * (a[0] * a[4]);
  V const shears = fma(f.v, a[2], f.w * a[3]);
  x[1] = x[1] + pressure;
  x[2] = fnma(drift, a[2], x[2]);
  x[3] = fnma(drift, a[3], x[3]);
  // H - q = c^2 / Gamma
  x[4] = x[4] + fma(f.u, pressure, drift * fms(f.enthalpy - q, a[1], shears));
}

}  // namespace brisance::fluid
