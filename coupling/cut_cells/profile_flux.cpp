// Second order at partly open faces: the sweeps give the flux at the middle of a whole face at the middle of the step,
// the balance takes it through the part that is open at the end of the step (coupling/README.md, "Density profiles").
#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

/// Speed of the wall along `normal`: the mean over the pieces of both cells that face this way. The facets of a round
/// wall that turns go forth and back at their ends, the wall does not.
Real advance(WallRecord const& record, CellIndex low, CellIndex high, Vec3 const& normal) {
  Real sum = 0, weight = 0;
  for (CellIndex const& c : {low, high}) {
    Index const index = record.cut_index(c);
    if (index < 0) continue;
    CutCell const& cut = record.cut(index);
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
      Real const facing = dot(piece.area, normal), size = norm(piece.area);
      if (!(facing > 0 && size > 0)) continue;
      sum += facing * dot(record.wall_velocity(piece.triangle, piece.bary_centroid), piece.area) / size;
      weight += facing;
    }
  }
  return weight > 0 ? sum / weight : 0;
}

}  // namespace

State CutCells::profile_flux(CellIndex c, int d, int side, Real dt) const {
  fluid::Grid const& grid = flow_.grid();
  auto const dir = static_cast<std::size_t>(d);
  CellIndex low = c, high = c;
  (side == 0 ? low : high)[dir] += side == 0 ? -1 : 1;
  // Cells that exchange part by part have no profiles.
  if (divided_)
    for (CellIndex const& cell : {low, high})
      if (grid.inside(cell) && affected(grid.cell_id(cell))) return {};
  // Through a side of the domain goes what the law of the side says, but for the gas that slides out along the wall.
  bool const inner = grid.inside(low) && grid.inside(high);
  if (!inner && (grid.periodic[dir] || flow_.reflecting(d, side))) return {};
  Real const now = next_.aperture(c, d, side), whole = grid.face_area(d);
  if (!(now > 0 && now < whole)) return {};

  WallSlopes const& profiles = sweeper_.profiles();
  Moments const face = face_moments(grid, d);
  State u{};  // the mean of both sides, over the whole face
  Profile profile{};
  Real known = 0;
  for (int end = 0; end < 2; ++end) {
    CellIndex const cell = end == 0 ? low : high;
    if (!grid.inside(cell)) continue;
    GlobalId const id = grid.cell_id(cell);
    State const* const mean = profiles.mean(id);
    if (!mean || !((*mean)[0] > 0)) continue;
    Vec3 centre;  // of the face
    centre[d] = (end == 0 ? 0.5 : -0.5) * grid.spacing[d];
    State const at_face = profiles.value(id, *mean, moved(face, centre));
    known += 1;
    for (std::size_t q = 0; q < 5; ++q) u[q] += at_face[q];
    if (Profile const* const p = profiles.profile(id)) profile = profile + moved(*p, centre);
  }
  if (known == 0) return {};
  profile = 1 / known * profile;
  for (Real& x : u) x /= known;
  Vec3 const velocity = Vec3{u[1], u[2], u[3]} / u[0];

  State flux{};
  if (inner) {
    // What comes through the face in a sweep stood half a step upstream, and farther along the axes swept before.
    Vec3 upstream;
    for (int t = 0; t < grid.dimension; ++t)
      upstream[t] = (t == d ? -0.5 : sweeper_.swept_before(t, d) ? -1 : 0) * dt * velocity[t];
    Moments const open = aperture_moments(next_, c, d, side);
    flux = flux_change(flow_.gas(), u, change_between(moved(profile, upstream), open - face), d);
    for (Real& f : flux) f *= now;
  }
  if (moved_)
    for_open_edges(next_, c, d, side, [&](OpenEdge const& edge) {
      // Between the wall and the gas that slides along it opens a triangle: what was there at the start of the step
      // passes the face with the gas, though neither the flux nor the swept volume know of it.
      Vec3 const wall = next_.wall_velocity(edge.piece.triangle, edge.piece.bary_centroid);
      Real const size = norm(edge.piece.area);
      if (!(size > 0)) return;
      Vec3 const normal = edge.piece.area / size;
      Vec3 const slip = beside(normal, velocity - wall);
      Real const rate = 0.5 * dt * advance(next_, low, high, normal) *
                        (dot(normal, edge.open) * slip[d] - normal[d] * dot(slip, edge.open));
      Vec3 const place = 0.5 * (edge.a + edge.b) - dt / 3 * (wall + velocity);
      State const v = moved_within(flow_.gas(), u, change_between(profile, moments_of_point(place) - face));
      for (std::size_t q = 0; q < 5; ++q) flux[q] += rate * v[q];
    });
  return flux;
}

}  // namespace brisance::coupling
