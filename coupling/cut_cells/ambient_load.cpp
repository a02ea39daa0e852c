// Loads relative to the ambient pressure p_a: the fluid gives all of its pressure, the solid feels the part beyond p_a,
// as a structure that was built in still air. What lies between, p_a times the volume that the bodies sweep, goes to
// the account, so that it closes to the bit.
#include <cmath>

#include "coupling/cut_cells/cut_cells.hpp"

namespace brisance::coupling {

namespace {
/// Pressures this close to the ambient one, in its units, count as it: still air in a cut cell is content over volume,
/// a few roundings from the ambient state.
constexpr Real still = 1e-12;
}  // namespace

Vec3 CutCells::force_on_solid(Real chi, Vec3 const& pressure, Vec3 const& area) const {
  Vec3 force;
  for (int d = 0; d < 3; ++d) {
    Real felt = chi * pressure[d];
    if (ambient_pressure_) {
      felt -= *ambient_pressure_;
      if (std::abs(felt) <= still * *ambient_pressure_) felt = 0;
    }
    force[d] = -felt * area[d];
  }
  return force;
}

void CutCells::ambient_account(Real dt) {
  fluid::Grid const& grid = flow_.grid();
  for (CutCell const& cut : next_.geometry.cells) {
    if (!owned(cut.cell)) continue;
    fluid::Block const& block = *std::as_const(flow_).find(grid.block_of(cut.cell));
    CellIndex const first = block.first();
    WallBlock const& wall = sweeper_.blocks().at(block.id());
    Vec3 pressure;
    for (int d = 0; d < grid.dimension; ++d)
      pressure[d] = wall.pressure[static_cast<std::size_t>(d)]
                                 [wall.cell(cut.cell[0] - first[0], cut.cell[1] - first[1], cut.cell[2] - first[2])];
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = next_.geometry.pieces[static_cast<std::size_t>(f)];
      Real const chi = piece_factor_[static_cast<std::size_t>(f)];
      Vec3 const given{-chi * pressure.x * piece.area.x, -chi * pressure.y * piece.area.y,
                       -chi * pressure.z * piece.area.z};
      Vec3 const beyond = force_on_solid(chi, pressure, piece.area) - given;
      Real const work = dt * dot(beyond, next_.wall_velocity(piece.triangle, piece.bary_centroid));
      for (int d = 0; d < 3; ++d) ambient_given_[static_cast<std::size_t>(d)].add(dt * beyond[d]);
      ambient_given_[3].add(work);
      wall_work_.add(-work);
    }
  }
}

}  // namespace brisance::coupling
