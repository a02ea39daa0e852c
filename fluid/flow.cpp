#include "fluid/flow.hpp"

#include <algorithm>
#include <utility>

namespace brisance::fluid {
namespace {

std::vector<Block> owned_blocks(Grid const& grid, std::vector<int> const& owner, int rank, Index depth,
                                int components) {
  std::vector<Block> blocks;
  for (Index b = 0; b < grid.block_count(); ++b)
    if (owner[static_cast<std::size_t>(b)] == rank) blocks.emplace_back(grid, b, depth, components);
  return blocks;
}

}  // namespace

Flow::Flow(FlowConfig const& config, Grid grid, std::vector<int> owner, parallel::Comm& comm)
    : grid_(std::move(grid)),
      gas_(make_gas(config)),
      mixture_(make_mixture(config)),
      order_(config.order()),
      owner_(std::move(owner)),
      comm_(comm),
      blocks_(owned_blocks(grid_, owner_, comm.rank(), ghost_depth(order_), components())),
      boundaries_(config, gas_, grid_),
      ghosts_(grid_, owner_, blocks_, boundaries_, comm),
      options_(config.options()),
      splitting_(config.splitting()),
      sleep_(config.sleep && !mixture_),
      saved_(blocks_.size()),
      uniform_(blocks_.size()),
      surveys_(blocks_.size()) {
  if (grid_.dimension > 1 && options_.shear_dissipation > 0)
    sensor_ = std::make_unique<ShockSensor>(grid_, owner_, blocks_, comm);
  GasState const& ambient = config.ambient;
  ambient_ = gas_.conserved(ambient.density, ambient.velocity, ambient.pressure);
  for (Block& block : blocks_) block.fill(ambient_);
}

std::vector<Block>& Flow::blocks() {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    keep_saved(b);
    changed(b);
  }
  return blocks_;
}

void Flow::changed(std::size_t position) {
  uniform_.changed(position);
  surveys_[position].reset();
  if (sensor_) sensor_->changed(position);
}

Survey const& Flow::survey(std::size_t position) const {
  std::optional<Survey>& seen = surveys_[position];
  if (!seen) seen = mixture_ ? survey_mixture(blocks_[position], *mixture_) : fluid::survey(blocks_[position], gas_);
  return *seen;
}

std::size_t Flow::position(Index block_id) const {
  auto const at = std::lower_bound(blocks_.begin(), blocks_.end(), block_id,
                                   [](Block const& block, Index id) { return block.id() < id; });
  return static_cast<std::size_t>((at != blocks_.end() && at->id() == block_id ? at : blocks_.end()) - blocks_.begin());
}

Block* Flow::find(Index block_id) {
  std::size_t const b = position(block_id);
  if (b == blocks_.size()) return nullptr;
  keep_saved(b);
  changed(b);
  return &blocks_[b];
}

Block const* Flow::find(Index block_id) const {
  std::size_t const b = position(block_id);
  return b == blocks_.size() ? nullptr : &blocks_[b];
}

void Flow::look_at_blocks() {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    bool const may_sleep = sleep_ && !(sweeper_ && sweeper_->handles(blocks_[b].id()));
    may_sleep ? uniform_.look(b, blocks_[b]) : uniform_.changed(b);
  }
}

void Flow::begin_pair() {
  if (!sensor_) return;
  look_at_blocks();
  sensor_->update(
      blocks_, gas_, mixture(), [this](Index block) { return sweeper_ && sweeper_->handles(block); },
      [this](Block const& block, Index i, Index j, Index k) { return sweeper_->is_fluid(block, i, j, k); },
      [this](std::size_t position) { return uniform_.state(position) != nullptr; });
}

void Flow::save() {
  for (SavedBlock& saved : saved_) saved.untouched = true;
  saved_ledger_ = ledger_;
}

Block& Flow::spare(std::size_t position) {
  std::optional<Block>& spare = saved_[position].spare;
  if (!spare) {
    Block const& block = blocks_[position];
    spare.emplace(grid_, block.id(), ghost_depth(order_), components());
    spare->fill(ambient_);
  }
  return *spare;
}

/// Called before the cells of a block are written to in place.
void Flow::keep_saved(std::size_t position) {
  if (!saved_[position].untouched) return;
  std::ranges::copy(std::as_const(blocks_[position]).storage(), spare(position).storage().begin());
  saved_[position].untouched = false;
}

void Flow::restore() {
  for (std::size_t b = 0; b < saved_.size(); ++b) {
    SavedBlock& saved = saved_[b];
    if (saved.untouched || !saved.spare) continue;
    std::swap(blocks_[b], *saved.spare);
    saved.untouched = true;
    changed(b);
  }
  ledger_ = saved_ledger_;
}

std::size_t Flow::bytes() const {
  std::size_t n = ghosts_.bytes() + (sensor_ ? sensor_->bytes() : 0);
  for (Block const& block : blocks_) n += block.bytes();
  for (SavedBlock const& saved : saved_) n += saved.spare ? saved.spare->bytes() : 0;
  return n;
}

}  // namespace brisance::fluid
