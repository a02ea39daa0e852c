#include "coupling/cut_cells/mixing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/near_cells.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

class Merger {
 public:
  Merger(fluid::Grid const& grid, Real small_cell, Sight sight, std::vector<NearCell>& cells,
         std::span<NearLink const> links)
      : near_(grid, cells, links),
        grid_(grid),
        full_(grid.cell_volume()),
        small_(small_cell * full_),
        sight_(sight),
        cells_(cells) {
    parent_.resize(cells.size());
    std::iota(parent_.begin(), parent_.end(), Index{0});
    for (NearCell& c : cells_) c.grouped = false;
  }

  Merging run() {
    bind_inside_out();
    for (Index i = 0; i < count(); ++i) {
      if (speaker_[at(i)] != i) continue;
      NearCell const& c = cell(i);
      for (Index j = i - 1; c.share >= 0 && j >= 0 && cell(j).id == c.id; --j)
        if (cell(j).share == c.share) unite(j, i);
      if (c.amount == State{}) continue;  // a void has nothing to share, in a crack that opens as in a covered cell
      bool const whole = c.unit == 0 && c.volume >= small_;
      if (c.settled || (!covered(c, full_) && (whole || near_.drains(c)))) continue;
      Index const t = near_.target(i, {});
      if (t >= 0) unite(i, t);
    }
    for (;;) {  // every round unites groups, so that it ends
      sum_groups();
      std::vector<std::pair<Index, Index>> unions;
      for (Index i = 0; i < count(); ++i)
        if (root(i) == i && judged_[at(i)] && inadmissible(volume_[at(i)], amount_[at(i)])) {
          Index const partner = growth(i);
          if (partner >= 0)
            unions.emplace_back(i, partner);
          else if (sight_ == Sight::everything || mine(i))  // a foreign group may have its partner beyond the halo
            return {place(i) + ": no neighbour makes its group of small cells admissible", sight_ == Sight::halo};
        }
      if (unions.empty()) return finish();
      for (auto const& [a, b] : unions) unite(a, b);
    }
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  Index count() const { return static_cast<Index>(cells_.size()); }
  NearCell& cell(Index i) { return cells_[at(i)]; }
  Index root(Index i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void unite(Index a, Index b) {
    a = root(a), b = root(b);
    if (a != b) parent_[at(std::max(a, b))] = std::min(a, b);  // the root is the lowest id: no order of visit enters
  }

  /// Covered cells between bodies that overlap, with a face that is inside out between them, are one: what goes through
  /// it is as large as it is arbitrary, and may not move gas from one side of the walls to the other. The fullest
  /// speaks for all when they ask for a target.
  void bind_inside_out() {
    speaker_.resize(cells_.size());
    std::iota(speaker_.begin(), speaker_.end(), Index{0});
    auto const bindable = [&](NearCell const& c) { return c.unit == 0 && !c.linked && covered(c, full_); };
    std::vector<Index> bound;
    for (Index i = 0; i < count(); ++i)
      for (int d = 0; d < grid_.dimension && bindable(cell(i)); ++d) {
        if (cell(i).aperture[static_cast<std::size_t>(d)][1] >= -inside_out * grid_.face_area(d)) continue;
        CellIndex high = cell(i).cell;
        high[static_cast<std::size_t>(d)] += 1;
        Index const j = near_.find(high);
        if (j < 0 || !bindable(cell(j))) continue;
        unite(i, j);
        bound.insert(bound.end(), {i, j});
      }
    for (Index const i : bound) {  // first the speaker of each root
      Index& speaker = speaker_[at(root(i))];
      Index const now = speaker;
      if (std::abs(cell(i).volume) > std::abs(cell(now).volume)) speaker = i;
    }
    for (Index const i : bound) speaker_[at(i)] = speaker_[at(root(i))];
  }

  void sum_groups() {
    volume_.assign(cells_.size(), 0);
    amount_.assign(cells_.size(), State{});
    judged_.assign(cells_.size(), false);
    next_.assign(cells_.size(), -1);
    last_.assign(cells_.size(), -1);
    for (Index i = 0; i < count(); ++i) {
      Index const r = root(i);
      if (r != i) next_[at(last_[at(r)])] = i;
      last_[at(r)] = i;
      volume_[at(r)] += cell(i).volume;
      for (std::size_t q = 0; q < 5; ++q) amount_[at(r)][q] += cell(i).amount[q];
      if (cell(i).rewritten || r != i) judged_[at(r)] = true;
    }
  }

  Index growth(Index group) {
    Index best = -1;
    Real best_score = 0;
    auto const offer = [&](Index j, Real area, int d) {
      if (j < 0 || root(j) == group || cell(j).volume <= 0) return;
      Index const other = root(j);
      bool const positive = !inadmissible(volume_[at(other)], amount_[at(other)]);
      Real const score = cell(j).volume / grid_.cell_volume() + 2 * area / grid_.face_area(d) + (positive ? 1 : 0);
      NearCells::consider(j, score, best, best_score);
    };
    for (Index i = group; i >= 0; i = next_[at(i)]) {
      if (cell(i).linked) {
        for (NearLink const& link : near_.links(cell(i)))
          offer(near_.find(link.to, link.to_unit), link.area, link.direction);
        continue;
      }
      for (int d = 0; d < grid_.dimension; ++d)
        for (int side = 0; side < 2; ++side) {
          CellIndex n = cell(i).cell;
          n[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
          offer(near_.find(n), cell(i).aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)], d);
        }
    }
    return best >= 0 ? best : nearest_fluid(group);
  }

  /// Gas that walls have shut in on all sides, as between bodies that collide, leaves for the nearest fluid.
  Index nearest_fluid(Index group) {
    Index const farthest =
        sight_ == Sight::halo ? largest_group / 2 : *std::max_element(grid_.cells.begin(), grid_.cells.end());
    for (Index distance = 1; distance <= farthest; ++distance) {
      Index best = -1;
      Real best_score = 0;
      for (Index i = group; i >= 0; i = next_[at(i)])
        for_shell(grid_, cell(i).cell, distance, [&](CellIndex n) {
          Index const j = near_.find(n);
          if (j >= 0 && root(j) != group && !covered(cell(j), full_))
            NearCells::consider(j, cell(j).volume, best, best_score);
        });
      if (best >= 0) return best;
    }
    return -1;
  }

  bool mine(Index group) {
    for (Index i = group; i >= 0; i = next_[at(i)])
      if (cell(i).mine) return true;
    return false;
  }

  std::string place(Index i) {
    CellIndex const c = cell(i).cell;
    return "cell (" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " + std::to_string(c[2]) + ")";
  }

  Merging finish() {
    std::vector<CellIndex> low(cells_.size()), high(cells_.size());
    std::vector<Index> members(cells_.size(), 0);
    for (Index i = 0; i < count(); ++i) {
      std::size_t const r = at(root(i));
      for (std::size_t d = 0; d < 3; ++d) {
        low[r][d] = members[r] == 0 ? cell(i).cell[d] : std::min(low[r][d], cell(i).cell[d]);
        high[r][d] = members[r] == 0 ? cell(i).cell[d] : std::max(high[r][d], cell(i).cell[d]);
      }
      ++members[r];
    }
    for (Index i = 0; i < count(); ++i) {
      std::size_t const r = at(root(i));
      if (members[r] < 2) continue;
      for (std::size_t d = 0; d < 3; ++d)
        if (sight_ == Sight::halo && high[r][d] - low[r][d] >= largest_group && cell(i).mine) return {"", true};
      cell(i).grouped = true;
      cell(i).group = root(i);
      for (std::size_t q = 0; q < 5; ++q) cell(i).mean[q] = amount_[r][q] / volume_[r];
    }
    return {};
  }

  NearCells near_;
  fluid::Grid const& grid_;
  Real full_, small_;
  Sight sight_;
  std::vector<NearCell>& cells_;
  std::vector<Index> parent_;
  std::vector<Index> speaker_;      ///< of the cells that are bound to it; of others: the cell itself
  std::vector<Index> next_, last_;  ///< members of a group in the order of ids: after i; the last one, by root
  std::vector<Real> volume_;
  std::vector<State> amount_;
  std::vector<bool> judged_;
};

}  // namespace

Merging merge_small_cells(fluid::Grid const& grid, Real small_cell, Sight sight, std::vector<NearCell>& cells,
                          std::span<NearLink const> links) {
  return Merger(grid, small_cell, sight, cells, links).run();
}

}  // namespace brisance::coupling
