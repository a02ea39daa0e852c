#include "fluid/flow.hpp"

#include <algorithm>
#include <utility>

namespace brisance::fluid {
namespace {

std::vector<Block> owned_blocks(Grid const& grid, std::vector<int> const& owner, int rank, Index depth) {
  std::vector<Block> blocks;
  for (Index b = 0; b < grid.block_count(); ++b)
    if (owner[static_cast<std::size_t>(b)] == rank) blocks.emplace_back(grid, b, depth);
  return blocks;
}

}  // namespace

Flow::Flow(FlowConfig const& config, Grid grid, std::vector<int> owner, parallel::Comm& comm)
    : grid_(std::move(grid)),
      gas_(make_gas(config)),
      order_(config.order()),
      owner_(std::move(owner)),
      comm_(comm),
      blocks_(owned_blocks(grid_, owner_, comm.rank(), ghost_depth(order_))),
      boundaries_(config, gas_, grid_),
      ghosts_(grid_, owner_, blocks_, boundaries_, comm),
      options_(config.options()) {
  if (grid_.dimension > 1 && options_.shear_dissipation > 0)
    sensor_ = std::make_unique<ShockSensor>(grid_, owner_, blocks_, comm);
  GasState const& ambient = config.ambient;
  for (Block& block : blocks_) block.fill(gas_.conserved(ambient.density, ambient.velocity, ambient.pressure));
}

Block* Flow::find(Index block_id) {
  auto const at = std::lower_bound(blocks_.begin(), blocks_.end(), block_id,
                                   [](Block const& block, Index id) { return block.id() < id; });
  return at != blocks_.end() && at->id() == block_id ? &*at : nullptr;
}

void Flow::begin_step() {
  if (!sensor_) return;
  sensor_->update(
      blocks_, gas_, [this](Index block) { return sweeper_ && sweeper_->handles(block); },
      [this](Block const& block, Index i, Index j, Index k) { return sweeper_->is_fluid(block, i, j, k); });
}

void Flow::save() {
  saved_.resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    std::span<Real const> const all = std::as_const(blocks_[b]).storage();
    saved_[b].assign(all.begin(), all.end());
  }
  saved_ledger_ = ledger_;
}

void Flow::restore() {
  for (std::size_t b = 0; b < saved_.size(); ++b) std::ranges::copy(saved_[b], blocks_[b].storage().begin());
  ledger_ = saved_ledger_;
}

std::size_t Flow::bytes() const {
  std::size_t n = ghosts_.bytes() + (sensor_ ? sensor_->bytes() : 0);
  for (Block const& block : blocks_) n += block.bytes();
  for (std::vector<Real> const& copy : saved_) n += copy.capacity() * sizeof(Real);
  return n;
}

}  // namespace brisance::fluid
