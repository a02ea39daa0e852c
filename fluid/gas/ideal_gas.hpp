// Ideal gas in the general form of the theory: p = Gamma phi, phi = internal energy per volume.
#pragma once
#include <cmath>

#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Source: theory/fluid.md 1.2, 1.5.
struct IdealGas {
  static constexpr char const* name = "ideal";
  Real gamma = 1.4;
  Real vacuum_density = 0;  ///< kg/m3: at or below, a cell is vacuum (1e-10 of the reference density)
  Real vacuum_energy = 0;   ///< J/m3: phi at or below, a cell is vacuum (1e-12 p_ref / Gamma)

  Real kappa() const { return gamma - 1; }
  /// phi, J/m3. The same operations in the same order as the sweep, so that both agree on what is vacuum.
  Real internal_energy(State const& u) const {
    if (!(u[0] > 0)) return u[4];
    Real const inverse = 1 / u[0];
    Real const twice_kinetic = std::fma(u[1], u[1] * inverse, std::fma(u[2], u[2] * inverse, u[3] * (u[3] * inverse)));
    return std::fma(-0.5, twice_kinetic, u[4]);
  }
  bool vacuum(State const& u) const { return !(u[0] > vacuum_density) || !(internal_energy(u) > vacuum_energy); }
  /// Pa; 0 in vacuum.
  Real pressure(State const& u) const { return vacuum(u) ? 0 : kappa() * internal_energy(u); }
  /// m/s; 0 in vacuum.
  Real sound_speed(State const& u) const { return vacuum(u) ? 0 : std::sqrt(gamma * pressure(u) / u[0]); }
  State conserved(Real density, Vec3 const& v, Real pressure_) const {
    return {density, density * v.x, density * v.y, density * v.z, pressure_ / kappa() + 0.5 * density * norm2(v)};
  }
};

}  // namespace brisance::fluid
