// The scene's keys of viscosity, heat conduction and the walls that feel them.
#pragma once
#include <optional>
#include <string>

#include "core/base/keys.hpp"

namespace brisance::fluid {

/// Defaults: air.  Source: theory/fluid.md 5.1, 5.2.
struct ViscosityConfig {
  std::string law = "sutherland";
  double dynamic_viscosity = 1.716e-5;    // Pa s
  double reference_temperature = 273.15;  // K
  double sutherland_temperature = 110.4;  // K
  double prandtl = 0.72;
  std::string time = "strang";
  int max_substeps = 50;
  Location at;
  static void keys(Keys<ViscosityConfig>& k);
};

/// How a reflecting side of the grid meets a viscous gas. Without an entry the side is a symmetry plane.
struct WallConfig {
  bool slip = false;
  std::optional<double> temperature;  // K; not given: adiabatic
  Vec3 velocity{};                    // m/s, in the plane of the wall
  Location at;
  static void keys(Keys<WallConfig>& k);
};

/// The walls at the six sides of the grid.
struct WallsConfig {
  std::optional<WallConfig> x_low, x_high, y_low, y_high, z_low, z_high;
  std::optional<WallConfig> const& side(int d, int side) const;
  static void keys(Keys<WallsConfig>& k);
};

struct FlowConfig;

/// Checks what keys alone cannot.  Errors: scene errors with the place in the scene.
void check_diffusion(FlowConfig const& config);

}  // namespace brisance::fluid
