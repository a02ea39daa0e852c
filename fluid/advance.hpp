// A fluid without anything else, advanced to a time: the step loop of pure-fluid cases.
#pragma once
#include <cstdint>
#include <limits>

#include "fluid/flow.hpp"
#include "fluid/time_step.hpp"

namespace brisance::fluid {

/// Where a run of a fluid alone stands. Counts are the same on all ranks.
struct FlowClock {
  Real time = 0;          ///< s
  std::int64_t step = 0;  ///< chooses the sequence of sweeps
  Retry retry;
  std::int64_t fallback_faces = 0;  ///< of accepted pairs
  Real courant_max = 0;             ///< largest sigma (|u| + c) met in a sweep of an accepted pair
};

struct AdvanceLimits {
  Real end;  ///< s, hit exactly
  Real cfl;  ///< nominal Courant number
  std::int64_t steps =
      std::numeric_limits<std::int64_t>::max();         ///< stop at this step number or the next end of a pair
  Real dt_max = std::numeric_limits<Real>::infinity();  ///< s
};

/// Collective. Pairs of steps until the end; a pair with bad health is undone and repeated with half the time step.
/// Source: theory/fluid.md 3, 4.6.  Errors: numerical, naming the cell and the cause, after ten halvings.
void advance(Flow& flow, FlowClock& clock, AdvanceLimits const& limits);

}  // namespace brisance::fluid
