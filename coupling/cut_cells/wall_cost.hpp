// What the walls cost a rank since the program started: figures for the summary, never for a decision.
#pragma once
#include <chrono>
#include <cstdint>

#include "core/base/real.hpp"

namespace brisance::coupling {

struct WallCost {
  Real geometry_s = 0;  ///< clipping, fractions, swept volumes
  Real closest_s = 0;   ///< runs, closest points and images of the mirror states
  Real exchange_s = 0;  ///< triangles and velocities between ranks, waiting included
  std::int64_t steps = 0;
  std::int64_t cut = 0;     ///< cut cells of this rank's blocks, summed over the steps
  std::int64_t moving = 0;  ///< those that hold a piece that moved
  std::int64_t mixed = 0;   ///< those divided by a thin wall whose parts could not be followed and shared their gas
};

/// Adds the time of its life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(Real& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<Real>(Clock::now() - start_).count(); }
  Stopwatch(Stopwatch const&) = delete;
  Stopwatch& operator=(Stopwatch const&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Real& sum_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace brisance::coupling
