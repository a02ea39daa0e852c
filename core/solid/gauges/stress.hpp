// Mean stress and strain of a particle.
#pragma once
#include <vector>

#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Symmetric part of (1/V) sum of arm x force over links and loaded faces, in the fixed frame, Pa: the mean Cauchy
/// stress of a body in equilibrium. In 2D and 1D with the stress that keeps the slab in its plane.
/// Loads of a fluid are not among the faces and do not count.  Expects: an owned particle; forces are current.
Mat3 mean_stress(Solid const& solid, Index particle);
/// The same of all owned particles.
std::vector<Mat3> mean_stresses(Solid const& solid);

/// The strain that Hooke's law gives to a stress, 1.
Mat3 elastic_strain(Material const& material, Mat3 const& stress);

}  // namespace brisance::solid
