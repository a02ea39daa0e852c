// Flow::sweep: order of work of one sweep over the blocks of this rank.
#include "fluid/flow.hpp"

namespace brisance::fluid {

CellBox box_of(Block& block, int dimension) {
  return {{block.component(0), block.component(1), block.component(2), block.component(3), block.component(4)},
          block.size(),
          block.stride(),
          dimension};
}

void merge(SweepReport& total, SweepReport const& report, CellIndex first, Grid const& grid) {
  total.signal_max = max(total.signal_max, report.signal_max);
  total.fallback_faces += report.fallback_faces;
  if (report.health != 0) {
    CellIndex const where{first[0] + report.where[0], first[1] + report.where[1], first[2] + report.where[2]};
    if (total.health == 0 || grid.cell_id(where) < grid.cell_id(total.where)) total.where = where;
  }
  total.health |= report.health;
}

void Flow::sweep_block(Block& block, int direction, Real dt, SweepReport& total) {
  if (sweeper_ && sweeper_->handles(block.id())) {
    merge(total, sweeper_->sweep(block, direction, dt), block.first(), grid_);
    return;
  }
  CellBox box = box_of(block, grid_.dimension);
  if (CellLayer<std::uint8_t> const* const layer = marks(block))
    box.marks = layer->at(0, 0, 0), box.mark_stride = layer->stride();
  SweepReport const report = sweep_box(order_, box, direction, dt / grid_.spacing[direction], gas_, options_);
  merge(total, report, block.first(), grid_);
  for (int side = 0; side < 2; ++side)
    if (grid_.neighbour(block.id(), direction, side) < 0) {
      if (side == 1) total.fallback_faces += report.fallback_faces_high_end;
      ledger_.add(direction, side, dt, grid_.face_area(direction), side == 0 ? report.flux_low : report.flux_high);
    }
}

SweepReport Flow::sweep(int direction, Real dt, Real middle) {
  SweepReport total;
  if (sweeper_) sweeper_->prepare(direction, dt);
  ghosts_.start(direction, middle);
  for (std::size_t const b : ghosts_.ready(direction)) sweep_block(blocks_[b], direction, dt, total);
  ghosts_.finish(direction);
  for (std::size_t const b : ghosts_.waiting(direction)) sweep_block(blocks_[b], direction, dt, total);
  return total;
}

}  // namespace brisance::fluid
