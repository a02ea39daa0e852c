// The time step of loaded particles that no link limits.
#pragma once
#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// A rigid particle without links could take any step; under a load that changes in time it takes those that an elastic
/// body of its size would: cbrt(V) / c_p, s. 1e300 for a particle with links.
inline Real free_step(Mesh const& mesh, GlobalId particle) {
  if (!mesh.links_of(particle).empty()) return 1e300;
  Material const& m = mesh.material(particle);
  return std::cbrt(mesh.shape(particle).volume) * std::sqrt(m.density / (m.lame() + 2 * m.shear()));
}

}  // namespace brisance::solid
