// Solids so light that the gas of a wall cell outweighs them: where they are, and what step still couples them stably
// (theory/coupling.md 1.8).
#pragma once
#include <string>
#include <vector>

#include "core/solid/surface.hpp"

namespace brisance::coupling {

/// Below this ratio of the mass of the solid per wetted area to that of the gas in one cell, the exchange of pressures
/// is unstable at the full step of the gas. Source: theory/coupling.md 1.8.
constexpr Real light_ratio = 0.7;

/// Mass per wetted area behind each element of the boundary, kg/m2, by element: that of its particle over all of its
/// boundary faces as seen along the normal of the element, so half of it on each side of a plate that is wet on both.
/// Infinite where the particle is held. In the reference state, which turns with the body.
std::vector<Real> areal_masses(solid::Surface const& surface, solid::Mesh const& mesh);

/// The place where the solid is lightest beside its gas.
struct LightestPlace {
  Real ratio = 1e300;       ///< of the areal masses of solid and gas
  Real solid = 0, gas = 0;  ///< kg/m2
  GlobalId element = -1;
  Vec3 where{};  ///< m
};

/// What a user should know of it; empty at or above light_ratio. `limited`: does the coupling shorten the step?
/// `cell_pressure`: walls feel the pressure of their cell, which nothing damps.
std::string describe(LightestPlace const& place, solid::Surface const& surface, solid::Mesh const& mesh, bool limited,
                     bool cell_pressure);

}  // namespace brisance::coupling
