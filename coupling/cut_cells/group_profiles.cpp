// Groups of merged cells are no flatter than the flow around them: their members share a linear profile instead of the
// mean. Conservative, as the profile is taken about the centroid of the group.
#include <algorithm>
#include <cmath>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/near_cells.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

void CutCells::spread(std::vector<NearCell> const& cells) {
  fluid::Grid const& grid = flow_.grid();
  Real const full = grid.cell_volume();
  struct Group {
    Index first;
    Vec3 centre;                 ///< of its first member with fluid
    std::vector<Index> members;  ///< with fluid
    Moments region;              ///< about the centre of its first member
    std::vector<GlobalId> around;
  };
  // Members of a group follow each other in no order of the list: collected by the place of the first.
  std::vector<Index> group_of(cells.size(), -1);
  std::vector<Group> groups;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    NearCell const& cell = cells[n];
    if (!cell.grouped || covered(cell, full)) continue;
    Index& group = group_of[static_cast<std::size_t>(cell.group)];
    if (group < 0) {
      group = static_cast<Index>(groups.size());
      groups.push_back({cell.group, {}, {}, {}, {}});
    }
    Group& g = groups[static_cast<std::size_t>(group)];
    if (g.members.empty()) g.centre = grid.centre(cell.cell);
    g.members.push_back(static_cast<Index>(n));
  }
  // Beside a wall that divides cells the mean stays.
  std::erase_if(groups, [&](Group const& g) {
    return std::any_of(g.members.begin(), g.members.end(),
                       [&](Index m) { return cells[static_cast<std::size_t>(m)].linked; });
  });
  std::vector<std::pair<GlobalId, Moments>> regions;  // of the groups of cells of this rank, about the cell's centre
  std::vector<GlobalId> wanted;
  for (Group& group : groups) {
    Real volume = 0;
    bool mine = false;
    for (Index const m : group.members) {
      NearCell const& cell = cells[static_cast<std::size_t>(m)];
      volume += cell.volume;
      group.region = group.region + cell.volume * moved(cell.region, grid.centre(cell.cell) - group.centre);
      mine = mine || cell.mine;
    }
    group.region = 1 / volume * group.region;
    if (!mine) {
      group.members.clear();
      continue;
    }
    for (Index const m : group.members) {
      NearCell const& cell = cells[static_cast<std::size_t>(m)];
      if (cell.mine) regions.emplace_back(cell.id, moved(group.region, group.centre - grid.centre(cell.cell)));
      for_seen(next_, cell.cell, [&](CellIndex n) {
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
  std::sort(regions.begin(), regions.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<GlobalId> const ids = wanted;
  around_groups_.plan(comm_, flow_, std::move(wanted));
  // A neighbour in a group of its own holds that group's mean, over that group's region, which its owner knows.
  std::vector<Moments> region_of(ids.size());
  auto const region = [&](Block const& b, Index i, Index j, Index k) {
    CellIndex const c{b.first()[0] + i, b.first()[1] + j, b.first()[2] + k};
    GlobalId const id = grid.cell_id(c);
    auto const at =
        std::lower_bound(regions.begin(), regions.end(), id, [](auto const& p, GlobalId x) { return p.first < x; });
    return at != regions.end() && at->first == id ? at->second : fluid_moments(next_, c);
  };
  around_groups_.refresh(comm_, [&](Block const& b, Index i, Index j, Index k) {
    Moments const m = region(b, i, j, k);
    return State{m.mean.x, m.mean.y, m.mean.z, m.product[0], m.product[1]};
  });
  for (std::size_t s = 0; s < ids.size(); ++s) {
    State const& x = around_groups_[static_cast<Index>(s)];
    region_of[s] = {{x[0], x[1], x[2]}, {x[3], x[4]}};
  }
  around_groups_.refresh(comm_, [&](Block const& b, Index i, Index j, Index k) {
    Moments const m = region(b, i, j, k);
    return State{m.product[2], m.product[3], m.product[4], m.product[5], 0};
  });
  for (std::size_t s = 0; s < ids.size(); ++s) {
    State const& x = around_groups_[static_cast<Index>(s)];
    std::copy_n(x.begin(), 4, region_of[s].product.begin() + 2);
  }
  around_groups_.refresh(comm_, [](Block const& b, Index i, Index j, Index k) { return b.load(i, j, k); });

  std::vector<PlacedState> around;
  for (Group const& group : groups) {
    if (group.members.empty()) continue;
    around.clear();
    for (GlobalId const id : group.around) {
      Index const slot = around_groups_.slot(id);
      CellIndex const c = cell_from_id(grid, id);
      bool const near = std::any_of(group.members.begin(), group.members.end(),
                                    [&](Index m) { return adjacent(cells[static_cast<std::size_t>(m)].cell, c); });
      around.push_back({around_groups_[slot],
                        moved(region_of[static_cast<std::size_t>(slot)], grid.centre(c) - group.centre), near});
    }
    State const& mean = cells[static_cast<std::size_t>(group.members.front())].mean;
    Profile profile{};
    if (!fit_profile(sweeper_.profile_kind, flow_.gas(), grid.spacing, grid.dimension, {mean, group.region}, around,
                     profile))
      continue;
    auto const change_of = [&](NearCell const& cell) {
      return change_between(profile, moved(cell.region, grid.centre(cell.cell) - group.centre) - group.region);
    };
    // All members or none: the mean of the group is kept.
    bool const fits = std::all_of(group.members.begin(), group.members.end(), [&](Index m) {
      State const change = change_of(cells[static_cast<std::size_t>(m)]);
      return change == State{} || moved_within(flow_.gas(), mean, change) != mean;
    });
    if (!fits) continue;
    for (Index const m : group.members) {
      NearCell const& cell = cells[static_cast<std::size_t>(m)];
      if (!cell.mine) continue;
      Block& block = *flow_.find(grid.block_of(cell.cell));
      CellIndex const first = block.first();
      State const change = change_of(cell);
      block.store(cell.cell[0] - first[0], cell.cell[1] - first[1], cell.cell[2] - first[2],
                  moved_within(flow_.gas(), mean, change));
    }
  }
}

}  // namespace brisance::coupling
