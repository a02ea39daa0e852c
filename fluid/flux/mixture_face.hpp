// What the sweep of a mixture computes once per face: an exact Roe linearisation, the jumps in primitive form, the
// low-order flux. Source: theory/fluid.md 1.4, 2.3, 2.4, 4.1.
//
// Jumps are kept as (dp, du, dv, dw, dalpha, k1, k2) with k_i = d(alpha_i rho_i) - rho_i dalpha_i: what is left of a
// partial mass after the volume fraction is taken out. Projected on another face these stay what they are. The jump of
// a conserved vector does not: where products are absent a face has no rho_1 to project with, and sees pressure in a
// contact. The densities are means weighted by volume fraction, sum of masses over sum of fractions:
// a trace of products with a meaningless density weighs nothing, and d(alpha g) = [g] k1 + g dalpha stays exact.
#pragma once
#include "fluid/flux/mixture_cell.hpp"
#include "fluid/flux/positivity.hpp"

namespace brisance::fluid {

/// Jumps of a face in primitive form, and its third-order corrections P/2 (theory/fluid.md 2.4, step 1) likewise.
template <class V>
struct MixtureJump {
  V jump[7], third[7];
  V steep;  ///< > 0: products are compressed here, and the pressures differ by more than 20 %
};

/// A face and the low-order state of the cell on its left.
template <class V>
struct MixtureFace {
  V strength[7];  ///< own: acoustic left, alpha, products, rest, two shears, acoustic right
  V u, v, w, q, enthalpy, sound, density, share;
  V density1, density2;  ///< phase densities that travel with the volume fraction
  V slope, contact;      ///< energy carried by k1 and by alpha, beside their kinetic energy
  V speed1, speed5;      ///< acoustic speeds with the entropy cure, >= 0
  V room1, room0, room5;
  V room_fraction;              ///< room0 at the faster of u and the contact of the low-order flux
  V full;                       ///< 1; 0 where a side is vacuum
  V upwind_share;               ///< mass fraction of products in the cell u comes from
  V trace, rest;                ///< densities of products and ambient gas in the left cell, not negative
  V cure;                       ///< m/s: least speed of shear and entropy waves beside a transverse shock; 0: none
  V low_flux[6], above_low[6];  ///< positive flux; mean of the analytic fluxes minus it
  /// What it does to alpha of the left and of the right cell, which is no flux, and u dalpha/2 minus that.
  V low_left, low_right, above_left, above_right;
  V low_state[7], energy_floor;
};

/// The positive flux: HLLC, whose fan holds both substances at densities of their own, so that the mean over a cell is
/// admissible where the states of the fan are; volume fractions mix by the same mean. A contact is kept exactly.
template <class V>
BRISANCE_INLINE void set_low_flux(MixtureFace<V>& f, MixtureCell<V> const& l, MixtureCell<V> const& r, V leftmost,
                                  V rightmost, V mean[6], V fraction_jump, MixtureConstants<V> const& k) {
  V const zero(0.0), half(0.5);
  V const mass_l = l.state[0] * (leftmost - l.u), mass_r = r.state[0] * (rightmost - r.u);
  V const speed = (fma(mass_l, l.u, r.pressure - l.pressure) - mass_r * r.u) / (mass_l - mass_r);
  Mask<V> const from_left = speed >= zero;
  V const outer = select(from_left, leftmost, rightmost), u = select(from_left, l.u, r.u);
  V const p = select(from_left, l.pressure, r.pressure);
  V x[6], base[6];
  BRISANCE_UNROLL for (int n = 0; n < 6; ++n) {
    x[n] = select(from_left, l.state[n], r.state[n]);
    base[n] = select(from_left, l.flux[n], r.flux[n]);
  }
  V const ratio = (outer - u) / (outer - speed), mass = ratio * x[0];
  V const star[6] = {mass,
                     mass * speed,
                     ratio * x[2],
                     ratio * x[3],
                     ratio * fma(speed - u, fma(x[0], speed, p / (outer - u)), x[4]),
                     ratio * x[5]};
  V const inner = select(from_left, min(leftmost, zero), max(rightmost, zero));
  V const widest = max(l.signal, r.signal), dissipation = half * widest;
  Mask<V> const llf = widest > k.contact_limit;
  BRISANCE_UNROLL for (int n = 0; n < 6; ++n) {
    V const plain = fnma(dissipation, r.state[n] - l.state[n], mean[n]);
    f.low_flux[n] = select(llf, plain, fma(inner, star[n] - x[n], base[n]));
    f.above_low[n] = mean[n] - f.low_flux[n];
  }
  f.low_left = select(llf, fma(half, r.u, -dissipation), min(speed, zero)) * fraction_jump;
  f.low_right = select(llf, fma(half, l.u, dissipation), max(speed, zero)) * fraction_jump;
  f.above_left = fms(half * f.u, fraction_jump, f.low_left);
  f.above_right = fms(half * f.u, fraction_jump, f.low_right);
  f.room_fraction = half * max(k.inv_sigma - max(abs(f.u), abs(speed)), zero);
}

/// Low-order state of the left cell and its energy floor, from its two faces.
template <class V>
BRISANCE_INLINE void set_low_state(MixtureFace<V>& f, V const* left_state, MixtureFace<V> const& previous,
                                   MixtureConstants<V> const& k) {
  BRISANCE_UNROLL for (int n = 0; n < 6; ++n) f.low_state[n] =
      fnma(k.sigma, f.low_flux[n] - previous.low_flux[n], left_state[n]);
  f.low_state[6] = fnma(k.sigma, f.low_left + previous.low_right, left_state[6]);
  f.energy_floor = V(kept_share) * thermal_energy(f.low_state, k);
}

/// Divided difference of g(rho_1), or its slope where the densities are close or a side holds too little to have one.
template <class V>
BRISANCE_INLINE V curve_slope(MixtureCell<V> const& l, MixtureCell<V> const& r) {
  V const zero(0.0), one(1.0), al = max(l.state[6], zero), ar = max(r.state[6], zero), both = al + ar;
  Mask<V> const some = both > V(least_fraction);
  V const slope = fma(al, l.slope, ar * r.slope) / select(some, both, one);
  if (!any_of(some)) return zero;
  Mask<V> const two = products_present(l.state[5], l.state[6]) & products_present(r.state[5], r.state[6]) &
                      (min(al, ar) > V(0.1) * max(al, ar));
  V const inv_l = one / select(two, al, one), inv_r = one / select(two, ar, one);
  V const change = fms(r.state[5], inv_r, l.state[5] * inv_l), sum = fma(r.state[5], inv_r, l.state[5] * inv_l);
  Mask<V> const apart = two & (abs(change) > V(1e-4) * sum);
  V const divided = fms(r.potential, inv_r, l.potential * inv_l) / select(apart, change, one);
  return select(apart, divided, select(some, slope, zero));
}

/// Everything of a face that depends on its two cells only, and the low-order state of the cell between it and
/// `previous`.
template <int Order, class V>
BRISANCE_INLINE void form_face(MixtureCell<V> const& l, MixtureCell<V> const& r, MixtureFace<V> const& previous,
                               MixtureFace<V>& f, MixtureJump<V>& j, MixtureConstants<V> const& k) {
  V const zero(0.0), half(0.5), one(1.0);
  V const inverse = one / (l.root + r.root), wl = l.root * inverse, wr = r.root * inverse;
  V const u = fma(wl, l.u, wr * r.u), v = fma(wl, l.v, wr * r.v), w = fma(wl, l.w, wr * r.w);
  V const enthalpy = fma(wl, l.enthalpy, wr * r.enthalpy), share = fma(wl, l.share, wr * r.share);
  V const density = l.root * r.root, q = half * fma(u, u, fma(v, v, w * w));

  V const fraction = l.state[6] + r.state[6], rest = V(2.0) - fraction;
  V const mass1 = l.state[5] + r.state[5], mass2 = (l.state[0] + r.state[0]) - mass1;
  Mask<V> const some1 = fraction > V(fraction_slack), some2 = rest > V(fraction_slack);
  V const inv1 = one / select(some1, fraction, one);
  f.density1 = select(some1, mass1 * inv1, zero);
  f.density2 = select(some2, mass2 / select(some2, rest, one), zero);
  V const potential1 = select(some1, (l.potential + r.potential) * inv1, zero);
  f.slope = curve_slope(l, r);
  // xi p is linear in both, so that any complementary means make d(xi p) = xi dp + p dxi exact
  f.contact = fma(half * (l.pressure + r.pressure), k.contrast, k.cold2 - potential1);
  V const least = min(l.sound, r.sound);
  V const square = max(fma(f.slope, share, enthalpy - q) / (half * (l.weight + r.weight)), least * least);
  V const sound = sqrt(square), inv_sound = one / sound;
  f.u = u, f.v = v, f.w = w, f.q = q, f.enthalpy = enthalpy, f.sound = sound, f.density = density, f.share = share;

  V const dp = r.pressure - l.pressure, du = r.u - l.u, dv = r.v - l.v, dw = r.w - l.w;
  V const da = r.state[6] - l.state[6], dtrace = r.state[5] - l.state[5];
  V const drest = (r.state[0] - l.state[0]) - dtrace;
  V const k1 = fnma(f.density1, da, dtrace), k2 = fma(f.density2, da, drest);
  V const jump[7] = {dp, du, dv, dw, da, k1, k2};
  BRISANCE_UNROLL for (int n = 0; n < 7; ++n) j.jump[n] = jump[n];
  j.steep = select((fraction > one) & (du < zero), fnma(V(0.2), min(l.pressure, r.pressure), abs(dp)), -one);
  f.full = one;
  f.upwind_share = select(negative(u), r.share, l.share);
  f.trace = max(l.state[5], zero);
  f.rest = max(l.state[0] - l.state[5], zero);
  V const compression = half * dp * (inv_sound * inv_sound), shear = half * density * du * inv_sound;
  V const both = compression + compression;
  V const strength[7] = {compression - shear, da,           fnma(share, both, k1), fnma(one - share, both, k2),
                         density * dv,        density * dw, compression + shear};
  BRISANCE_UNROLL for (int n = 0; n < 7; ++n) f.strength[n] = strength[n];

  V const lambda1 = u - sound, lambda5 = u + sound, outer_left = l.u - l.sound, outer_right = r.u + r.sound;
  V const gap1 = max(lambda1 - outer_left, (r.u - r.sound) - lambda1);
  V const gap5 = max(lambda5 - (l.u + l.sound), outer_right - lambda5);
  V const speed1 = max(abs(lambda1), gap1), speed0 = abs(u), speed5 = max(abs(lambda5), gap5);
  f.speed1 = speed1, f.speed5 = speed5;
  V mean[6];
  BRISANCE_UNROLL for (int n = 0; n < 6; ++n) mean[n] = half * (l.flux[n] + r.flux[n]);
  set_low_flux(f, l, r, min(outer_left, lambda1), max(outer_right, lambda5), mean, da, k);
  set_low_state(f, l.state, previous, k);

  if constexpr (Order >= 3) {
    f.room1 = half * max(k.inv_sigma - speed1, zero);
    f.room0 = half * max(k.inv_sigma - speed0, zero);
    f.room5 = half * max(k.inv_sigma - speed5, zero);
    auto factor = [&](V speed, V lambda) __attribute__((always_inline)) {
      V const nu = min(k.sigma * speed, one);
      return flip(V(1.0 / 6) * speed * fnma(nu, nu, one), lambda);
    };
    V const left = factor(speed1, lambda1) * strength[0], right = factor(speed5, lambda5) * strength[6];
    V const middle = factor(speed0, u), sum = left + right;
    V const third[7] = {square * sum,
                        sound / density * (right - left),
                        middle * dv,
                        middle * dw,
                        middle * da,
                        fma(middle, strength[2], share * sum),
                        fma(middle, strength[3], (one - share) * sum)};
    BRISANCE_UNROLL for (int n = 0; n < 7; ++n) j.third[n] = third[n];
  }
}

/// Lanes where a side is vacuum: LLF is the whole flux, and the face is flat in the stencils of others.
template <int Order, class V>
[[gnu::noinline, gnu::cold]] void empty_face(MixtureCell<V> const& l, MixtureCell<V> const& r, Mask<V> vacuum,
                                             MixtureFace<V> const& previous, MixtureFace<V>& f, MixtureJump<V>& j,
                                             MixtureConstants<V> const& k) {
  V const zero(0.0), one(1.0), half(0.5), dissipation = half * max(l.signal, r.signal);
  for (int n = 0; n < 6; ++n) {
    V const mean = half * (l.flux[n] + r.flux[n]);
    f.low_flux[n] = select(vacuum, fnma(dissipation, r.state[n] - l.state[n], mean), f.low_flux[n]);
    f.above_low[n] = select(vacuum, zero, f.above_low[n]);
  }
  V const da = r.state[6] - l.state[6];
  f.low_left = select(vacuum, fma(half, r.u, -dissipation) * da, f.low_left);
  f.low_right = select(vacuum, fma(half, l.u, dissipation) * da, f.low_right);
  for (V* x : {&f.above_left, &f.above_right}) *x = select(vacuum, zero, *x);
  set_low_state(f, l.state, previous, k);
  for (V& x : f.strength) x = select(vacuum, zero, x);
  for (V* x : {&f.full, &f.upwind_share, &f.room_fraction}) *x = select(vacuum, zero, *x);
  for (V* x : {&f.u, &f.v, &f.w, &f.q, &f.enthalpy, &f.share, &f.density1, &f.density2, &f.slope, &f.contact, &f.speed1,
               &f.speed5})
    *x = select(vacuum, zero, *x);
  for (V* x : {&f.sound, &f.density}) *x = select(vacuum, one, *x);
  for (V& x : j.jump) x = select(vacuum, zero, x);
  j.steep = select(vacuum, zero, j.steep);
  if constexpr (Order >= 3) {
    for (V& x : j.third) x = select(vacuum, zero, x);
    for (V* x : {&f.room1, &f.room0, &f.room5}) *x = select(vacuum, zero, *x);
  }
}

}  // namespace brisance::fluid
