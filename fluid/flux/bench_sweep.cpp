#include "fluid/flux/bench_sweep.hpp"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fluid/flux/pack.hpp"
#include "fluid/flux/sweep.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::fluid {
namespace {

constexpr int repetitions = 7;

/// Seconds of processor time of this thread: what a neighbour takes is not counted.
Real now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}
template <class Work>
Real best_time(Work work) {
  Real best = std::numeric_limits<Real>::infinity();
  for (int r = 0; r < repetitions; ++r) {
    Real const start = now();
    work();
    best = min(best, now() - start);
  }
  return best;
}

Real measure_bandwidth() {
  std::size_t const n = std::size_t{1} << 23;  // 64 MB an array: beyond any cache
  std::size_t const shift = 72;                // so that equal elements do not fall into the same cache sets
  std::vector<Real> storage(3 * n + 2 * shift, 1.0);
  Real scale = 1.5;
  Real const time = best_time([&] {
    Real* const to = storage.data();
    Real const *const x = to + n + shift, *const y = x + n + shift;
    for (std::size_t i = 0; i < n; ++i) to[i] = x[i] + scale * y[i];
    asm volatile("" ::"r"(to) : "memory");
    scale += 1e-3;
  });
  return 24 * static_cast<Real>(n) / time;
}

Real measure_multiply_adds() {
  constexpr int chains = 12, turns = 2000000;  // chains hide the latency of an operation
  Pack x[chains];
  for (int k = 0; k < chains; ++k) x[k] = Pack(1.0 + k);
  Pack const factor(0.999999), term(1e-9);
  Real const time = best_time([&] {
    for (int i = 0; i < turns; ++i) {
      BRISANCE_UNROLL for (int k = 0; k < chains; ++k) x[k] = fma(x[k], factor, term);
    }
  });
  Real sink[lanes_of<Pack>];
  for (int k = 0; k < chains; ++k) {
    store(sink, x[k]);
    asm volatile("" ::"r"(sink) : "memory");
  }
  return 2.0 * chains * turns * lanes_of<Pack> / time;
}

Grid periodic_box(Index side) {
  Grid grid;
  grid.cells = {side, side, side};
  grid.periodic = {true, true, true};
  for (auto& cut : grid.cuts) cut = {0, side};
  return grid;
}

void fill(Block& block, Index n, Gas const& gas) {
  using std::cos, std::sin;
  Real const turn = 2 * std::numbers::pi / n;
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        Real const x = (i + 0.5) * turn, y = (j + 0.5) * turn, z = (k + 0.5) * turn;
        Vec3 const v{0.4 * sin(x + 0.2) * cos(y) * cos(z), 0.2 - 0.4 * cos(x) * sin(y) * cos(z),
                     0.3 * sin(2 * x) * cos(z + 1)};
        Real const centre = 0.5 * n, r = std::hypot(i - centre, j - centre, k - centre);
        Real const pressure = (1 + 0.2 * cos(x + y) * sin(z)) * (r < 0.14 * n ? 10 : 1);
        block.store(i, j, k, gas.conserved(1 + 0.3 * sin(x) * cos(y) * sin(z + 0.3), v, pressure));
      }
}

void copy_periodic(Block& block, std::size_t along, Index n, Index ghosts) {
  auto const stride = block.stride();
  std::size_t const inner = along == 0 ? 1 : 0, outer = along == 2 ? 1 : 2;
  std::ptrdiff_t const wrap = stride[along] * n;
  for (int q = 0; q < 5; ++q)
    for (Index o = 0; o < n; ++o)
      for (Index g = 0; g < ghosts; ++g) {
        Real* const low = block.component(q) + o * stride[outer] + g * stride[along];
        Real* const high = low + wrap - ghosts * stride[along];
        for (Index i = 0; i < n; ++i) {
          low[i * stride[inner] + wrap] = low[i * stride[inner]];
          high[i * stride[inner] - wrap] = high[i * stride[inner]];
        }
      }
}

}  // namespace

Real limit_share(BenchRow const& row, MachineRoofs const& roofs) {
  return max(row.items_per_s * row.bytes_per_item / roofs.bytes_per_s,
             row.items_per_s * row.flops_per_item / roofs.flops_per_s);
}

MachineRoofs measure_roofs() { return {measure_bandwidth(), measure_multiply_adds()}; }

BenchRow bench_triad(MachineRoofs const& roofs) {
  BenchRow row{"stream.triad", roofs.bytes_per_s / 24, 24, 2, 0};
  row.limit_share = limit_share(row, roofs);
  return row;
}
BenchRow bench_multiply_add(MachineRoofs const& roofs) {
  return {"arithmetic.multiply_add", roofs.flops_per_s / 2, 0, 2, 1};
}

Real sweep_operations(int order, bool smooth) {
  constexpr Real count[2][6] = {{280, 668, 775, 902, 1049, 1216},  // orders 1, 3, ... 11
                                {280, 741, 964, 1091, 1238, 1405}};
  return count[smooth][order / 2];
}

BenchRow bench_sweep(int order, int dimension, bool smooth, MachineRoofs const& roofs, Index side) {
  Grid const grid = periodic_box(side);
  Block block(grid, 0, ghost_depth(order));
  Gas const gas{1.4, 1e-10, 1e-12};
  fill(block, side, gas);
  CellBox box{{}, block.size(), block.stride(), dimension};
  for (int q = 0; q < 5; ++q) box.u[static_cast<std::size_t>(q)] = block.component(q);
  SweepOptions options;
  options.smooth = smooth;
  Real sigma = 0.1;  // the first step finds the signal speed
  bool forward = true;
  Real const time = best_time([&] {
    Real signal = 0;
    for (int m = 0; m < dimension; ++m) {
      int const along = forward ? m : dimension - 1 - m;
      copy_periodic(block, static_cast<std::size_t>(along), side, ghost_depth(order));
      signal = max(signal, sweep_box(order, box, along, sigma, gas, options).signal_max);
    }
    sigma = 0.8 / signal;
    forward = !forward;
  });
  Real const cells = static_cast<Real>(grid.cell_count());
  std::string const variant = smooth ? "d.smooth.order" : "d.order";
  BenchRow row{"fluid.kernel." + std::to_string(dimension) + variant + std::to_string(order), cells / time,
               80.0 * dimension, sweep_operations(order, smooth) * dimension, 0};
  row.limit_share = limit_share(row, roofs);
  return row;
}

}  // namespace brisance::fluid
