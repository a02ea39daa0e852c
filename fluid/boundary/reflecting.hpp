// Slip wall at rest.
#pragma once
#include "fluid/boundary/ghost_cell.hpp"

namespace brisance::fluid {

/// Ghost k copies the k-th cell inside with its normal momentum negated.  Source: theory/fluid.md 6.
struct Reflecting {
  static constexpr char const* name = "reflecting";
  /// Distance of the source cell from the side, in cells.
  Index source(Index ghost) const { return ghost; }
  State operator()(State u, GhostCell const& ghost) const {
    u[ghost.normal()] = -u[ghost.normal()];
    return u;
  }
};

}  // namespace brisance::fluid
