// What the viscous terms do on this machine.
#pragma once
#include "fluid/flux/bench_sweep.hpp"

namespace brisance::fluid {

/// `fluid.kernel.<dimension>d.viscous`: the viscous terms of one step (two Heun half steps) with Sutherland's law, over
/// 96^3 cells or 256 blocks of 64^2, without their ghosts. Item: cell-step.  Expects: dimension 2 or 3.
BenchRow bench_viscous(int dimension, MachineRoofs const& roofs);

}  // namespace brisance::fluid
