// Places in messages.
#pragma once
#include <string>

#include "core/base/vec3.hpp"

namespace brisance {

/// "(x, y, z) m"
std::string place_text(Vec3 const& p);

}  // namespace brisance
