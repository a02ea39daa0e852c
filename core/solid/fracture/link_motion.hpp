// Figures of a link that only some criteria want.
#pragma once
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// (|d| - D) / D of the line between the poles of the ends; at a wall, of the line from the pole to the face.
Real stretch(Solid const& solid, std::size_t link);

/// Speed at which the ends move apart and along each other at their face, m/s, from the half-step velocities.
Real gap_speed(Solid const& solid, std::size_t link);

/// Largest tensile stress over the face, Pa, of the linear distribution whose moment is the bending moment of the link:
/// sigma(y) = a . y with M2 a = n x M.
Real fibre_stress(Solid const& solid, std::size_t link);

}  // namespace brisance::solid
