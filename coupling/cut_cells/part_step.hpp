// The parts of divided cells followed through a step: which part at t^n is which at t^{n+1}.
#pragma once
#include <span>
#include <vector>

#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// The units of a cell that is divided at t^n or t^{n+1}: first its parts at t^{n+1}, then those that are no more.
struct CellUnits {
  static constexpr std::size_t most = 2 * most_parts;
  CellIndex cell{};
  std::size_t count = 1, after = 1;  ///< units, parts at t^{n+1}
  std::size_t parts_before = 1;
  std::array<Index, most> before{};            ///< part at t^n of a unit; -1: it is new
  std::array<std::size_t, most_parts> unit{};  ///< of a part at t^n
  bool mixed = false;                          ///< no assignment fits: all of its parts share their gas
  std::array<Index, most> share{};             ///< units of equal numbers share their gas in this step; -1: no other
};

class PartStep {
 public:
  /// Matches the parts of cells within `near` so that every unit keeps the volume law (G2) with what the wall swept;
  /// where several assignments do, the one whose parts are bounded by the same triangles.
  void match(WallRecord const& before, WallRecord const& after, std::span<CellBox const> near, bool moved);
  void clear();
  bool empty() const { return cells_.empty(); }
  std::vector<CellUnits> const& cells() const { return cells_; }
  /// Null for a cell whose fluid is connected, before and after.
  CellUnits const* find(CellIndex const& c) const;
  std::size_t units(CellIndex const& c) const {
    CellUnits const* const u = find(c);
    return u ? u->count : 1;
  }
  /// The unit whose gas a piece of `after` touches.
  std::size_t unit_of(Index piece) const;
  /// The unit of cell `c` that a piece of `after` sweeps there.
  std::size_t swept_unit(CellIndex const& c, Index piece) const;
  std::size_t bytes() const { return cells_.capacity() * sizeof(CellUnits) + places_.bytes(); }

 private:
  /// A part of a cell at t^{n+1} (`after`) or at t^n.
  struct Label {
    bool after;
    std::size_t part;
  };
  Label label(CellIndex const& c, Index piece) const;
  struct Work;
  void settle(Work& work);
  /// Units that make up the cell only together, as where a part splits or parts join.
  void join(Work& work);

  WallRecord const* before_ = nullptr;
  WallRecord const* after_ = nullptr;
  std::vector<CellUnits> cells_;  ///< by key
  CellPlaces places_;
};

}  // namespace brisance::coupling
