#include "tests/support/held_cells.hpp"

namespace brisance::testing {

using fluid::Block;
using fluid::CellIndex;
using fluid::Flow;
using fluid::State;

namespace {

/// Block and local place of a global cell.
std::pair<Block*, CellIndex> place(Flow& flow, CellIndex c) {
  Block* const block = flow.find(flow.grid().block_of(c));
  CellIndex const first = block->first();
  return {block, {c[0] - first[0], c[1] - first[1], c[2] - first[2]}};
}

}  // namespace

State load(Flow const& flow, CellIndex c) {
  auto const [block, at] = place(const_cast<Flow&>(flow), c);
  return block->load(at[0], at[1], at[2]);
}

void store(Flow& flow, CellIndex c, State const& u) {
  auto const [block, at] = place(flow, c);
  block->store(at[0], at[1], at[2], u);
}

HeldCells::HeldCells(Flow& flow, fluid::FlowClock const& clock, Held held)
    : flow_(flow), clock_(clock), held_(std::move(held)) {
  CellIndex c, n = flow.grid().cells;
  for (c[2] = 0; c[2] < n[2]; ++c[2])
    for (c[1] = 0; c[1] < n[1]; ++c[1])
      for (c[0] = 0; c[0] < n[0]; ++c[0])
        if (holds(c)) cells_.push_back(c);
  flow.set_sweeper(this);
}

HeldCells::~HeldCells() { flow_.set_sweeper(nullptr); }

void HeldCells::prepare(int, Real dt) {
  int const dimension = flow_.grid().dimension, all = dimension * fluid::steps_per_pair(dimension);
  if (sweeps_ == 0) {
    if (clock_.step == last_step_)
      added_ = saved_;
    else
      saved_ = added_;
    last_step_ = clock_.step;
  }
  Real const time = clock_.time + (sweeps_ / dimension + 0.5) * dt;
  sweeps_ = (sweeps_ + 1) % all;
  Real const volume = flow_.grid().cell_volume();
  for (CellIndex const c : cells_) {
    State const old = load(flow_, c), now = held_.state(flow_, c, time);
    for (std::size_t q = 0; q < 5; ++q) {  // apart, because a difference would be rounded
      added_[q].add(now[q] * volume);
      added_[q].add(-(old[q] * volume));
    }
    store(flow_, c, now);
  }
}

State HeldCells::added() const {
  State sum;
  for (std::size_t q = 0; q < 5; ++q) sum[q] = added_[q].value();
  return sum;
}

}  // namespace brisance::testing
