// A given state enters.
#pragma once
#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// All ghosts hold the given conserved state.  Source: theory/fluid.md 6.
struct Inflow {
  static constexpr char const* name = "inflow";
  State given{};
  Index source(Index) const { return 0; }
  State operator()(State const&, int) const { return given; }
};

}  // namespace brisance::fluid
