#include "coupling/cut_cells/near_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/cut_cells/cell_geometry.hpp"

namespace brisance::coupling {

bool inadmissible(Real volume, fluid::State const& m) {
  if (volume <= 0) return m != fluid::State{};
  if (!(m[0] >= 0) || !std::isfinite(m[4])) return true;
  if (m[0] == 0) return m[4] < 0;
  Real const internal = m[4] - 0.5 * (m[1] * m[1] + m[2] * m[2] + m[3] * m[3]) / m[0];
  return !(internal >= -1e-13 * std::abs(m[4]));
}

Index NearCells::find(CellIndex c) const {
  if (!grid_.inside(c)) return -1;
  GlobalId const id = grid_.cell_id(c);
  auto const f =
      std::lower_bound(cells_.begin(), cells_.end(), id, [](NearCell const& n, GlobalId x) { return n.id < x; });
  return f != cells_.end() && f->id == id ? static_cast<Index>(f - cells_.begin()) : -1;
}

Index NearCells::find(GlobalId cell, Index unit) const {
  auto const f = std::lower_bound(cells_.begin(), cells_.end(), std::pair(cell, unit), [](NearCell const& n, auto x) {
    return n.id != x.first ? n.id < x.first : n.unit < x.second;
  });
  return f != cells_.end() && f->id == cell && f->unit == unit ? static_cast<Index>(f - cells_.begin()) : -1;
}

std::span<NearLink const> NearCells::links(NearCell const& c) const {
  NearLink const low{c.id, c.unit, std::numeric_limits<GlobalId>::min(), 0, 0, 0};
  NearLink const high{c.id, c.unit, std::numeric_limits<GlobalId>::max(), 0, 0, 0};
  return {std::lower_bound(links_.begin(), links_.end(), low), std::upper_bound(links_.begin(), links_.end(), high)};
}

Index NearCells::linked_target(Index i, std::span<Index const> taken) const {
  NearCell const& c = cell(i);
  Index best = -1, largest = -1;
  Real best_score = 0, largest_volume = 0;
  for (NearLink const& link : links(c)) {
    Index const j = find(link.to, link.to_unit);
    Real const a = link.area / grid_.face_area(link.direction);
    if (j < 0 || j == i || !(a > 1e-12) || std::find(taken.begin(), taken.end(), j) != taken.end()) continue;
    consider(j, cell(j).volume, largest, largest_volume);
    if (cell(j).volume > c.volume) consider(j, a + 0.5 * cell(j).volume / grid_.cell_volume(), best, best_score);
  }
  return best >= 0 ? best : largest;
}

bool NearCells::drains(NearCell const& c) const {
  Real widest = 0;
  for (int d = 0; d < grid_.dimension; ++d)
    for (Real const a : c.aperture[static_cast<std::size_t>(d)]) widest = max(widest, a / grid_.face_area(d));
  return widest <= 1.1 * c.volume / grid_.cell_volume() && c.volume <= 2 * c.volume_before &&
         c.volume_before <= 2 * c.volume;
}

Index NearCells::target(Index i, std::span<Index const> taken) const {
  NearCell const& c = cell(i);
  if (c.linked) return linked_target(i, taken);
  auto const offered = [&](Index j) {
    return j >= 0 && j != i && std::find(taken.begin(), taken.end(), j) == taken.end();
  };
  Index best = -1, turned = -1;
  Real best_score = 0, turned_score = 0;
  bool open = false;
  Real const full = grid_.cell_volume();
  for (int d = 0; d < grid_.dimension; ++d)
    for (int side = 0; side < 2; ++side) {
      CellIndex n = c.cell;
      n[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
      Real const a = c.aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)] / grid_.face_area(d);
      Index const j = find(n);
      if (!offered(j)) continue;
      if (covered(c, full) && a < -inside_out && !covered(cell(j), full)) consider(j, -a, turned, turned_score);
      if (!(a > 1e-12)) continue;
      open = true;
      if (!(cell(j).volume > c.volume)) continue;
      consider(j, a + 0.5 * cell(j).volume / grid_.cell_volume(), best, best_score);
    }
  if (turned >= 0) return turned;
  if (best >= 0 && open) return best;
  for_neighbourhood(grid_, c.cell, 1, [&](CellIndex n) {
    Index const j = find(n);
    if (offered(j) && cell(j).volume > c.volume) consider(j, cell(j).volume, best, best_score);
  });
  return best;
}

}  // namespace brisance::coupling
