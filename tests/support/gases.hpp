// The gases of theory/fluid.md 8, without vacuum thresholds.
#pragma once
#include "fluid/gas/gas.hpp"

namespace brisance::testing {

inline fluid::Gas ideal_gas(double gamma) { return {.gamma = gamma}; }
/// Water as a stiffened gas.
inline fluid::Gas water_gas() {
  fluid::Gas gas{.gamma = 4.4};
  gas.curve.stiffness = 6e8;
  return gas;
}
/// Products of TNT (Dobratz & Crawford 1985).
inline fluid::Gas tnt_products() {
  fluid::Gas gas{.gamma = 1.30};
  gas.curve = {0, 371.2e9, 3.231e9, 4.15, 0.95, 1630};
  return gas;
}

}  // namespace brisance::testing
