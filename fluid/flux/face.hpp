// What is computed once per cell and once per face: primitives, Roe state, own jumps, low-order flux.
// Source: theory/fluid.md 2.3, 2.6 (Roe, entropy cure), 4.1 (low-order flux), 4.3 (vacuum).
#pragma once
#include <type_traits>

#include "fluid/flux/osmp.hpp"
#include "fluid/flux/sweep.hpp"
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// Kinds of gas the sweeps are compiled for: the ideal one, and any other reference curve (stiffened, JWL).
struct IdealCurve {
  static constexpr bool curved = false;
};
struct AnyCurve {
  static constexpr bool curved = true;
};

/// Constants of a sweep, one copy per lane.
template <class V, class Curve>
struct SweepConstants {
  V gamma, kappa, sigma, inv_sigma;
  V vacuum_density, vacuum_energy;
  V hlle_limit;  ///< m/s: above this signal speed the low-order flux is LLF (theory/fluid.md 4.1)
  bool hybrid;   ///< acoustic waves with frozen coefficients next to pressure jumps
  V shear;       ///< eta of the transverse cure (theory/fluid.md 2.7)
  ReferenceCurve curve;

  SweepConstants(Gas const& gas, Real sigma_, SweepOptions const& options)
      : gamma(gas.gamma),
        kappa(gas.kappa()),
        sigma(sigma_),
        inv_sigma(1 / sigma_),
        vacuum_density(gas.vacuum_density),
        vacuum_energy(gas.vacuum_energy),
        hlle_limit(hlle_courant(gas) / sigma_),
        hybrid(options.hybrid),
        shear(options.shear_dissipation),
        curve(gas.curve) {}
  /// Largest Courant number at which HLLE keeps the state admissible next to any other face. theory/fluid.md 4.1 takes
  /// 0.8 up to gamma = 3; up to 5/3 the same random test (3 million triples a gamma, one face at this number, the other
  /// at most at 1) finds nothing at 0.91 either, and LLF between 0.8 and 0.9 would double the error of strong shocks
  /// run at Courant 0.9 (F18d, F18e). The half per cent keeps rounding from deciding in a scene run at 0.9.
  static Real hlle_courant(Gas const& gas) {
    if (gas.gamma <= 1.67 && !gas.curve.exponential()) return 0.905;
    return gas.kappa() <= 2 ? 0.8 : 0.5;
  }
};

/// Exponentials of the reference curve at one density, and what follows from them (theory/fluid.md 1.2).
template <class V>
struct CurvePoint {
  V pressure, energy, slope;  ///< p_ref (Pa), rho e_ref (J/m3), dp_ref/drho
};
template <class V>
BRISANCE_INLINE CurvePoint<V> curve_at(V density, ReferenceCurve const& c, V least_density) {
  V const stiffness(c.stiffness);
  if (!c.exponential()) return {-stiffness, stiffness, V(0.0)};
  V const v = V(c.solid_density) / max(density, least_density), inverse = V(1.0) / v;
  V const a = V(c.a) * exp(V(-c.r1) * v), b = V(c.b) * exp(V(-c.r2) * v);
  return {a + b - stiffness, fma(fma(V(1 / c.r1), a, V(1 / c.r2) * b), inverse, stiffness),
          fma(V(c.r1), a, V(c.r2) * b) * (v * v) * V(1 / c.solid_density)};
}

struct Nothing {};

/// What a cell has beside, with a reference curve.
template <class V>
struct CellCurve {
  V pressure;    ///< Pa
  V scale;       ///< rho c^2 / gamma, Pa: what pressure jumps are compared with
  V f, f_slope;  ///< p_ref - Gamma rho e_ref and its derivative
};

/// A cell as its two faces see it, sweep coordinates. Every member counts: beyond some size the compiler keeps cells in
/// memory instead of registers.
template <class V, class Curve>
struct Cell {
  V state[5], flux[5];
  V u, v, w, enthalpy, root, sound, signal;  ///< velocity, H, sqrt(density), c, |u| + c
  V energy;                                  ///< phi: internal above the reference curve, J/m3
  [[no_unique_address]] std::conditional_t<Curve::curved, CellCurve<V>, Nothing> curve;
};
template <class V, class Curve>
BRISANCE_INLINE V pressure_of(Cell<V, Curve> const& c, SweepConstants<V, Curve> const& k) {
  if constexpr (Curve::curved)
    return c.curve.pressure;
  else
    return k.kappa * c.energy;
}

/// Jump of the conserved state at a face, right minus left (0 where a side is vacuum), and its third-order correction:
/// P/2 of theory/fluid.md 2.4, step 1. What the windows of other faces read.
template <class V>
struct Jump {
  V jump[5], third[5];
};

/// A face and the low-order state of the cell on its left.
template <class V, class Curve>
struct Face {
  V strength[5];  ///< the jump in the face's own characteristics
  V u, v, w, enthalpy, sound, inv_sound;
  V speed1, speed5;       ///< acoustic speeds with the entropy cure, >= 0
  V room1, room0, room5;  ///< (1 - nu)/(2 sigma) of the three wave speeds
  V steep;                ///< > 0: see `steepness`
  V cure;                 ///< m/s: least speed of the shear and entropy waves beside a transverse shock; 0: none
  V low_flux[5];          ///< positive flux
  V above_low[5];         ///< mean of the two analytic fluxes minus low_flux
  V low_state[5];         ///< left cell after a step of the low-order flux
  V energy_floor;         ///< least density * phi the left cell may be left with
  [[no_unique_address]] std::conditional_t<Curve::curved, V, Nothing> bend;  ///< chi / Gamma, m2/s2
};

/// What a projection needs of a face. With a reference curve, chi/Gamma adds to the kinetic energy q of the left
/// vectors and subtracts from that of the entropy wave.
template <class V>
struct Frame {
  V u, v, w, q, q_entropy, kappa_over_2c2, inv_2c;
};
template <class V>
BRISANCE_INLINE Frame<V> make_frame(V u, V v, V w, V q, V inv_sound, V kappa, Nothing) {
  V const inv_2c = V(0.5) * inv_sound;
  return {u, v, w, q, q, kappa * inv_2c * inv_sound, inv_2c};
}
template <class V>
BRISANCE_INLINE Frame<V> make_frame(V u, V v, V w, V q, V inv_sound, V kappa, V bend) {
  Frame<V> f = make_frame(u, v, w, q, inv_sound, kappa, Nothing{});
  f.q_entropy = f.q - bend;
  f.q = f.q + bend;
  return f;
}
/// The two numbers all characteristic components follow from: dp/2c^2 and rho du/2c.
template <class V>
struct Acoustic {
  V pressure, velocity;
};
template <class V>
BRISANCE_INLINE Acoustic<V> project(V const* x, Frame<V> const& f) {
  V const e = fnma(f.u, x[1], fma(f.q, x[0], x[4])) - fma(f.v, x[2], f.w * x[3]);
  return {f.kappa_over_2c2 * e, f.inv_2c * fnma(f.u, x[0], x[1])};
}
/// Sum of the characteristic components h times the right eigenvectors.
template <class V, class Curve>
BRISANCE_INLINE void assemble(V const* h, Face<V, Curve> const& f, V q_entropy, V* x) {
  V const both = h[0] + h[4], apart = f.sound * (h[4] - h[0]);
  x[0] = both + h[1];
  x[1] = fma(f.u, x[0], apart);
  x[2] = fma(f.v, x[0], h[2]);
  x[3] = fma(f.w, x[0], h[3]);
  x[4] = fma(f.enthalpy, both, fma(f.u, apart, fma(q_entropy, h[1], fma(f.v, h[2], f.w * h[3]))));
}

/// density * phi: what positivity compares.
template <class V, class Curve>
BRISANCE_INLINE V density_energy(V const* x, SweepConstants<V, Curve> const& k) {
  V const twice_kinetic = fma(x[1], x[1], fma(x[2], x[2], x[3] * x[3]));
  if constexpr (Curve::curved)
    return fnma(V(0.5), twice_kinetic, x[0] * (x[4] - curve_at(x[0], k.curve, k.vacuum_density).energy));
  else
    return fnma(V(0.5), twice_kinetic, x[0] * x[4]);
}

/// Velocity, pressure and fluxes of a cell that is not vacuum; lanes that are hold nonsense until `empty_cell`.
template <class V, class Curve>
BRISANCE_INLINE void primitives(Cell<V, Curve>& c, SweepConstants<V, Curve> const& k) {
  V const* const x = c.state;
  V const inverse = V(1.0) / x[0];
  c.root = sqrt(x[0]);
  c.u = x[1] * inverse, c.v = x[2] * inverse, c.w = x[3] * inverse;
  c.energy = fnma(V(0.5), fma(x[1], c.u, fma(x[2], c.v, x[3] * c.w)), x[4]);
  if constexpr (Curve::curved) {
    CurvePoint<V> const ref = curve_at(x[0], k.curve, k.vacuum_density);
    c.energy = c.energy - ref.energy;
    V const thermal = k.kappa * c.energy, sound2 = fma(k.gamma * thermal, inverse, ref.slope);
    c.sound = sqrt(sound2);
    c.curve = {ref.pressure + thermal, x[0] * sound2 / k.gamma, fnma(k.kappa, ref.energy, ref.pressure),
               fnma(k.kappa, (ref.energy + ref.pressure) * inverse, ref.slope)};
  } else {
    c.sound = sqrt(k.gamma * (k.kappa * c.energy) * inverse);
  }
  V const pressure = pressure_of(c, k), total = x[4] + pressure;
  c.signal = abs(c.u) + c.sound;
  c.enthalpy = total * inverse;
  c.flux[0] = x[1];
  c.flux[1] = fma(x[1], c.u, pressure);
  c.flux[2] = x[2] * c.u;
  c.flux[3] = x[3] * c.u;
  c.flux[4] = total * c.u;
}
/// Lanes where the cell is vacuum or not a number.
template <class V, class Curve>
BRISANCE_INLINE Mask<V> is_vacuum(Cell<V, Curve> const& c, SweepConstants<V, Curve> const& k) {
  return !((c.state[0] > k.vacuum_density) & (c.energy > k.vacuum_energy));
}
/// Evaluates vacuum lanes as gas at rest at the end of its reference curve (no pressure; -p_inf of stiffened gas),
/// content untouched.
template <class V, class Curve>
[[gnu::noinline, gnu::cold]] void empty_cell(Cell<V, Curve>& c, Mask<V> vacuum, SweepConstants<V, Curve> const& k) {
  V const zero(0.0), least(-k.curve.stiffness);
  for (V* x : {&c.u, &c.v, &c.w, &c.enthalpy, &c.sound, &c.signal, &c.energy}) *x = select(vacuum, zero, *x);
  c.root = select(vacuum, V(1.0), c.root);
  if constexpr (Curve::curved) {
    for (V* x : {&c.curve.scale, &c.curve.f, &c.curve.f_slope}) *x = select(vacuum, zero, *x);
    c.curve.pressure = select(vacuum, least, c.curve.pressure);
  }
  for (int n = 0; n < 5; ++n) c.flux[n] = select(vacuum, n == 1 ? least : zero, c.flux[n]);
}

/// Low-order state of the left cell and its energy floor, from the fluxes of its two faces.
template <class V, class Curve>
BRISANCE_INLINE void set_low_state(Face<V, Curve>& f, V const* left_state, V const* previous_flux,
                                   SweepConstants<V, Curve> const& k) {
  V w[5];
  BRISANCE_UNROLL for (int n = 0; n < 5; ++n) {
    w[n] = fnma(k.sigma, f.low_flux[n] - previous_flux[n], left_state[n]);
    f.low_state[n] = w[n];
  }
  f.energy_floor = V(1e-4) * density_energy(w, k);
}

/// chi / Gamma of the Roe average: the secant of f between the two densities, its mean slope where they nearly agree.
template <class V, class Curve>
BRISANCE_INLINE V secant(Cell<V, Curve> const& l, Cell<V, Curve> const& r, SweepConstants<V, Curve> const& k) {
  V const drho = r.state[0] - l.state[0], sum = r.state[0] + l.state[0];
  Mask<V> const apart = abs(drho) > V(1e-6) * sum;
  V const slope = (r.curve.f - l.curve.f) / select(apart, drho, V(1.0));
  return select(apart, slope, V(0.5) * (l.curve.f_slope + r.curve.f_slope)) / k.kappa;
}

/// > 0 where the pressures of the two cells differ by more than 20 % and the gas between them expands: there the
/// acoustic waves take frozen coefficients (`hybrid`). With exponentials in the reference curve, where it is
/// compressed. theory/fluid.md 2.4 freezes all waves beside all jumps; fluid/README.md has the measurements that led
/// here.
template <class V, class Curve>
BRISANCE_INLINE V steepness(Cell<V, Curve> const& l, Cell<V, Curve> const& r, SweepConstants<V, Curve> const& k) {
  V const none(-1.0), share(0.2);
  if constexpr (Curve::curved) {
    V const jump = fnma(share, min(l.curve.scale, r.curve.scale), abs(r.curve.pressure - l.curve.pressure));
    return k.curve.exponential() ? select(r.u < l.u, jump, none) : select(r.u > l.u, jump, none);
  } else {
    return select(r.u > l.u, fnma(share, min(l.energy, r.energy), abs(r.energy - l.energy)), none);
  }
}

/// Everything of a face that depends on its two cells only, and the low-order state of the cell between it and
/// `previous`.
template <int Order, class V, class Curve>
BRISANCE_INLINE void form_face(Cell<V, Curve> const& l, Cell<V, Curve> const& r, Face<V, Curve> const& previous,
                               Face<V, Curve>& f, Jump<V>& window, SweepConstants<V, Curve> const& k) {
  V const inverse = V(1.0) / (l.root + r.root), wl = l.root * inverse, wr = r.root * inverse;
  V const u = fma(wl, l.u, wr * r.u), v = fma(wl, l.v, wr * r.v), w = fma(wl, l.w, wr * r.w);
  V const enthalpy = fma(wl, l.enthalpy, wr * r.enthalpy);
  V const q = V(0.5) * fma(u, u, fma(v, v, w * w));
  V const least = min(l.sound, r.sound);
  V sound;
  std::conditional_t<Curve::curved, V, Nothing> bend;
  if constexpr (Curve::curved) {
    bend = secant(l, r, k);
    V const sound2 = k.kappa * (bend + (enthalpy - q));
    sound = sqrt(select(sound2 > V(0.0), sound2, least * least));
  } else {
    // the Roe average lies above the smaller of the two sound speeds: the max acts on rounding only
    sound = sqrt(max(k.kappa * (enthalpy - q), least * least));
  }
  V const inv_sound = V(1.0) / sound;
  V jump[5];
  BRISANCE_UNROLL for (int n = 0; n < 5; ++n) window.jump[n] = jump[n] = r.state[n] - l.state[n];
  f.u = u, f.v = v, f.w = w, f.enthalpy = enthalpy, f.sound = sound, f.inv_sound = inv_sound;

  V const lambda1 = u - sound, lambda5 = u + sound, outer_left = l.u - l.sound, outer_right = r.u + r.sound;
  V const gap1 = max(lambda1 - outer_left, (r.u - r.sound) - lambda1);
  V const gap5 = max(lambda5 - (l.u + l.sound), outer_right - lambda5);
  V const speed1 = max(abs(lambda1), gap1), speed0 = abs(u), speed5 = max(abs(lambda5), gap5);
  f.speed1 = speed1, f.speed5 = speed5;

  V const widest = max(l.signal, r.signal);
  Mask<V> const llf = widest > k.hlle_limit;
  V const leftmost = select(llf, -widest, min(min(outer_left, lambda1), V(0.0)));
  V const rightmost = select(llf, widest, max(max(outer_right, lambda5), V(0.0)));
  V const width = V(1.0) / (rightmost - leftmost);
  V const skew = V(0.5) * (rightmost + leftmost) * width, spread = rightmost * leftmost * width;
  BRISANCE_UNROLL for (int n = 0; n < 5; ++n) {
    V const above = fnma(spread, jump[n], skew * (r.flux[n] - l.flux[n]));
    f.above_low[n] = above;
    f.low_flux[n] = fms(V(0.5), l.flux[n] + r.flux[n], above);
  }
  set_low_state(f, l.state, previous.low_flux, k);

  f.bend = bend;
  Frame<V> const frame = make_frame(u, v, w, q, inv_sound, k.kappa, bend);
  Acoustic<V> const a = project(jump, frame);
  V const strength[5] = {a.pressure - a.velocity, fnma(V(2.0), a.pressure, jump[0]), fnma(v, jump[0], jump[2]),
                         fnma(w, jump[0], jump[3]), a.pressure + a.velocity};
  BRISANCE_UNROLL for (int n = 0; n < 5; ++n) f.strength[n] = strength[n];
  if constexpr (Order >= 3) {
    V const none(0.0), half(0.5);
    f.room1 = half * max(k.inv_sigma - speed1, none);
    f.room0 = half * max(k.inv_sigma - speed0, none);
    f.room5 = half * max(k.inv_sigma - speed5, none);
    f.steep = steepness(l, r, k);
    V const one(1.0), sixth(1.0 / 6);
    V const nu1 = min(k.sigma * speed1, one), nu0 = min(k.sigma * speed0, one), nu5 = min(k.sigma * speed5, one);
    V const factor0 = sixth * u * fnma(nu0, nu0, one);
    V const h[5] = {flip(sixth * speed1 * fnma(nu1, nu1, one), lambda1) * strength[0], factor0 * strength[1],
                    factor0 * strength[2], factor0 * strength[3],
                    flip(sixth * speed5 * fnma(nu5, nu5, one), lambda5) * strength[4]};
    assemble(h, f, frame.q_entropy, window.third);
  }
}

/// Lanes where a side is vacuum: LLF is the whole flux, and the face is flat in the stencils of others.
template <int Order, class V, class Curve>
[[gnu::noinline, gnu::cold]] void empty_face(Cell<V, Curve> const& l, Cell<V, Curve> const& r, Mask<V> vacuum,
                                             Face<V, Curve> const& previous, Face<V, Curve>& f, Jump<V>& window,
                                             SweepConstants<V, Curve> const& k) {
  V const zero(0.0), one(1.0), half(0.5), widest = max(l.signal, r.signal);
  for (int n = 0; n < 5; ++n) {
    V const dissipation = half * widest * (r.state[n] - l.state[n]);
    f.low_flux[n] = select(vacuum, fms(half, l.flux[n] + r.flux[n], dissipation), f.low_flux[n]);
  }
  set_low_state(f, l.state, previous.low_flux, k);
  for (V* array : {window.jump, f.strength, f.above_low})
    for (int n = 0; n < 5; ++n) array[n] = select(vacuum, zero, array[n]);
  for (V* x : {&f.u, &f.v, &f.w, &f.enthalpy, &f.speed1, &f.speed5}) *x = select(vacuum, zero, *x);
  if constexpr (Curve::curved) f.bend = select(vacuum, zero, f.bend);
  if constexpr (Order >= 3) {
    for (V& p : window.third) p = select(vacuum, zero, p);
    for (V* x : {&f.room1, &f.room0, &f.room5}) *x = select(vacuum, zero, *x);
  }
  for (V* x : {&f.sound, &f.inv_sound}) *x = select(vacuum, one, *x);
}

}  // namespace brisance::fluid
