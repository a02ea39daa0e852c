// A given state enters, constant or with a history.
#pragma once
#include "fluid/boundary/ghost_cell.hpp"
#include "fluid/boundary/time_table.hpp"
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// All ghosts hold the given conserved state.  Source: theory/fluid.md 6.
struct Inflow {
  static constexpr char const* name = "inflow";
  State given{};
  Index source(Index) const { return 0; }
  State operator()(State const&, GhostCell const&) const { return given; }
};

/// Density, velocity and pressure as functions of time.
struct InflowHistory {
  TimeTable<5> table;  ///< density, u, v, w, pressure
  Gas gas;
  Inflow at(Real time) const {
    auto const [density, u, v, w, pressure] = table.at(time);
    return {gas.conserved(density, {u, v, w}, pressure)};
  }
};

}  // namespace brisance::fluid
