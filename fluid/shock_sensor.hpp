// Marks of the cells beside shocks: where shear waves get dissipation of their own in the sweeps across a shock, or a
// strong shock that runs along the grid breaks up (theory/fluid.md 2.7).
#pragma once
#include <functional>

#include "fluid/gas/mixture.hpp"
#include "fluid/layers.hpp"

namespace brisance::fluid {

/// Bit d of a cell's mark: a shock runs along direction d here or in the next cell along d.
class ShockSensor {
 public:
  ShockSensor(Grid const& grid, std::vector<int> const& owner, std::vector<Block> const& blocks, parallel::Comm& comm);

  /// The cells of the block at this position may have changed since the last update.
  void changed(std::size_t position) { changed_[position] = 1; }

  /// True where a cell of an owned block holds a state of the fluid; the others are skipped.
  using IsFluid = std::function<bool(Block const&, Index i, Index j, Index k)>;

  /// Collective. `mixture`: null without products. Marks from the cells as they are, at the start of a pair of steps.
  /// `has_walls`: blocks in which `is_fluid` must be asked.  Cost: one pass over the cells, two exchanges of thin
  /// layers. `uniform`: blocks, by position, that hold one state in all cells.
  void update(std::vector<Block> const& blocks, Gas const& gas, Mixture const* mixture,
              std::function<bool(Index)> const& has_walls, IsFluid const& is_fluid,
              std::function<bool(std::size_t)> const& uniform);

  /// Marks of the block at this position in the list of owned blocks, one ghost on every side; null: no mark within it
  /// and around it.
  CellLayer<std::uint8_t> const* marks(std::size_t position) const {
    return marked_[position] ? &marks_[position] : nullptr;
  }
  std::size_t bytes() const;

 private:
  bool mark(std::size_t position);
  bool steep_at_ends(std::size_t position) const;
  /// Takes the marks of a block away where the shock runs at an angle to the grid; returns whether any are left.
  bool drop_oblique(std::size_t position);
  bool any(CellLayer<std::uint8_t> const& layer) const;

  int dimension_;
  std::vector<CellLayer<Real>> pressure_;  // two ghosts; 0 where a pair must be skipped
  std::vector<CellLayer<std::uint8_t>> marks_;
  std::vector<char> marked_, changed_;
  std::vector<std::uint8_t> steep_;  // of the faces of one direction of a block
  LayerExchange<Real> exchange_pressure_;
  LayerExchange<std::uint8_t> exchange_marks_;
};

}  // namespace brisance::fluid
