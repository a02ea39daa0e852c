// What the blasts of a scene are, in a line each.
#pragma once
#include <string>
#include <vector>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// One line per solid.blast: faces, nearest and furthest, and what reaches the nearest.
/// Errors: those of the loads themselves.
std::vector<std::string> describe_blasts(SolidConfig const& config, Mesh const& mesh);

}  // namespace brisance::solid
