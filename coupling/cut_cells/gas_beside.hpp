// The cells around a part of a cell that its gas comes to, where walls are thin enough to look through.
#pragma once
#include <cstdint>
#include <vector>

#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

class GasBeside {
 public:
  /// Cells within `reach` of the cell of a part, through openings no farther away than one cell more.
  void find(WallRecord const& record, CellIndex const& c, std::size_t part, Index reach);
  bool holds(CellIndex const& c) const;

  /// May another gas stand within `reach` of a cut cell? Where no wall there faces another way there is none.
  static bool possible(WallRecord const& record, CutCell const& cut, Index reach);

 private:
  std::size_t place(CellIndex const& c) const;
  CellBox box_{};
  std::vector<std::uint8_t> parts_;  ///< by cell: a bit for each part
  struct Unit {
    CellIndex cell;
    std::size_t part;
  };
  std::vector<Unit> met_;
};

}  // namespace brisance::coupling
