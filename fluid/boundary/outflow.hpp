// Open side: the upwind flux itself is the characteristic boundary.
#pragma once
#include "fluid/boundary/ghost_cell.hpp"

namespace brisance::fluid {

/// All ghosts copy the last cell.  Source: theory/fluid.md 6.
struct Outflow {
  static constexpr char const* name = "outflow";
  Index source(Index) const { return 0; }
  State operator()(State const& u, GhostCell const&) const { return u; }
};

}  // namespace brisance::fluid
