#include "coupling/cut_cells/cut_cells.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/identities.hpp"
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
  plan.keep(keep());
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
}  // namespace brisance::coupling
