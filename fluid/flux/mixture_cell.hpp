// What the sweep of a mixture computes once per cell: pressure, sound speed and fluxes of two substances.
// Source: theory/fluid.md 1.2, 1.4.
#pragma once
#include "fluid/flux/pack.hpp"
#include "fluid/gas/mixture.hpp"

namespace brisance::fluid {

/// Constants of a sweep, one copy per lane.
template <class V>
struct MixtureConstants {
  V sigma, inv_sigma;
  V inv_gamma1, inv_gamma2, contrast;        ///< 1/Gamma of products and ambient gas, their difference
  V stiffness, cold2;                        ///< of the ambient gas: p_inf, and its potential -p_inf (1 + 1/Gamma)
  V a, b, r1, r2, solid_density, inv_solid;  ///< JWL; 1/rho0
  V specific1, specific2;                    ///< 1/(R rho0): pressure to energy per mass, m3/kg
  V vacuum_density, vacuum_energy;
  V contact_limit;  ///< m/s: above this signal speed the low-order flux is LLF (theory/fluid.md 4.1)

  MixtureConstants(Mixture const& mixture, Real sigma_)
      : sigma(sigma_),
        inv_sigma(1 / sigma_),
        inv_gamma1(1 / mixture.products.kappa()),
        inv_gamma2(1 / mixture.ambient.kappa()),
        contrast(1 / mixture.products.kappa() - 1 / mixture.ambient.kappa()),
        stiffness(mixture.ambient.curve.stiffness),
        cold2(-mixture.ambient.curve.stiffness * (1 + 1 / mixture.ambient.kappa())),
        a(mixture.products.curve.a),
        b(mixture.products.curve.b),
        r1(mixture.products.curve.r1),
        r2(mixture.products.curve.r2),
        solid_density(mixture.products.curve.solid_density),
        inv_solid(1 / mixture.products.curve.solid_density),
        specific1(1 / (mixture.products.curve.r1 * mixture.products.curve.solid_density)),
        specific2(1 / (mixture.products.curve.r2 * mixture.products.curve.solid_density)),
        vacuum_density(mixture.ambient.vacuum_density),
        vacuum_energy(mixture.ambient.vacuum_energy),
        contact_limit((mixture.ambient.kappa() <= 2 ? 0.905 : 0.5) / sigma_) {}
};

/// The cold curve of the products in a cell: alpha g(rho_1), g'(rho_1), alpha rho_1 e_ref(rho_1), where
/// g = p_ref/Gamma - rho e_ref is what the curve adds to Gamma-weighted pressure. Zero where they are absent.
template <class V>
struct ColdProducts {
  V potential, slope, energy;
};
template <class V>
BRISANCE_INLINE Mask<V> products_present(V trace, V fraction) {
  return (fraction > V(least_fraction)) & (trace > V(0.0));
}
template <class V>
BRISANCE_INLINE ColdProducts<V> cold_products(V trace, V fraction, MixtureConstants<V> const& k) {
  V const zero(0.0), largest(200.0);  // at v = 200 both exponentials are far below any pressure
  Mask<V> const present = products_present(trace, fraction);
  if (!any_of(present)) return {zero, zero, zero};
  V const v = min(fraction * k.solid_density / select(present, trace, V(1.0)), largest);
  V const first = k.a * exp(-(k.r1 * v)), second = k.b * exp(-(k.r2 * v));
  V const pressure = first + second;
  V const specific = fma(k.specific1, first, k.specific2 * second);
  V const energy = trace * specific;
  V const steepness = fma(k.r1, first, k.r2 * second);
  V const slope = fms(fms(steepness * v, k.inv_gamma1, pressure), v * k.inv_solid, specific);
  return {select(present, fms(fraction * k.inv_gamma1, pressure, energy), zero), select(present, slope, zero),
          select(present, energy, zero)};
}

/// Internal energy above the cold curves of a state, J/m3.
template <class V>
BRISANCE_INLINE V thermal_energy(V const* x, MixtureConstants<V> const& k) {
  V const kinetic = fma(x[1], x[1], fma(x[2], x[2], x[3] * x[3])) / x[0];
  V const internal = fnma(V(0.5), kinetic, x[4]);
  V const rest = (V(1.0) - x[6]) * k.stiffness;
  V energy = internal - rest;
  // lane by lane the same bits whether the branch is taken or not: the curve is zero where products are absent
  if (any_of(products_present(x[5], x[6]))) energy = energy - cold_products(x[5], x[6], k).energy;
  return energy;
}

/// A cell as its two faces see it, sweep coordinates.
template <class V>
struct MixtureCell {
  V state[7], flux[6];  ///< fluxes of the conserved six
  V u, v, w, pressure, enthalpy, root, sound, signal;
  V share, weight;              ///< mass fraction of products; alpha/Gamma_1 + (1 - alpha)/Gamma_2
  V potential, slope, thermal;  ///< of the products' cold curve; internal energy above both curves
};

template <class V>
BRISANCE_INLINE void primitives(MixtureCell<V>& c, MixtureConstants<V> const& k) {
  V const* const x = c.state;
  V const inverse = V(1.0) / x[0];
  c.root = sqrt(x[0]);
  c.u = x[1] * inverse, c.v = x[2] * inverse, c.w = x[3] * inverse;
  V const internal = fnma(V(0.5), fma(x[1], c.u, fma(x[2], c.v, x[3] * c.w)), x[4]);
  V const rest = V(1.0) - x[6];
  ColdProducts<V> const cold = cold_products(x[5], x[6], k);
  c.potential = cold.potential, c.slope = cold.slope;
  c.thermal = internal - cold.energy - rest * k.stiffness;
  c.weight = fma(x[6], k.contrast, k.inv_gamma2);
  c.pressure = (internal + cold.potential + rest * k.cold2) / c.weight;
  c.share = x[5] * inverse;
  V const total = x[4] + c.pressure;
  V const square = fma(cold.slope, c.share, (internal + c.pressure) * inverse) / c.weight;
  c.sound = sqrt(max(square, V(0.0)));
  c.signal = abs(c.u) + c.sound;
  c.enthalpy = total * inverse;
  c.flux[0] = x[1];
  c.flux[1] = fma(x[1], c.u, c.pressure);
  c.flux[2] = x[2] * c.u;
  c.flux[3] = x[3] * c.u;
  c.flux[4] = total * c.u;
  c.flux[5] = x[5] * c.u;
}
/// Lanes where the cell is vacuum or not a number.
template <class V>
BRISANCE_INLINE Mask<V> is_vacuum(MixtureCell<V> const& c, MixtureConstants<V> const& k) {
  return !((c.state[0] > k.vacuum_density) & (c.thermal > k.vacuum_energy));
}
/// Evaluates vacuum lanes as gas at rest without pressure: zero flux in all components, content untouched.
template <class V>
[[gnu::noinline, gnu::cold]] void empty_cell(MixtureCell<V>& c, Mask<V> vacuum) {
  V const zero(0.0);
  for (V* x :
       {&c.u, &c.v, &c.w, &c.pressure, &c.enthalpy, &c.sound, &c.signal, &c.share, &c.potential, &c.slope, &c.thermal})
    *x = select(vacuum, zero, *x);
  c.root = select(vacuum, V(1.0), c.root);
  for (V& f : c.flux) f = select(vacuum, zero, f);
}

}  // namespace brisance::fluid
