// State redistribution of small cells (theory/coupling.md 4.3; Berger & Giuliani 2021).
#pragma once
#include "coupling/cut_cells/mixing.hpp"
#include "coupling/cut_cells/wall_slopes.hpp"

namespace brisance::coupling {

/// Every small cell with neighbours enough for half a cell has a neighbourhood M_i; each of its cells takes the mean
/// over the neighbourhoods it is in of their linear profiles. Rewrites `amount` of the cells of this rank, exactly
/// conservative over all ranks, and marks the small cells done with as settled; what is left, where a cell is empty,
/// covered or inadmissible, is for merging. The results are convex combinations of admissible states, profiles that
/// leave these are flattened. Depends on the cells within 8 of those of the rank. `record`: the geometry of the list.
void redistribute(fluid::Gas const& gas, WallRecord const& record, Real small_cell, ProfileKind kind,
                  std::vector<NearCell>& cells);

}  // namespace brisance::coupling
