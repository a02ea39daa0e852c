// How much of a cell the walls leave to the fluid, as the coupling tells it.
#pragma once
#include <functional>
#include <utility>

#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Fluid volumes of owned cells, m3; 0 in solid cells. Default: all cells are whole.
class FluidVolume {
 public:
  FluidVolume() = default;
  /// `of_cell` is asked in the blocks for which `cuts` is true; the cells of the others are whole.
  FluidVolume(std::function<Real(CellIndex)> of_cell, std::function<bool(Index block)> cuts)
      : of_cell_(std::move(of_cell)), cuts_(std::move(cuts)) {}

  /// Every block is asked.
  FluidVolume(std::function<Real(CellIndex)> of_cell) : FluidVolume(std::move(of_cell), [](Index) { return true; }) {}

  /// Do walls cut this block? The plain loops serve the others.
  bool cuts(Index block) const { return cuts_ && cuts_(block); }
  /// Expects: c lies in a block that is cut, or beside it.
  Real operator()(CellIndex c) const { return of_cell_(c); }

 private:
  std::function<Real(CellIndex)> of_cell_;
  std::function<bool(Index)> cuts_;
};

}  // namespace brisance::fluid
