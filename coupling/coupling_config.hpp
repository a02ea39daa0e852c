// The scene's [coupling] section.
#pragma once
#include <optional>
#include <string>

#include "core/base/keys.hpp"

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

/// Moving cut cells, time coupling `lag` (theory/coupling.md 1.8, 5).
struct CutCellsConfig {
  double small_cell = 0.5;
  std::string small_cells = "merging";
  std::string wall_pressure = "half_riemann";
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
    k("profile", &CutCellsConfig::profile, "",
      "what varies linearly within cut cells, for what passes partly open faces: nothing or the density")
        .one_of({"constant", "density"});
    k("wall", &CutCellsConfig::wall, "",
      "fluid.viscosity: friction and heat at the bodies; not given: they hold the gas and pass no heat");
  }
};

struct CouplingConfig {
  std::optional<CutCellsConfig> cut_cells;
  static void keys(Keys<CouplingConfig>& k) {
    k("cut_cells", &CouplingConfig::cut_cells, "", "conservative moving cut cells between [fluid] and [solid]");
  }
};

}  // namespace brisance::coupling
