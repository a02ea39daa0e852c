// The identities (G1) to (G3) of theory/coupling.md 1.5, asked of every cell after every step in debug builds.
#pragma once
#include <span>
#include <string>

#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

#ifdef BRISANCE_CHECKS
constexpr bool check_identities = true;
#else
constexpr bool check_identities = false;
#endif

/// What is wrong with the worst cell of `own` (boxes of a rank's blocks), with the cell and the size of the defect;
/// empty when closure, volume law and prisms hold to 1e-11 of a cell or face. `after` was reached from `before` in one
/// step.
std::string broken_identity(WallRecord const& before, WallRecord const& after, std::span<CellBox const> own);

}  // namespace brisance::coupling
