// Characteristic side: waves leave, and only what the ambient state sends comes in.
#pragma once
#include "fluid/boundary/ghost_cell.hpp"
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// All ghosts hold the state at the side between the last cell and the ambient state, both waves taken as isentropic:
/// by Riemann invariants (ideal and stiffened gas), else by linear characteristics at the last cell. Supersonic exit:
/// as outflow; supersonic entry: the ambient state. A cell equal to the ambient state gives that state bit for bit.
/// Source: theory/fluid.md 6; for ideal gas with the entering invariant at the entropy of the last cell, where the
/// theory takes that of the ambient state: the sides then send back less (F28), and hot gas leaves without a wave.
struct FarField {
  static constexpr char const* name = "far_field";
  static constexpr bool same_for_all_ghosts = true;
  Gas gas;
  State ambient{};
  Index source(Index) const { return 0; }
  State operator()(State const& inside, GhostCell const& ghost) const;
};

}  // namespace brisance::fluid
