// Pressure of the cut cells on the pieces of the wall (theory/coupling.md 1.4).
#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

/// How much of what the fading (theory/coupling.md 1.4) leaves out, `rest`, a step bears where gas is thrown at a wall.
/// It belongs to the pressure `start` at t^n: a sweep that has heated the cell since (`now`) does not multiply it. And
/// its impulse at most turns the gas around, of `momentum` towards the wall per volume: what lies in a narrow gap has
/// more wall than mass. `dt_per_depth`: step over depth of the cell before its walls, s/m.
Real bearable(Real rest, Real start, Vec3 const& now, Real momentum, Real dt_per_depth) {
  Real const impulse = rest * start * dt_per_depth, turns = 2 * momentum, largest = max(now.x, max(now.y, now.z));
  if (impulse > turns) rest *= turns / impulse;
  if (largest > start) rest *= start / largest;
  return rest;
}

}  // namespace

Real CutCells::half_riemann(State const& u, Vec3 const& wall_velocity, Vec3 const& area, Vec3 const& now,
                            Real dt_per_depth) const {
  fluid::Gas const& gas = flow_.gas();
  if (config_.wall_pressure == "cell" || !gas.curve.zero()) return 1;  // the factor is that of an ideal gas
  Real const c = gas.sound_speed(u), size = norm(area);
  if (!(c > 0) || !(size > 0)) return 1;  // a triangle whose corners coincide sweeps, but bears nothing
  Vec3 const velocity = Vec3{u[1], u[2], u[3]} / u[0];
  Real const mach = dot(velocity - wall_velocity, area) / (size * c);
  Real const g = gas.gamma;
  Real exact;
  if (mach > 0) {
    exact = std::pow(max(0, 1 - 0.5 * (g - 1) * mach), 2 * g / (g - 1));
  } else {
    Real const m = -mach, b = 0.25 * (g + 1) * m;
    exact = 1 + g * m * (b + std::sqrt(1 + b * b));
  }
  Real const theta = clamp(2 - 2 * std::abs(mach), 0, 1);
  Real const faded = theta * exact + 1 - theta;
  if (mach >= -0.5 || dt_per_depth < 0) return faded;
  return faded + bearable(exact - faded, gas.pressure(u), now, -mach * c * u[0], dt_per_depth);
}

bool CutCells::between_walls(WallRecord const& record, CutCell const& cut) const {
  fluid::Grid const& grid = flow_.grid();
  Vec3 sum;
  Real total = 0;
  for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
    Vec3 const& area = record.geometry.pieces[static_cast<std::size_t>(f)].area;
    sum += area;
    total += norm(area);
  }
  bool thin = record_.solid(cut.cell) || cut.volume <= 0.1 * grid.cell_volume();
  for (int d = 0; d < grid.dimension; ++d)
    for (int side = 0; side < 2; ++side) {
      auto const at = static_cast<std::size_t>(d);
      if (cut.cell[at] != (side == 0 ? 0 : grid.cells[at] - 1) || !flow_.reflecting(d, side)) continue;
      Real const open = record.aperture(cut.cell, d, side);
      sum[d] += side == 0 ? open : -open;
      total += open;
      thin = true;
    }
  return thin && norm(sum) < 0.5 * total;
}

void CutCells::find_vacuum(WallRecord const& record, bool initial) {
  fluid::Grid const& grid = flow_.grid();
  vacuum_.clear();
  CellBox around{grid.cells, {0, 0, 0}};  // this rank's blocks
  for (fluid::Block const& block : std::as_const(flow_).blocks())
    for (std::size_t d = 0; d < 3; ++d) {
      CellBox const box = box_of(block);
      around.low[d] = std::min(around.low[d], box.low[d]);
      around.high[d] = std::max(around.high[d], box.high[d]);
    }
  near_.start(around);
  for (CutCell const& cut : record.geometry.cells)
    for_neighbourhood(grid, cut.cell, 1, [&](CellIndex n) {
      if (around.holds(n)) near_.insert(n);
    });
  for (CellIndex const& n : near_.cells()) {
    if (record_.solid(n) || !owned(n)) continue;
    fluid::Block const& block = *flow_.find(grid.block_of(n));
    CellIndex const first = block.first();
    Index const i = n[0] - first[0], j = n[1] - first[1], k = n[2] - first[2];
    WallBlock const& wall = sweeper_.blocks().at(block.id());
    if (flow_.gas().vacuum(initial ? block.load(i, j, k) : wall.before[wall.cell(i, j, k)]))
      vacuum_.push_back(grid.cell_id(n));
  }
  std::sort(vacuum_.begin(), vacuum_.end());
  std::map<int, parallel::Bytes> to;
  for (GlobalId const id : vacuum_) {
    CellIndex const c = cell_from_id(grid, id);
    std::vector<int> told{comm_.rank()};
    for_neighbourhood(grid, c, 1, [&](CellIndex n) {
      if (!grid.inside(n)) return;
      int const rank = flow_.owner(grid.block_of(n));
      if (std::find(told.begin(), told.end(), rank) != told.end()) return;
      told.push_back(rank);
      parallel::put(to[rank], id);
    });
  }
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to) out.push_back({rank, std::move(data)});
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) vacuum_.push_back(parallel::take<GlobalId>(in));
  std::sort(vacuum_.begin(), vacuum_.end());
}

void CutCells::wall_pressure(WallRecord const& record, bool initial, Real dt, std::vector<CellForce>& forces) {
  fluid::Grid const& grid = flow_.grid();
  forces.clear();
  piece_factor_.assign(record.geometry.pieces.size(), 1);
  find_vacuum(record, initial);
  for (CutCell const& cut : record.geometry.cells) {
    if (!owned(cut.cell)) continue;
    fluid::Block const& block = *flow_.find(grid.block_of(cut.cell));
    CellIndex const first = block.first();
    Index const i = cut.cell[0] - first[0], j = cut.cell[1] - first[1], k = cut.cell[2] - first[2];
    WallBlock const& wall = sweeper_.blocks().at(block.id());
    State main = initial ? block.load(i, j, k) : wall.before[wall.cell(i, j, k)];
    // In a cell that was solid stands the gas as the wall mirrors it: what meets the wall would seem to leave it.
    if (record_.solid(cut.cell))
      if (MirrorCell const* const mirror = wall.mirror_at({i, j, k}); mirror && mirror->slot >= 0)
        main = reflect(main, *mirror);
    // The factor is 1 in or next to a vacuum cell, and between walls.
    bool vacuum = false;
    if (!vacuum_.empty())
      for_neighbourhood(grid, cut.cell, 1, [&](CellIndex n) {
        vacuum = vacuum || (grid.inside(n) && std::binary_search(vacuum_.begin(), vacuum_.end(), grid.cell_id(n)));
      });
    bool const factor_one = vacuum || between_walls(record, cut) || (!initial && sweeper_.bound(cut.cell));
    Vec3 main_pressure;
    for (int d = 0; d < grid.dimension; ++d)
      main_pressure[d] =
          initial ? flow_.gas().pressure(main) : wall.pressure[static_cast<std::size_t>(d)][wall.cell(i, j, k)];
    Real wet = 0;
    for (Index f = cut.first_piece; f < cut.last_piece; ++f)
      wet += norm(record.geometry.pieces[static_cast<std::size_t>(f)].area);
    Real const dt_per_depth = dt * wet / record.volume(cut.cell);
    bool const divided = record.parts.find(cut.cell) || (!initial && parts_.find(cut.cell));
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
      State u = main;
      Vec3 pressure = main_pressure;
      if (divided) {
        std::size_t const unit = parts_.unit_of(f);
        if (initial && unit > 0) {
          u = start_state(cut.cell, unit);
          pressure = flow_.gas().pressure(u) * Vec3{1, 1, 1};
        } else if (!initial) {
          u = main_before(cut.cell, unit) ? main : state_before(cut.cell, unit);
          pressure = unit_pressure(cut.cell, unit);
        }
      }
      Vec3 const velocity = record.wall_velocity(piece.triangle, piece.bary_centroid);
      Real const chi = factor_one ? 1 : half_riemann(u, velocity, piece.area, pressure, dt_per_depth);
      piece_factor_[static_cast<std::size_t>(f)] = chi;
      PieceFriction const friction = viscous_ && !initial ? (*viscous_)[static_cast<std::size_t>(f)] : PieceFriction{};
      Vec3 const felt = force_on_solid(chi, pressure, piece.area), force = felt + friction.force;
      if (scheme_ == TimeCoupling::explicit_load && !initial) {
        StartExchange::Share received{force, friction.heat};
        if (ambient_pressure_) {
          received.beyond = force_of_gas(chi, pressure, piece.area) - felt;
          received.beyond_power = dot(received.beyond, velocity);
        }
        at_start_.give(record, static_cast<std::size_t>(f), received);
      }
      GlobalId const triangle = record.triangles[static_cast<std::size_t>(piece.triangle)].id;
      GlobalId const cell = grid.cell_id(cut.cell);
      if (forces.empty() || forces.back().triangle != triangle || forces.back().cell != cell)
        forces.push_back({triangle, cell, {}, 0});
      for (std::size_t a = 0; a < 3; ++a) forces.back().force[a] += piece.bary_centroid[a] * force;
      forces.back().area += norm(piece.area);
    }
  }
}

}  // namespace brisance::coupling
