// What a scene says about fracture: laws, each for all links or for those of a body or a material.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/location.hpp"
#include "core/solid/fracture/criteria.hpp"
#include "core/solid/fracture/weibull.hpp"

namespace brisance::solid {

/// One criterion and the links it is for. A link follows the last law that fits it; without one it never breaks.
struct LawConfig {
  std::optional<std::string> body, material;  ///< both ends of the link belong to it
  std::vector<std::string> between;           ///< two materials: links across their interface
  std::optional<Elongation> elongation;
  std::optional<MixedStress> stress;
  std::optional<MohrCoulomb> mohr_coulomb;
  std::optional<EnergyRelease> energy;
  std::optional<Cohesive> cohesive;
  std::optional<Weibull> weibull;
  bool clamps = true;  ///< half links to a rigid wall break too
  Location at;
  static void keys(Keys<LawConfig>& k);

  /// Errors: scene error unless exactly one criterion is given.
  Criterion criterion() const;
};

struct FractureConfig {
  std::vector<LawConfig> law;
  Location at;
  static void keys(Keys<FractureConfig>& k);
};

}  // namespace brisance::solid
