#include "fluid/gauges/gauge_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/errors.hpp"

namespace brisance::fluid {
namespace {

constexpr double most_rows = 1e8;

bool fits_file_name(std::string const& name) {
  auto const plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), plain);
}

}  // namespace

void GaugeConfig::keys(Keys<GaugeConfig>& k) {
  k("name", &GaugeConfig::name, "", "its file is gauges/NAME.csv: letters, digits, and - _ . inside").required();
  k("position", &GaugeConfig::position, "m", "where it stands; it does not move").required();
  k("interval", &GaugeConfig::interval, "s", "time between two rows, at its multiples whatever the time step")
      .required()
      .above(0);
  k("quantities", &GaugeConfig::quantities, "", "columns to write; not given: all, temperature for an ideal gas only")
      .one_of({"density", "pressure", "overpressure", "velocity", "temperature", "dynamic_pressure", "impulse"});
  k("arrival_pressure", &GaugeConfig::arrival_pressure, "Pa",
    "overpressure, of either sign, that counts as the arrival of a wave; not given: 1 % of the ambient pressure")
      .above(0);
}

std::vector<std::string> quantities(GaugeConfig const& gauge, GasConfig const& gas) {
  if (!gauge.quantities.empty()) return gauge.quantities;
  std::vector<std::string> all{"density", "pressure", "overpressure", "velocity"};
  if (gas.law == "ideal") all.push_back("temperature");
  all.insert(all.end(), {"dynamic_pressure", "impulse"});
  return all;
}

void check(std::vector<GaugeConfig> const& gauges, FlowConfig const& flow, Grid const& grid, Real end_time) {
  std::set<std::string> names;
  for (GaugeConfig const& gauge : gauges) {
    std::string const who = "output.gauge \"" + gauge.name + "\"";
    require(fits_file_name(gauge.name), gauge.at,
            who + ": its name becomes a file: use letters, digits, and - _ . inside");
    require(names.insert(gauge.name).second, gauge.at, who + " is there twice: give every gauge a name of its own");
    for (int d = 0; d < 3; ++d) {
      Real const low = d < grid.dimension ? flow.low[d] : 0, high = d < grid.dimension ? flow.high[d] : 0;
      Real const x = gauge.position[d];
      require(
          x >= low && x <= high, gauge.at,
          fmt::format("{} stands at {} = {:g} m, outside the grid, which reaches from {:g} to {:g} m: move it inside",
                      who, "xyz"[d], x, low, high));
    }
    require(end_time / gauge.interval <= most_rows, gauge.at,
            fmt::format("{} would write {:.2g} rows by end_time: raise its interval", who, end_time / gauge.interval));
    bool const temperature = std::count(gauge.quantities.begin(), gauge.quantities.end(), "temperature") > 0;
    require(!temperature || flow.gas.law == "ideal", gauge.at,
            who + ": only an ideal gas has a temperature: leave it out of quantities");
    require(gauge.arrival_pressure || flow.ambient.pressure > 0, gauge.at,
            who + ": the ambient pressure is 0, so 1 % of it marks no arrival: give arrival_pressure");
  }
}

}  // namespace brisance::fluid
