// A [[output.solid_gauge]] of the scene: what of the solid is watched, how often, and what is written of it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/keys.hpp"
#include "core/solid/mesh.hpp"

namespace brisance::solid {

struct SolidGaugeConfig {
  std::string name, watch = "particle";
  double interval = 0;                  // s
  std::optional<std::string> body;      // not given: all
  std::optional<Vec3> position;         // m, reference state
  std::optional<Vec3> normal;           // section
  std::optional<Vec3> low, high;        // support, section: box, reference state
  std::vector<std::string> quantities;  // particle
  Location at;
  static void keys(Keys<SolidGaugeConfig>& k);
};

/// The columns of its file.
std::vector<std::string> columns(SolidGaugeConfig const& gauge, int dimension);

/// Checks what keys alone cannot.  Errors: scene errors naming the gauge: a name twice (also among `taken`) or unfit
/// for a file, a missing place, a body that does not exist, more rows than a file should have.
void check(std::vector<SolidGaugeConfig> const& gauges, std::vector<std::string> const& taken, Mesh const& mesh,
           Real end_time);

}  // namespace brisance::solid
