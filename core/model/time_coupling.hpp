// How fluid and solid alternate within a step.
#pragma once

namespace brisance {

/// The three time couplings; all conserve, and differ in the boundary that the fluid meets at the end of a step.
/// Source: theory/coupling.md 1.8.
enum class TimeCoupling {
  lag,           ///< boundary predicted under the loads of the last step; loads of the new pressures on it
  semi,          ///< the same, repeated until boundary and loads agree
  explicit_load  ///< loads of the boundary at the start of the step, then the boundary follows the solid
};

}  // namespace brisance
