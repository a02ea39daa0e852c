// The scene's keys of gravity in the fluid.
#pragma once
#include "core/base/keys.hpp"

namespace brisance::fluid {

struct GravityConfig {
  Vec3 acceleration{};  // m/s2
  Location at;
  static void keys(Keys<GravityConfig>& k) {
    k("acceleration", &GravityConfig::acceleration, "m/s2", "of every piece of gas, constant").required();
  }
};

}  // namespace brisance::fluid
