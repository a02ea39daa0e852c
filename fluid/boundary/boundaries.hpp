// The family of boundary laws. `periodic` is not among them: it makes the two sides neighbours (Grid::periodic).
#pragma once
#include <array>
#include <functional>
#include <string>

#include "fluid/boundary/inflow.hpp"
#include "fluid/boundary/outflow.hpp"
#include "fluid/boundary/reflecting.hpp"
#include "fluid/flow_config.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::fluid {

/// Fills the ghosts of one side of a block, in the transverse range of its cells, from its own cells.
template <class Law>
void fill_ghosts(Law const& law, Block& block, int direction, int side) {
  std::size_t const d = static_cast<std::size_t>(direction);
  Index const n = block.size()[d];
  CellIndex begin{0, 0, 0}, end = block.size();
  end[d] = block.ghost()[d];
  CellIndex c{};
  for (c[2] = begin[2]; c[2] < end[2]; ++c[2])
    for (c[1] = begin[1]; c[1] < end[1]; ++c[1])
      for (c[0] = begin[0]; c[0] < end[0]; ++c[0]) {
        CellIndex from = c, to = c;
        Index const k = c[d];
        to[d] = side == 0 ? -1 - k : n + k;
        from[d] = side == 0 ? law.source(k) : n - 1 - law.source(k);
        block.store(to[0], to[1], to[2], law(block.load(from[0], from[1], from[2]), direction));
      }
}

/// What stands at the sides of the domain, chosen once when the scene is read.
class Boundaries {
 public:
  Boundaries(FlowConfig const& config, Gas const& gas);
  /// Fills the ghosts of a block whose `side` (0 low, 1 high) lies on the side of the domain.
  void fill(Block& block, int direction, int side) const { at(direction, side).fill(block, direction, side); }
  std::string const& law(int direction, int side) const { return at(direction, side).name; }
  /// Do the ghosts follow from the cells of their pencil (and the time) alone, wherever along the side they are? Then
  /// one pencil tells what a uniform block gets.
  bool same_along(int direction, int side) const { return at(direction, side).same_along; }

 private:
  struct Side {
    std::string name;
    bool same_along = true;
    std::function<void(Block&, int, int)> fill;
  };
  Side const& at(int direction, int side) const { return sides_[static_cast<std::size_t>(2 * direction + side)]; }
  std::array<Side, 6> sides_;
};

}  // namespace brisance::fluid
