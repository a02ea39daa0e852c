#include "tests/support/hard_run.hpp"

#include <cmath>

#include "fluid/flux/positivity.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::testing {

using fluid::CellIndex;
using fluid::State;

HardRun::HardRun(HardCase const& c, int order) : scene(c) {
  scene.config.euler->order = order;
  flow = make_flow(scene.config, comm());
  if (scene.start)
    fluid::fill(*flow, [&](CellIndex at) { return scene.start(*flow, at); });
  else
    fluid::fill(*flow, scene.config);
  if (scene.held) held = std::make_unique<HeldCells>(*flow, clock, *scene.held);
  density_min = pressure_min = std::numeric_limits<Real>::infinity();
  judge_cells();
}

void HardRun::judge_cells() {
  for_cells(*this, [&](CellIndex, State const& u) {
    health |= fluid::judge(u, flow->gas());
    density_min = min(density_min, u[0]);
    pressure_min = min(pressure_min, flow->gas().pressure(u));
  });
}

/// Many times the steps of the longest case: a run that needs more is stuck in ever smaller ones.
constexpr std::int64_t endless = 100000;

void HardRun::run(Real cfl) {
  fluid::Totals const before = totals(*flow);
  try {
    while (scene.steps > 0 ? clock.step < scene.steps : clock.time < scene.end) {
      advance(*flow, clock, {.end = scene.end, .cfl = cfl, .steps = clock.step + 1, .dt_max = scene.dt_max});
      judge_cells();
      if (clock.step > endless) {
        failure = "not at the end after " + std::to_string(clock.step) + " steps";
        break;
      }
    }
  } catch (std::exception const& e) {
    failure = e.what();
  }
  fluid::Totals const after = totals(*flow);
  fluid::BoundaryLedger::Totals const crossed = flow->ledger().totals(flow->comm());
  State gained = crossed.gained;
  if (held) {
    State const added = held->added();
    for (std::size_t q = 0; q < 5; ++q) gained[q] += added[q];
  }
  auto const defect = [&](Real now, Real then, std::size_t q, Real scale) {
    Real const d = std::abs(now - then - gained[q]) / scale;
    conservation = d >= 0 ? max(conservation, d) : std::numeric_limits<Real>::infinity();
  };
  defect(after.mass, before.mass, 0, max(before.mass, after.mass));
  defect(after.energy, before.energy, 4, max(before.energy, after.energy));
  // where nothing has moved nothing is to be compared
  if (Real const size = max(before.momentum_size, after.momentum_size) + crossed.impulse; size > 0)
    for (int d = 0; d < 3; ++d) defect(after.momentum[d], before.momentum[d], 1 + static_cast<std::size_t>(d), size);
}

void for_cells(HardRun const& run, std::function<void(CellIndex, State const&)> const& visit) {
  for (fluid::Block const& block : run.flow->blocks())
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j)
        for (Index i = 0; i < block.size()[0]; ++i) {
          CellIndex const first = block.first(), c{first[0] + i, first[1] + j, first[2] + k};
          if (!run.held || !run.held->holds(c)) visit(c, block.load(i, j, k));
        }
}

}  // namespace brisance::testing
