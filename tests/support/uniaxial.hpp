// A body pulled at two ends, and the affine displacement that fits what it does: patch tests.
#pragma once
#include "tests/support/linear_solid.hpp"
#include "tests/support/solids.hpp"

namespace brisance::testing {

/// Affine field u = u0 + A (X - X0) fitted to the displacements of the poles, and how far they are off it.
struct AffineFit {
  Mat3 gradient{};   ///< A
  Real scatter = 0;  ///< rms distance from the field, m
};

/// Displacement gradient per stress (1/Pa) and scatter (m/Pa) of a free body under tractions along x on its faces at
/// x = low and high, for small strains.
AffineFit small_strain(Lone& body, Real low, Real high);
/// Displacement gradient and scatter (m) in the true equilibrium under `stress`; the faces carry their traction along.
AffineFit finite_strain(Lone& body, Real low, Real high, Real stress);

}  // namespace brisance::testing
