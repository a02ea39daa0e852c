#include "fluid/diffusion/bench_viscous.hpp"

#include <ctime>

#include <cmath>
#include <limits>
#include <vector>

#include "fluid/diffusion/block_stage.hpp"

namespace brisance::fluid {
namespace {

constexpr int repetitions = 7, stages_per_step = 4;

/// Seconds of processor time of this thread: what a neighbour takes is not counted.
Real now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}

/// A smooth flow with its ghosts.
Block smooth_block(Grid const& grid, Gas const& gas) {
  Block block(grid, 0, 3);
  Index const beyond = grid.dimension > 2 ? 1 : 0;
  for (Index k = -beyond; k < grid.cells[2] + beyond; ++k)
    for (Index j = -1; j <= grid.cells[1]; ++j)
      for (Index i = -1; i <= grid.cells[0]; ++i) {
        Real const x = 0.11 * i, y = 0.07 * j, z = 0.05 * k;
        Vec3 const v{std::sin(x) * std::cos(y), std::cos(x + z), std::sin(z - y)};
        block.store(i, j, k, gas.conserved(1 + 0.2 * std::sin(x + y), v, 5 + std::cos(y + z)));
      }
  return block;
}

}  // namespace

BenchRow bench_viscous(int dimension, MachineRoofs const& roofs) {
  Index const side = dimension == 3 ? 48 : 64;
  std::size_t const blocks = dimension == 3 ? 8 : 256;
  Grid grid;
  grid.dimension = dimension;
  for (std::size_t d = 0; d < 3; ++d) {
    grid.cells[d] = static_cast<int>(d) < dimension ? side : 1;
    grid.cuts[d] = {0, grid.cells[d]};
  }
  Gas gas{1.4, 1e-10, 1e-12};
  gas.gas_constant = 1;
  ViscosityConfig config;
  config.dynamic_viscosity = 1e-3;
  config.reference_temperature = config.sutherland_temperature = 4;
  std::vector<Block> all;
  std::vector<std::vector<Real>> before;
  for (std::size_t b = 0; b < blocks; ++b) {
    all.push_back(smooth_block(grid, gas));
    before.emplace_back(BlockStage::before_size(all.back()));
  }
  BlockStage stage(Transport(config, gas), grid);
  std::array<State, 6> through{};
  Real best = std::numeric_limits<Real>::infinity();
  for (int r = 0; r < repetitions; ++r) {
    Real const start = now();
    for (int half = 0; half < 2; ++half)
      for (DiffusionStage const s : {DiffusionStage::heun_first, DiffusionStage::heun_second})
        for (std::size_t b = 0; b < blocks; ++b) stage.run(all[b], 0.1, s, before[b], {}, through);
    best = min(best, now() - start);
  }
  // Heun reads nine doubles and writes eight in its first stage and four in its second; the operations are those of the
  // text: primitives 26, a face 47 (2D: 34), an update 10 for each of four columns (2D: 8), a check 12.
  Real const bytes = 8.0 * 2 * (5 + 8 + 9 + 4);
  Real const flops = stages_per_step * (26 + (dimension == 3 ? 3 * 47 + 40 : 2 * 34 + 32) + 12.0);
  BenchRow row{"fluid.kernel." + std::to_string(dimension) + "d.viscous",
               static_cast<Real>(blocks) * static_cast<Real>(grid.cell_count()) / best, bytes, flops, 0};
  row.limit_share =
      max(row.items_per_s * bytes / roofs.bytes_per_s, row.items_per_s * row.flops_per_item / roofs.flops_per_s);
  return row;
}

}  // namespace brisance::fluid
