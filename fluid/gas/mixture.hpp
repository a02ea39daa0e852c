// Two substances in one flow: detonation products (JWL) and the gas around them, with one velocity and one pressure.
// Unknowns beside the five conserved ones: the mass of products per volume, conserved, and their volume fraction alpha,
// which is carried along. Source: theory/fluid.md 1.4.
#pragma once
#include <algorithm>
#include <array>

#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// density, momentum (3), total energy, density of products (mass per volume of mixture), volume fraction of products.
using MixtureState = std::array<Real, 7>;

/// Below this volume fraction the products count as absent: the density of a trace of 1e-12, mass over volume fraction,
/// is rounding, and its JWL curve would be noise of the size of the air's pressure.
inline constexpr Real least_fraction = 1e-10;
/// Masses and volume fractions may be as negative as this share: rounding (theory/fluid.md 1.4, trap T22).
inline constexpr Real fraction_slack = 1e-12;

/// Both substances at one pressure. Errors: none; states outside the admissible set count as vacuum.
struct Mixture {
  Gas products;  ///< JWL
  Gas ambient;   ///< ideal or stiffened; its vacuum thresholds serve the mixture

  /// What the volume fraction of products does to the internal energy: alpha/Gamma_1 + (1 - alpha)/Gamma_2.
  Real weight(Real fraction) const { return fraction / products.kappa() + (1 - fraction) / ambient.kappa(); }
  bool present(MixtureState const& x) const { return x[6] > least_fraction && x[5] > 0; }
  /// Energy per volume of both cold curves, J/m3.
  Real cold_energy(MixtureState const& x) const {
    Real const rest = (1 - x[6]) * ambient.curve.stiffness;
    return present(x) ? x[6] * products.reference_energy(x[5] / x[6]) + rest : rest;
  }
  Real internal_energy(MixtureState const& x) const {
    return x[0] > 0 ? x[4] - 0.5 * (x[1] * x[1] + x[2] * x[2] + x[3] * x[3]) / x[0] : x[4];
  }
  /// Internal energy above the cold curves, J/m3: the concave measure of admissibility.
  Real thermal_energy(MixtureState const& x) const { return internal_energy(x) - cold_energy(x); }
  bool vacuum(MixtureState const& x) const {
    return !(x[0] > ambient.vacuum_density) || !(thermal_energy(x) > ambient.vacuum_energy);
  }
  /// Pa; 0 in vacuum.
  Real pressure(MixtureState const& x) const {
    if (vacuum(x)) return 0;
    Real cold = -(1 - x[6]) * ambient.curve.stiffness / ambient.kappa();
    if (present(x)) cold += x[6] * products.reference_pressure(x[5] / x[6]) / products.kappa();
    return (thermal_energy(x) + cold) / weight(x[6]);
  }
  /// m/s, at frozen volume fraction: xi rho c^2 = sum alpha_k rho_k c_k^2 / Gamma_k; 0 in vacuum.
  Real sound_speed(MixtureState const& x) const {
    if (vacuum(x)) return 0;
    Real const p = pressure(x), gamma = ambient.gamma;
    Real sum = (1 - x[6]) / ambient.kappa() * gamma * (p + ambient.curve.stiffness);
    if (present(x)) {
      Real const density = x[5] / x[6];
      sum +=
          x[6] / products.kappa() *
          (products.gamma * (p - products.reference_pressure(density)) + density * products.reference_slope(density));
    } else {
      sum += x[6] / products.kappa() * products.gamma * p;
    }
    return std::sqrt(sum / (weight(x[6]) * x[0]));
  }
  /// The state of two substances of these densities, kg/m3, mixed by volume at one velocity and pressure.
  MixtureState conserved(Real fraction, Real density_products, Real density_ambient, Vec3 const& v, Real p) const {
    Real const trace = fraction * density_products, density = trace + (1 - fraction) * density_ambient;
    Real energy = 0.5 * density * norm2(v);
    if (fraction > 0) energy += fraction * products.energy_at_rest(density_products, p);
    if (fraction < 1) energy += (1 - fraction) * ambient.energy_at_rest(density_ambient, p);
    return {density, density * v.x, density * v.y, density * v.z, energy, trace, fraction};
  }
};

}  // namespace brisance::fluid
