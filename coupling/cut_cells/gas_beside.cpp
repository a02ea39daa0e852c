#include "coupling/cut_cells/gas_beside.hpp"

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/openings.hpp"

namespace brisance::coupling {

std::size_t GasBeside::place(CellIndex const& c) const {
  auto const nx = box_.high[0] - box_.low[0], ny = box_.high[1] - box_.low[1];
  return static_cast<std::size_t>(c[0] - box_.low[0] + nx * (c[1] - box_.low[1] + ny * (c[2] - box_.low[2])));
}

bool GasBeside::holds(CellIndex const& c) const { return box_.holds(c) && (parts_[place(c)] & 1u) != 0; }

void GasBeside::find(WallRecord const& record, CellIndex const& c, std::size_t part, Index reach) {
  fluid::Grid const& grid = record.grid();
  box_ = grown(grid, {c, {c[0] + 1, c[1] + 1, c[2] + 1}}, reach + 1);
  for (std::size_t d = 0; d < 3; ++d)
    box_.low[d] = std::max(box_.low[d], 0), box_.high[d] = std::min(box_.high[d], grid.cells[d]);
  parts_.assign(empty(box_) ? 0 : place({box_.high[0] - 1, box_.high[1] - 1, box_.high[2] - 1}) + 1, 0);
  met_.clear();
  auto const meet = [&](CellIndex const& n, std::size_t p) {
    if (!box_.holds(n) || (parts_[place(n)] >> p & 1u) != 0) return;
    parts_[place(n)] |= static_cast<std::uint8_t>(1u << p);
    met_.push_back({n, p});
  };
  meet(c, part);
  for (std::size_t next = 0; next < met_.size();) {  // it grows
    Unit const from = met_[next++];
    for_openings(record, from.cell, from.part, [&](CellIndex n, std::size_t p, int d, Real area) {
      if (area > covered_fraction * record.lattice().face_area(d)) meet(n, p);
    });
  }
}

bool GasBeside::possible(WallRecord const& record, CutCell const& cut, Index reach) {
  fluid::Grid const& grid = record.grid();
  CellIndex const& c = cut.cell;
  if (record.parts.any_within(grown(grid, {c, {c[0] + 1, c[1] + 1, c[2] + 1}}, reach))) return true;
  bool other = false;
  Real const size = norm(cut.area);
  for_neighbourhood(grid, c, reach, [&](CellIndex n) {
    Index const at = record.cut_index(n);
    if (other || at < 0) return;
    Vec3 const& area = record.cut(at).area;
    other = dot(area, cut.area) < 0.3 * norm(area) * size;
  });
  return other;
}

}  // namespace brisance::coupling
