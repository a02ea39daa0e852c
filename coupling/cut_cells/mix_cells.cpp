// Small cells are mixed with their neighbours: gathered around the blocks of this rank, merged or redistributed,
// stored.
#include <algorithm>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/near_cells.hpp"
#include "coupling/cut_cells/redistribution.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

void CutCells::mix() {
  fluid::Grid const& grid = flow_.grid();
  std::vector<CellBox> near;
  for (Block const& block : std::as_const(flow_).blocks()) near.push_back(grown(grid, box_of(block), mixing_halo));
  auto const within = [&](CellIndex c) {
    return std::any_of(near.begin(), near.end(), [&](CellBox const& b) { return b.holds(c); });
  };
  std::vector<GlobalId> ids;
  CellBox around = near.front();
  for (CellBox const& b : near)
    for (std::size_t d = 0; d < 3; ++d) {
      around.low[d] = std::max(0, std::min(around.low[d], b.low[d]));
      around.high[d] = std::min(grid.cells[d], std::max(around.high[d], b.high[d]));
    }
  near_.start(around);
  for (WallRecord const* r : {&record_, &next_})
    for (CutCell const& cut : r->geometry.cells) {
      if (r == &next_ && record_.cut_index(cut.cell) >= 0) continue;  // been there
      for_neighbourhood(grid, cut.cell, 2, [&](CellIndex c) {
        if (around.holds(c)) near_.insert(c);
      });
    }
  for (CellIndex const& c : near_.cells())
    if (within(c)) ids.push_back(grid.cell_id(c));
  for (Content const& c : contents_) ids.push_back(c.cell);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());

  std::vector<NearCell> cells;
  cells.reserve(ids.size());
  Real const full = grid.cell_volume();
  std::size_t next_content = 0;
  for (GlobalId const id : ids) {
    CellIndex const c = cell_from_id(grid, id);
    CellUnits const* const units = parts_.find(c);
    for (std::size_t unit = 0; unit < (units ? units->count : 1); ++unit) {
      NearCell& cell = cells.emplace_back();
      cell.id = id;
      cell.cell = c;
      cell.mine = owned(c);
      cell.unit = static_cast<Index>(unit);
      if (divided_) measure_unit(units, unit, cell);
      if (!units) {
        cell.volume = next_.volume(c);
        cell.volume_before = record_.volume(c);
        for (int d = 0; d < grid.dimension; ++d)
          for (int side = 0; side < 2; ++side)
            cell.aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)] = next_.aperture(c, d, side);
      }
      if (linear_ || config_.small_cells == "redistribution") cell.region = fluid_moments(next_, c);
      Content const here{id, {}, cell.unit};
      while (next_content < contents_.size() && contents_[next_content] < here) ++next_content;
      if (next_content < contents_.size() && !(here < contents_[next_content])) {
        cell.amount = contents_[next_content].amount;
        cell.rewritten = true;
      } else if (cell.mine && unit == 0 && !covered(cell, full)) {
        Block const& block = *std::as_const(flow_).find(grid.block_of(c));
        CellIndex const first = block.first();
        cell.amount = block.load(c[0] - first[0], c[1] - first[1], c[2] - first[2]);
        for (Real& x : cell.amount) x *= cell.volume;
      }
    }
  }
  links_.clear();
  if (divided_) link_near(cells);
  exchange_near(cells);
  if (config_.small_cells == "redistribution") {
    redistribute(flow_.gas(), next_, config_.small_cell, linear_ ? sweeper_.profile_kind : ProfileKind::all, cells);
    exchange_near(cells);
  }

  Merging merging =
      merge_small_cells(grid, config_.small_cell, comm_.size() > 1 ? Sight::halo : Sight::everything, cells, links_);
  if (comm_.size() > 1) {
    std::uint64_t outgrown = merging.outgrown ? 1 : 0;
    comm_.bit_or(std::span(&outgrown, 1));
    if (outgrown > 0) merging = merge_everywhere(cells);
  }
  if (!merging.trouble.empty() && health_.good) health_ = {false, merging.trouble};
  store(cells);
  if (linear_) spread(cells);
}

std::vector<int> CutCells::ranks_within(CellIndex c, Index halo) const {
  fluid::Grid const& grid = flow_.grid();
  std::vector<int> ranks;
  CellBox const around = grown(grid, {c, {c[0] + 1, c[1] + 1, c[2] + 1}}, halo);
  CellIndex low{}, high{};  // groups do not reach through periodic sides
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = std::max(around.low[d], 0);
    high[d] = std::min(around.high[d], grid.cells[d]) - 1;
  }
  auto const b0 = grid.block_position(grid.block_of(low)), b1 = grid.block_position(grid.block_of(high));
  for (Index bz = b0[2]; bz <= b1[2]; ++bz)
    for (Index by = b0[1]; by <= b1[1]; ++by)
      for (Index bx = b0[0]; bx <= b1[0]; ++bx) {
        int const rank = flow_.owner(grid.block_id({bx, by, bz}));
        if (rank != comm_.rank() && std::find(ranks.begin(), ranks.end(), rank) == ranks.end()) ranks.push_back(rank);
      }
  return ranks;
}

void CutCells::exchange_near(std::vector<NearCell>& cells) {
  if (comm_.size() == 1) return;
  struct Row {
    GlobalId id;
    State amount;
    std::int32_t rewritten, settled;
    Index unit, none;
  };
  std::map<int, parallel::Bytes> to;
  for (NearCell const& cell : cells) {
    if (!cell.mine) continue;
    std::vector<int> const ranks = ranks_within(cell.cell, mixing_halo);
    for (int const rank : ranks)
      parallel::put(to[rank], Row{cell.id, cell.amount, cell.rewritten, cell.settled, cell.unit, 0});
  }
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to) out.push_back({rank, std::move(data)});
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      Row const row = parallel::take<Row>(in);
      auto const at = std::lower_bound(cells.begin(), cells.end(), row, [](NearCell const& c, Row const& r) {
        return c.id != r.id ? c.id < r.id : c.unit < r.unit;
      });
      if (at != cells.end() && at->id == row.id && at->unit == row.unit)
        at->amount = row.amount, at->rewritten = row.rewritten != 0, at->settled = row.settled != 0;
    }
}

void CutCells::store(std::vector<NearCell> const& cells) {
  fluid::Grid const& grid = flow_.grid();
  Real const full = grid.cell_volume();
  kept_.clear();
  minor_.clear();
  for (NearCell const& cell : cells) {
    if (!cell.mine || !(cell.rewritten || cell.grouped)) continue;
    if (cell.unit > 0) {
      CellUnits const* const units = parts_.find(cell.cell);
      if (cell.unit >= static_cast<Index>(units->after)) continue;  // its gas went to its group
      Content m{cell.id, cell.amount, cell.unit};
      if (cell.grouped) m.amount = cell.mean;
      for (Real& x : m.amount) x *= cell.grouped ? cell.volume : 1;
      minor_.push_back(m);
      continue;
    }
    bool const empty = covered(cell, full);
    State u = cell.mean;
    if (!cell.grouped) {
      if (empty) continue;  // nothing in it
      u = cell.amount;
      for (Real& x : u) x /= cell.volume;
    }
    if (empty) {
      Content k{cell.id, u};
      for (Real& x : k.amount) x *= cell.volume;
      kept_.push_back(k);
      continue;
    }
    Block& block = *flow_.find(grid.block_of(cell.cell));
    CellIndex const first = block.first();
    block.store(cell.cell[0] - first[0], cell.cell[1] - first[1], cell.cell[2] - first[2], u);
  }
}

Merging CutCells::merge_everywhere(std::vector<NearCell>& cells) {
  // A group is longer than the halo is wide, as along a closing crack: every rank merges the cells of all.
  parallel::Bytes bytes;
  for (NearCell const& cell : cells)
    if (cell.mine) parallel::put(bytes, cell);
  std::vector<NearCell> all;
  std::vector<parallel::Bytes> const gathered = comm_.all_gather(bytes);
  for (std::size_t rank = 0; rank < gathered.size(); ++rank)
    for (std::span<std::byte const> in(gathered[rank]); !in.empty();) {
      all.push_back(parallel::take<NearCell>(in));
      all.back().mine = static_cast<int>(rank) == comm_.rank();
    }
  std::sort(all.begin(), all.end(),
            [](NearCell const& a, NearCell const& b) { return a.id != b.id ? a.id < b.id : a.unit < b.unit; });
  std::vector<NearLink> links;
  if (divided_) {
    bytes.clear();
    for (NearLink const& link : links_)
      if (owned(cell_from_id(flow_.grid(), link.from))) parallel::put(bytes, link);
    for (parallel::Bytes const& from : comm_.all_gather(bytes))
      for (std::span<std::byte const> in(from); !in.empty();) links.push_back(parallel::take<NearLink>(in));
    std::sort(links.begin(), links.end());
  }
  Merging const merging = merge_small_cells(flow_.grid(), config_.small_cell, Sight::everything, all, links);
  cells = std::move(all);
  return merging;
}

}  // namespace brisance::coupling
