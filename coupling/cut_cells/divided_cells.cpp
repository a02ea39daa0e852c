// Cells that a wall thinner than a cell divides: a state for every connected part of their fluid. The largest part is
// the cell as fields and sweeps know it; the others are merged with what they open to on their own side, so that the
// low-order flux between the states at t^n serves their faces (README, thin walls).
#include <algorithm>
#include <limits>
#include <map>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "coupling/cut_cells/openings.hpp"
#include "coupling/geometry/clip.hpp"
#include "fluid/flux/low_order.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

namespace {

/// Cells around the blocks of a rank within which it knows the states of parts.
constexpr Index part_halo = 3;

State over(State u, Real volume) {
  for (Real& x : u) x /= volume;
  return u;
}

}  // namespace

void CutCells::follow_parts(WallRecord const& after) {
  fluid::Grid const& grid = flow_.grid();
  std::vector<CellBox> near;
  for (Block const& block : std::as_const(flow_).blocks()) near.push_back(grown(grid, box_of(block), mixing_halo + 1));
  parts_.match(record_, after, near, &after == &next_ && moved_);
  find_affected();

  std::vector<CellBox> halo;
  for (Block const& block : std::as_const(flow_).blocks()) halo.push_back(grown(grid, box_of(block), part_halo));
  std::vector<GlobalId> wanted;
  for (GlobalId const id : affected_) {
    CellIndex const c = cell_from_id(grid, id);
    if (std::any_of(halo.begin(), halo.end(), [&](CellBox const& b) { return b.holds(c); })) wanted.push_back(id);
  }
  main_states_.plan(comm_, flow_, std::move(wanted));
  main_states_.refresh(comm_, [&](Block const& b, Index i, Index j, Index k) {
    WallBlock const& wall = sweeper_.blocks().at(b.id());
    return wall.before[wall.cell(i, j, k)];
  });
  minor_near_ = minor_;
  if (comm_.size() == 1) return;
  std::map<int, parallel::Bytes> to;
  for (Content const& m : minor_)
    for (int const rank : ranks_within(cell_from_id(grid, m.cell), part_halo + 1)) parallel::put(to[rank], m);
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to) out.push_back({rank, std::move(data)});
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) minor_near_.push_back(parallel::take<Content>(in));
  std::sort(minor_near_.begin(), minor_near_.end());
}

bool CutCells::any_divided(bool next) const {
  std::int64_t divided = !record_.parts.empty() || (next && !next_.parts.empty());
  comm_.sum(std::span(&divided, 1));
  return divided > 0;
}

void CutCells::find_affected() {
  fluid::Grid const& grid = flow_.grid();
  affected_.clear();
  auto const enter = [&](CellIndex c) {
    if (grid.inside(c)) affected_.push_back(grid.cell_id(c));
  };
  for (CellUnits const& u : parts_.cells()) {
    enter(u.cell);
    for (int d = 0; d < grid.dimension; ++d)
      for (int const by : {-1, 1}) enter(beside(u.cell, d, by));
  }
  std::sort(affected_.begin(), affected_.end());
  affected_.erase(std::unique(affected_.begin(), affected_.end()), affected_.end());
}

std::optional<State> CutCells::own_state_before(CellIndex c, std::size_t unit) const {
  fluid::Grid const& grid = flow_.grid();
  CellUnits const* const u = parts_.find(c);
  Index const part = u ? u->before[unit] : 0;
  if (part < 0) return std::nullopt;
  GlobalId const id = grid.cell_id(c);
  if (part == 0) {
    if (u && record_.solid(c)) return std::nullopt;
    Index const slot = main_states_.slot(id);
    return slot >= 0 ? std::optional(main_states_[slot]) : std::nullopt;
  }
  Real const volume = record_.parts.find(c)->volume[static_cast<std::size_t>(part)];
  Content const here{id, {}, part};
  auto const at = std::lower_bound(minor_near_.begin(), minor_near_.end(), here);
  if (at == minor_near_.end() || here < *at || !(volume > covered_fraction * grid.cell_volume())) return std::nullopt;
  return over(at->amount, volume);
}

State CutCells::state_before(CellIndex c, std::size_t unit) const {
  if (std::optional<State> const own = own_state_before(c, unit)) return *own;
  // New, or a film: the gas that stands in its widest opening, at one or two cells.
  fluid::Grid const& grid = flow_.grid();
  CellUnits const* const u = parts_.find(c);
  State found{};
  Real widest = 0;
  auto const look = [&](CellIndex from, std::size_t at, auto const& deeper, int depth, Real limit) -> void {
    CellUnits const* const here = parts_.find(from);
    bool const now = !here || at < here->after;
    auto const visit = [&](CellIndex n, std::size_t part, int, Real area) {
      if (!grid.inside(n)) return;
      CellUnits const* const there = parts_.find(n);
      std::size_t const next = there && !now ? there->unit[part] : part;
      Real const width = min(limit, area);
      std::optional<State> const s = own_state_before(n, next);
      if (s && width > widest) widest = width, found = *s;
      if (!s && depth < 1) deeper(n, next, deeper, depth + 1, 1e-3 * width);
    };
    if (now)
      for_openings(next_, from, at, visit);
    else
      for_openings(record_, from, static_cast<std::size_t>(here->before[at]), visit);
  };
  look(c, unit, look, 0, std::numeric_limits<Real>::max());
  if (widest > 0) return found;
  Index const slot = main_states_.slot(grid.cell_id(c));
  return u && slot >= 0 ? main_states_[slot] : sweeper_.ambient;
}

State CutCells::opening_flux(CellIndex low, int d, std::size_t low_unit, std::size_t high_unit, CellIndex at, Real dt) {
  fluid::Grid const& grid = flow_.grid();
  CellIndex const high = beside(low, d, 1);
  bool const inner = grid.inside(low) && grid.inside(high);
  bool const low_main = !grid.inside(low) || main_before(low, low_unit);
  bool const high_main = !grid.inside(high) || main_before(high, high_unit);
  if (low_main && high_main && (!inner || record_.parts.joined(low, d))) {
    Block const& block = *std::as_const(flow_).find(grid.block_of(at));
    CellIndex face = at;
    for (std::size_t e = 0; e < 3; ++e) face[e] -= block.first()[e];
    if (at == low) face[static_cast<std::size_t>(d)] += 1;
    WallBlock const& wall = sweeper_.blocks().at(block.id());
    return wall.flux[static_cast<std::size_t>(d)][wall.face(d, face[0], face[1], face[2])];
  }
  if (!inner) {
    State const u = state_before(at, at == low ? low_unit : high_unit);
    if (flow_.reflecting(d, at == low ? 1 : 0)) {
      State closed{};
      closed[static_cast<std::size_t>(d) + 1] = flow_.gas().pressure(u);
      return closed;
    }
    return fluid::low_order_flux(u, u, d, dt / grid.spacing[d], flow_.gas());
  }
  return fluid::low_order_flux(state_before(low, low_unit), state_before(high, high_unit), d, dt / grid.spacing[d],
                               flow_.gas());
}

std::array<Real, 4> CutCells::opening_stress(CellIndex low, int d, std::size_t low_unit, std::size_t high_unit,
                                             CellIndex at, Real dt) {
  fluid::Grid const& grid = flow_.grid();
  CellIndex const high = beside(low, d, 1);
  bool const inner = grid.inside(low) && grid.inside(high);
  bool const low_main = !grid.inside(low) || main_before(low, low_unit);
  bool const high_main = !grid.inside(high) || main_before(high, high_unit);
  // What stands in the faces of the block has felt the stages of the step; between gases that the step joins it is 0.
  if (low_main && high_main) {
    auto const [wall, local] = wall_block_of(at);
    CellIndex const face = at == low ? beside(local, d, 1) : local;
    return wall->viscous[static_cast<std::size_t>(d)][wall->face(d, face[0], face[1], face[2])];
  }
  if (!inner) return {};
  return viscous_->between(state_before(low, low_unit), state_before(high, high_unit), d, dt);
}

void CutCells::for_face(CellIndex c, std::size_t unit, int d, int side,
                        std::function<void(Real, std::size_t, std::size_t)> const& visit) const {
  if (CellUnits const* const u = parts_.find(c); u && unit >= u->after) return;
  CellIndex const other = beside(c, d, side == 0 ? -1 : 1), low = side == 0 ? other : c;
  if (!next_.parts.find(c) && !next_.parts.find(other)) {
    Real const area = next_.aperture(c, d, side);
    if (area != 0) visit(area, 0, 0);
    return;
  }
  for (Opening const& o : next_.parts.through(low, d))
    if ((side == 0 ? o.high_part : o.low_part) == unit) visit(o.area, o.low_part, o.high_part);
}

Vec3 CutCells::unit_pressure(CellIndex c, std::size_t unit) const {
  if (!divided_ || main_before(c, unit)) return swept_pressure(c);
  Real const p = flow_.gas().pressure(state_before(c, unit));
  return {p, p, p};
}

void CutCells::measure_unit(CellUnits const* units, std::size_t unit, NearCell& cell) const {
  cell.linked = affected(cell.id);
  if (!units) return;
  cell.share = units->share[unit];
  Index const part = units->before[unit];
  if (PartedCell const* const p = record_.parts.find(cell.cell); p && part >= 0)
    cell.volume_before = p->volume[static_cast<std::size_t>(part)];
  else if (part == 0)
    cell.volume_before = record_.volume(cell.cell);
  if (unit >= units->after) return;
  PartedCell const* const p = next_.parts.find(cell.cell);
  cell.volume = p ? p->volume[unit] : next_.volume(cell.cell);
  for (int d = 0; d < flow_.grid().dimension; ++d)
    for (int side = 0; side < 2; ++side) {
      auto const dir = static_cast<std::size_t>(d), at = static_cast<std::size_t>(side);
      cell.aperture[dir][at] = p ? p->aperture[unit][dir][at] : next_.aperture(cell.cell, d, side);
    }
}

void CutCells::link_near(std::vector<NearCell> const& cells) {
  fluid::Grid const& grid = flow_.grid();
  for (NearCell const& cell : cells) {
    if (!cell.linked) continue;
    CellUnits const* const units = parts_.find(cell.cell);
    auto const unit = static_cast<std::size_t>(cell.unit);
    bool const now = !units || unit < units->after;
    auto const visit = [&](CellIndex n, std::size_t part, int d, Real area) {
      if (!grid.inside(n)) return;
      CellUnits const* const there = parts_.find(n);
      std::size_t const to = there && !now ? there->unit[part] : part;
      links_.push_back({cell.id, cell.unit, grid.cell_id(n), static_cast<Index>(to), d, area});
    };
    if (now)
      for_openings(next_, cell.cell, unit, visit);
    else  // no more: where it opened to
      for_openings(record_, cell.cell, static_cast<std::size_t>(units->before[unit]), visit);
  }
  std::sort(links_.begin(), links_.end());
}

State CutCells::start_state(CellIndex c, std::size_t part) const {
  Content const here{flow_.grid().cell_id(c), {}, static_cast<Index>(part)};
  return std::lower_bound(start_.begin(), start_.end(), here)->amount;
}

void CutCells::start_parts() {
  fluid::Grid const& grid = flow_.grid();
  minor_.clear();
  divided_ = any_divided(false);
  if (!divided_) return;
  std::vector<CellBox> near;
  for (Block const& block : std::as_const(flow_).blocks()) near.push_back(grown(grid, box_of(block), mixing_halo + 1));
  parts_.match(record_, next_, near, false);
  find_affected();
  // Fields are filled by cells and know no sides: where the whole cells on the side of a part agree, they tell its gas;
  // else the nearest of them does for parts that the fields know nothing of.
  struct Part {
    CellIndex cell;
    std::size_t part;
    std::vector<GlobalId> whole;  ///< the nearest first
  };
  std::vector<Part> parts;
  std::vector<GlobalId> wanted;
  for (PartedCell const& p : record_.parts.cells) {
    if (!owned(p.cell)) continue;
    for (std::size_t part = 0; part < p.parts; ++part) {
      Part found{p.cell, part, {}};
      std::vector<std::pair<CellIndex, std::size_t>> seen{{p.cell, part}};
      for (std::size_t next = 0, layer = 0, end = 1; layer < 3; ++layer, end = seen.size())
        for (; next < end; ++next)
          for_openings(record_, seen[next].first, seen[next].second, [&](CellIndex n, std::size_t to, int, Real) {
            std::pair const there{n, to};
            if (!grid.inside(n) || std::find(seen.begin(), seen.end(), there) != seen.end()) return;
            seen.push_back(there);
            if (record_.cut_index(n) < 0) found.whole.push_back(grid.cell_id(n));
          });
      wanted.insert(wanted.end(), found.whole.begin(), found.whole.end());
      parts.push_back(std::move(found));
    }
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  StateGather states;
  states.plan(comm_, flow_, std::move(wanted));
  states.refresh(comm_, [](Block const& b, Index i, Index j, Index k) { return b.load(i, j, k); });
  for (Part const& p : parts) {
    Block& block = *flow_.find(grid.block_of(p.cell));
    CellIndex const first = block.first();
    Index const i = p.cell[0] - first[0], j = p.cell[1] - first[1], k = p.cell[2] - first[2];
    State u = block.load(i, j, k);
    auto const state = [&](GlobalId id) { return states[states.slot(id)]; };
    bool const uniform =
        std::all_of(p.whole.begin(), p.whole.end(), [&](GlobalId id) { return state(id) == state(p.whole.front()); });
    if (!p.whole.empty() && (uniform || p.part > 0)) u = state(p.whole.front());
    if (p.part == 0) {
      block.store(i, j, k, u);
      continue;
    }
    start_.push_back({grid.cell_id(p.cell), u, static_cast<Index>(p.part)});
    for (Real& x : u) x *= record_.parts.find(p.cell)->volume[p.part];
    minor_.push_back({grid.cell_id(p.cell), u, static_cast<Index>(p.part)});
  }
  std::sort(minor_.begin(), minor_.end());
  std::sort(start_.begin(), start_.end());
}

void CutCells::for_parts(std::function<void(CellIndex, Vec3 const&, State const&)> const& visit) const {
  fluid::Grid const& grid = flow_.grid();
  for (CutCell const& cut : record_.geometry.cells) {
    if (!owned(cut.cell) || record_.solid(cut.cell)) continue;
    Block const& block = *std::as_const(flow_).find(grid.block_of(cut.cell));
    CellIndex const first = block.first();
    State u = block.load(cut.cell[0] - first[0], cut.cell[1] - first[1], cut.cell[2] - first[2]);
    for (Real& x : u) x *= record_.main_volume(cut.cell);
    PartedCell const* const parts = record_.parts.find(cut.cell);
    visit(cut.cell, parts ? parts->area[0] : cut.area, u);
    if (!parts) continue;
    GlobalId const id = grid.cell_id(cut.cell);
    for (auto m = std::lower_bound(minor_.begin(), minor_.end(), Content{id, {}, 0});
         m != minor_.end() && m->cell == id; ++m)
      visit(cut.cell, parts->area[static_cast<std::size_t>(m->unit)], m->amount);
  }
}

void CutCells::keep_parts(CellParts const& old) {
  fluid::Grid const& grid = flow_.grid();
  std::vector<CellIndex> cells;
  for (CellParts const* parts : {&old, &std::as_const(record_.parts)})
    for (PartedCell const& p : parts->cells)
      if (owned(p.cell)) cells.push_back(p.cell);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<Content> kept;
  for (CellIndex const& c : cells) {
    GlobalId const id = grid.cell_id(c);
    Block& block = *flow_.find(grid.block_of(c));
    CellIndex const first = block.first();
    Index const i = c[0] - first[0], j = c[1] - first[1], k = c[2] - first[2];
    PartedCell const *const a = old.find(c), *const b = record_.parts.find(c);
    Real const whole = record_.volume(c), main = a ? a->volume[0] : whole;
    std::vector<State> contents{block.load(i, j, k)};
    for (Real& x : contents[0]) x *= main;
    for (auto m = std::lower_bound(minor_.begin(), minor_.end(), Content{id, {}, 0});
         m != minor_.end() && m->cell == id; ++m) {
      contents.resize(static_cast<std::size_t>(m->unit) + 1, State{});
      contents.back() = m->amount;
    }
    if (a) contents.resize(a->parts, State{});
    // The same parts, in the same order, where the new faces coincide with each other; otherwise all share the gas.
    bool same = a && b && a->parts == b->parts;
    for (std::size_t p = 0; same && p < a->parts; ++p)
      same = std::abs(a->volume[p] - b->volume[p]) < 1e-9 * grid.cell_volume() && dot(a->area[p], b->area[p]) >= 0;
    State sum{};
    for (State const& u : contents)
      for (std::size_t q = 0; q < 5; ++q) sum[q] += u[q];
    if (!same) block.store(i, j, k, over(sum, whole));
    for (std::size_t p = 1; b && p < b->parts; ++p) {
      State u = same ? contents[p] : over(sum, whole);
      for (Real& x : u) x *= same ? 1 : b->volume[p];
      kept.push_back({id, u, static_cast<Index>(p)});
    }
  }
  std::sort(kept.begin(), kept.end());
  minor_ = std::move(kept);
}

}  // namespace brisance::coupling
