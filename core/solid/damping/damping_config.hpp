// What a scene says about damping of the solid.
#pragma once
#include <optional>
#include <string>

#include "core/base/location.hpp"
#include "core/base/real.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

struct DampingConfig {
  std::string law = "viscous", relative_to = "ground";
  std::optional<double> rate{};      ///< viscous: alpha, 1/s
  std::optional<double> until{};     ///< s
  std::optional<double> residual{};  ///< of the net forces over their largest value so far, 1
  Location at{};
  static void keys(Keys<DampingConfig>& k);
};

}  // namespace brisance::solid
