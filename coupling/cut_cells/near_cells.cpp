#include "coupling/cut_cells/near_cells.hpp"

#include <algorithm>
#include <cmath>

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

bool NearCells::drains(NearCell const& c) const {
  Real widest = 0;
  for (int d = 0; d < grid_.dimension; ++d)
    for (Real const a : c.aperture[static_cast<std::size_t>(d)]) widest = max(widest, a / grid_.face_area(d));
  return widest <= 1.1 * c.volume / grid_.cell_volume() && c.volume <= 2 * c.volume_before &&
         c.volume_before <= 2 * c.volume;
}

Index NearCells::target(Index i, std::span<Index const> taken) const {
  NearCell const& c = cell(i);
  auto const offered = [&](Index j) {
    return j >= 0 && j != i && std::find(taken.begin(), taken.end(), j) == taken.end();
  };
  Index best = -1;
  Real best_score = 0;
  bool open = false;
  for (int d = 0; d < grid_.dimension; ++d)
    for (int side = 0; side < 2; ++side) {
      CellIndex n = c.cell;
      n[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
      Real const a = c.aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)] / grid_.face_area(d);
      Index const j = find(n);
      if (!offered(j) || !(a > 1e-12)) continue;
      open = true;
      if (!(cell(j).volume > c.volume)) continue;
      consider(j, a + 0.5 * cell(j).volume / grid_.cell_volume(), best, best_score);
    }
  if (best >= 0 && open) return best;
  for_neighbourhood(grid_, c.cell, 1, [&](CellIndex n) {
    Index const j = find(n);
    if (offered(j) && cell(j).volume > c.volume) consider(j, cell(j).volume, best, best_score);
  });
  return best;
}

}  // namespace brisance::coupling
