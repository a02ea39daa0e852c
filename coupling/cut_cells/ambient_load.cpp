// Loads relative to the ambient pressure p_a: the fluid gives all of its pressure, the solid feels the part beyond p_a,
// as a structure that was built in still air. What lies between, p_a times the volume that the bodies sweep, goes to
// the account, so that it closes to the bit.
#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/cut_cells/cut_cells.hpp"
#include "parallel/error.hpp"

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

Vec3 CutCells::velocity_in_step(Piece const& piece) const {
  GlobalId const id = record_.triangles[static_cast<std::size_t>(piece.triangle)].id;
  auto const& moved = next_.triangles;
  auto const at = std::lower_bound(moved.begin(), moved.end(), id,
                                   [](SurfaceTriangle const& t, GlobalId other) { return t.id < other; });
  require(at != moved.end() && at->id == id, Failure::internal,
          "triangle " + std::to_string(id) + " of the wall is out of sight after a step");
  return next_.wall_velocity(static_cast<Index>(at - moved.begin()), piece.bary_centroid);
}

void CutCells::ambient_account(Real dt) {
  // The boundary that bore the loads.
  bool const at_start = scheme_ == TimeCoupling::explicit_load;
  WallRecord const& loaded = at_start ? record_ : next_;
  for (CutCell const& cut : loaded.geometry.cells) {
    if (!owned(cut.cell)) continue;
    Vec3 const pressure = swept_pressure(cut.cell);
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = loaded.geometry.pieces[static_cast<std::size_t>(f)];
      Real const chi = piece_factor_[static_cast<std::size_t>(f)];
      Vec3 const beyond = force_on_solid(chi, pressure, piece.area) - force_of_gas(chi, pressure, piece.area);
      Vec3 const velocity =
          at_start ? velocity_in_step(piece) : loaded.wall_velocity(piece.triangle, piece.bary_centroid);
      Real const work = dt * dot(beyond, velocity);
      for (int d = 0; d < 3; ++d) ambient_given_[static_cast<std::size_t>(d)].add(dt * beyond[d]);
      ambient_given_[3].add(work);
      wall_work_.add(-work);
    }
  }
}

}  // namespace brisance::coupling
