// Small fluid domains for tests: blocks dealt out to the ranks in turn, so that every block has foreign neighbours.
#pragma once
#include <memory>
#include <vector>

#include "fluid/flow.hpp"
#include "parallel/comm.hpp"

namespace brisance::testing {

inline std::unique_ptr<fluid::Flow> make_flow(fluid::FlowConfig const& config, parallel::Comm& comm) {
  fluid::Grid grid = fluid::make_grid(config);
  std::vector<int> owner;
  for (Index b = 0; b < grid.block_count(); ++b) owner.push_back(static_cast<int>(b) % comm.size());
  return std::make_unique<fluid::Flow>(config, std::move(grid), std::move(owner), comm);
}

/// A box [0, length]^dimension with `cells` along each direction and gas in units of order one.
inline fluid::FlowConfig unit_box(int dimension, int cells, Real length = 1) {
  fluid::FlowConfig config;
  config.cells.assign(static_cast<std::size_t>(dimension), cells);
  for (int d = 0; d < dimension; ++d) config.high[d] = length;
  config.ambient.density = 1;
  config.ambient.pressure = 1;
  config.euler.emplace();
  return config;
}

inline void set_boundaries(fluid::FlowConfig& config, std::string const& law) {
  fluid::BoundaryConfig& b = config.boundary;
  b.x_low = b.x_high = b.y_low = b.y_high = b.z_low = b.z_high = law;
}

}  // namespace brisance::testing
