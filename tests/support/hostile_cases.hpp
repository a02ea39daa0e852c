// Flows as hard as a user may ask for, in no table: 1D, 2D and 3D, n cells along each side of a unit box.
#pragma once
#include <vector>

#include "tests/support/hard_run.hpp"

namespace brisance::testing {

/// All but the random ones: collisions, rarefactions, hot cells, voids, water, detonation products.
std::vector<HardCase> hostile_cases(int dimension, int n);

/// Periodic box of random cells for some steps: pressures above the reference curve over 12 decades, densities over 6
/// (JWL 5, stiffened 3), Mach up to 1000 (100 with a curve), one cell in ten empty.
HardCase random_box(int dimension, int n, unsigned seed, std::int64_t steps, fluid::Gas const& gas);

}  // namespace brisance::testing
