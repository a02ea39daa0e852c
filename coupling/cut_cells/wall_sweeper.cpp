#include "coupling/cut_cells/wall_sweeper.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"
#include "fluid/flux/low_order.hpp"
#include "fluid/flux/sweep.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

State reflect(State u, MirrorCell const& mirror) {
  if (!(u[0] > 0)) return u;
  Vec3 const momentum{u[1], u[2], u[3]};
  Vec3 const jump = (2 * (dot(momentum, mirror.normal) - u[0] * mirror.wall_speed)) * mirror.normal;
  Vec3 const reflected = momentum - jump;
  u[4] += 0.5 * (norm2(reflected) - norm2(momentum)) / u[0];
  u[1] = reflected.x, u[2] = reflected.y, u[3] = reflected.z;
  return u;
}

MirrorCell const* WallBlock::mirror_at(CellIndex const& local) const {
  auto const place = [](CellIndex const& c) { return std::tuple(c[2], c[1], c[0]); };
  auto const at = std::lower_bound(solid.begin(), solid.end(), local, [&](auto const& entry, CellIndex const& c) {
    return place(entry.first) < place(c);
  });
  return at != solid.end() && at->first == local ? &at->second : nullptr;
}

namespace {

/// Highest order whose window stays within the run; 5, or the scene's if lower, when none does.
std::uint8_t order_within(int scene_order, Index room) {
  int const fits = room >= 6 ? 11 : room >= 5 ? 9 : room >= 4 ? 7 : 5;
  return static_cast<std::uint8_t>(std::min(scene_order, fits));
}

/// Components of a state in sweep coordinates: the momentum normal to the faces comes first.
constexpr std::array<std::array<std::size_t, 5>, 3> sweep_component{
    {{0, 1, 2, 3, 4}, {0, 2, 1, 3, 4}, {0, 3, 2, 1, 4}}};

/// Order of the faces near cut cells that hold profiles. Higher ones damp too little: what the profiles make of noise
/// along the wall then grows (coupling/README.md).
constexpr std::uint8_t calm_order = 3;
/// Cells along the sweep from a face within which a cut cell makes it one of these.
constexpr Index calm_reach = 3;

/// Health bits of a full cell after a sweep, with the bands of theory/fluid.md 4.4.
std::uint64_t judge(State const& u, fluid::Gas const& gas) {
  auto const bit = [](fluid::Health h) { return static_cast<std::uint64_t>(h); };
  if (!(std::abs(u[0]) < 1e300) || !(std::abs(u[4]) < 1e300)) return bit(fluid::Health::not_finite);
  if (!(u[0] >= -1e-3 * gas.vacuum_density)) return bit(fluid::Health::negative_density);
  Real const rest = gas.curve.zero() ? u[4] : u[4] - gas.reference_energy(max(u[0], gas.vacuum_density));
  Real const twice = 2 * u[0] * rest - (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]);  // 2 rho phi
  if (!(twice >= -2e-13 * std::abs(u[0] * u[4]))) return bit(fluid::Health::negative_energy);
  return 0;
}

/// Is sigma (|u| + c) above 1 before the sweep? Without root or division: (rho c)^2 against (rho / sigma - |m|)^2.
std::uint64_t courant(Real density, Real momentum, Real pressure, Real sigma, fluid::Gas const& gas) {
  Real const thermal =
      gas.curve.zero() ? pressure : pressure - gas.reference_pressure(max(density, gas.vacuum_density));
  if (!(thermal > 0)) return 0;  // vacuum
  Real const room = density / sigma - std::abs(momentum);
  Real impedance2 = gas.gamma * thermal * density;
  if (gas.curve.exponential()) impedance2 += density * density * gas.reference_slope(density);
  bool const bad = room < 0 || impedance2 > room * room;
  return bad ? static_cast<std::uint64_t>(fluid::Health::courant) : 0;
}

/// What goes through a face that is inside out, as between bodies that overlap: no gas but what moves with the walls.
/// The flux between states of either side would run from the lower to the higher pressure there.
State closed_flux(State const& a, State const& b, Vec3 const& wall_velocity, int direction, fluid::Gas const& gas) {
  auto const internal = [](State const& u) {
    return u[0] > 0 ? u[4] - 0.5 * (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / u[0] : u[4];
  };
  Real const density = 0.5 * (a[0] + b[0]), pressure = 0.5 * (gas.pressure(a) + gas.pressure(b));
  Real const energy = 0.5 * (internal(a) + internal(b)) + 0.5 * density * norm2(wall_velocity);
  Real const speed = wall_velocity[direction];
  State flux{speed * density, 0, 0, 0, speed * (energy + pressure)};
  for (int d = 0; d < 3; ++d) flux[static_cast<std::size_t>(d) + 1] = speed * density * wall_velocity[d];
  flux[static_cast<std::size_t>(direction) + 1] += pressure;
  return flux;
}

}  // namespace

void WallSweeper::begin_step() {
  profiled_ = false;
  sweeps_ = 0;
  done_ = under_way_ = {};
  for (auto& [id, wall] : blocks_) {
    Block const& block = *flow_.find(id);
    std::size_t const cells = static_cast<std::size_t>(wall.size[0]) * static_cast<std::size_t>(wall.size[1]) *
                              static_cast<std::size_t>(wall.size[2]);
    wall.before.resize(cells);
    for (Index k = 0; k < wall.size[2]; ++k)
      for (Index j = 0; j < wall.size[1]; ++j)
        for (Index i = 0; i < wall.size[0]; ++i) wall.before[wall.cell(i, j, k)] = block.load(i, j, k);
    for (int d = 0; d < flow_.grid().dimension; ++d) {
      auto const dir = static_cast<std::size_t>(d);
      auto const n = static_cast<std::size_t>(wall.size[dir]);
      wall.flux[dir].resize(cells / n * (n + 1));
      wall.pressure[dir].resize(cells);
    }
  }
}

void WallSweeper::make_profiles(WallRecord const& next, bool same) {
  fluid::Grid const& grid = flow_.grid();
  if (!same || !profiles_.planned()) {
    std::vector<CellBox> near;
    for (Block const& block : std::as_const(flow_).blocks()) near.push_back(grown(grid, box_of(block), 1));
    std::vector<GlobalId> cells;
    for (WallRecord const* r : {record_, &next})
      for (CutCell const& cut : r->geometry.cells)
        if (grid.inside(cut.cell) &&
            std::any_of(near.begin(), near.end(), [&](CellBox const& b) { return b.holds(cut.cell); }))
          cells.push_back(grid.cell_id(cut.cell));
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    profiles_.plan(comm_, flow_, *record_, std::move(cells));
  }
  if (!image_slopes_.planned()) image_slopes_.plan(comm_, flow_, *record_, image_cells_);
  auto const read = [](Block const& b, Index i, Index j, Index k) { return b.load(i, j, k); };
  profiles_.refresh(comm_, read, profile_kind);
  image_slopes_.refresh(comm_, read, profile_kind);
  profiled_ = true;
  Moments const whole = cell_moments(grid);
  for (auto& [id, wall] : blocks_) {
    Block& block = *flow_.find(id);
    CellBox const own = box_of(block);
    CellIndex const first = block.first();
    for (CutCell const& cut : record_->geometry.cells) {
      if (!own.holds(cut.cell) || record_->solid(cut.cell)) continue;
      Index const i = cut.cell[0] - first[0], j = cut.cell[1] - first[1], k = cut.cell[2] - first[2];
      block.store(i, j, k, profiles_.value(grid.cell_id(cut.cell), wall.before[wall.cell(i, j, k)], whole));
    }
  }
}

State WallSweeper::image(MirrorCell const& mirror) const {
  State const& u = images_[mirror.slot];
  if (!profiled_) return u;
  Profile const* const profile = image_slopes_.profile(image_cells_[static_cast<std::size_t>(mirror.slot)]);
  if (!profile) return u;
  // The sweeps have carried the profile with them.
  Vec3 upstream;
  for (int d = 0; d < 3; ++d) upstream[d] = -done_[d] * u[static_cast<std::size_t>(d) + 1] / u[0];
  return moved_within(flow_.gas(), u, change_between(moved(*profile, upstream), moments_of_point(mirror.offset)));
}

void WallSweeper::prepare(int direction, Real dt) {
  order_[static_cast<std::size_t>(direction)] = sweeps_++;
  done_ += under_way_;
  under_way_ = {};
  under_way_[direction] = dt;
  refresh_mirrors();
}

bool WallSweeper::is_fluid(Block const& block, Index i, Index j, Index k) const {
  CellIndex const first = block.first();
  return !record_->solid({first[0] + i, first[1] + j, first[2] + k});
}

void WallSweeper::calm(Block const& block, WallBlock::Run const& run, int direction, Index longest, std::size_t lane) {
  auto const d = static_cast<std::size_t>(direction);
  auto const width = static_cast<std::size_t>(fluid::lanes());
  CellIndex c = block.first();
  c[d == 0 ? 1 : 0] += run.transverse[0], c[d == 2 ? 1 : 2] += run.transverse[1];
  Index const first = c[d], start = std::max(run.begin, 0);
  auto const is_cut = [&](Index i) {
    if (i < run.begin || i >= run.end) return false;
    c[d] = first + i;
    return record_->cut_index(c) >= 0;
  };
  Index latest = -2 * calm_reach;  // cut cell met last
  Index asked = -calm_reach;
  for (Index f = 0; f <= longest; ++f) {
    for (; asked < f + calm_reach; ++asked)
      if (is_cut(start + asked)) latest = asked;
    if (latest < f - calm_reach) continue;
    std::uint8_t& order = scratch_order_[static_cast<std::size_t>(f) * width + lane];
    order = std::min(order, calm_order);
  }
}

fluid::SweepReport WallSweeper::sweep(Block& block, int direction, Real dt) {
  auto const d = static_cast<std::size_t>(direction);
  std::size_t const t0 = d == 0 ? 1 : 0, t1 = d == 2 ? 1 : 2;
  WallBlock& wall = blocks_.at(block.id());
  int const order = flow_.order();
  Real const sigma = dt / flow_.grid().spacing[direction];
  auto const width = static_cast<std::size_t>(fluid::lanes());
  Index const n = block.size()[d], ghost = fluid::ghost_depth(order);
  auto const cells = static_cast<std::size_t>(n + 2 * ghost);
  scratch_u_.resize(cells * 5 * width);
  scratch_result_.resize(static_cast<std::size_t>(n) * 5 * width);
  scratch_flux_.resize(static_cast<std::size_t>(n + 1) * 5 * width);
  scratch_pressure_.resize(static_cast<std::size_t>(n) * width);
  scratch_order_.resize(static_cast<std::size_t>(n + 1) * width);
  auto const& component = sweep_component[d];
  fluid::CellLayer<std::uint8_t> const* const marks = flow_.marks(block);
  auto const across = static_cast<std::uint8_t>(7u & ~(1u << d));

  fluid::SweepReport total;
  flux_between_solids(block, wall, direction, sigma);
  // The two runs that end at a closed face both have a flux for it; where the step opens it, neither is right.
  std::vector<State> through_parted;
  for (CellIndex const& high : wall.parted[d]) {
    CellIndex low = high;
    --low[d];
    through_parted.push_back(fluid::low_order_flux(
        block.load(low[0], low[1], low[2]), block.load(high[0], high[1], high[2]), direction, sigma, flow_.gas()));
  }
  for (auto const& [c, m] : wall.solid) wall.pressure[d][wall.cell(c[0], c[1], c[2])] = pressure_of_solid(block, c);

  auto const& runs = wall.runs[d];
  auto const& ends = wall.ends[d];
  for (std::size_t base = 0; base < runs.size(); base += width) {
    std::size_t const used = std::min(width, runs.size() - base);
    Index longest = 0;
    for (std::size_t lane = 0; lane < used; ++lane)
      longest = std::max(longest, std::min(runs[base + lane].end, n) - std::max(runs[base + lane].begin, 0));
    if (marks) scratch_marks_.assign(static_cast<std::size_t>(longest) + 2, 0);
    Real* const u0 = scratch_u_.data() + static_cast<std::size_t>(ghost) * 5 * width;
    for (std::size_t lane = 0; lane < width; ++lane) {
      WallBlock::Run const& run = runs[base + std::min(lane, used - 1)];
      Index const start = std::max(run.begin, 0);
      CellIndex c{};
      c[t0] = run.transverse[0], c[t1] = run.transverse[1];
      auto const block_state = [&](Index i) {
        CellIndex at = c;
        at[d] = i;
        return block.load(at[0], at[1], at[2]);
      };
      auto const put = [&](Index i, State const& s) {
        Real* const to = u0 + static_cast<std::ptrdiff_t>(i) * 5 * static_cast<std::ptrdiff_t>(width) + lane;
        for (std::size_t q = 0; q < 5; ++q) to[q * width] = s[component[q]];
      };
      Index const from = std::max(run.begin - start, -ghost), to = std::min(run.end - start, longest + ghost);
      for (Index i = from; i < to; ++i) put(i, block_state(start + i));
      auto const beyond = [&](Index end, Index first, Index stop, Index step) {
        State s = block_state(first - step + start);
        Index m = 0;
        for (Index i = first; i != stop; i += step, ++m) {
          if (end >= 0 && m < 3) {
            WallBlock::RunEnd const& e = ends[static_cast<std::size_t>(end)];
            auto const at = static_cast<std::size_t>(m);
            if (e.mirror[at].slot >= 0)
              s = reflect(image(e.mirror[at]), e.mirror[at]);
            else if (e.general[at] && start + i >= -ghost && start + i < n + ghost)
              s = block_state(start + i);
          }
          put(i, s);
        }
      };
      beyond(run.low, from - 1, std::min(from - 1, -ghost - 1), -1);
      beyond(run.high, to, std::max(to, longest + ghost), +1);
      if (marks)  // mirror cells take the mark of the end of the run
        for (Index i = -1; i <= longest; ++i) {
          CellIndex at = c;
          at[d] = std::min(start + std::clamp(i, std::max(run.begin - start, Index{-1}), run.end - 1 - start), n);
          if (*marks->at(at[0], at[1], at[2]) & across) scratch_marks_[static_cast<std::size_t>(i + 1)] |= 1u << lane;
        }
      for (Index f = 0; f <= longest; ++f) {
        Index const at = start + f;
        Index room = 6;
        if (run.low >= 0) room = std::min(room, at - run.begin);
        if (run.high >= 0) room = std::min(room, run.end - at);
        bool const beyond_run = at > std::min(run.end, n);  // of a lane shorter than the longest: order 0, not counted
        scratch_order_[static_cast<std::size_t>(f) * width + lane] = beyond_run ? 0 : order_within(order, room);
      }
      if (profiled_) calm(block, run, direction, longest, lane);
    }
    fluid::LineBundle const bundle{longest,
                                   u0,
                                   scratch_result_.data(),
                                   scratch_flux_.data(),
                                   scratch_pressure_.data(),
                                   scratch_order_.data(),
                                   marks ? scratch_marks_.data() + 1 : nullptr};
    fluid::SweepReport const report = fluid::sweep_lines(order, bundle, static_cast<std::uint32_t>((1u << used) - 1),
                                                         sigma, flow_.gas(), flow_.options());
    total.fallback_faces += report.fallback_faces;
    total.signal_max = max(total.signal_max, report.signal_max);

    for (std::size_t lane = 0; lane < used; ++lane) {
      WallBlock::Run const& run = runs[base + lane];
      Index const start = std::max(run.begin, 0), stop = std::min(run.end, n);
      CellIndex c{};
      c[t0] = run.transverse[0], c[t1] = run.transverse[1];
      for (Index i = start; i <= stop; ++i) {
        CellIndex at = c;
        at[d] = i;
        auto const row = static_cast<std::size_t>(i - start);
        State& f = wall.flux[d][wall.face(direction, at[0], at[1], at[2])];
        for (std::size_t q = 0; q < 5; ++q) f[component[q]] = scratch_flux_[(row * 5 + q) * width + lane];
        if (i == stop) break;
        State s;
        for (std::size_t q = 0; q < 5; ++q) s[component[q]] = scratch_result_[(row * 5 + q) * width + lane];
        block.store(at[0], at[1], at[2], s);
        Real const pressure = scratch_pressure_[row * width + lane];
        wall.pressure[d][wall.cell(at[0], at[1], at[2])] = pressure;
        CellIndex const first = block.first();
        if (record_->cut_index({first[0] + at[0], first[1] + at[1], first[2] + at[2]}) >= 0)
          continue;  // provisional: judged after merging
        Real const* const old = u0 + row * 5 * width + lane;
        std::uint64_t const health = judge(s, flow_.gas()) | courant(old[0], old[width], pressure, sigma, flow_.gas());
        if (health != 0 && total.health == 0) total.where = at;
        total.health |= health;
      }
    }
  }
  for (std::size_t f = 0; f < through_parted.size(); ++f) {
    CellIndex const& high = wall.parted[d][f];
    wall.flux[d][wall.face(direction, high[0], high[1], high[2])] = through_parted[f];
  }
  close_reflecting_sides(block, wall, direction, sigma, total);
  return total;
}

bool WallSweeper::turned(CellIndex const& c, int direction, int side, Real part) const {
  Real const limit = -part * record_->lattice().face_area(direction);
  return record_->aperture(c, direction, side) < limit || next_.aperture(c, direction, side) < limit;
}

bool WallSweeper::bound(CellIndex const& c) const {
  bool found = false;
  for (int d = 0; record_->solid(c) && d < flow_.grid().dimension; ++d)
    for (int side = 0; side < 2; ++side) found = found || turned(c, d, side, inside_out);
  return found;
}

/// Of its mirror state. Cells that a face binds have one, that of the gas if there is any beside it: what is left of
/// the forces in them goes to their group.
Real WallSweeper::pressure_of_solid(Block const& block, CellIndex const& local) const {
  auto const at = [&](CellIndex const& c) { return flow_.gas().pressure(block.load(c[0], c[1], c[2])); };
  CellIndex c = block.first();
  for (std::size_t d = 0; d < 3; ++d) c[d] += local[d];
  Real const own = at(local);
  if (record_->cut_index(c) < 0 && next_.cut_index(c) < 0) return own;
  Real beside = own, gas = 0;
  int solids = 1, gases = 0;
  for (int d = 0; d < flow_.grid().dimension; ++d)
    for (int side = 0; side < 2; ++side) {
      if (!turned(c, d, side, inside_out)) continue;
      CellIndex other = c, there = local;
      other[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
      there[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
      if (record_->solid(other))
        beside += at(there), ++solids;
      else
        gas += at(there), ++gases;
    }
  return gases > 0 ? gas / gases : beside / solids;
}

Vec3 WallSweeper::wall_velocity_beside(CellIndex const& low, CellIndex const& high) const {
  Vec3 sum;
  Real weight = 0;
  for (CellIndex const& c : {low, high}) {
    Index const at = record_->cut_index(c);
    if (at < 0) continue;
    for (Index f = record_->cut(at).first_piece; f < record_->cut(at).last_piece; ++f) {
      Piece const& piece = record_->geometry.pieces[static_cast<std::size_t>(f)];
      Real const size = norm(piece.area);
      sum += size * record_->wall_velocity(piece.triangle, piece.bary_centroid);
      weight += size;
    }
  }
  return weight > 0 ? sum / weight : Vec3{};
}

void WallSweeper::flux_between_solids(Block const& block, WallBlock& wall, int direction, Real sigma) const {
  auto const d = static_cast<std::size_t>(direction);
  CellIndex const first = block.first();
  auto const global = [&](CellIndex const& c) { return CellIndex{c[0] + first[0], c[1] + first[1], c[2] + first[2]}; };
  for (auto const& [cell, m] : wall.solid)
    for (int side = 0; side < 2; ++side) {
      CellIndex low = cell, high = cell, face = cell;
      (side == 0 ? low : high)[d] += side == 0 ? -1 : 1;
      face[d] += side;
      if (!record_->solid(global(side == 0 ? low : high))) continue;  // the end of a run: its flux is the run's
      State const below = block.load(low[0], low[1], low[2]), above = block.load(high[0], high[1], high[2]);
      wall.flux[d][wall.face(direction, face[0], face[1], face[2])] =
          turned(global(cell), direction, side, 0)
              ? closed_flux(below, above, wall_velocity_beside(global(low), global(high)), direction, flow_.gas())
              : fluid::low_order_flux(below, above, direction, sigma, flow_.gas());
    }
}

void WallSweeper::close_reflecting_sides(Block& block, WallBlock& wall, int direction, Real sigma,
                                         fluid::SweepReport& total) const {
  auto const d = static_cast<std::size_t>(direction);
  std::size_t const t0 = d == 0 ? 1 : 0, t1 = d == 2 ? 1 : 2;
  for (int side = 0; side < 2; ++side) {
    Index const face = side == 0 ? 0 : block.size()[d];
    if (block.first()[d] + face != (side == 0 ? 0 : flow_.grid().cells[d])) continue;
    if (!flow_.reflecting(direction, side)) continue;
    for (Index b = 0; b < block.size()[t1]; ++b)
      for (Index a = 0; a < block.size()[t0]; ++a) {
        CellIndex c{};
        c[d] = face, c[t0] = a, c[t1] = b;
        State& f = wall.flux[d][wall.face(direction, c[0], c[1], c[2])];
        State removed = f;
        removed[1 + d] = 0;
        for (std::size_t q = 0; q < 5; ++q) f[q] -= removed[q];
        c[d] -= side;
        CellIndex const first = block.first();
        CellIndex const global{first[0] + c[0], first[1] + c[1], first[2] + c[2]};
        // Bodies that overlap on the side leave it a negative area. With the pressure of the pieces in the cell, not
        // that of gas that meets a wall, the cell stays closed and gas does not fall the faster for falling.
        if (record_->aperture(global, direction, side) < 0) f[1 + d] = wall.pressure[d][wall.cell(c[0], c[1], c[2])];
        // The cell behind the side has let through what was removed: a run that ends near the side is no mirror of
        // itself.
        if (removed == State{} || record_->solid(global)) continue;
        State u = block.load(c[0], c[1], c[2]);
        for (std::size_t q = 0; q < 5; ++q) u[q] += (side == 0 ? -sigma : sigma) * removed[q];
        block.store(c[0], c[1], c[2], u);
        if (record_->cut_index(global) >= 0) continue;
        if (std::uint64_t const health = judge(u, flow_.gas()); health != 0) {
          if (total.health == 0) total.where = c;
          total.health |= health;
        }
      }
  }
}

std::size_t WallSweeper::bytes() const {
  std::size_t total = 0;
  for (auto const& [id, wall] : blocks_) {
    total += wall.before.capacity() * sizeof(State);
    for (std::size_t d = 0; d < 3; ++d)
      total += wall.flux[d].capacity() * sizeof(State) + wall.viscous[d].capacity() * 4 * sizeof(Real) +
               wall.pressure[d].capacity() * sizeof(Real) + wall.runs[d].capacity() * sizeof(WallBlock::Run) +
               wall.ends[d].capacity() * sizeof(WallBlock::RunEnd);
  }
  return total;
}

}  // namespace brisance::coupling
