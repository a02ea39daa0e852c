// Peak pressures, impulses and times of the air blast of TNT over scaled distance.
#pragma once
#include <string>

#include "core/base/real.hpp"

namespace brisance::solid {

/// The blast of 1 kg of TNT at a scaled distance.  Units: Pa, Pa s / kg^(1/3), s / kg^(1/3).
struct ScaledBlast {
  Real incident_pressure = 0, reflected_pressure = 0;
  Real incident_impulse = 0, reflected_impulse = 0;
  Real arrival = 0, duration = 0;  ///< of the positive phase
};

enum class Burst { air, surface };  ///< sphere in free air; hemisphere on the ground

/// Scaled distances for which all six curves are published, m / kg^(1/3).
struct ScaledRange {
  Real low, high;
};
ScaledRange range_of(Burst burst);

/// Source: C. N. Kingery, G. Bulmash, Airblast parameters from TNT spherical air burst and hemispherical surface burst,
/// ARBRL-TR-02555 (1984); the curves of UFC 3-340-02, figures 2-7 and 2-15.
/// Expects: a scaled distance (m / kg^(1/3)) within range_of.
ScaledBlast kingery_bulmash(Burst burst, Real scaled_distance);

}  // namespace brisance::solid
