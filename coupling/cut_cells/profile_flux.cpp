// Second order at partly open faces: the sweeps give the flux at the middle of a whole face at the middle of the step,
// the balance takes it through the part that is open at the end of the step (coupling/README.md, "Linear profiles").
#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

/// Area vector and mean velocity of the pieces of a cell, with the area as weight.
struct WallMotion {
  Vec3 area, velocity;
  Real weight = 0;
  void add(WallRecord const& record, CellIndex c) {
    Index const i = record.cut_index(c);
    if (i < 0) return;
    for (Index f = record.cut(i).first_piece; f < record.cut(i).last_piece; ++f) {
      Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
      Real const w = norm(piece.area);
      area += piece.area;
      velocity += w * record.wall_velocity(piece.triangle, piece.bary_centroid);
      weight += w;
    }
  }
};

}  // namespace

State CutCells::profile_flux(CellIndex c, int d, int side) const {
  fluid::Grid const& grid = flow_.grid();
  auto const dir = static_cast<std::size_t>(d);
  CellIndex low = c, high = c;
  (side == 0 ? low : high)[dir] += side == 0 ? -1 : 1;
  // Through a side of the domain goes what the law of the side says, but for the gas that slides out along the wall.
  bool const inner = grid.inside(low) && grid.inside(high);
  if (!inner && (grid.periodic[dir] || flow_.reflecting(d, side))) return {};
  Real const now = next_.aperture(c, d, side), before = moved_ ? record_.aperture(c, d, side) : now;
  Real const whole = grid.face_area(d);
  if (now == before && (now == 0 || now == whole)) return {};

  WallSlopes const& profiles = sweeper_.profiles();
  State u{};
  Profile slope{};
  Real known = 0;
  for (int end = 0; end < 2; ++end) {
    CellIndex const cell = end == 0 ? low : high;
    if (!grid.inside(cell)) continue;
    GlobalId const id = grid.cell_id(cell);
    State const* const mean = profiles.mean(id);
    if (!mean || !((*mean)[0] > 0)) continue;
    Profile const* const profile = profiles.profile(id);
    Vec3 face;
    face[d] = (end == 0 ? 0.5 : -0.5) * grid.spacing[d];
    State const at_face = profiles.value(id, *mean, face);
    known += 1;
    for (std::size_t q = 0; q < 5; ++q) {
      u[q] += at_face[q];
      for (std::size_t t = 0; profile && t < 3; ++t) slope[t][q] += (*profile)[t][q];
    }
  }
  if (known == 0) return {};
  for (std::size_t q = 0; q < 5; ++q) {
    u[q] /= known;
    for (std::size_t t = 0; t < 3; ++t) slope[t][q] /= known;
  }

  State flux{};
  Vec3 const centroid = aperture_centroid(next_, c, d, side);
  if (inner && now > 0 && now < whole) {
    flux = flux_change(flow_.gas(), u, change_along(slope, centroid), d);
    for (Real& f : flux) f *= now;
  }
  auto const cut = [&](CellIndex x) { return !grid.inside(x) || record_.cut_index(x) >= 0 || next_.cut_index(x) >= 0; };
  if (now != before && cut(low) && cut(high)) {
    // The opening at the end of the step stands for that of the whole step. What the gas carries with its motion
    // relative to the wall, along it, goes through the mean opening: relative, so that common motion stays exact.
    WallMotion wall;
    for (CellIndex const& cell : {low, high}) wall.add(next_, cell);
    if (!(wall.weight > 0))
      for (CellIndex const& cell : {low, high}) wall.add(record_, cell);
    if (!(wall.weight > 0)) return flux;
    Vec3 const slip = beside(wall.area, Vec3{u[1], u[2], u[3]} / u[0] - wall.velocity / wall.weight);
    Vec3 const moment = before * aperture_centroid(record_, c, d, side) - now * centroid;
    State const change = change_along(slope, moment);
    for (std::size_t q = 0; q < 5; ++q) flux[q] += 0.5 * slip[d] * ((before - now) * u[q] + change[q]);
  }
  return flux;
}

}  // namespace brisance::coupling
