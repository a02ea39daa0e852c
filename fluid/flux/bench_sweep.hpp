// What the sweeps do on this machine: cell-steps a second, and the share of the machine's roofs they reach.
#pragma once
#include <string>

#include "core/base/real.hpp"

namespace brisance::fluid {

/// One measured row. Rates are per core, best of several; from processor time, where ranks wait for each other from
/// wall time.
struct BenchRow {
  std::string name;
  Real items_per_s = 0;
  Real bytes_per_item = 0;  ///< what must move when nothing stays in cache
  Real flops_per_item = 0;  ///< a multiply-add is two; min, max, divide and square root are one
  Real limit_share = 0;     ///< of the bandwidth or of the flop limit, whichever is closer
};

/// Roofs of one core.
struct MachineRoofs {
  Real bytes_per_s = 0;  ///< triad of three arrays
  Real flops_per_s = 0;  ///< independent multiply-adds
};
MachineRoofs measure_roofs();
/// Share of the closer of the two roofs that a row reaches.
Real limit_share(BenchRow const& row, MachineRoofs const& roofs);
/// `stream.triad`: a = b + s c; an item is one element.
BenchRow bench_triad(MachineRoofs const& roofs);
/// `arithmetic.multiply_add`: an item is one multiply-add of one lane.
BenchRow bench_multiply_add(MachineRoofs const& roofs);

/// `fluid.kernel.<dimension>d.order<N>`, `fluid.kernel.<dimension>d.smooth.order<N>` with the terms of `smooth`: the
/// kernel alone: periodic copies and one sweep per direction over one block of side^3 cells, smooth flow and a blast,
/// with positivity. Item: cell-step. In fewer dimensions the cells are a set of planes or lines swept together. Whole
/// steps: bench_steps.hpp. Expects: side >= 16. Cost: about 7 side^3 dimension / 3e7 s.
BenchRow bench_sweep(int order, int dimension, bool smooth, MachineRoofs const& roofs, Index side = 96);

/// Operations of one cell in one sweep, counted on the text of the kernel (tests/unit/fluid/flux/operations_test.cpp).
Real sweep_operations(int order, bool smooth = false);

}  // namespace brisance::fluid
