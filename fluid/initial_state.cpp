#include "fluid/initial_state.hpp"

#include "fluid/charges.hpp"
#include "fluid/shapes.hpp"

namespace brisance::fluid {

void fill(Flow& flow, std::function<State(CellIndex)> const& state) {
  for (Block& block : flow.blocks()) {
    auto const [nx, ny, nz] = block.size();
    CellIndex const first = block.first();
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) {
          block.store(i, j, k, state({first[0] + i, first[1] + j, first[2] + k}));
          for (int q = 5; q < block.components(); ++q) block.component(q)[block.at(i, j, k)] = 0;
        }
  }
}

void fill(Flow& flow, FlowConfig const& config, FluidVolume const& volume) {
  Gas const& gas = flow.gas();
  State const ambient = gas.conserved(config.ambient.density, config.ambient.velocity, config.ambient.pressure);
  std::vector<State> inside;
  for (RegionConfig const& region : config.region)
    inside.push_back(gas.conserved(region.density, region.velocity, region.pressure));
  fill(flow, [&](CellIndex c) {
    State u = ambient;
    for (std::size_t r = 0; r < inside.size(); ++r) {
      Real const share = covered(config.region[r], flow.grid(), c);
      if (share > 0) u = mixed(u, inside[r], share);
    }
    return u;
  });
  add_charges(flow, config, volume);
}

}  // namespace brisance::fluid
