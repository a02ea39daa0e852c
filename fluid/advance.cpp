#include "fluid/advance.hpp"

#include <cstdio>

#include "parallel/error.hpp"

namespace brisance::fluid {
namespace {

/// What all ranks know of a pair of steps.
struct PairReport {
  std::uint64_t health = 0;
  GlobalId where = std::numeric_limits<GlobalId>::max();  // first bad cell
  std::int64_t fallback_faces = 0;
  Real courant = 0;
};

PairReport sweep_pair(Flow& flow, FlowClock const& clock, Real dt) {
  Grid const& grid = flow.grid();
  PairReport pair;
  flow.begin_pair();
  for (int s = 0; s < steps_per_pair(grid.dimension); ++s) {
    for (auto const [d, share, middle] : sweeps(grid.dimension, clock.step + s, flow.splitting())) {
      SweepReport const report = flow.sweep(d, share * dt, clock.time + (s + middle) * dt);
      pair.health |= report.health;
      if (report.health) pair.where = std::min(pair.where, grid.cell_id(report.where));
      pair.fallback_faces += report.fallback_faces;
      pair.courant = max(pair.courant, share * dt / grid.spacing[d] * report.signal_max);
    }
  }
  return pair;
}

void agree(PairReport& pair, parallel::Comm& comm) {
  comm.bit_or(std::span(&pair.health, 1));
  comm.sum(std::span(&pair.fallback_faces, 1));
  double extremes[2] = {pair.courant, -static_cast<double>(pair.where)};
  comm.max(extremes);
  pair.courant = extremes[0];
  pair.where = static_cast<GlobalId>(-extremes[1]);
}

[[noreturn]] void give_up(Flow const& flow, PairReport const& pair, FlowClock const& clock, Real dt) {
  Grid const& grid = flow.grid();
  GlobalId const nx = grid.cells[0], ny = grid.cells[1], c = pair.where;
  char text[256];
  std::snprintf(
      text, sizeof text,
      "fluid: %s in cell (%lld, %lld, %lld) at t = %.9g s, step %lld, although the time step was halved ten times "
      "(dt = %.3g s). Check the initial state there, or refine the grid.",
      describe(pair.health).c_str(), static_cast<long long>(c % nx), static_cast<long long>(c / nx % ny),
      static_cast<long long>(c / (nx * ny)), clock.time, static_cast<long long>(clock.step), dt);
  throw Error(Failure::numerical, text);
}

}  // namespace

void advance(Flow& flow, FlowClock& clock, AdvanceLimits const& limits) {
  Grid const& grid = flow.grid();
  int const steps = steps_per_pair(grid.dimension);
  while (clock.time < limits.end && clock.step < limits.steps) {
    std::array<Real, 3> speeds = signal_speeds(flow);
    flow.comm().max(speeds);
    Real const cfl = courant_number(grid.dimension, clock.step, limits.cfl);
    Real const nominal =
        min(limits.dt_max, min(acoustic_time_step(grid, speeds, cfl), side_time_step(flow, clock.time, cfl)));
    flow.save();
    for (;;) {
      PairStep const step = shorten(clock.time, limits.end, clock.retry.factor() * nominal, steps);
      PairReport pair = sweep_pair(flow, clock, step.dt);
      agree(pair, flow.comm());
      if (pair.health != 0) {
        flow.restore();
        if (!clock.retry.reject()) give_up(flow, pair, clock, step.dt);
        continue;
      }
      clock.retry.accept();
      clock.time = step.reaches_end ? limits.end : clock.time + steps * step.dt;
      clock.step += steps;
      clock.fallback_faces += pair.fallback_faces;
      clock.courant_max = max(clock.courant_max, pair.courant);
      break;
    }
  }
}

}  // namespace brisance::fluid
