// Cells beyond the edge of a test's domain that hold a given state: ghosts of any law, in time and place.
#pragma once
#include <functional>
#include <vector>

#include "fluid/advance.hpp"
#include "parallel/exact_sum.hpp"

namespace brisance::testing {

/// Which cells are held, and what they hold at a time. Both see the whole flow, so that a cell may mirror another.
struct Held {
  std::function<bool(fluid::Grid const&, fluid::CellIndex)> where;
  std::function<fluid::State(fluid::Flow const&, fluid::CellIndex, Real)> state;
};

/// Writes the held cells before every sweep, at the time of the middle of its step (theory/fluid.md 6), and accounts
/// for what that adds. Registers itself as the sweeper of no block. Expects: serial flow, driven by advance() with
/// `clock`.
class HeldCells final : public fluid::BlockSweeper {
 public:
  HeldCells(fluid::Flow& flow, fluid::FlowClock const& clock, Held held);
  ~HeldCells() override;
  bool handles(Index) const override { return false; }
  void prepare(int direction, Real dt) override;
  fluid::SweepReport sweep(fluid::Block&, int, Real) override { return {}; }
  bool is_fluid(fluid::Block const&, Index, Index, Index) const override { return true; }

  bool holds(fluid::CellIndex c) const { return held_.where(flow_.grid(), c); }
  /// What was written less what stood there, over all accepted pairs: kg, kg m/s, J (2D: per metre).
  fluid::State added() const;

 private:
  using Sums = std::array<parallel::ExactSum, 5>;
  fluid::Flow& flow_;
  fluid::FlowClock const& clock_;
  Held held_;
  std::vector<fluid::CellIndex> cells_;
  int sweeps_ = 0;               // of the pair under way
  std::int64_t last_step_ = -1;  // step at which the last pair began: the same again after a rejection
  Sums added_, saved_;
};

/// Mean state of a cell anywhere in the flow.
fluid::State load(fluid::Flow const& flow, fluid::CellIndex c);
void store(fluid::Flow& flow, fluid::CellIndex c, fluid::State const& u);

}  // namespace brisance::testing
