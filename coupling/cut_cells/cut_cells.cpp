#include "coupling/cut_cells/cut_cells.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/identities.hpp"
#include "coupling/cut_cells/mixing.hpp"
#include "coupling/cut_cells/redistribution.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"
#include "parallel/error.hpp"

namespace brisance::coupling {

using fluid::Block;
using fluid::State;

CutCells::CutCells(CutCellsConfig const& config, TimeCoupling scheme, fluid::Flow& flow, solid::Solid& solid,
                   std::shared_ptr<solid::Surface const> surface, fluid::State const& ambient, parallel::Comm& comm)
    : config_(config),
      scheme_(scheme),
      linear_(config.profile != "constant"),
      flow_(flow),
      solid_(solid),
      comm_(comm),
      surface_(solid, std::move(surface), flow, comm, wall_margin),
      sweeper_(flow, next_, comm) {
  std::vector<CellBox> region;
  for (Block const& block : flow.blocks()) region.push_back(grown(flow.grid(), box_of(block), wall_margin));
  for (WallRecord* r : {&record_, &next_}) {
    r->set_grid(flow.grid());
    r->set_region(region);
  }
  sweeper_.ambient = ambient;
  if (config.load == "relative") surface_.beyond_loads = ambient_pressure_.emplace(flow.gas().pressure(ambient));
  flow.set_sweeper(&sweeper_);
  areal_mass_ = areal_masses(surface_.topology(), solid.mesh());
}

bool CutCells::owned(CellIndex c) const {
  return flow_.grid().inside(c) && flow_.owner(flow_.grid().block_of(c)) == comm_.rank();
}

void CutCells::cut_initial_geometry() {
  solid_.exchange_pose();
  surface_.start();
  surface_.send_triangles(record_.triangles);
  rebuild_record();
}

void CutCells::begin() {
  // Small cells of the initial fields merge like those of a step.
  next_.triangles = record_.triangles;
  next_.rebuild();
  fluid::Grid const& grid = flow_.grid();
  start_parts();
  contents_.clear();
  for (CutCell const& cut : record_.geometry.cells)
    if (owned(cut.cell)) {
      Block const& block = *flow_.find(grid.block_of(cut.cell));
      CellIndex const first = block.first();
      State u = block.load(cut.cell[0] - first[0], cut.cell[1] - first[1], cut.cell[2] - first[2]);
      Real const v = fluid_volume(cut.cell);
      for (Real& x : u) x *= v;
      contents_.push_back({grid.cell_id(cut.cell), u});
    }
  contents_.insert(contents_.end(), minor_.begin(), minor_.end());
  std::sort(contents_.begin(), contents_.end());
  mix();
  sweeper_.rebuild(record_);
  std::vector<CellForce> forces;
  wall_pressure(record_, true, 0, forces);
  surface_.apply(forces, LoadOf::present);
  start_.clear();
  remark_on_start();
}

void CutCells::rebuild_record(CellParts const* before_opening) {
  record_.rebuild();
  if (before_opening) keep_parts(*before_opening);
  sweeper_.rebuild(record_);
  quiet_ = 0;
  if (viscous_) viscous_->forget_plan();
}

fluid::ViscousWalls& CutCells::add_viscosity(fluid::Transport const& transport) {
  if (linear_)
    scene_error(config_.at,
                "coupling.cut_cells.profile = \"" + config_.profile +
                    "\" does not go together with fluid.viscosity: friction at the walls is taken from full "
                    "cells beside cut cells of constant state; leave it \"constant\"");
  sweeper_.expect_viscosity();
  viscous_ = std::make_unique<ViscousWall>(config_.wall.value_or(BodyWallConfig{}), transport, flow_, sweeper_, comm_);
  return *viscous_;
}

void CutCells::join(Plan& plan) {
  plan.effect("coupling.cut_cells", [this] {
    return record_.bytes() + next_.bytes() + sweeper_.bytes() + at_start_.bytes() + parts_.bytes() +
           (stage_account_ ? stage_account_->bytes() : 0);
  });
  if (StageLedger* const stages = plan.stages()) {
    stage_account_ = std::make_unique<StageAccount>(*stages, flow_, sweeper_);
    stages->on_flow_charge([this](Part part) { stage_account_->look(part); });
  }
  plan.at(Stage::predict, [this](Clock const& c) { begin_step(c); });
  plan.at(Stage::boundary, [this](Clock const&) { new_geometry(); });
  plan.at(Stage::load_solid, [this, &plan](Clock const& c) {
    if (scheme_ == TimeCoupling::explicit_load)
      load_at_start(c.dt);
    else if (load_solid(c))
      plan.ask_for_boundary();
  });
  plan.at(Stage::drift, [this](Clock const& c) { end_drift(c); });
  plan.at(Stage::flow_update, [this](Clock const& c) {
    if constexpr (check_identities) require_identities(c);
    update_contents(c.dt);
  });
  plan.at(Stage::mix, [this](Clock const&) { mix(); });
  plan.at(Stage::fill, [this](Clock const&) { fill(); });
  if (solid_.damageable()) {
    broken_.assign(solid_.mesh().links.size(), false);
    plan.at(Stage::open, [this](Clock const&) { open_cracks(); });
  }
  plan.limit("coupling.wall", [this](Clock const&) {
    Real seconds = std::numeric_limits<Real>::max();
    for (int d = 0; d < flow_.grid().dimension; ++d)
      if (Real const w = surface_.fastest_vertex(d); w > 0) seconds = min(seconds, 0.4 * flow_.grid().spacing[d] / w);
    return seconds;
  });
  if (limited_) plan.limit("coupling.light_solid", [this](Clock const&) { return weigh().second; });
  remark_ = [&plan](std::string text) { plan.remark(std::move(text)); };
  plan.finding([this] { return remark_on_mixed(); });
  plan.health([this](Clock const&) { return judge(); });
  plan.account([this](Ledger& ledger) { account(ledger); });
  Plan::Keep keep;
  keep.save = [this] {
    surface_.save();
    broken_saved_ = broken_;
    kept_saved_ = kept_;
    minor_saved_ = minor_;
  };
  keep.restore = [this] {
    surface_.restore();
    areal_mass_ = areal_masses(surface_.topology(), solid_.mesh());
    broken_ = broken_saved_;
    kept_ = kept_saved_;
    minor_ = minor_saved_;
    surface_.send_triangles(record_.triangles);
    rebuild_record();
    for (auto& sum : crossed_) sum = {};
    for (auto& sum : ambient_given_) sum = {};
    wall_work_ = pressure_impulse_ = exchanged_energy_ = wall_heat_ = {};
    health_ = {};
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    surface_.write(file);
    std::vector<std::int64_t> ids;
    std::vector<double> rows;
    for (Content const& k : kept_) ids.push_back(k.cell), rows.insert(rows.end(), k.amount.begin(), k.amount.end());
    file.sparse("coupling/covered", 5, ids, rows);
    ids.clear(), rows.clear();
    for (Content const& m : minor_) {
      ids.push_back(m.cell * static_cast<GlobalId>(most_parts) + m.unit);
      rows.insert(rows.end(), m.amount.begin(), m.amount.end());
    }
    file.sparse("coupling/parts", 5, ids, rows);
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    if (!broken_.empty() && gather_broken())
      surface_.replace(std::make_shared<solid::Surface>(solid_.mesh(), broken_, nullptr));
    areal_mass_ = areal_masses(surface_.topology(), solid_.mesh());
    surface_.read(file);
    parallel::ArchiveReader::Sparse const stored = file.sparse("coupling/covered", 5);
    kept_.clear();
    for (std::size_t s = 0; s < stored.ids.size(); ++s) {
      if (!owned(cell_from_id(flow_.grid(), stored.ids[s]))) continue;
      Content k{stored.ids[s], {}};
      std::copy_n(stored.data.begin() + static_cast<std::ptrdiff_t>(5 * s), 5, k.amount.begin());
      kept_.push_back(k);
    }
    std::sort(kept_.begin(), kept_.end(), [](auto const& a, auto const& b) { return a.cell < b.cell; });
    minor_.clear();
    parallel::ArchiveReader::Sparse const parts = file.sparse("coupling/parts", 5);
    for (std::size_t s = 0; s < parts.ids.size(); ++s) {
      GlobalId const id = parts.ids[s] / static_cast<GlobalId>(most_parts);
      if (!owned(cell_from_id(flow_.grid(), id))) continue;
      Content m{id, {}, static_cast<Index>(parts.ids[s] % static_cast<GlobalId>(most_parts))};
      std::copy_n(parts.data.begin() + static_cast<std::ptrdiff_t>(5 * s), 5, m.amount.begin());
      minor_.push_back(m);
    }
    std::sort(minor_.begin(), minor_.end());
    surface_.send_triangles(record_.triangles);
    rebuild_record();
  };
  keep.digest = [this](parallel::Digest& d) { digest(d); };
  plan.keep(std::move(keep));
}

void CutCells::new_geometry() {
  if (scheme_ == TimeCoupling::explicit_load) surface_.place();
  // Judged by the owners of the vertices: a triangle that runs away may reach nobody.
  Vec3 const bound = 0.5 * flow_.grid().spacing;
  std::optional<Vec3> const lost = surface_.beyond(bound);
  if (lost && health_.good)
    health_ = {false, "the wall at (" + std::to_string(lost->x) + ", " + std::to_string(lost->y) + ", " +
                          std::to_string(lost->z) + ") m moves more than half a cell in a step"};
  std::optional<Vec3> const across = lost ? std::nullopt : surface_.near_periodic_side();
  if (across && health_.good)
    health_ = {false, "a body reaches a periodic side of the domain at (" + std::to_string(across->x) + ", " +
                          std::to_string(across->y) + ", " + std::to_string(across->z) + ") m"};
  std::int64_t state[3] = {surface_.moved(), lost || across, surface_.news()};
  comm_.sum(std::span(state));
  moved_ = state[0] > 0;
  // `semi` comes here several times a step, `explicit` sends its velocities with the triangles: nothing is left out.
  quiet_ = state[2] > 0 || scheme_ != TimeCoupling::lag ? 0 : quiet_ + 1;
  news_ = quiet_ == 0;
  bool const built = state[1] == 0 && build_next();
  if (!built) {  // the boundary rests in this step, and the pair is rejected after it
    surface_.hold();
    moved_ = false;
    quiet_ = 0;
    news_ = true;
    build_next();
  }
  if (divided_)
    follow_parts(next_);
  else
    parts_.clear(), affected_.clear();
  if (linear_) sweeper_.make_profiles(next_, !moved_, affected_);
}

bool CutCells::build_next() {
  if (quiet_ > 2) return true;  // both records hold the same since two steps
  if (quiet_ > 0) {
    surface_.repeat_triangles(record_.triangles, next_.triangles);
  } else {
    Stopwatch const watch(cost_.exchange_s);
    surface_.send_triangles(next_.triangles);
  }
  std::int64_t state[2] = {0, 0};  // folded, divided
  std::int64_t& folded = state[0];
  try {
    Stopwatch const watch(cost_.geometry_s);
    next_.rebuild();
  } catch (Error const& error) {
    folded = 1;
    if (health_.good) health_ = {false, error.what()};
  }
  state[1] = !record_.parts.empty() || !next_.parts.empty();
  comm_.sum(std::span(state));
  divided_ = state[1] > 0;
  return folded == 0;
}

void CutCells::mix() {
  fluid::Grid const& grid = flow_.grid();
  std::vector<CellBox> near;
  for (Block const& block : std::as_const(flow_).blocks()) near.push_back(grown(grid, box_of(block), mixing_halo));
  auto const within = [&](CellIndex c) {
    return std::any_of(near.begin(), near.end(), [&](CellBox const& b) { return b.holds(c); });
  };
  std::vector<GlobalId> ids;
  CellBox around = near.front();
  for (CellBox const& b : near)
    for (std::size_t d = 0; d < 3; ++d) {
      around.low[d] = std::max(0, std::min(around.low[d], b.low[d]));
      around.high[d] = std::min(grid.cells[d], std::max(around.high[d], b.high[d]));
    }
  near_.start(around);
  for (WallRecord const* r : {&record_, &next_})
    for (CutCell const& cut : r->geometry.cells) {
      if (r == &next_ && record_.cut_index(cut.cell) >= 0) continue;  // been there
      for_neighbourhood(grid, cut.cell, 2, [&](CellIndex c) {
        if (around.holds(c)) near_.insert(c);
      });
    }
  for (CellIndex const& c : near_.cells())
    if (within(c)) ids.push_back(grid.cell_id(c));
  for (Content const& c : contents_) ids.push_back(c.cell);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());

  std::vector<NearCell> cells;
  cells.reserve(ids.size());
  Real const full = grid.cell_volume();
  std::size_t next_content = 0;
  for (GlobalId const id : ids) {
    CellIndex const c = cell_from_id(grid, id);
    CellUnits const* const units = parts_.find(c);
    for (std::size_t unit = 0; unit < (units ? units->count : 1); ++unit) {
      NearCell& cell = cells.emplace_back();
      cell.id = id;
      cell.cell = c;
      cell.mine = owned(c);
      cell.unit = static_cast<Index>(unit);
      if (divided_) measure_unit(units, unit, cell);
      if (!units) {
        cell.volume = next_.volume(c);
        cell.volume_before = record_.volume(c);
        for (int d = 0; d < grid.dimension; ++d)
          for (int side = 0; side < 2; ++side)
            cell.aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)] = next_.aperture(c, d, side);
      }
      if (linear_ || config_.small_cells == "redistribution") cell.region = fluid_moments(next_, c);
      Content const here{id, {}, cell.unit};
      while (next_content < contents_.size() && contents_[next_content] < here) ++next_content;
      if (next_content < contents_.size() && !(here < contents_[next_content])) {
        cell.amount = contents_[next_content].amount;
        cell.rewritten = true;
      } else if (cell.mine && unit == 0 && cell.volume > covered_fraction * full) {
        Block const& block = *std::as_const(flow_).find(grid.block_of(c));
        CellIndex const first = block.first();
        cell.amount = block.load(c[0] - first[0], c[1] - first[1], c[2] - first[2]);
        for (Real& x : cell.amount) x *= cell.volume;
      }
    }
  }
  links_.clear();
  if (divided_) link_near(cells);
  exchange_near(cells);
  if (config_.small_cells == "redistribution") {
    redistribute(flow_.gas(), next_, config_.small_cell, linear_ ? sweeper_.profile_kind : ProfileKind::all, cells);
    exchange_near(cells);
  }

  Merging merging =
      merge_small_cells(grid, config_.small_cell, comm_.size() > 1 ? Sight::halo : Sight::everything, cells, links_);
  if (comm_.size() > 1) {
    std::uint64_t outgrown = merging.outgrown ? 1 : 0;
    comm_.bit_or(std::span(&outgrown, 1));
    if (outgrown > 0) merging = merge_everywhere(cells);
  }
  if (!merging.trouble.empty() && health_.good) health_ = {false, merging.trouble};
  store(cells);
  if (linear_) spread(cells);
}

std::vector<int> CutCells::ranks_within(CellIndex c, Index halo) const {
  fluid::Grid const& grid = flow_.grid();
  std::vector<int> ranks;
  CellBox const around = grown(grid, {c, {c[0] + 1, c[1] + 1, c[2] + 1}}, halo);
  CellIndex low{}, high{};  // groups do not reach through periodic sides
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = std::max(around.low[d], 0);
    high[d] = std::min(around.high[d], grid.cells[d]) - 1;
  }
  auto const b0 = grid.block_position(grid.block_of(low)), b1 = grid.block_position(grid.block_of(high));
  for (Index bz = b0[2]; bz <= b1[2]; ++bz)
    for (Index by = b0[1]; by <= b1[1]; ++by)
      for (Index bx = b0[0]; bx <= b1[0]; ++bx) {
        int const rank = flow_.owner(grid.block_id({bx, by, bz}));
        if (rank != comm_.rank() && std::find(ranks.begin(), ranks.end(), rank) == ranks.end()) ranks.push_back(rank);
      }
  return ranks;
}

void CutCells::exchange_near(std::vector<NearCell>& cells) {
  if (comm_.size() == 1) return;
  struct Row {
    GlobalId id;
    State amount;
    std::int32_t rewritten, settled;
    Index unit, none;
  };
  std::map<int, parallel::Bytes> to;
  for (NearCell const& cell : cells) {
    if (!cell.mine) continue;
    std::vector<int> const ranks = ranks_within(cell.cell, mixing_halo);
    for (int const rank : ranks)
      parallel::put(to[rank], Row{cell.id, cell.amount, cell.rewritten, cell.settled, cell.unit, 0});
  }
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to) out.push_back({rank, std::move(data)});
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      Row const row = parallel::take<Row>(in);
      auto const at = std::lower_bound(cells.begin(), cells.end(), row, [](NearCell const& c, Row const& r) {
        return c.id != r.id ? c.id < r.id : c.unit < r.unit;
      });
      if (at != cells.end() && at->id == row.id && at->unit == row.unit)
        at->amount = row.amount, at->rewritten = row.rewritten != 0, at->settled = row.settled != 0;
    }
}

void CutCells::store(std::vector<NearCell> const& cells) {
  fluid::Grid const& grid = flow_.grid();
  Real const full = grid.cell_volume();
  kept_.clear();
  minor_.clear();
  for (NearCell const& cell : cells) {
    if (!cell.mine || !(cell.rewritten || cell.grouped)) continue;
    if (cell.unit > 0) {
      CellUnits const* const units = parts_.find(cell.cell);
      if (cell.unit >= static_cast<Index>(units->after)) continue;  // its gas went to its group
      Content m{cell.id, cell.amount, cell.unit};
      if (cell.grouped) m.amount = cell.mean;
      for (Real& x : m.amount) x *= cell.grouped ? cell.volume : 1;
      minor_.push_back(m);
      continue;
    }
    bool const covered = cell.volume <= covered_fraction * full;
    State u = cell.mean;
    if (!cell.grouped) {
      if (covered) continue;  // nothing in it
      u = cell.amount;
      for (Real& x : u) x /= cell.volume;
    }
    if (covered) {
      Content k{cell.id, u};
      for (Real& x : k.amount) x *= cell.volume;
      kept_.push_back(k);
      continue;
    }
    Block& block = *flow_.find(grid.block_of(cell.cell));
    CellIndex const first = block.first();
    block.store(cell.cell[0] - first[0], cell.cell[1] - first[1], cell.cell[2] - first[2], u);
  }
}

Merging CutCells::merge_everywhere(std::vector<NearCell>& cells) {
  // A group is longer than the halo is wide, as along a closing crack: every rank merges the cells of all.
  parallel::Bytes bytes;
  for (NearCell const& cell : cells)
    if (cell.mine) parallel::put(bytes, cell);
  std::vector<NearCell> all;
  std::vector<parallel::Bytes> const gathered = comm_.all_gather(bytes);
  for (std::size_t rank = 0; rank < gathered.size(); ++rank)
    for (std::span<std::byte const> in(gathered[rank]); !in.empty();) {
      all.push_back(parallel::take<NearCell>(in));
      all.back().mine = static_cast<int>(rank) == comm_.rank();
    }
  std::sort(all.begin(), all.end(),
            [](NearCell const& a, NearCell const& b) { return a.id != b.id ? a.id < b.id : a.unit < b.unit; });
  std::vector<NearLink> links;
  if (divided_) {
    bytes.clear();
    for (NearLink const& link : links_)
      if (owned(cell_from_id(flow_.grid(), link.from))) parallel::put(bytes, link);
    for (parallel::Bytes const& from : comm_.all_gather(bytes))
      for (std::span<std::byte const> in(from); !in.empty();) links.push_back(parallel::take<NearLink>(in));
    std::sort(links.begin(), links.end());
  }
  Merging const merging = merge_small_cells(flow_.grid(), config_.small_cell, Sight::everything, all, links);
  cells = std::move(all);
  return merging;
}

void CutCells::fill() {
  ++cost_.steps;
  for (CutCell const& cut : next_.geometry.cells) cost_.cut += owned(cut.cell) ? 1 : 0;
  // Mirror states hold the velocity of the wall: they are made anew when it changed, as a restart would make them.
  for (CellUnits const& units : parts_.cells()) cost_.mixed += units.mixed && owned(units.cell) ? 1 : 0;
  std::vector<CellBox> differences;
  if (news_) differences = WallRecord::differences(record_, next_);
  std::int64_t changed = differences.empty() ? 0 : 1;
  comm_.sum(std::span(&changed, 1));
  std::swap(record_, next_);
  surface_.accept();
  if (changed > 0) {
    quiet_ = 0;
    Stopwatch const watch(cost_.closest_s);
    sweeper_.update(record_, differences);
  } else {
    sweeper_.keep(record_);
  }
}

void CutCells::require_identities(Clock const& clock) const {
  std::vector<CellBox> own;
  for (Block const& block : std::as_const(flow_).blocks()) own.push_back(box_of(block));
  std::string const broken = broken_identity(record_, next_, own);
  require(broken.empty(), Failure::internal,
          "step " + std::to_string(clock.step) + ", t = " + std::to_string(clock.time) + " s: " + broken);
}

bool CutCells::gather_broken() {
  parallel::Bytes mine;
  for (std::size_t k = 0; k < solid_.links(); ++k)
    if (solid_.intact(k) == 0 && solid_.link_store().end_i(k) < solid_.owned() && !broken_[solid_.mesh_link(k)])
      parallel::put(mine, static_cast<std::uint64_t>(solid_.mesh_link(k)));
  bool any = false;
  for (parallel::Bytes const& bytes : comm_.all_gather(mine))
    for (std::span<std::byte const> in(bytes); !in.empty(); any = true)
      broken_[static_cast<std::size_t>(parallel::take<std::uint64_t>(in))] = true;
  return any;
}

void CutCells::open_cracks() {
  if (!gather_broken()) return;
  // Faces that part coincide in the record: no aperture and no volume changes before they move.
  surface_.open(std::make_shared<solid::Surface>(solid_.mesh(), broken_, &surface_.topology()));
  areal_mass_ = areal_masses(surface_.topology(), solid_.mesh());
  CellParts const old = record_.parts;
  surface_.send_triangles(record_.triangles);
  rebuild_record(&old);
}

Verdict CutCells::judge() const { return health_; }

GlobalId CutCells::cut_cell_count() const {
  return std::count_if(record_.geometry.cells.begin(), record_.geometry.cells.end(),
                       [&](CutCell const& c) { return owned(c.cell); });
}

void CutCells::account(Ledger& ledger) {
  for (std::vector<Content> const* contents : {&kept_, &minor_})
    for (Content const& k : *contents) {
      ledger.add(Entry::mass, k.amount[0]);
      ledger.add(Entry::momentum_x, Vec3{k.amount[1], k.amount[2], k.amount[3]});
      ledger.add(Entry::energy, k.amount[4]);
      ledger.add(Entry::fluid_energy, k.amount[4]);
    }
  ledger.add(Entry::in_mass, crossed_[0]);
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), crossed_[1 + d]);
  ledger.add(Entry::in_energy, crossed_[4]);
  ledger.add(Entry::fluid_in_energy, crossed_[4]);
  parallel::ExactSum lost_heat;  // not rounded: the sum of this rank alone depends on the partition
  lost_heat.subtract(wall_heat_);
  ledger.add(Entry::in_energy, lost_heat);
  ledger.add(Entry::fluid_in_energy, lost_heat);
  ledger.add(Entry::wall_work, wall_work_);
  ledger.add(Entry::pressure_impulse, pressure_impulse_);
  ledger.add(Entry::exchanged_energy, exchanged_energy_);
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), ambient_given_[d]);
  ledger.add(Entry::in_energy, ambient_given_[3]);
  for (auto& sum : crossed_) sum = {};
  for (auto& sum : ambient_given_) sum = {};
  wall_work_ = pressure_impulse_ = exchanged_energy_ = wall_heat_ = {};
}

std::string CutCells::remark_on_mixed() const {
  std::int64_t mixed = cost_.mixed;
  comm_.sum(std::span(&mixed, 1));
  if (mixed == 0) return {};
  return "a thin wall leaked within a cell: " + std::to_string(mixed) +
         " time(s) the parts into which it divides one could not be followed through a step, and shared their gas. "
         "Mass, momentum and energy are kept. Smaller steps (fluid.euler.cfl) or finer cells help; "
         "geometry.mixed_divided_cells in summary.json counts such cells.";
}

void CutCells::digest(parallel::Digest& digest) const {
  constexpr std::uint32_t covered_kind = 3;
  for (Content const& k : kept_) digest.add(covered_kind, k.cell, k.amount);
  for (Content const& m : minor_) digest.add(covered_kind + static_cast<std::uint32_t>(m.unit), m.cell, m.amount);
}

}  // namespace brisance::coupling
