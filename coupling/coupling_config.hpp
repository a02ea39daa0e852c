// The scene's [coupling] section.
#pragma once
#include <optional>
#include <string>

#include "core/base/keys.hpp"
#include "core/model/time_coupling.hpp"

namespace brisance::coupling {

/// How the bodies meet a viscous gas (theory/fluid.md 5.3).
struct BodyWallConfig {
  bool slip = false;
  std::optional<double> temperature;  // K; not given: adiabatic
  Location at;
  static void keys(Keys<BodyWallConfig>& k) {
    k("slip", &BodyWallConfig::slip, "", "does the gas slide along the bodies?");
    k("temperature", &BodyWallConfig::temperature, "K", "of the bodies; not given: no heat passes").above(0);
  }
};

/// Moving cut cells (theory/coupling.md 1 to 5).
struct CutCellsConfig {
  double small_cell = 0.5;
  std::string small_cells = "merging";
  std::string wall_pressure = "half_riemann", load = "absolute";
  std::string profile = "constant";
  std::optional<BodyWallConfig> wall;
  Location at;
  static void keys(Keys<CutCellsConfig>& k) {
    k("small_cell", &CutCellsConfig::small_cell, "1", "cells with less than this fraction of fluid are small")
        .above(0)
        .at_most(0.5);
    k("small_cells", &CutCellsConfig::small_cells, "",
      "what becomes of them: merged with neighbours, or state redistribution among these, and merging where that fails")
        .one_of({"merging", "redistribution"});
    k("wall_pressure", &CutCellsConfig::wall_pressure, "",
      "pressure on the wall: that of the cell, or corrected by the half-Riemann factor chi*")
        .one_of({"cell", "half_riemann"});
    k("load", &CutCellsConfig::load, "",
      "pressure that the bodies feel: absolute: all of it; relative: what it differs by from fluid.ambient, so that a "
      "structure in still air is exactly at rest, as one that was built in that air")
        .one_of({"absolute", "relative"});
    k("profile", &CutCellsConfig::profile, "",
      "what varies within cut cells, as a quadratic profile fitted to the cells around: nothing or the density")
        .one_of({"constant", "density"});
    k("wall", &CutCellsConfig::wall, "",
      "fluid.viscosity: friction and heat at the bodies; not given: they hold the gas and pass no heat");
  }
};

/// What the fluid does to each body, as a table.
struct BodyLoadsConfig {
  Location at;
  static void keys(Keys<BodyLoadsConfig>&) {}
};

struct CouplingConfig {
  static constexpr int most_sub_steps = 64;  ///< where the scene gives no number
  std::optional<CutCellsConfig> cut_cells;
  std::optional<BodyLoadsConfig> body_loads;
  std::string scheme = "lag", light_solids = "limit";
  std::optional<int> sub_steps;
  Location at;
  int largest_sub_steps() const { return sub_steps.value_or(most_sub_steps); }
  TimeCoupling time_coupling() const {
    return scheme == "lag" ? TimeCoupling::lag : scheme == "semi" ? TimeCoupling::semi : TimeCoupling::explicit_load;
  }
  static void keys(Keys<CouplingConfig>& k) {
    k("scheme", &CouplingConfig::scheme, "",
      "how gas and solid alternate in a step: lag: on the boundary predicted under the last loads; semi: repeated "
      "until boundary and loads agree; explicit: loads of the boundary at the start of the step")
        .one_of({"lag", "semi", "explicit"});
    k("light_solids", &CouplingConfig::light_solids, "",
      "where a particle weighs less than 0.7 of the gas in a cell beside it: limit the step to that share of the "
      "gas's, "
      "or only warn at the start")
        .one_of({"limit", "warn"});
    k("sub_steps", &CouplingConfig::sub_steps, "",
      "steps of the solid in one of the gas; not given: as many as its stable step asks for, 64 at most")
        .above(0)
        .at_most(1000);
    k("cut_cells", &CouplingConfig::cut_cells, "", "conservative moving cut cells between [fluid] and [solid]");
    k("body_loads", &CouplingConfig::body_loads, "",
      "body_loads.csv: force, torque, impulse and energy that each body receives from the fluid, at every output time");
  }
};

}  // namespace brisance::coupling
