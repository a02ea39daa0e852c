// Groups of merged cells are no flatter than the flow around them: their members share a linear profile instead of the
// mean. Conservative, as the profile is taken about the centroid of the group.
#include <algorithm>
#include <cmath>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

void CutCells::spread(std::vector<NearCell> const& cells) {
  fluid::Grid const& grid = flow_.grid();
  Real const covered = covered_fraction * grid.cell_volume();
  struct Group {
    Index first;
    std::vector<Index> members;  ///< with fluid
    Vec3 place;
    std::vector<GlobalId> around;
  };
  // Members of a group follow each other in no order of the list: collected by the place of the first.
  std::vector<Index> group_of(cells.size(), -1);
  std::vector<Group> groups;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    NearCell const& cell = cells[n];
    if (!cell.grouped || cell.volume <= covered) continue;
    Index& group = group_of[static_cast<std::size_t>(cell.group)];
    if (group < 0) {
      group = static_cast<Index>(groups.size());
      groups.push_back({cell.group, {}, {}, {}});
    }
    groups[static_cast<std::size_t>(group)].members.push_back(static_cast<Index>(n));
  }
  std::vector<std::pair<GlobalId, Vec3>> places;  // of cells of this rank in groups
  std::vector<GlobalId> wanted;
  for (Group& group : groups) {
    Real volume = 0;
    bool mine = false;
    for (Index const m : group.members) {
      NearCell const& cell = cells[static_cast<std::size_t>(m)];
      volume += cell.volume;
      group.place += cell.volume * cell.place;
      mine = mine || cell.mine;
    }
    group.place = group.place / volume;
    if (!mine) {
      group.members.clear();
      continue;
    }
    for (Index const m : group.members) {
      NearCell const& cell = cells[static_cast<std::size_t>(m)];
      if (cell.mine) places.emplace_back(cell.id, group.place);
      for_neighbourhood(grid, cell.cell, 1, [&](CellIndex n) {
        if (!grid.inside(n) || next_.solid(n) || !sees(next_, cell.cell, n)) return;
        GlobalId const id = grid.cell_id(n);
        for (Index const other : group.members)
          if (cells[static_cast<std::size_t>(other)].id == id) return;
        group.around.push_back(id);
      });
    }
    std::sort(group.around.begin(), group.around.end());
    group.around.erase(std::unique(group.around.begin(), group.around.end()), group.around.end());
    wanted.insert(wanted.end(), group.around.begin(), group.around.end());
  }
  std::sort(places.begin(), places.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<GlobalId> const ids = wanted;
  around_groups_.plan(comm_, flow_, std::move(wanted));
  // A neighbour in a group of its own holds that group's mean, at that group's centroid, which its owner knows.
  around_groups_.refresh(comm_, [&](Block const& b, Index i, Index j, Index k) {
    CellIndex const c{b.first()[0] + i, b.first()[1] + j, b.first()[2] + k};
    GlobalId const id = grid.cell_id(c);
    auto const at =
        std::lower_bound(places.begin(), places.end(), id, [](auto const& p, GlobalId x) { return p.first < x; });
    Vec3 const x = at != places.end() && at->first == id ? at->second : grid.centre(c) + fluid_centroid(next_, c);
    return State{x.x, x.y, x.z, 0, 0};
  });
  std::vector<Vec3> place_of(ids.size());
  for (std::size_t s = 0; s < ids.size(); ++s) {
    State const& x = around_groups_[static_cast<Index>(s)];
    place_of[s] = {x[0], x[1], x[2]};
  }
  around_groups_.refresh(comm_, [](Block const& b, Index i, Index j, Index k) { return b.load(i, j, k); });

  std::vector<PlacedState> around;
  for (Group const& group : groups) {
    if (group.members.empty()) continue;
    around.clear();
    for (GlobalId const id : group.around) {
      Index const slot = around_groups_.slot(id);
      around.push_back({around_groups_[slot], place_of[static_cast<std::size_t>(slot)] - group.place});
    }
    State const& mean = cells[static_cast<std::size_t>(group.members.front())].mean;
    Profile profile{};
    if (!fit_profile(sweeper_.profile_kind, flow_.gas(), grid.spacing, grid.dimension, mean, around, profile)) continue;
    // All members or none: the mean of the group is kept.
    bool const fits = std::all_of(group.members.begin(), group.members.end(), [&](Index m) {
      State const change = change_along(profile, cells[static_cast<std::size_t>(m)].place - group.place);
      return change == State{} || moved_within(flow_.gas(), mean, change) != mean;
    });
    if (!fits) continue;
    for (Index const m : group.members) {
      NearCell const& cell = cells[static_cast<std::size_t>(m)];
      if (!cell.mine) continue;
      Block& block = *flow_.find(grid.block_of(cell.cell));
      CellIndex const first = block.first();
      State const change = change_along(profile, cell.place - group.place);
      block.store(cell.cell[0] - first[0], cell.cell[1] - first[1], cell.cell[2] - first[2],
                  moved_within(flow_.gas(), mean, change));
    }
  }
}

}  // namespace brisance::coupling
