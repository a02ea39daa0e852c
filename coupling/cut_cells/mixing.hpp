// Conservative merging of small cells into groups, growing until every group is admissible (theory/coupling.md 4.2).
#pragma once
#include <span>
#include <string>
#include <vector>

#include "coupling/cut_cells/moments.hpp"
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// Cells near the wall with their contents, sorted by id: those of this rank and a halo of others.
struct NearCell {
  GlobalId id = 0;
  CellIndex cell{};
  Real volume = 0;                                ///< fluid, m3
  Real volume_before = 0;                         ///< at the start of the step, m3
  std::array<std::array<Real, 2>, 3> aperture{};  ///< fluid area of the faces, m2
  fluid::State amount{};                          ///< integral over the cell
  bool rewritten = false;                         ///< the balance changed it: it is judged
  bool mine = false;
  Moments region{};      ///< of the fluid about the centre of the cell; needed where groups get profiles
  Index unit = 0;        ///< of a cell with parts; the list is sorted by (id, unit)
  bool linked = false;   ///< its neighbours are those of NearLink, not those of the grid
  Index share = -1;      ///< units of its cell with the same number share their gas; -1: none does
  bool settled = false;  ///< state redistribution has done with it: it is not merged for its size
  // results
  bool grouped = false;
  fluid::State mean{};  ///< of its group, when grouped
  Index group = -1;     ///< place in the list of the first member of its group, when grouped
};

/// A unit of a cell with parts, or of a cell beside it, and one that it opens to.
struct NearLink {
  GlobalId from;
  Index from_unit;
  GlobalId to;
  Index to_unit;
  int direction;
  Real area;  ///< m2
  friend bool operator<(NearLink const& a, NearLink const& b) {
    if (a.from != b.from || a.from_unit != b.from_unit)
      return a.from != b.from ? a.from < b.from : a.from_unit < b.from_unit;
    return a.to != b.to ? a.to < b.to : a.to_unit < b.to_unit;
  }
};

/// Cells beyond those of a rank within which the groups of its cells are built redundantly.
constexpr Index mixing_halo = 16;
/// Largest extent along an axis of a group that a rank can build with its halo alone.
constexpr Index largest_group = 14;

/// What the list holds: the cells of a rank and its halo, or those of all ranks.
enum class Sight { halo, everything };

struct Merging {
  std::string trouble;    ///< empty, or why and where no admissible grouping exists
  bool outgrown = false;  ///< a group of cells of this rank needs more than the halo: merge again with everything
};

/// Groups of small cells, and of whatever must join them to be admissible; fills `grouped` and `mean`. Independent of
/// the order of visit and, unless outgrown, of what else is in sight.
/// `links`: sorted, of the linked cells.
Merging merge_small_cells(fluid::Grid const& grid, Real small_cell, Sight sight, std::vector<NearCell>& cells,
                          std::span<NearLink const> links = {});

}  // namespace brisance::coupling
