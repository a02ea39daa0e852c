// Flow::sweep: order of work of one sweep over the blocks of this rank.
#include <utility>

#include "fluid/flow.hpp"

namespace brisance::fluid {

CellBox box_of(Block& block, int dimension) {
  return {{block.component(0), block.component(1), block.component(2), block.component(3), block.component(4)},
          block.size(),
          block.stride(),
          dimension};
}

MixtureBox mixture_box_of(Block& block) {
  MixtureBox box{{}, block.size(), block.stride()};
  for (int q = 0; q < 7; ++q) box.u[static_cast<std::size_t>(q)] = block.component(q);
  return box;
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

/// True when the sweep would change no bit of the block; then its report is added as if it had been swept.
bool Flow::sleeps(std::size_t position, int direction, Real dt, SweepReport& total) {
  State const* const inside = uniform_.state(position);
  if (!inside) return false;
  State const *const low = ghosts_.end(position, 0), *const high = ghosts_.end(position, 1);
  if (!low || !high) return false;
  Block const& block = blocks_[position];
  if (marks(block)) return false;  // a shock is close
  CellIndex const size = block.size();
  Index const along = size[static_cast<std::size_t>(direction)];
  UniformSweeps::Outcome const& found = uniform_sweeps_.find(*inside, *low, *high, along);
  if (!found.unchanged) return false;
  total.signal_max = max(total.signal_max, found.face.signal_max);
  std::int64_t const cells = std::int64_t{size[0]} * size[1] * size[2];
  for (int side = 0; side < 2; ++side)
    if (grid_.neighbour(block.id(), direction, side) < 0)
      ledger_.add(direction, side, dt, grid_.face_area(direction),
                  sum_of_equal(side == 0 ? found.face.flux_low : found.face.flux_high, cells / along));
  ++saved_by_sleep_.block_sweeps_skipped;
  saved_by_sleep_.cell_sweeps_skipped += cells;
  return true;
}

void Flow::sweep_block(std::size_t position, int direction, Real dt, SweepReport& total) {
  Block& block = blocks_[position];
  CellIndex const size = block.size();
  ++saved_by_sleep_.block_sweeps;
  saved_by_sleep_.cell_sweeps += std::int64_t{size[0]} * size[1] * size[2];
  if (sleeps(position, direction, dt, total)) return;
  ghosts_.complete(position, direction);
  changed(position);
  SavedBlock& saved = saved_[position];
  if (sweeper_ && sweeper_->handles(block.id())) {
    keep_saved(position);
    merge(total, sweeper_->sweep(block, direction, dt), block.first(), grid_);
    return;
  }
  if (mixture_) {
    keep_saved(position);
    sweep_products(block, direction, dt, total);
    return;
  }
  CellBox box = box_of(block, grid_.dimension);
  if (CellLayer<std::uint8_t> const* const layer = marks(block))
    box.marks = layer->at(0, 0, 0), box.mark_stride = layer->stride();
  if (saved.untouched)
    for (int q = 0; q < 5; ++q) box.result[static_cast<std::size_t>(q)] = spare(position).component(q);
  SweepReport const report = sweep_box(order_, box, direction, dt / grid_.spacing[direction], gas_, options_);
  if (saved.untouched) std::swap(block, *saved.spare);
  saved.untouched = false;
  take(report, block, direction, dt, total);
}

/// Adds what the sweep of a block noticed, and what crossed the sides of the domain.
void Flow::take(SweepReport const& report, Block const& block, int direction, Real dt, SweepReport& total) {
  merge(total, report, block.first(), grid_);
  for (int side = 0; side < 2; ++side)
    if (grid_.neighbour(block.id(), direction, side) < 0) {
      if (side == 1) total.fallback_faces += report.fallback_faces_high_end;
      ledger_.add(direction, side, dt, grid_.face_area(direction), side == 0 ? report.flux_low : report.flux_high);
    }
}

void Flow::sweep_products(Block& block, int direction, Real dt, SweepReport& total) {
  MixtureBox box = mixture_box_of(block);
  if (CellLayer<std::uint8_t> const* const layer = marks(block))
    box.marks = layer->at(0, 0, 0), box.mark_stride = layer->stride();
  MixtureReport const report =
      sweep_mixture(order_, box, direction, dt / grid_.spacing[direction], *mixture_, options_);
  take(report, block, direction, dt, total);
  for (int side = 0; side < 2; ++side)
    if (grid_.neighbour(block.id(), direction, side) < 0)
      ledger_.add_products(side, dt, grid_.face_area(direction),
                           side == 0 ? report.products_low : report.products_high);
}

SweepReport Flow::sweep(int direction, Real dt, Real middle) {
  SweepReport total;
  if (sweeper_) sweeper_->prepare(direction, dt);
  look_at_blocks();
  uniform_sweeps_.begin(order_, grid_.dimension, direction, dt / grid_.spacing[direction], gas_, options_);
  ghosts_.start(direction, middle, sleep_ ? &uniform_ : nullptr);
  for (std::size_t const b : ghosts_.ready(direction)) sweep_block(b, direction, dt, total);
  ghosts_.finish(direction);
  for (std::size_t const b : ghosts_.waiting(direction)) sweep_block(b, direction, dt, total);
  return total;
}

}  // namespace brisance::fluid
