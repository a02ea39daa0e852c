// How many particles a slender body is thick, and what that does to its stiffness in bending.
#pragma once
#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// Particles across a rod: a body at least four times longer than thick, in both directions. 0: it is none.
/// Counted in straight lines from each boundary face to the one opposite.
int layers_across_a_rod(Mesh const& mesh, Index body);

/// By how much a rod of n x n cubes is too stiff in bending, as a share of E I. The Poisson effect wants strains across
/// the rod that vary over it, and each layer has one. A fit to cantilevers at nu = 0.3, 0.49 and -0.9 with n = 2 to 12,
/// to 0.02 (0.06 of the error itself at -0.9); 0 for one layer and for nu = 0 (theory/solid.md section 13.4).
Real stiffening_of_a_rod(Real poisson_ratio, int layers);

}  // namespace brisance::solid
