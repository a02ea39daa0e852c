// What `brisance bench` reports of the walls as the fluid sees them.
#pragma once
#include "coupling/geometry/bench.hpp"

namespace brisance::coupling {

/// Row `coupling.projections`: nearest wall points of the three cells behind both ends of every run of fluid cells
/// along x, beside the sphere of `coupling.cut_cells`. Items: cells.
GeometryRate bench_projections();

}  // namespace brisance::coupling
