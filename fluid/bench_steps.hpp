// Whole steps of a run of the fluid on this machine, as opposed to the kernel alone (flux/bench_sweep.hpp).
#pragma once
#include <string>
#include <vector>

#include "fluid/flux/bench_sweep.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// Pairs of steps by Simulation and the effect fluid.euler in a periodic box: time step limit, state kept for
/// rejection, ghosts with their messages, sweeps, agreement on the health, audit, extrema: what `brisance run` does
/// between two pairs, files apart. Smooth flow with a blast, positivity on. In 3D one block a
/// rank (the default blocks of 48 cells cost a tenth more), else default blocks.
/// Collective. `cells` a rank, their number is the dimension; ranks extend the box along x, each with a part of it.
/// Item: cell-step (a step = one sweep per direction). Time: wall time on several ranks, whose messages wait for each
/// other, else processor time; best of several.  Cost: about a second and a half.
BenchRow bench_steps(std::string const& name, int order, std::vector<int> const& cells, parallel::Comm& comm,
                     MachineRoofs const& roofs);

}  // namespace brisance::fluid
