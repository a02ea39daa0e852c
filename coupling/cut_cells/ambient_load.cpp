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
  // The boundary that bore the loads, with its velocity: areas and arms of one instant, as nothing turns under p_a.
  WallRecord const& loaded = scheme_ == TimeCoupling::explicit_load ? record_ : next_;
  for (CutCell const& cut : loaded.geometry.cells) {
    if (!owned(cut.cell)) continue;
    Vec3 pressure = swept_pressure(cut.cell);
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = loaded.geometry.pieces[static_cast<std::size_t>(f)];
      Real const chi = piece_factor_[static_cast<std::size_t>(f)];
      if (divided_) pressure = unit_pressure(cut.cell, parts_.unit_of(f));
      Vec3 const beyond = force_on_solid(chi, pressure, piece.area) - force_of_gas(chi, pressure, piece.area);
      Real const work = dt * dot(beyond, loaded.wall_velocity(piece.triangle, piece.bary_centroid));
      for (int d = 0; d < 3; ++d) ambient_given_[static_cast<std::size_t>(d)].add(dt * beyond[d]);
      ambient_given_[3].add(work);
      wall_work_.add(-work);
    }
  }
}

}  // namespace brisance::coupling
