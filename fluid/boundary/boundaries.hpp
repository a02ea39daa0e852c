// The family of boundary laws. `periodic` is not among them: it makes the two sides neighbours (Grid::periodic).
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "fluid/boundary/laws.hpp"
#include "fluid/flow_config.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::fluid {

/// Which ghosts of a side: how many layers, and how far beyond the cells of the block in the other directions.
struct GhostRange {
  Index depth;
  CellIndex margin{0, 0, 0};
};

/// Fills the ghosts of one side of a block from its own cells, and from its other ghosts within the margin; of a patch
/// only the pencils for which `where(global cell)` holds.
template <class Law, class Where>
void fill_ghosts(Law const& law, Block& block, int direction, int side, GhostRange const& range, Where const& where) {
  std::size_t const d = static_cast<std::size_t>(direction);
  Index const n = block.size()[d];
  CellIndex const first = block.first();
  CellIndex begin{0, 0, 0}, end = block.size();
  for (std::size_t e = 0; e < 3; ++e) begin[e] -= range.margin[e], end[e] += range.margin[e];
  begin[d] = 0, end[d] = range.depth;
  CellIndex c{};
  for (c[2] = begin[2]; c[2] < end[2]; ++c[2])
    for (c[1] = begin[1]; c[1] < end[1]; ++c[1])
      for (c[0] = begin[0]; c[0] < end[0]; ++c[0]) {
        CellIndex from = c, to = c;
        Index const k = c[d];
        to[d] = side == 0 ? -1 - k : n + k;
        GhostCell const ghost{direction, side, {first[0] + to[0], first[1] + to[1], first[2] + to[2]}};
        if (!where(ghost.global)) continue;
        if constexpr (requires { Law::same_for_all_ghosts; })
          if (k > 0) {
            from[d] = side == 0 ? -1 : n;
            block.store(to[0], to[1], to[2], block.load(from[0], from[1], from[2]));
            continue;
          }
        from[d] = side == 0 ? law.source(k) : n - 1 - law.source(k);
        block.store(to[0], to[1], to[2], law(block.load(from[0], from[1], from[2]), ghost));
      }
}
/// All ghosts of a side, in the transverse range of the block's cells.
template <class Law>
void fill_ghosts(Law const& law, Block& block, int direction, int side) {
  fill_ghosts(law, block, direction, side, {block.ghost()[static_cast<std::size_t>(direction)]},
              [](CellIndex const&) { return true; });
}

/// What stands at the sides of the domain, chosen once when the scene is read.
class Boundaries {
 public:
  /// `grid` must outlive this.
  Boundaries(FlowConfig const& config, Gas const& gas, Grid const& grid);
  /// Fills the ghosts of a block whose `side` (0 low, 1 high) lies on the side of the domain, with the laws of `time`:
  /// the middle of the step, s (theory/fluid.md 6).
  void fill(Block& block, int direction, int side, Real time) const {
    fill(block, direction, side, time, {block.ghost()[static_cast<std::size_t>(direction)]});
  }
  void fill(Block& block, int direction, int side, Real time, GhostRange const& range) const;
  /// Does a patch of the side take the face beside this cell or ghost?
  bool patched(int direction, int side, CellIndex const& c) const;
  std::string const& law(int direction, int side) const { return at(direction, side).whole.name; }
  /// Largest |u_d| + c of the states given at the sides along `direction` between two times, m/s; 0 without any.
  Real signal_speed(int direction, Real from, Real to) const;
  /// Do the ghosts follow from the cells of their pencil (and the time) alone, wherever along the side they are? Then
  /// one pencil tells what a uniform block gets.
  bool same_along(int direction, int side) const {
    return at(direction, side).whole.same_along && at(direction, side).patches.empty();
  }

 private:
  struct Law {
    std::string name;
    std::function<void(Block&, int, int, Real, GhostRange const&)> fill;
    std::function<Real(int, Real, Real)> signal;  // of the states it gives, if it gives any
    bool same_along = true;                       // false: depends on where along the side it is
  };
  struct Side {
    Law whole;
    std::vector<Law> patches;
    std::vector<std::function<bool(CellIndex const&)>> patched;
  };
  template <class Where>
  static Law make(LawOfSide const& given, FlowConfig const& config, Gas const& gas, Grid const& grid,
                  Where const& where);
  Side& at(int direction, int side) { return sides_[static_cast<std::size_t>(2 * direction + side)]; }
  Side const& at(int direction, int side) const { return sides_[static_cast<std::size_t>(2 * direction + side)]; }
  std::array<Side, 6> sides_;
};

}  // namespace brisance::fluid
