#include "fluid/diffusion/diffusion_config.hpp"

#include "core/base/errors.hpp"
#include "fluid/flow_config.hpp"

namespace brisance::fluid {
namespace {

void check_wall(FlowConfig const& config, int d, int side) {
  WallConfig const& wall = *config.wall.side(d, side);
  std::string const name = side_names[2 * d + side], key = "fluid.wall." + name;
  require(config.viscosity.has_value(), wall.at,
          key +
              " needs the effect fluid.viscosity: without it every reflecting side lets the gas slip. Add viscosity = "
              "{} to [fluid], or leave the wall out.");
  require(d < dimension(config), wall.at, key + ": the grid has no cells along " + "xyz"[d] + ".");
  require(config.boundary.side(d, side) == "reflecting", wall.at,
          key + " describes a wall, but fluid.boundary." + name + " is \"" + config.boundary.side(d, side) +
              "\": only reflecting sides are walls.");
  require(wall.velocity[d] == 0, wall.at,
          key + ".velocity: the wall may move in its own plane only; set its component along " + "xyz"[d] + " to 0.");
  require(!wall.slip || norm2(wall.velocity) == 0, wall.at,
          key + ": a wall that lets the gas slip does not carry it along; leave out `velocity` or `slip`.");
}

}  // namespace

void ViscosityConfig::keys(Keys<ViscosityConfig>& k) {
  using C = ViscosityConfig;
  k("law", &C::law, "", "constant, or growing with temperature by Sutherland's law").one_of({"constant", "sutherland"});
  k("dynamic_viscosity", &C::dynamic_viscosity, "Pa s", "constant: the viscosity; sutherland: at reference_temperature")
      .above(0);
  k("reference_temperature", &C::reference_temperature, "K", "sutherland: T_0").above(0);
  k("sutherland_temperature", &C::sutherland_temperature, "K", "sutherland: S").at_least(0);
  k("prandtl", &C::prandtl, "1", "Prandtl number mu c_p / kappa: gives the heat conductivity").above(0);
  k("time", &C::time, "",
    "strang: a Heun half step before and one after the sweeps, second order; lie: one Euler step after them, a quarter "
    "of the cost, first order")
      .one_of({"strang", "lie"});
  k("max_substeps", &C::max_substeps, "", "viscous steps within one step of the gas before they limit it").at_least(1);
}

void WallConfig::keys(Keys<WallConfig>& k) {
  k("slip", &WallConfig::slip, "", "does the gas slide along the wall?");
  k("temperature", &WallConfig::temperature, "K", "of an isothermal wall; not given: no heat passes").above(0);
  k("velocity", &WallConfig::velocity, "m/s", "of the wall in its own plane");
}

std::optional<WallConfig> const& WallsConfig::side(int d, int side) const {
  std::optional<WallConfig> const* const all[6] = {&x_low, &x_high, &y_low, &y_high, &z_low, &z_high};
  return *all[2 * d + side];
}

void WallsConfig::keys(Keys<WallsConfig>& k) {
  std::optional<WallConfig> WallsConfig::*const members[6] = {&WallsConfig::x_low, &WallsConfig::x_high,
                                                              &WallsConfig::y_low, &WallsConfig::y_high,
                                                              &WallsConfig::z_low, &WallsConfig::z_high};
  for (int s = 0; s < 6; ++s) k(side_names[s], members[s], "", "wall at this side; not given: a symmetry plane");
}

void check_diffusion(FlowConfig const& config) {
  if (config.viscosity) {
    require(config.euler.has_value(), config.viscosity->at,
            "fluid.viscosity needs the effect fluid.euler: add euler = {} to [fluid].");
    require(config.gas.law == "ideal", config.viscosity->at,
            "fluid.viscosity needs temperatures, which only an ideal gas has here; fluid.gas.law is \"" +
                config.gas.law + "\".");
  }
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side)
      if (config.wall.side(d, side)) check_wall(config, d, side);
}

}  // namespace brisance::fluid
