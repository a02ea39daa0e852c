#include "coupling/cut_cells/viscous_wall.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/wall_profile.hpp"
#include "fluid/diffusion/single_face.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

/// Cells around a cut cell from which the profile at the wall is taken: two beyond it, full ones start in the second.
constexpr Index reach = 2;

/// How the velocity of a triangle of the wall changes along its plane: d/dx of the velocity in the directions of the
/// plane (3D: of the triangle, 2D: of the segment), 1/s.
struct SurfaceGradient {
  std::array<Vec3, 3> direction{};  // gradient of the barycentric coordinates
  std::array<Vec3, 3> velocity{};
  Vec3 along(Vec3 const& t) const {
    Vec3 change;
    for (std::size_t a = 0; a < 3; ++a) change += dot(direction[a], t) * velocity[a];
    return change;
  }
  /// Gradient in the plane of the velocity along n.
  Vec3 of_component(Vec3 const& n) const {
    Vec3 gradient;
    for (std::size_t a = 0; a < 3; ++a) gradient += dot(velocity[a], n) * direction[a];
    return gradient;
  }
};

SurfaceGradient surface_gradient(SurfaceTriangle const& t, int dimension) {
  SurfaceGradient g;
  if (dimension == 2) {
    Vec3 const edge = t.x_new[1] - t.x_new[0];
    g.direction[1] = edge / norm2(edge);
    g.direction[0] = -g.direction[1];
    g.velocity = {t.velocity[0], t.velocity[1], {}};
    return g;
  }
  Vec3 const normal = cross(t.x_new[1] - t.x_new[0], t.x_new[2] - t.x_new[0]);
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 const opposite = t.x_new[(a + 2) % 3] - t.x_new[(a + 1) % 3];
    g.direction[a] = cross(normal, opposite) / norm2(normal);
    g.velocity[a] = t.velocity[a];
  }
  return g;
}

}  // namespace

void ViscousWall::prepare() {
  sweeper_.set_mirrors([this](State const& u, MirrorCell const& m) {
    return fluid::wall_mirror(u, transport_.gas, config_.slip, config_.temperature, m.wall_velocity, m.normal);
  });
}

void ViscousWall::Sink::add(int direction, Index j, Index k, Index faces, Real* stress, std::ptrdiff_t pitch) {
  thin->replace(direction, j, k, stress, pitch);
  auto& impulse = wall->viscous[static_cast<std::size_t>(direction)];
  for (Index i = 0; i < faces; ++i) {
    auto& face = impulse[wall->face(direction, i, j, k)];
    for (std::size_t q = 0; q < 4; ++q) face[q] += weight * stress[static_cast<std::ptrdiff_t>(q) * pitch + i];
  }
}

fluid::FaceSink& ViscousWall::sink(Index block, Real weight) {
  sink_.wall = &sweeper_.blocks().at(block);
  sink_.weight = weight;
  thin_.find(*std::as_const(flow_).find(block), *sink_.wall);
  return sink_;
}

void ViscousWall::begin_step() {
  for (auto& [id, wall] : sweeper_.blocks())
    for (std::size_t d = 0; d < 3; ++d) wall.viscous[d].assign(wall.flux[d].size(), {});
}

State ViscousWall::state(CellIndex c) const {
  fluid::Grid const& grid = flow_.grid();
  if (fluid::Block const* const block = std::as_const(flow_).find(grid.block_of(c))) {
    CellIndex const first = block->first();
    return block->load(c[0] - first[0], c[1] - first[1], c[2] - first[2]);
  }
  return around_[around_.slot(grid.cell_id(c))];
}

void ViscousWall::find(WallRecord const& now, WallRecord const& next, bool moved, OwnState const& own) {
  fluid::Grid const& grid = flow_.grid();
  auto const owned = [&](CellIndex c) { return grid.inside(c) && flow_.owner(grid.block_of(c)) == comm_.rank(); };
  if (moved || !planned_) {
    std::vector<GlobalId> wanted;
    for (CutCell const& cut : next.geometry.cells)
      if (owned(cut.cell))
        for_neighbourhood(grid, cut.cell, reach, [&](CellIndex c) {
          if (grid.inside(c) && !owned(c)) wanted.push_back(grid.cell_id(c));
        });
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    around_.plan(comm_, flow_, std::move(wanted));
    planned_ = true;
  }
  around_.refresh(comm_, [](fluid::Block const& b, Index i, Index j, Index k) { return b.load(i, j, k); });
  found_.assign(next.geometry.pieces.size(), {});
  for (CutCell const& cut : next.geometry.cells) {
    if (!owned(cut.cell)) continue;
    bool const look = GasBeside::possible(next, cut, reach);
    PartedCell const* const parts = next.parts.find(cut.cell);
    std::size_t around = most_parts;  // the part whose gas was looked for
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      std::size_t const part = parts ? next.parts.part_of(*parts, f) : 0;
      if (look && part != around) gas_.find(next, cut.cell, part, reach), around = part;
      found_[static_cast<std::size_t>(f)] = friction(now, next, cut, f, look ? &gas_ : nullptr, own);
    }
  }
}

std::array<Real, 4> ViscousWall::between(State const& low, State const& high, int direction, Real dt) const {
  std::array<Real, 4> flux = fluid::viscous_flux(transport_, flow_.grid(), direction, low, high);
  for (Real& f : flux) f *= dt;
  return flux;
}

PieceFriction ViscousWall::friction(WallRecord const& now, WallRecord const& next, CutCell const& cut, Index place,
                                    GasBeside const* gas_around, OwnState const& own) const {
  if (config_.slip && !config_.temperature) return {};
  fluid::Grid const& grid = flow_.grid();
  fluid::Gas const& gas = transport_.gas;
  Piece const& piece = next.geometry.pieces[static_cast<std::size_t>(place)];
  Real const h = smallest_spacing(grid), area = norm(piece.area);
  Vec3 const n = piece.area / area;
  Vec3 const wall_velocity = next.wall_velocity(piece.triangle, piece.bary_centroid);
  SurfaceGradient const gradient =
      surface_gradient(next.triangles[static_cast<std::size_t>(piece.triangle)], grid.dimension);
  WallProfile profile(n, h, grid.dimension);
  Real temperatures = 0, weights = 0;
  auto const consider = [&](CellIndex c, State const& u, Real least_distance) {
    if (gas.vacuum(u)) return;
    Vec3 const offset = grid.centre(c) - piece.centroid;
    Real const d = max(dot(offset, n), least_distance);
    Vec3 const beside = offset - dot(offset, n) * n;
    Vec3 const relative = Vec3{u[1], u[2], u[3]} / u[0] - wall_velocity - gradient.along(beside);
    Real const temperature = gas.temperature(u[0], gas.pressure(u));
    Real const w = square(h) / (square(d) + norm2(beside));
    profile.add(d, beside, {relative.x, relative.y, relative.z, temperature - config_.temperature.value_or(0)}, w);
    temperatures += w * temperature, weights += w;
  };
  for_neighbourhood(grid, cut.cell, reach, [&](CellIndex c) {
    if (!grid.inside(c) || now.solid(c) || next.solid(c) || now.cut_index(c) >= 0 || next.cut_index(c) >= 0) return;
    if (gas_around && !gas_around->holds(c)) return;
    if (dot(grid.centre(c) - piece.centroid, n) > 0.25 * h) consider(c, state(c), 0);
  });
  // Walls so near to each other that no full cell lies between them: what the cell itself holds.
  if (weights == 0 && !next.solid(cut.cell)) consider(cut.cell, own(cut, place), 0.5 * h);
  if (weights == 0) return {};

  auto const slope = profile.slopes();
  Real const mu = transport_.viscosity(config_.temperature.value_or(temperatures / weights));
  PieceFriction result;
  if (!config_.slip) {
    // Stress of a wall that holds the gas: the change of the velocity along n, and of that of the wall in its plane, so
    // that gas turning with a body feels none; 4/3 of the part along n.
    Vec3 const change{slope[0], slope[1], slope[2]};
    Vec3 const traction = change + gradient.of_component(n) + dot(change, n) / 3 * n;
    result.force = mu * area * traction;
  }
  if (config_.temperature) result.heat = mu * transport_.conductivity_ratio * area * slope[3];
  return result;
}

}  // namespace brisance::coupling
