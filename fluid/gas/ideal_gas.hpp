// Ideal gas in the general form of the theory: p = Gamma phi, phi = internal energy per volume.
#pragma once
#include <cmath>

#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Source: theory/fluid.md 1.2, 1.5.
struct IdealGas {
  static constexpr char const* name = "ideal";
  Real gamma = 1.4;
  Real vacuum_density = 0;   ///< kg/m3: at or below, a cell is vacuum (1e-10 of the reference density)
  Real vacuum_energy = 0;    ///< J/m3: phi at or below, a cell is vacuum (1e-12 p_ref / Gamma)

  Real kappa() const { return gamma - 1; }
  Real internal_energy(State const& u) const {
    return u[0] > 0 ? u[4] - 0.5 * (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / u[0] : u[4];
  }
  bool vacuum(State const& u) const {
    return !(u[0] > vacuum_density) || !(internal_energy(u) > vacuum_energy);
  }
  /// Pa; 0 in vacuum.
  Real pressure(State const& u) const { return vacuum(u) ? 0 : kappa() * internal_energy(u); }
  /// m/s; 0 in vacuum.
  Real sound_speed(State const& u) const { return vacuum(u) ? 0 : std::sqrt(gamma * pressure(u) / u[0]); }
  State conserved(Real density, Vec3 const& v, Real pressure_) const {
    return {density, density * v.x, density * v.y, density * v.z, pressure_ / kappa() + 0.5 * density * norm2(v)};
  }
};

}  // namespace brisance::fluid
