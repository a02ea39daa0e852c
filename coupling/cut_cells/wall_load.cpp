// Pressure of the cut cells on the pieces of the wall (theory/coupling.md 1.4).
#include <cmath>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"

namespace brisance::coupling {

using fluid::State;

Real CutCells::half_riemann(State const& u, Vec3 const& wall_velocity, Vec3 const& area) const {
  fluid::Gas const& gas = flow_.gas();
  if (config_.wall_pressure == "cell" || !gas.curve.zero()) return 1;  // the factor is that of an ideal gas
  Real const c = gas.sound_speed(u);
  if (!(c > 0)) return 1;
  Vec3 const velocity = Vec3{u[1], u[2], u[3]} / u[0];
  Real const mach = dot(velocity - wall_velocity, area) / (norm(area) * c);
  Real const g = gas.gamma;
  Real exact;
  if (mach > 0) {
    exact = std::pow(max(0, 1 - 0.5 * (g - 1) * mach), 2 * g / (g - 1));
  } else {
    Real const m = -mach, b = 0.25 * (g + 1) * m;
    exact = 1 + g * m * (b + std::sqrt(1 + b * b));
  }
  Real const theta = clamp(2 - 2 * std::abs(mach), 0, 1);
  return theta * exact + 1 - theta;
}

void CutCells::wall_pressure(WallRecord const& record, bool initial, std::vector<CellForce>& forces) {
  fluid::Grid const& grid = flow_.grid();
  forces.clear();
  piece_factor_.assign(record.geometry.pieces.size(), 1);
  for (CutCell const& cut : record.geometry.cells) {
    if (!owned(cut.cell)) continue;
    fluid::Block const& block = *flow_.find(grid.block_of(cut.cell));
    CellIndex const first = block.first();
    Index const i = cut.cell[0] - first[0], j = cut.cell[1] - first[1], k = cut.cell[2] - first[2];
    WallBlock const& wall = sweeper_.blocks().at(block.id());
    State const u = initial ? block.load(i, j, k) : wall.before[wall.cell(i, j, k)];
    // The factor is 1 in or next to a vacuum cell.
    bool vacuum = false;
    for_neighbourhood(grid, cut.cell, 1, [&](CellIndex n) {
      if (!grid.inside(n) || grid.block_of(n) != block.id() || record_.solid(n)) return;
      State const s = initial ? block.load(n[0] - first[0], n[1] - first[1], n[2] - first[2])
                              : wall.before[wall.cell(n[0] - first[0], n[1] - first[1], n[2] - first[2])];
      vacuum = vacuum || flow_.gas().vacuum(s);
    });
    Vec3 pressure;
    for (int d = 0; d < grid.dimension; ++d)
      pressure[d] = initial ? flow_.gas().pressure(u) : wall.pressure[static_cast<std::size_t>(d)][wall.cell(i, j, k)];
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
      Real const chi =
          vacuum ? 1 : half_riemann(u, record.wall_velocity(piece.triangle, piece.bary_centroid), piece.area);
      piece_factor_[static_cast<std::size_t>(f)] = chi;
      Vec3 force{-chi * pressure.x * piece.area.x, -chi * pressure.y * piece.area.y, -chi * pressure.z * piece.area.z};
      if (viscous_ && !initial) force += (*viscous_)[static_cast<std::size_t>(f)].force;
      GlobalId const triangle = record.triangles[static_cast<std::size_t>(piece.triangle)].id;
      GlobalId const cell = grid.cell_id(cut.cell);
      if (forces.empty() || forces.back().triangle != triangle || forces.back().cell != cell)
        forces.push_back({triangle, cell, {}});
      for (std::size_t a = 0; a < 3; ++a) forces.back().force[a] += piece.bary_centroid[a] * force;
    }
  }
}

}  // namespace brisance::coupling
