// The balance of the cut cells in content form (theory/coupling.md 1.3): what was there, what the wall swept from and
// to the neighbours, what the faces and the wall let through.
#include <algorithm>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/openings.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

namespace {
void add(State& to, Real factor, State const& u) {
  for (std::size_t q = 0; q < 5; ++q) to[q] += factor * u[q];
}
/// Stress and energy flux over a step, as they are subtracted from the flux along the axis.
void add_viscous(State& to, Real factor, std::array<Real, 4> const& stress) {
  for (std::size_t q = 0; q < 4; ++q) to[1 + q] += factor * stress[q];
}
}  // namespace

void CutCells::transfers() {
  fluid::Grid const& grid = flow_.grid();
  transfers_.clear();
  if (!moved_) return;
  std::vector<CellBox> near;
  for (Block const& block : std::as_const(flow_).blocks()) near.push_back(grown(grid, box_of(block), 1));
  std::vector<GlobalId> wanted;
  auto watch = std::make_optional<Stopwatch>(cost_.geometry_s);
  // Beyond an open side the gas goes on as it is inside; beyond a reflecting one there is none.
  auto const open = [&](CellIndex c) {
    for (int d = 0; d < grid.dimension; ++d) {
      auto const dir = static_cast<std::size_t>(d);
      if (c[dir] < 0 && (grid.periodic[dir] || flow_.reflecting(d, 0))) return false;
      if (c[dir] >= grid.cells[dir] && (grid.periodic[dir] || flow_.reflecting(d, 1))) return false;
    }
    return true;
  };
  auto const id_of = [&](CellIndex c) { return grid.inside(c) ? grid.cell_id(c) : GlobalId{-1}; };
  for (CutCell const& cut : next_.geometry.cells) {
    bool const here = owned(cut.cell);
    if (!here && std::none_of(near.begin(), near.end(), [&](CellBox const& b) { return b.holds(cut.cell); })) continue;
    bool moving = false;
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = next_.geometry.pieces[static_cast<std::size_t>(f)];
      SurfaceTriangle const& triangle = next_.triangles[static_cast<std::size_t>(piece.triangle)];
      if (!triangle.moved(grid.dimension)) continue;
      moving = true;
      swept_.clear();
      swept(next_.lattice(), next_.geometry, piece, triangle, swept_);
      Vec3 before;
      for (std::size_t a = 0; a < 3; ++a) before += piece.bary_centroid[a] * triangle.x_old[a];
      Vec3 const middle = 0.5 * (before + piece.centroid);
      Vec3 const velocity = next_.wall_velocity(piece.triangle, piece.bary_centroid);
      for (Swept const& s : swept_) {
        if (s.cell == cut.cell || s.volume == 0) continue;
        if (!here && !owned(s.cell)) continue;
        if (!open(s.cell) || !open(cut.cell)) continue;
        CellIndex const inside = into_domain(grid, s.cell);
        Vec3 place = middle - grid.centre(inside);
        for (int d = 0; d < 3; ++d)
          place[d] = d < grid.dimension ? clamp(place[d], -0.5 * grid.spacing[d], 0.5 * grid.spacing[d]) : 0;
        Transfer t{id_of(cut.cell), id_of(s.cell), grid.cell_id(inside), s.volume, 0, 0, 0, place,
                   piece.area,      velocity};
        if (divided_) {
          t.to_unit = parts_.unit_of(f);
          t.from_unit = parts_.swept_unit(s.cell, f);
          t.state_unit = parts_.swept_unit(inside, f);
        }
        transfers_.push_back(t);
        if (!parts_.find(inside) && (wanted.empty() || wanted.back() != t.state)) wanted.push_back(t.state);
      }
    }
    cost_.moving += moving && here;
  }
  watch.reset();
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  swept_states_.plan(comm_, flow_, std::move(wanted));
  swept_states_.refresh(comm_, [&](Block const& b, Index i, Index j, Index k) {
    WallBlock const& wall = sweeper_.blocks().at(b.id());
    return wall.before[wall.cell(i, j, k)];
  });
}

State CutCells::content_before(CellIndex c, std::size_t unit) const {
  fluid::Grid const& grid = flow_.grid();
  if (CellUnits const* const units = parts_.find(c); units && units->before[unit] != 0) {
    Content const here{grid.cell_id(c), {}, units->before[unit]};
    if (here.unit < 0) return {};
    auto const at = std::lower_bound(minor_.begin(), minor_.end(), here);
    return at != minor_.end() && !(here < *at) ? at->amount : State{};
  }
  if (record_.solid(c)) {
    GlobalId const id = grid.cell_id(c);
    auto const at =
        std::lower_bound(kept_.begin(), kept_.end(), id, [](Content const& k, GlobalId i) { return k.cell < i; });
    return at != kept_.end() && at->cell == id ? at->amount : State{};
  }
  Block const& block = *flow_.find(grid.block_of(c));
  CellIndex const first = block.first();
  WallBlock const& wall = sweeper_.blocks().at(block.id());
  State u = wall.before[wall.cell(c[0] - first[0], c[1] - first[1], c[2] - first[2])];
  Real const v = record_.main_volume(c);
  for (Real& x : u) x *= v;
  return u;
}

template <class Visit>
void CutCells::for_faces_of_sides(int d, Visit const& visit) const {
  fluid::Grid const& grid = flow_.grid();
  auto const dir = static_cast<std::size_t>(d);
  if (grid.periodic[dir]) return;
  std::vector<SideFace> faces;
  for (auto const& [id, wall] : sweeper_.blocks()) {
    CellIndex const first = std::as_const(flow_).find(id)->first();
    std::size_t const t0 = d == 0 ? 1 : 0, t1 = d == 2 ? 1 : 2;
    for (int side = 0; side < 2; ++side) {
      Index const cell = side == 0 ? 0 : wall.size[dir] - 1;
      if (first[dir] + cell != (side == 0 ? 0 : grid.cells[dir] - 1)) continue;
      faces.clear();
      for (Index b = 0; b < wall.size[t1]; ++b)
        for (Index a = 0; a < wall.size[t0]; ++a) {
          CellIndex c{};
          c[dir] = cell, c[t0] = a, c[t1] = b;
          CellIndex face = c;
          face[dir] += side;
          faces.push_back(
              {{first[0] + c[0], first[1] + c[1], first[2] + c[2]}, wall.face(d, face[0], face[1], face[2])});
        }
      visit(wall, side, std::span<SideFace const>(faces));
    }
  }
}

void CutCells::update_contents(Real dt) {
  fluid::Grid const& grid = flow_.grid();
  transfers();

  // The cells to rewrite: with pieces now or before, covered ones that hold something, and those a transfer touches.
  // Divided cells and their neighbours exchange part by part.
  std::vector<Content> band;
  auto const enter = [&](GlobalId id) {
    CellIndex const c = cell_from_id(grid, id);
    if (!owned(c)) return;
    std::size_t const units = parts_.units(c);
    for (std::size_t unit = 0; unit < units; ++unit) band.push_back({id, {}, static_cast<Index>(unit)});
  };
  for (WallRecord const* r : {&record_, &next_})
    for (CutCell const& cut : r->geometry.cells)
      if (grid.inside(cut.cell)) enter(grid.cell_id(cut.cell));
  for (Content const& k : kept_) enter(k.cell);
  for (Transfer const& t : transfers_)
    for (GlobalId const id : {t.to, t.from})
      if (id >= 0) enter(id);
  if (divided_)
    for (GlobalId const id : affected_) enter(id);
  std::sort(band.begin(), band.end());
  band.erase(std::unique(band.begin(), band.end(), same_unit), band.end());
  contents_ = std::move(band);
  balanced_.clear();
  std::vector<CellIndex> swept_cells;  // whose state the sweeps changed: once per cell
  for (Content& c : contents_) {
    CellIndex const cell = cell_from_id(grid, c.cell);
    auto const unit = static_cast<std::size_t>(c.unit);
    balanced_.push_back(cell);
    if (main_before(cell, unit)) swept_cells.push_back(cell);
    c.amount = content_before(cell, unit);
  }
  if (stage_account_) stage_account_->begin_balance(swept_cells, record_, counted());

  pass_transfers(dt);
  charge(Part::transfers);
  for (int d = 0; d < grid.dimension; ++d) {
    pass_fluxes(d, dt);
    charge(sweep_part(d));
  }
  if (viscous_) {
    pass_friction(dt);
    charge(Part::diffusion);
  }
  pass_exchange(dt);
  charge(Part::wall);
}

void CutCells::pass_transfers(Real dt) {
  auto const content = [&](GlobalId id, std::size_t unit) -> State* {
    Content const here{id, {}, static_cast<Index>(unit)};
    auto const at = std::lower_bound(contents_.begin(), contents_.end(), here);
    return at != contents_.end() && same_unit(*at, here) ? &at->amount : nullptr;
  };
  // In the order of pieces, which is that of cells and triangles on every rank.
  for (Transfer const& t : transfers_) {
    Index const slot = swept_states_.slot(t.state);
    State u = slot >= 0 ? swept_states_[slot] : state_before(cell_from_id(flow_.grid(), t.state), t.state_unit);
    if (linear_ && u[0] > 0) {
      // Gas that slides along the wall: the fluxes pass what stands half a step upstream.
      Vec3 const slip = beside(t.area, Vec3{u[1], u[2], u[3]} / u[0] - t.wall_velocity);
      u = sweeper_.profiles().value(t.state, u, moments_of_point(t.place - 0.5 * dt * slip));
    }
    if (State* to = content(t.to, t.to_unit)) add(*to, t.volume, u);
    if (State* from = content(t.from, t.from_unit)) add(*from, -t.volume, u);
    if (t.to < 0 || t.from < 0)
      for (std::size_t q = 0; q < 5; ++q) crossed_[q].add((t.to < 0 ? -t.volume : t.volume) * u[q]);
  }
}

void CutCells::pass_fluxes(int d, Real dt) {
  auto const dir = static_cast<std::size_t>(d);
  for (std::size_t n = 0; n < contents_.size(); ++n) {
    CellIndex const cell = balanced_[n];
    State& amount = contents_[n].amount;
    auto const [wall, local] = wall_block_of(cell);
    for (int side = 0; side < 2; ++side) {
      Real const share = side == 0 ? dt : -dt;
      if (divided_ && affected(contents_[n].cell)) {
        CellIndex const low = side == 0 ? beside(cell, d, -1) : cell;
        for_face(cell, static_cast<std::size_t>(contents_[n].unit), d, side,
                 [&](Real area, std::size_t low_unit, std::size_t high_unit) {
                   add(amount, share * area, opening_flux(low, d, low_unit, high_unit, cell, dt));
                 });
        continue;
      }
      if (linear_) add(amount, share, profile_flux(cell, d, side, dt));
      Real const aperture = next_.aperture(cell, d, side);
      if (aperture == 0) continue;
      CellIndex face = local;
      face[dir] += side;
      add(amount, share * aperture, wall->flux[dir][wall->face(d, face[0], face[1], face[2])]);
    }
  }
  for_faces_of_sides(d, [&](WallBlock const& wall, int side, std::span<SideFace const> faces) {
    Real const share = side == 0 ? dt : -dt;
    State sum{};
    Real impulse = 0;
    for (SideFace const& face : faces) {
      if (divided_ && affected(flow_.grid().cell_id(face.cell))) {
        for (std::size_t unit = 0; unit < parts_.units(face.cell); ++unit)
          for_face(face.cell, unit, d, side, [&](Real open, std::size_t low_unit, std::size_t high_unit) {
            CellIndex const low = side == 0 ? beside(face.cell, d, -1) : face.cell;
            State const flux = opening_flux(low, d, low_unit, high_unit, face.cell, dt);
            add(sum, share * open, flux);
            impulse += dt * open * std::abs(flux[1 + dir]);
          });
        continue;
      }
      if (linear_) add(sum, share, profile_flux(face.cell, d, side, dt));
      Real const area = next_.aperture(face.cell, d, side);
      if (area == 0) continue;
      State const& f = wall.flux[dir][face.at];
      add(sum, share * area, f);
      impulse += dt * area * std::abs(f[1 + dir]);
    }
    for (std::size_t q = 0; q < 5; ++q) crossed_[q].add(sum[q]);
    pressure_impulse_.add(impulse);
    exchanged_energy_.add(std::abs(sum[4]));
  });
}

void CutCells::pass_friction(Real dt) {
  for (int d = 0; d < flow_.grid().dimension; ++d) {
    auto const dir = static_cast<std::size_t>(d);
    // Of a unit of an affected cell, opening by opening.
    auto const pass_openings = [&](CellIndex cell, std::size_t unit, int side, State& to) {
      CellIndex const low = side == 0 ? beside(cell, d, -1) : cell;
      for_face(cell, unit, d, side, [&](Real area, std::size_t low_unit, std::size_t high_unit) {
        add_viscous(to, (side == 0 ? -1 : 1) * area, opening_stress(low, d, low_unit, high_unit, cell, dt));
      });
    };
    for (std::size_t n = 0; n < contents_.size(); ++n) {
      auto const [wall, local] = wall_block_of(balanced_[n]);
      for (int side = 0; side < 2; ++side) {
        if (divided_ && affected(contents_[n].cell)) {
          pass_openings(balanced_[n], static_cast<std::size_t>(contents_[n].unit), side, contents_[n].amount);
          continue;
        }
        Real const aperture = next_.aperture(balanced_[n], d, side);
        if (aperture == 0) continue;
        CellIndex face = local;
        face[dir] += side;
        add_viscous(contents_[n].amount, (side == 0 ? -1 : 1) * aperture,
                    wall->viscous[dir][wall->face(d, face[0], face[1], face[2])]);
      }
    }
    for_faces_of_sides(d, [&](WallBlock const& wall, int side, std::span<SideFace const> faces) {
      State sum{};
      for (SideFace const& face : faces)
        if (divided_ && affected(flow_.grid().cell_id(face.cell))) {
          for (std::size_t unit = 0; unit < parts_.units(face.cell); ++unit) pass_openings(face.cell, unit, side, sum);
        } else if (Real const area = next_.aperture(face.cell, d, side); area != 0) {
          add_viscous(sum, (side == 0 ? -1 : 1) * area, wall.viscous[dir][face.at]);
        }
      for (std::size_t q = 0; q < 5; ++q) crossed_[q].add(sum[q]);
      exchanged_energy_.add(std::abs(sum[4]));
    });
  }
}

void CutCells::pass_exchange(Real dt) {
  for (std::size_t n = 0; n < contents_.size(); ++n) {
    Index const cut_index = next_.cut_index(balanced_[n]);
    if (cut_index < 0) continue;
    CutCell const& cut = next_.cut(cut_index);
    if (scheme_ == TimeCoupling::explicit_load)
      exchange_of_start(cut, static_cast<std::size_t>(contents_[n].unit), dt, contents_[n].amount);
    else
      exchange_at_end(cut, static_cast<std::size_t>(contents_[n].unit), dt, contents_[n].amount);
  }
  if (scheme_ == TimeCoupling::explicit_load) exchange_outside(dt);
  if (ambient_pressure_) ambient_account(dt);
}

std::pair<WallBlock const*, CellIndex> CutCells::wall_block_of(CellIndex c) const {
  Block const& block = *std::as_const(flow_).find(flow_.grid().block_of(c));
  CellIndex const first = block.first();
  return {&sweeper_.blocks().at(block.id()), {c[0] - first[0], c[1] - first[1], c[2] - first[2]}};
}

void CutCells::take(Vec3 const& force, Real heat, Vec3 const& velocity, Real dt, State& amount) {
  Real const work = dot(force, velocity);
  for (int d = 0; d < 3; ++d) amount[static_cast<std::size_t>(d) + 1] -= dt * force[d];
  if (viscous_) {
    amount[4] -= dt * heat;
    wall_heat_.add(dt * heat);
    exchanged_energy_.add(dt * std::abs(heat));
  }
  amount[4] -= dt * work;
  pressure_impulse_.add(dt * norm(force));
  exchanged_energy_.add(dt * std::abs(work));
}

void CutCells::take_difference(Index triangle, Real area, Real dt, State& amount) {
  SurfaceTriangle const& t = next_.triangles[static_cast<std::size_t>(triangle)];
  Real const energy = dt * area * t.centring;
  for (int d = 0; d < 3; ++d) amount[static_cast<std::size_t>(d) + 1] -= dt * area * t.turning[d];
  amount[4] -= energy;
  exchanged_energy_.add(std::abs(energy));
}

Vec3 CutCells::swept_pressure(CellIndex c) const {
  fluid::Grid const& grid = flow_.grid();
  Block const& block = *std::as_const(flow_).find(grid.block_of(c));
  CellIndex const first = block.first();
  WallBlock const& wall = sweeper_.blocks().at(block.id());
  Vec3 pressure;
  for (int d = 0; d < grid.dimension; ++d)
    pressure[d] =
        wall.pressure[static_cast<std::size_t>(d)][wall.cell(c[0] - first[0], c[1] - first[1], c[2] - first[2])];
  return pressure;
}

void CutCells::exchange_at_end(CutCell const& cut, std::size_t unit, Real dt, State& amount) {
  Vec3 const pressure = unit_pressure(cut.cell, unit);
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    if (divided_ && parts_.unit_of(f) != unit) continue;
    Piece const& piece = next_.geometry.pieces[static_cast<std::size_t>(f)];
    Real const chi = piece_factor_[static_cast<std::size_t>(f)];
    // The same numbers as the force on the solid, with the opposite sign.
    Vec3 force = force_of_gas(chi, pressure, piece.area);
    PieceFriction const friction = viscous_ ? (*viscous_)[static_cast<std::size_t>(f)] : PieceFriction{};
    if (viscous_) force += friction.force;
    take(force, friction.heat, next_.wall_velocity(piece.triangle, piece.bary_centroid), dt, amount);
    take_difference(piece.triangle, norm(piece.area), dt, amount);
  }
}

void CutCells::take_part(Index triangle, TrianglePart const& part, StartExchange::Share const& share, Real dt,
                         State& amount) {
  take(part.share * share.force, part.share * share.heat, next_.wall_velocity(triangle, part.bary), dt, amount);
  take_difference(triangle, part.share * share.area, dt, amount);
  if (!ambient_pressure_) return;
  for (int d = 0; d < 3; ++d) amount[static_cast<std::size_t>(d) + 1] -= dt * part.share * share.beyond[d];
  amount[4] -= dt * part.share * share.beyond_power;
}

void CutCells::exchange_of_start(CutCell const& cut, std::size_t unit, Real dt, State& amount) {
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    if (divided_ && parts_.unit_of(f) != unit) continue;
    Piece const& piece = next_.geometry.pieces[static_cast<std::size_t>(f)];
    at_start_.for_parts(record_, next_, piece, [&](TrianglePart const& part, StartExchange::Share const& share, auto&) {
      take_part(piece.triangle, part, share, dt, amount);
    });
  }
}

void CutCells::exchange_outside(Real dt) {
  fluid::Grid const& grid = flow_.grid();
  for (CutCell const& cut : next_.geometry.cells) {
    if (grid.inside(cut.cell)) continue;
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = next_.geometry.pieces[static_cast<std::size_t>(f)];
      at_start_.for_parts(record_, next_, piece,
                          [&](TrianglePart const& part, StartExchange::Share const& share, Piece const& before) {
                            if (!owned(before.cell)) return;
                            State paid{};  // by nobody inside: as if it came from beyond the boundary
                            take_part(piece.triangle, part, share, dt, paid);
                            for (std::size_t q = 1; q < 5; ++q) crossed_[q].add(-paid[q]);
                          });
    }
  }
}

Amounts CutCells::counted() const {
  Amounts sums;
  for (Content const& c : contents_)
    for (std::size_t q = 0; q < 5; ++q) sums[q].add(c.amount[q]);
  subtract(sums, crossed_);
  for (std::size_t d = 0; d < 3; ++d) sums[1 + d].subtract(ambient_given_[d]);
  sums[4].subtract(ambient_given_[3]);
  sums[4].add(wall_heat_);
  return sums;
}

void CutCells::charge(Part part) {
  if (stage_account_) stage_account_->charge(part, counted());
}

}  // namespace brisance::coupling
