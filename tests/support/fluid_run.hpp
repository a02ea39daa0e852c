// A fluid with its effects, run by the simulation of the program: what scenes without a solid do.
#pragma once
#include <memory>
#include <utility>

#include "core/model/simulation.hpp"
#include "fluid/diffusion/viscosity.hpp"
#include "fluid/euler.hpp"
#include "fluid/source/gravity.hpp"
#include "tests/support/flow_case.hpp"

namespace brisance::testing {

class FluidRun {
 public:
  FluidRun(fluid::FlowConfig const& config, Real end, parallel::Comm& comm)
      : flow(make_flow(config, comm)), euler(*config.euler, *flow) {
    euler.join(plan);
    if (config.viscosity) viscosity = std::make_unique<fluid::Viscosity>(config, *flow);
    if (config.gravity) gravity = std::make_unique<fluid::Gravity>(*config.gravity, *flow);
    if (viscosity) viscosity->join(plan);
    if (gravity) gravity->join(plan);
    simulation =
        std::make_unique<Simulation>(plan, comm, TimeControl{end, fluid::steps_per_pair(flow->grid().dimension), 0});
  }
  /// To the end of the run; the cells must be filled.
  void run() {
    simulation->audit();
    while (!simulation->finished()) simulation->pair();
  }
  Conservation const& conservation() const { return simulation->ledger().conservation(); }
  /// Calls visit(cell, state) for the cells of this rank.
  template <class Visit>
  void for_cells(Visit&& visit) const {
    for (fluid::Block const& b : flow->blocks())
      for (Index k = 0; k < b.size()[2]; ++k)
        for (Index j = 0; j < b.size()[1]; ++j)
          for (Index i = 0; i < b.size()[0]; ++i)
            visit(fluid::CellIndex{b.first()[0] + i, b.first()[1] + j, b.first()[2] + k}, b.load(i, j, k));
  }

  std::unique_ptr<fluid::Flow> flow;
  Plan plan;
  fluid::Euler euler;
  std::unique_ptr<fluid::Viscosity> viscosity;
  std::unique_ptr<fluid::Gravity> gravity;
  std::unique_ptr<Simulation> simulation;
};

/// Means over a cell by Gauss points in the directions of the grid; `exact`: point -> conserved state.
template <class Exact>
fluid::State gauss_mean(fluid::Grid const& grid, fluid::CellIndex c, Exact const& exact) {
  constexpr Real node[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr Real weight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  int const ny = grid.dimension > 1 ? 4 : 1, nz = grid.dimension > 2 ? 4 : 1;
  fluid::State mean{};
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < 4; ++i) {
        Vec3 x = grid.centre(c);
        x.x += 0.5 * grid.spacing.x * node[i];
        if (ny > 1) x.y += 0.5 * grid.spacing.y * node[j];
        if (nz > 1) x.z += 0.5 * grid.spacing.z * node[k];
        Real const w = weight[i] * (ny > 1 ? weight[j] : 1) * (nz > 1 ? weight[k] : 1);
        fluid::State const u = exact(x);
        for (std::size_t q = 0; q < 5; ++q) mean[q] += w * u[q];
      }
  return mean;
}

}  // namespace brisance::testing
