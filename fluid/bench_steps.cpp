#include "fluid/bench_steps.hpp"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/model/simulation.hpp"
#include "fluid/euler.hpp"
#include "fluid/initial_state.hpp"

namespace brisance::fluid {
namespace {

constexpr int measurements = 6;
constexpr Real shortest_measurement = 0.1;  // s

Real seconds(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}

FlowConfig periodic_box(int order, std::vector<int> const& cells, int ranks) {
  FlowConfig config;
  config.cells = cells;
  config.cells[0] *= ranks;
  for (std::size_t d = 0; d < cells.size(); ++d) config.high[static_cast<int>(d)] = config.cells[d];
  if (cells.size() == 3) config.block = *std::max_element(cells.begin(), cells.end());
  config.ambient = {1, 1, {}};
  config.euler.emplace();
  config.euler->order = order;
  BoundaryConfig& b = config.boundary;
  b.x_low = b.x_high = b.y_low = b.y_high = b.z_low = b.z_high = "periodic";
  return config;
}

/// Every rank has a part of the box along x.
std::vector<int> owners(Grid const& grid, int ranks) {
  std::vector<int> owner;
  for (Index b = 0; b < grid.block_count(); ++b)
    owner.push_back(static_cast<int>(std::int64_t{grid.block_position(b)[0]} * ranks / grid.blocks_along(0)));
  return owner;
}

/// Waves of every family over one part of the box, and a ball of tenfold pressure in it.
State initial_state(Gas const& gas, std::vector<int> const& cells, CellIndex c) {
  using std::cos, std::sin;
  Vec3 x{}, from_centre{};
  for (std::size_t d = 0; d < cells.size(); ++d) {
    Real const part = (c[d] % cells[d] + 0.5) / cells[d];
    x[static_cast<int>(d)] = 2 * std::numbers::pi * part;
    from_centre[static_cast<int>(d)] = part - 0.5;
  }
  Vec3 v{0.4 * sin(x.x + 0.2) * cos(x.y) * cos(x.z), 0.2 - 0.4 * cos(x.x) * sin(x.y) * cos(x.z),
         0.3 * sin(2 * x.x) * cos(x.z + 1)};
  for (std::size_t d = cells.size(); d < 3; ++d) v[static_cast<int>(d)] = 0;
  Real const pressure = (1 + 0.2 * cos(x.x + x.y) * sin(x.z + 1)) * (norm2(from_centre) < 0.14 * 0.14 ? 10 : 1);
  return gas.conserved(1 + 0.3 * sin(x.x) * cos(x.y) * sin(x.z + 0.3), v, pressure);
}

}  // namespace

BenchRow bench_steps(std::string const& name, int order, std::vector<int> const& cells, parallel::Comm& comm,
                     MachineRoofs const& roofs) {
  FlowConfig const config = periodic_box(order, cells, comm.size());
  Grid const grid = make_grid(config);
  Flow flow(config, grid, owners(grid, comm.size()), comm);
  fill(flow, [&](CellIndex c) { return initial_state(flow.gas(), cells, c); });
  Euler euler(*config.euler, flow);
  Plan plan;
  euler.join(plan);
  int const steps = steps_per_pair(grid.dimension);
  Simulation simulation(plan, comm, {1e9, steps, 0});
  simulation.audit();
  auto const pair = [&] {
    simulation.pair();
    Extremes const e = extremes(flow);
    std::array<double, 2> low{e.density_min, e.pressure_min};
    std::array<double, 1> high{e.mach_max};
    comm.min(low);
    comm.max(high);
  };
  clockid_t const clock = comm.size() > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
  auto const time_of = [&](int pairs) {
    comm.barrier();
    Real const start = seconds(clock);
    for (int p = 0; p < pairs; ++p) pair();
    return (seconds(clock) - start) / pairs;
  };
  pair();  // pages and buffers come into being
  std::array<double, 1> once{time_of(1)};
  comm.max(once);
  int const pairs = once[0] < shortest_measurement ? static_cast<int>(std::ceil(shortest_measurement / once[0])) : 1;
  Real best = std::numeric_limits<Real>::infinity();
  for (int m = 0; m < measurements; ++m) best = min(best, time_of(pairs));
  Real const items = static_cast<Real>(grid.cell_count()) * steps / comm.size();
  BenchRow row{name, items / best, 80.0 * grid.dimension, sweep_operations(order) * grid.dimension, 0};
  row.limit_share = limit_share(row, roofs);
  return row;
}

}  // namespace brisance::fluid
