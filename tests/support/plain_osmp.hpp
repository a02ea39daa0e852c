// The OSMP sweep written plainly, one face and one field at a time, straight from theory/fluid.md 2-4: what the kernel
// must equal.
#pragma once
#include <vector>

#include "fluid/flux/sweep.hpp"

namespace brisance::testing {

using fluid::Gas;
using fluid::State;

/// One pencil in sweep coordinates; `first` is the place of cell 0 in `cells`.
struct PlainPencil {
  std::vector<State> cells;
  Index first = 0, n = 0;
  std::vector<int> face_order;  ///< of faces 0..n, empty: `order` everywhere
  std::vector<bool> marked;     ///< cells beside a transverse shock, as `cells`; empty: none
};
struct PlainSweep {
  std::vector<State> cells;      ///< 0..n-1 after the sweep
  std::vector<State> flux;       ///< final fluxes of faces 0..n
  std::vector<double> pressure;  ///< of cells 0..n-1 before the sweep
  int limited = 0;               ///< faces 0..n with theta < 1
};
PlainSweep plain_sweep(PlainPencil const& pencil, int order, double sigma, Gas const& gas,
                       fluid::SweepOptions const& options = {});

}  // namespace brisance::testing
