// What merging and state redistribution ask of the cells near a wall.
#pragma once
#include <span>

#include "coupling/cut_cells/mixing.hpp"

namespace brisance::coupling {

/// Outside the admissible set beyond rounding.
bool inadmissible(Real volume, fluid::State const& m);

/// Holds no fluid that a state could stand for, or less than none where bodies overlap; `full`: volume of a cell, m3.
inline bool covered(NearCell const& c, Real full) { return c.volume <= covered_fraction * full; }

/// A list of cells sorted by id, seen as a part of the grid.
class NearCells {
 public:
  NearCells(fluid::Grid const& grid, std::vector<NearCell> const& cells, std::span<NearLink const> links = {})
      : grid_(grid), cells_(cells), links_(links) {}
  /// Place of a cell in the list; -1: not in it.
  Index find(CellIndex c) const;
  Index find(GlobalId cell, Index unit) const;
  /// What a linked cell opens to.
  std::span<NearLink const> links(NearCell const& c) const;
  /// A cell of a gap between walls lets its content out as fast as a full cell, when its faces are as open as it is,
  /// and its walls are not about to crush or to stretch it: it keeps its own state, and gas enters a crack cell by
  /// cell.
  bool drains(NearCell const& c) const;
  /// The larger cell that a small one joins: along the wall's normal, through the widest face, or through one that is
  /// inside out; -1: none. `taken`: not these again.
  Index target(Index i, std::span<Index const> taken) const;
  /// Cells are sorted by id and visited in any order: a tie goes to the lower one.
  static void consider(Index j, Real score, Index& best, Real& best_score) {
    if (best < 0 || score > best_score || (score == best_score && j < best)) best = j, best_score = score;
  }

 private:
  Index linked_target(Index i, std::span<Index const> taken) const;
  NearCell const& cell(Index i) const { return cells_[static_cast<std::size_t>(i)]; }
  fluid::Grid const& grid_;
  std::vector<NearCell> const& cells_;
  std::span<NearLink const> links_;
};

}  // namespace brisance::coupling
