#include "core/base/place.hpp"

#include <fmt/format.h>

namespace brisance {

std::string place_text(Vec3 const& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x, p.y, p.z); }

}  // namespace brisance
