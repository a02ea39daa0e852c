// What the time couplings lag, semi and explicit differ in: which boundary bears the loads, and when it is placed
// (theory/coupling.md 1.8, 5).
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
  rounds_ = 0;
  if (scheme_ == TimeCoupling::explicit_load) {
    surface_.freeze_arms();
    return;
  }
  solid_.save(solid_before_);
  solid_.predict(clock.dt, clock.sub_steps);
  surface_.place();
  surface_.freeze_arms();
  surface_.take_velocities();
}

bool CutCells::load_solid(Clock const& clock) {
  std::vector<CellForce> forces;
  if (viscous_) viscous_->find(record_, next_, moved_);
  wall_pressure(next_, false, forces);
  surface_.apply(forces);
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

void CutCells::load_at_start() {
  std::vector<CellForce> forces;
  if (viscous_) viscous_->find(record_, record_, true);
  at_start_.begin(record_);
  wall_pressure(record_, false, forces);
  at_start_.exchange(record_, flow_, comm_);
  surface_.apply(forces);
}

void CutCells::end_drift(Clock const& clock) {
  surface_.take_velocities(1 / static_cast<Real>(clock.sub_steps), clock.sub_step == 0);
  solid_.add_load_work(clock.dt, wall_work_);
  bool const last = clock.sub_step + 1 == clock.sub_steps;
  // In `explicit` they travel with the triangles that are still to come.
  if (last && scheme_ != TimeCoupling::explicit_load) surface_.send_velocities(next_.triangles);
}

}  // namespace brisance::coupling
