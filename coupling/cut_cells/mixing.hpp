// Conservative merging of small cells into groups, growing until every group is admissible (theory/coupling.md 4.2).
#pragma once
#include <string>
#include <vector>

#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// Cells near the wall with their contents, sorted by id: those of this rank and a halo of others.
struct NearCell {
  GlobalId id = 0;
  CellIndex cell{};
  Real volume = 0;         ///< fluid, m3
  fluid::State amount{};   ///< integral over the cell
  bool rewritten = false;  ///< the balance changed it: it is judged
  bool mine = false;
  // results
  bool grouped = false;
  fluid::State mean{};  ///< of its group, when grouped
};

/// Cells beyond those of a rank within which the groups of its cells are built redundantly.
constexpr Index mixing_halo = 16;
/// Largest extent of a group along an axis: what the halo allows, applied on any number of ranks.
constexpr Index largest_group = 14;

/// Groups of small cells, and of whatever must join them to be admissible; fills `grouped` and `mean`.
/// Returns an empty text, or why and where no admissible grouping exists. Independent of the order of visit and of
/// ranks.
std::string merge_small_cells(WallRecord const& record, Real small_cell, std::vector<NearCell>& cells);

}  // namespace brisance::coupling
