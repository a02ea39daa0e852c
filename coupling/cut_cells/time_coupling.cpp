// What the time couplings lag, semi and explicit differ in: which boundary bears the loads, and when it is placed
// (theory/coupling.md 1.8, 5).
#include <algorithm>
#include <limits>

#include "coupling/cut_cells/cut_cells.hpp"

namespace brisance::coupling {

namespace {
/// Semi: boundary and particles agree to this part of a cell; the theory's prototype needs 4 rounds.
constexpr Real agreement = 1e-12;
constexpr int most_rounds = 25;
}  // namespace

void CutCells::begin_step(Clock const& clock) {
  if (sources_) sweeper_.keep(record_);
  sweeper_.begin_step();
  if (viscous_) viscous_->begin_step();
  surface_.begin_step();
  if (stage_account_) stage_account_->begin_step();
  rounds_ = 0;
  solid_.save(solid_before_);
  solid_.predict(clock.dt, clock.sub_steps);
  surface_.place();
  surface_.freeze_arms();
  if (scheme_ == TimeCoupling::explicit_load) {
    surface_.take_velocities_at_start();
    solid_.restore(solid_before_);
  } else {
    surface_.take_velocities();
  }
}

void CutCells::find_friction(WallRecord const& wall, bool moved) {
  viscous_->find(record_, wall, moved, [this](CutCell const& cut, Index piece) {
    std::size_t const unit = divided_ && parts_.find(cut.cell) ? parts_.unit_of(piece) : 0;
    return main_before(cut.cell, unit) ? viscous_->state(cut.cell) : state_before(cut.cell, unit);
  });
}

bool CutCells::load_solid(Clock const& clock) {
  std::vector<CellForce> forces;
  if (viscous_) find_friction(next_, moved_);
  wall_pressure(next_, false, clock.dt, forces);
  surface_.apply(forces, moved_ ? LoadOf::end : LoadOf::present);
  solid_.restore(solid_before_);
  if (scheme_ == TimeCoupling::lag) return false;
  // The pressures stay as they are, the boundary follows the loads: a contraction by p dt^2 / (2 rho_s h_s^2).
  solid_.predict(clock.dt, clock.sub_steps);
  Real farthest = -surface_.away();
  comm_.min(std::span(&farthest, 1));
  ++rounds_;
  bool const settled = -farthest <= agreement;
  if (!settled && rounds_ < most_rounds) {
    surface_.place();
    surface_.freeze_arms();
    surface_.take_velocities();
    return true;
  }
  if (!settled && health_.good)
    health_ = {false, "coupling.scheme = \"semi\": boundary and loads do not agree after " +
                          std::to_string(most_rounds) + " rounds (" + std::to_string(-farthest) +
                          " of a cell apart): the solid is too light for the step"};
  solid_.restore(solid_before_);
  return false;
}

void CutCells::load_at_start(Real dt) {
  std::vector<CellForce> forces;
  // The half-Riemann factor brakes the wall: with the velocity of the step before it would push what vibrates fast.
  surface_.send_velocities(record_.triangles);
  divided_ = any_divided(false);
  if (divided_)
    follow_parts(record_);
  else
    parts_.clear(), affected_.clear();
  if (viscous_) find_friction(record_, true);
  at_start_.begin(record_);
  wall_pressure(record_, false, dt, forces);
  at_start_.exchange(record_, flow_, comm_);
  surface_.apply(forces, LoadOf::start);
}

void CutCells::end_drift(Clock const& clock) {
  surface_.take_velocities(1 / static_cast<Real>(clock.sub_steps), clock.sub_step == 0);
  solid_.add_load_work(clock.dt, wall_work_);
  if (stage_account_) {
    Amounts received;
    solid_.add_load_impulse(clock.dt, std::span(received).subspan<1, 3>());
    solid_.add_load_work(clock.dt, received[4]);
    stage_account_->solid_received(received);
  }
  bool const last = clock.sub_step + 1 == clock.sub_steps;
  // In `explicit` they travel with the triangles that are still to come.
  Stopwatch const watch(cost_.exchange_s);
  if (last && scheme_ != TimeCoupling::explicit_load && surface_.send_velocities(next_.triangles)) news_ = true;
}

std::pair<LightestPlace, Real> CutCells::weigh() const {
  fluid::Grid const& grid = flow_.grid();
  fluid::Gas const& gas = flow_.gas();
  LightestPlace lightest;
  Real seconds = std::numeric_limits<Real>::max();
  for (CutCell const& cut : record_.geometry.cells) {
    if (!owned(cut.cell) || record_.solid(cut.cell)) continue;
    fluid::Block const& block = *std::as_const(flow_).find(grid.block_of(cut.cell));
    CellIndex const first = block.first();
    fluid::State const u = block.load(cut.cell[0] - first[0], cut.cell[1] - first[1], cut.cell[2] - first[2]);
    if (gas.vacuum(u)) continue;
    Real step = std::numeric_limits<Real>::max();
    Real const c = gas.sound_speed(u);
    for (int d = 0; d < grid.dimension; ++d)
      step = min(step, courant_number_ * grid.spacing[d] / (std::abs(u[static_cast<std::size_t>(d) + 1] / u[0]) + c));
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = record_.geometry.pieces[static_cast<std::size_t>(f)];
      Real const size = norm(piece.area);
      GlobalId const element = record_.triangles[static_cast<std::size_t>(piece.triangle)].id;
      Real const solid = areal_mass_[static_cast<std::size_t>(element)];
      if (!(size > 0)) continue;
      Real thickness = 0;
      for (int d = 0; d < grid.dimension; ++d) thickness += grid.spacing[d] * std::abs(piece.area[d]) / size;
      Real const ratio = solid / (u[0] * thickness);
      if (ratio < lightest.ratio) lightest = {ratio, solid, u[0] * thickness, element, piece.centroid};
      if (ratio < light_ratio) seconds = min(seconds, ratio * step);
    }
  }
  return {lightest, seconds};
}

void CutCells::remark_on_start() {
  // Where several places are as light, the first element speaks, on whatever rank it is.
  LightestPlace const mine = weigh().first;
  Real ratio = mine.ratio;
  comm_.min(std::span(&ratio, 1));
  Real element = mine.ratio == ratio ? static_cast<Real>(mine.element) : std::numeric_limits<Real>::max();
  comm_.min(std::span(&element, 1));
  parallel::Bytes bytes;
  if (mine.ratio == ratio && static_cast<Real>(mine.element) == element) parallel::put(bytes, mine);
  for (parallel::Bytes const& from : comm_.all_gather(bytes)) {
    if (from.empty()) continue;
    std::span<std::byte const> in(from);
    std::string const text = describe(parallel::take<LightestPlace>(in), surface_.topology(), solid_.mesh(), limited_,
                                      config_.wall_pressure == "cell");
    if (!text.empty() && remark_) remark_(text);
    return;
  }
}

std::string CutCells::remark_on_weight(Real density) const {
  LightestPlace lightest;
  Real thickness = 0;
  for (int d = 0; d < flow_.grid().dimension; ++d) thickness = max(thickness, flow_.grid().spacing[d]);
  for (std::size_t e = 0; e < areal_mass_.size(); ++e)
    if (Real const ratio = areal_mass_[e] / (density * thickness); ratio < lightest.ratio)
      lightest = {ratio, areal_mass_[e], density * thickness, static_cast<GlobalId>(e),
                  surface_.topology().reference(surface_.topology().elements()[e].vertex[0], solid_.mesh())};
  return describe(lightest, surface_.topology(), solid_.mesh(), limited_, config_.wall_pressure == "cell");
}

}  // namespace brisance::coupling
