// What the size of the particles makes of a law: figures a user should see before the run.
#pragma once
#include <string>
#include <vector>

#include "core/solid/fracture/fracture_config.hpp"
#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// A line per law of the scene: links, and the toughness that a strength implies, the strength that a toughness
/// implies, or whether particles resolve the softening zone.  Source: theory/solid.md section 14, beta_G = 0.29.
std::vector<std::string> law_figures(FractureConfig const& config, Mesh const& mesh);

}  // namespace brisance::solid
