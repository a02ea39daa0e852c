#include "coupling/cut_cells/stage_account.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::CellIndex;
using fluid::State;

void StageAccount::look(Part part) {
  if (part != Part::diffusion && part != Part::sweep_x && part != Part::sweep_y && part != Part::sweep_z) return;
  States states;
  for (auto const& [id, wall] : sweeper_.blocks()) {
    Block const& block = *flow_.find(id);
    std::vector<State>& of_block = states[id];
    of_block.reserve(wall.before.size());
    for (Index k = 0; k < wall.size[2]; ++k)
      for (Index j = 0; j < wall.size[1]; ++j)
        for (Index i = 0; i < wall.size[0]; ++i) of_block.push_back(block.load(i, j, k));
  }
  swept_.emplace_back(part, std::move(states));
}

void StageAccount::begin_balance(std::span<CellIndex const> cells, WallRecord const& record, Amounts counted) {
  counted_ = std::move(counted);
  fluid::Grid const& grid = flow_.grid();
  std::vector<Amounts> held(swept_.size() + 1);  // at the start of the step, then after each part of it
  for (CellIndex const& c : cells) {
    if (record.solid(c)) continue;
    Index const id = grid.block_of(c);
    CellIndex const first = flow_.find(id)->first();
    WallBlock const& wall = sweeper_.blocks().at(id);
    std::size_t const at = wall.cell(c[0] - first[0], c[1] - first[1], c[2] - first[2]);
    Real const volume = record.main_volume(c);
    for (std::size_t n = 0; n < held.size(); ++n) {
      State const& u = n == 0 ? wall.before[at] : swept_[n - 1].second.at(id)[at];
      for (std::size_t q = 0; q < 5; ++q) held[n][q].add(volume * u[q]);
    }
  }
  for (std::size_t n = 0; n < swept_.size(); ++n) {
    Amounts change = held[n + 1];
    subtract(change, held[n]);
    stages_.shift(swept_[n].first, Part::mixing, change);
  }
}

void StageAccount::charge(Part part, Amounts const& counted) {
  Amounts change = counted;
  subtract(change, counted_);
  stages_.shift(Part::mixing, part, change);
  counted_ = counted;
}

std::size_t StageAccount::bytes() const {
  std::size_t bytes = sizeof(Amounts);
  for (auto const& [part, states] : swept_)
    for (auto const& [id, of_block] : states) bytes += of_block.capacity() * sizeof(State);
  return bytes;
}

}  // namespace brisance::coupling
