#include "coupling/cut_cells/state_gather.hpp"

#include <algorithm>
#include <map>

namespace brisance::coupling {

StateGather::Local StateGather::locate(GlobalId cell) const {
  fluid::Grid const& grid = flow_->grid();
  GlobalId const nx = grid.cells[0], ny = grid.cells[1];
  fluid::CellIndex const c{static_cast<Index>(cell % nx), static_cast<Index>(cell / nx % ny),
                           static_cast<Index>(cell / (nx * ny))};
  fluid::Block const* const block = std::as_const(*flow_).find(grid.block_of(c));
  if (!block) return {nullptr, 0, 0, 0};
  fluid::CellIndex const first = block->first();
  return {block, c[0] - first[0], c[1] - first[1], c[2] - first[2]};
}

void StateGather::plan(parallel::Comm& comm, fluid::Flow& flow, std::vector<GlobalId> wanted) {
  flow_ = &flow;
  wanted_ = std::move(wanted);
  values_.resize(wanted_.size());
  here_.clear();
  asked_.clear();
  asks_.clear();
  std::map<int, std::vector<Index>> remote;
  fluid::Grid const& grid = flow.grid();
  GlobalId const nx = grid.cells[0], ny = grid.cells[1];
  for (std::size_t s = 0; s < wanted_.size(); ++s) {
    Local const local = locate(wanted_[s]);
    if (local.block) {
      here_.emplace_back(static_cast<Index>(s), local);
    } else {
      GlobalId const id = wanted_[s];
      int const owner = flow.owner(grid.block_of(
          {static_cast<Index>(id % nx), static_cast<Index>(id / nx % ny), static_cast<Index>(id / (nx * ny))}));
      remote[owner].push_back(static_cast<Index>(s));
    }
  }
  if (comm.size() == 1) return;
  std::vector<parallel::Message> out;
  for (auto& [rank, slots] : remote) {
    parallel::Message message{rank, {}};
    for (Index const s : slots) parallel::put(message.data, wanted_[static_cast<std::size_t>(s)]);
    out.push_back(std::move(message));
    asked_.emplace_back(rank, std::move(slots));
  }
  for (parallel::Message const& message : comm.deliver(std::move(out))) {
    std::vector<Local> cells;
    for (std::span<std::byte const> in(message.data); !in.empty();)
      cells.push_back(locate(parallel::take<GlobalId>(in)));
    asks_.emplace_back(message.rank, std::move(cells));
  }
}

void StateGather::refresh(parallel::Comm& comm, ReadCell const& read) {
  for (auto const& [slot, cell] : here_)
    values_[static_cast<std::size_t>(slot)] = read(*cell.block, cell.i, cell.j, cell.k);
  if (comm.size() == 1) return;
  std::vector<parallel::Message> out;
  for (auto const& [rank, cells] : asks_) {
    parallel::Message message{rank, {}};
    for (Local const& c : cells) parallel::put(message.data, read(*c.block, c.i, c.j, c.k));
    out.push_back(std::move(message));
  }
  std::vector<parallel::Message> const in = comm.deliver(std::move(out));
  for (parallel::Message const& message : in) {
    auto const from =
        std::find_if(asked_.begin(), asked_.end(), [&](auto const& a) { return a.first == message.rank; });
    std::span<std::byte const> bytes(message.data);
    for (Index const s : from->second) values_[static_cast<std::size_t>(s)] = parallel::take<fluid::State>(bytes);
  }
}

Index StateGather::slot(GlobalId cell) const {
  auto const found = std::lower_bound(wanted_.begin(), wanted_.end(), cell);
  return found != wanted_.end() && *found == cell ? static_cast<Index>(found - wanted_.begin()) : -1;
}

}  // namespace brisance::coupling
