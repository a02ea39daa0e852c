// summary.json of the contract.
#pragma once
#include <limits>
#include <string>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

struct RunState {
  std::string scene;
  std::string exit = "running";  ///< running, done, stopped, failed
  double setup_s = 0, wall_s = 0;
  Real density_min = std::numeric_limits<Real>::infinity(), pressure_min = density_min, mach_max = 0;  ///< over the run
};

/// Collective. Extremes of the present state join those of the run.
void update_extrema(World& world, RunState& run);

/// Collective. Writes DIR/summary.json atomically.
void write_summary(World& world, RunState const& run, std::string const& directory);

}  // namespace brisance::drivers
