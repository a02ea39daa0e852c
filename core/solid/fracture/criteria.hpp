// The family of fracture criteria: to add one, write a law beside these and name it in this file and in LawConfig.
#pragma once
#include <variant>

#include "core/solid/fracture/cohesive.hpp"
#include "core/solid/fracture/elongation.hpp"
#include "core/solid/fracture/energy_release.hpp"
#include "core/solid/fracture/stress.hpp"

namespace brisance::solid {

using Criterion = std::variant<Elongation, MixedStress, MohrCoulomb, EnergyRelease, Cohesive>;

}  // namespace brisance::solid
