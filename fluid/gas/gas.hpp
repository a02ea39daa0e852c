// The equation of state of one substance: p = p_ref(rho) + Gamma phi, phi = internal energy per volume above a
// reference curve. One form serves ideal gas, stiffened gas and JWL, and everything outside the sweeps.
#pragma once
#include <cmath>
#include <string>

#include "core/base/vec3.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Terms of the reference curve, rho = density, v = rho0 / rho:
/// p_ref = A exp(-R1 v) + B exp(-R2 v) - p_inf,  rho e_ref = rho [A/(R1 rho0) exp(-R1 v) + B/(R2 rho0) exp(-R2 v)] +
/// p_inf. Ideal gas: all zero. Stiffened gas: p_inf alone. JWL: A, B.  Source: theory/fluid.md 1.2.  Units: Pa, 1,
/// kg/m3.
struct ReferenceCurve {
  Real stiffness = 0;      ///< p_inf, Pa
  Real a = 0, b = 0;       ///< A, B of JWL, Pa
  Real r1 = 1, r2 = 1;     ///< R1, R2 of JWL
  Real solid_density = 1;  ///< rho0 of JWL, kg/m3
  bool exponential() const { return a != 0 || b != 0; }
  bool zero() const { return stiffness == 0 && !exponential(); }
};

/// Source: theory/fluid.md 1.2, 1.5.
struct Gas {
  Real gamma = 1.4;         ///< Gamma + 1: ratio of specific heats; 1 + omega of JWL
  Real vacuum_density = 0;  ///< kg/m3: at or below, a cell is vacuum (1e-10 of the reference density)
  Real vacuum_energy = 0;   ///< J/m3: phi at or below, a cell is vacuum (1e-12 p_ref / Gamma)
  ReferenceCurve curve{};
  Real gas_constant = 287.05;  ///< R, J/(kg K): temperature = p / (rho R), of ideal gas

  Real kappa() const { return gamma - 1; }
  /// p_ref, Pa.
  Real reference_pressure(Real density) const {
    if (!curve.exponential()) return -curve.stiffness;
    return curve.a * std::exp(-curve.r1 * curve.solid_density / density) +
           curve.b * std::exp(-curve.r2 * curve.solid_density / density) - curve.stiffness;
  }
  /// rho e_ref, J/m3.
  Real reference_energy(Real density) const {
    if (!curve.exponential()) return curve.stiffness;
    Real const v = curve.solid_density / density;
    return (curve.a / curve.r1 * std::exp(-curve.r1 * v) + curve.b / curve.r2 * std::exp(-curve.r2 * v)) / v +
           curve.stiffness;
  }
  /// dp_ref/drho, Pa m3/kg.
  Real reference_slope(Real density) const {
    if (!curve.exponential()) return 0;
    Real const v = curve.solid_density / density;
    return (curve.a * curve.r1 * std::exp(-curve.r1 * v) + curve.b * curve.r2 * std::exp(-curve.r2 * v)) * v / density;
  }

  /// phi, J/m3. The same operations in the same order as the sweep, so that both agree on what is vacuum.
  Real internal_energy(State const& u) const {
    if (!(u[0] > 0)) return u[4] - curve.stiffness;
    Real const inverse = 1 / u[0];
    Real const twice_kinetic = std::fma(u[1], u[1] * inverse, std::fma(u[2], u[2] * inverse, u[3] * (u[3] * inverse)));
    Real const energy = std::fma(-0.5, twice_kinetic, u[4]);
    return curve.zero() ? energy : energy - reference_energy(u[0]);
  }
  bool vacuum(State const& u) const { return !(u[0] > vacuum_density) || !(internal_energy(u) > vacuum_energy); }
  /// Pa; 0 in vacuum, which a stiffened gas leaves at -p_inf.
  Real pressure(State const& u) const {
    if (vacuum(u)) return -curve.stiffness;
    Real const thermal = kappa() * internal_energy(u);
    return curve.zero() ? thermal : reference_pressure(u[0]) + thermal;
  }
  /// m/s; 0 in vacuum.
  Real sound_speed(State const& u) const {
    if (vacuum(u)) return 0;
    Real const thermal = gamma * (kappa() * internal_energy(u)) / u[0];
    return std::sqrt(curve.zero() ? thermal : reference_slope(u[0]) + thermal);
  }
  /// K; of ideal gas.
  Real temperature(Real density, Real pressure_) const { return pressure_ / (density * gas_constant); }
  /// Energy per volume at rest, J/m3.
  Real energy_at_rest(Real density, Real pressure_) const {
    if (curve.zero()) return pressure_ / kappa();
    return (pressure_ - reference_pressure(density)) / kappa() + reference_energy(density);
  }
  /// Density 0 is true vacuum: no content but the energy at which the reference curve ends (p_inf of stiffened gas).
  State conserved(Real density, Vec3 const& v, Real pressure_) const {
    if (!curve.zero() && !(density > 0)) return {0, 0, 0, 0, curve.stiffness};
    return {density, density * v.x, density * v.y, density * v.z,
            energy_at_rest(density, pressure_) + 0.5 * density * norm2(v)};
  }
};

}  // namespace brisance::fluid
