#include "coupling/cut_cells/redistribution.hpp"

#include <algorithm>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/near_cells.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

constexpr std::size_t most_members = 4;

struct Neighbourhood {
  std::vector<Index> members;  ///< the small cell first
  State mean{};
  Moments region;  ///< about the centre of the small cell
  Profile profile{};
};

class Redistributor {
 public:
  Redistributor(fluid::Gas const& gas, WallRecord const& record, Real small_cell, ProfileKind kind,
                std::vector<NearCell>& cells)
      : gas_(gas), record_(record), grid_(record.grid()), kind_(kind), cells_(cells), near_(grid_, cells) {
    full_ = grid_.cell_volume();
    small_ = small_cell * full_;
  }

  void run() {
    find_neighbourhoods();
    for (Neighbourhood& n : sets_) average(n);
    for (Neighbourhood& n : sets_) fit(n);
    std::vector<State> amount(cells_.size());
    for (std::size_t j = 0; j < cells_.size(); ++j) {
      if (in_[j].empty()) continue;
      NearCell const& cell = cells_[j];
      bool const own = of_[j] < 0;  // a large cell is a neighbourhood of its own
      State sum{};
      if (own) sum = state(j);
      for (Index const s : in_[j]) {
        Neighbourhood const& n = sets_[at(s)];
        State const change = change_between(n.profile, region(n, static_cast<Index>(j)) - n.region);
        for (std::size_t q = 0; q < 5; ++q) sum[q] += n.mean[q] + change[q];
      }
      for (std::size_t q = 0; q < 5; ++q) amount[j][q] = cell.volume * sum[q] / count(j);
    }
    for (std::size_t j = 0; j < cells_.size(); ++j) {
      cells_[j].settled = of_[j] >= 0;
      if (!in_[j].empty()) cells_[j].amount = amount[j], cells_[j].rewritten = true;
    }
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  /// Neighbourhoods that hold cell j.
  Real count(std::size_t j) const { return static_cast<Real>(in_[j].size()) + (of_[j] < 0 ? 1 : 0); }
  State state(std::size_t j) const {
    State u = cells_[j].amount;
    for (Real& x : u) x /= cells_[j].volume;
    return u;
  }
  /// Empty and covered cells, and what the balance left without mass or pressure, are for merging.
  bool sound(Index j) const {
    NearCell const& c = cells_[at(j)];
    return !covered(c, full_) && !inadmissible(c.volume, c.amount) && !gas_.vacuum(state(at(j)));
  }

  /// From the centre of the small cell of n to that of cell j, m.
  Vec3 offset(Neighbourhood const& n, Index j) const {
    return grid_.centre(cells_[at(j)].cell) - grid_.centre(cells_[at(n.members.front())].cell);
  }
  Moments region(Neighbourhood const& n, Index j) const { return moved(cells_[at(j)].region, offset(n, j)); }
  bool near(Neighbourhood const& n, Index j) const {
    return std::any_of(n.members.begin(), n.members.end(),
                       [&](Index m) { return adjacent(cells_[at(m)].cell, cells_[at(j)].cell); });
  }

  void find_neighbourhoods() {
    in_.resize(cells_.size());
    of_.assign(cells_.size(), -1);
    for (Index i = 0; i < static_cast<Index>(cells_.size()); ++i) {
      NearCell const& c = cells_[at(i)];
      // Parts of cells are merged with what they open to, and so are their small neighbours.
      if (c.volume >= small_ || c.linked || !sound(i) || near_.drains(c)) continue;
      Neighbourhood n;
      n.members.push_back(i);
      Real volume = c.volume;
      while (volume < small_ && n.members.size() < most_members) {
        Index const j = near_.target(i, n.members);
        if (j < 0 || cells_[at(j)].linked || !sound(j)) break;
        n.members.push_back(j);
        volume += cells_[at(j)].volume;
      }
      if (volume < small_) continue;
      of_[at(i)] = static_cast<Index>(sets_.size());
      for (Index const j : n.members) in_[at(j)].push_back(static_cast<Index>(sets_.size()));
      sets_.push_back(std::move(n));
    }
  }

  void average(Neighbourhood& n) const {
    Real volume = 0;
    for (Index const j : n.members) {
      NearCell const& c = cells_[at(j)];
      Real const share = 1 / count(at(j));
      volume += share * c.volume;
      n.region = n.region + share * c.volume * region(n, j);
      for (std::size_t q = 0; q < 5; ++q) n.mean[q] += share * c.amount[q];
    }
    n.region = 1 / volume * n.region;
    for (Real& x : n.mean) x /= volume;
  }

  void fit(Neighbourhood& n) {
    std::vector<Index> around;
    for (Index const m : n.members)
      for_seen(record_, cells_[at(m)].cell, [&](CellIndex c) {
        Index const k = near_.find(c);
        // Alone, a part of a cell need not balance.
        if (k < 0 || cells_[at(k)].linked || covered(cells_[at(k)], full_)) return;
        if (std::find(n.members.begin(), n.members.end(), k) == n.members.end()) around.push_back(k);
      });
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    placed_.clear();
    for (Index const k : around) {
      if (Index const s = of_[at(k)]; s >= 0)
        placed_.push_back({sets_[at(s)].mean, moved(sets_[at(s)].region, offset(n, k)), near(n, k)});
      else
        placed_.push_back({state(at(k)), region(n, k), near(n, k)});
    }
    Profile profile{};
    if (!fit_profile(kind_, gas_, grid_.spacing, grid_.dimension, {n.mean, n.region}, placed_, profile)) return;
    for (Index const m : n.members) {
      State const change = change_between(profile, region(n, m) - n.region);
      if (change != State{} && moved_within(gas_, n.mean, change) == n.mean) return;
    }
    n.profile = profile;
  }

  fluid::Gas const& gas_;
  WallRecord const& record_;
  fluid::Grid const& grid_;
  ProfileKind kind_;
  std::vector<NearCell>& cells_;
  NearCells near_;
  Real full_ = 0, small_ = 0;
  std::vector<Neighbourhood> sets_;
  std::vector<std::vector<Index>> in_;  ///< neighbourhoods of small cells that hold a cell
  std::vector<Index> of_;               ///< the neighbourhood of a small cell; -1: none
  std::vector<PlacedState> placed_;
};

}  // namespace

void redistribute(fluid::Gas const& gas, WallRecord const& record, Real small_cell, ProfileKind kind,
                  std::vector<NearCell>& cells) {
  Redistributor(gas, record, small_cell, kind, cells).run();
}

}  // namespace brisance::coupling
