// A [[output.gauge]] of the scene: where the gas is watched, how often, and what is written of it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fluid/flow_config.hpp"

namespace brisance::fluid {

struct GaugeConfig {
  std::string name;
  Vec3 position{};                         // m
  double interval = 0;                     // s
  std::vector<std::string> quantities;     // empty: all that the gas has
  std::optional<double> arrival_pressure;  // Pa
  Location at;
  static void keys(Keys<GaugeConfig>& k);
};

/// What the columns of a gauge may hold: those of `quantities`, else all that the gas has, in the order of the file.
std::vector<std::string> quantities(GaugeConfig const& gauge, GasConfig const& gas);

/// Checks what keys alone cannot.  Errors: scene errors naming the gauge: a name twice or unfit for a file, a position
/// outside the grid, more rows than a file should have, a temperature of a gas that is not ideal.
void check(std::vector<GaugeConfig> const& gauges, FlowConfig const& flow, Grid const& grid, Real end_time);

}  // namespace brisance::fluid
