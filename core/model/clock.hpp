// Time of the simulation.
#pragma once
#include <cstdint>

#include "core/base/real.hpp"

namespace brisance {

struct Clock {
  std::int64_t step = 0;  ///< completed steps; also the place in the sequence of sweep directions
  Real time = 0;          ///< s
  Real dt = 0;            ///< s, of the step under way; held within a pair
  int sub_steps = 1;      ///< of the solid in a step
  int sub_step = 0;       ///< the one under way: in its stages `time` and `dt` are those of the sub-step
};

}  // namespace brisance
