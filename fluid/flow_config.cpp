#include "fluid/flow_config.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "fluid/boundary/boundary_config.hpp"
#include "fluid/boundary/products.hpp"
#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {
namespace {

constexpr char axis_names[] = "xyz";

std::string place(Location const& at, std::string const& what) {
  std::string const where = at.text();
  return where.empty() ? what : where + ": " + what;
}

void demand(bool ok, Location const& at, std::string const& message) {
  if (!ok) throw Error(Failure::scene, place(at, message));
}

void check_region(RegionConfig const& region, std::string const& name) {
  if (region.shape == "box")
    demand(region.low && region.high, region.at, name + ": a box needs `low` and `high`.");
  else if (region.shape == "ball")
    demand(region.centre && region.radius, region.at, name + ": a ball needs `centre` and `radius`.");
  else
    demand(
        region.point && region.normal && norm2(*region.normal) > 0, region.at,
        name +
            ": a half_space needs `point` and a `normal` that is not zero (it fills the side the normal points to).");
}

void check_jwl_charge(ChargeConfig const& charge, std::string const& name, FlowConfig const& config) {
  auto const check = [&](bool ok, char const* message) { demand(ok, charge.at, name + ": " + message); };
  check(config.products.has_value(),
        "model = \"jwl\" needs the equation of state of its products: add products = { law = \"jwl\" } to [fluid].");
  check(
      charge.shape == "ball" && !charge.radius && !charge.size && !charge.length && !charge.density && !charge.pressure,
      "a charge of model `jwl` is a ball of the density and energy of fluid.products, whose radius follows from how "
      "much it is: leave its extent and gas state out.");
  if (charge.tnt == "mass")
    check(charge.mass && !charge.energy && !charge.tnt_factor,
          "tnt = \"mass\" takes the `mass` of explosive and nothing else; for an energy in terms of TNT set "
          "tnt = \"energy\".");
  else
    check(charge.mass.has_value() != charge.energy.has_value() && !(charge.energy && charge.tnt_factor),
          "tnt = \"energy\" takes either `energy`, or the `mass` of TNT that holds it, which tnt_factor scales.");
}

void check_charge(ChargeConfig const& charge, int dimension, std::string const& name, FlowConfig const& config) {
  if (charge.model == "jwl") return check_jwl_charge(charge, name, config);
  auto const check = [&](bool ok, char const* message) { demand(ok, charge.at, name + ": " + message); };
  check(charge.tnt == "mass", "`tnt` chooses what a charge of model `jwl` keeps; a balloon has `mass` and `energy`.");
  bool const ball = charge.shape == "ball", box = charge.shape == "box", cylinder = charge.shape == "cylinder";
  check(!cylinder || dimension == 3,
        "a cylinder needs three dimensions; in 2D, a ball is one along z, a box one across.");
  check(!box || (charge.size && !charge.radius && !charge.length), "a box has its lengths as `size`, nothing else.");
  if (box)
    for (int d = 0; d < dimension; ++d) check((*charge.size)[d] > 0, "every length in `size` must be above 0.");
  check(!cylinder || (charge.radius && charge.length && !charge.size), "a cylinder has `radius`, `length` and `axis`.");
  check(!ball || (!charge.size && !charge.length), "a ball has a `radius`, or a `density` from which it follows.");
  check(!(charge.mass && charge.energy && charge.tnt_factor),
        "`mass`, `energy` and `tnt_factor` overdetermine it: energy = 4.184 MJ/kg x tnt_factor x mass; leave one out.");
  if (charge.mass || charge.energy) {
    check(!charge.pressure, "its pressure follows from its energy: leave `pressure` out.");
    check(ball ? charge.radius.has_value() != charge.density.has_value() : !charge.density,
          ball ? "give one of `radius` and `density`; the other follows from the mass."
               : "its density follows from its mass and shape: leave `density` out.");
  } else {
    check(charge.density && charge.pressure && (!ball || charge.radius) && !charge.tnt_factor,
          "give either how much it is, by `mass` (kg of explosive) or `energy` (J) or both, or the gas state `density` "
          "and `pressure` with the extent.");
  }
}

}  // namespace

void JwlConfig::keys(Keys<JwlConfig>& k) {
  k("a", &JwlConfig::a, "Pa", "A").at_least(0);
  k("b", &JwlConfig::b, "Pa", "B").at_least(0);
  k("r1", &JwlConfig::r1, "1", "R1").above(0);
  k("r2", &JwlConfig::r2, "1", "R2").above(0);
  k("omega", &JwlConfig::omega, "1", "omega, the Grueneisen coefficient").above(0);
  k("density", &JwlConfig::density, "kg/m3", "density of the explosive, rho0").above(0);
  k("energy", &JwlConfig::energy, "Pa", "energy of detonation per volume of explosive, E0 (J/m3 = Pa)").above(0);
}

void GasConfig::keys(Keys<GasConfig>& k) {
  k("law", &GasConfig::law, "", "equation of state").one_of({"ideal", "stiffened", "jwl"});
  k("gamma", &GasConfig::gamma, "1", "ideal, stiffened: ratio of specific heats (water 4.4)").above(1);
  k("stiffness", &GasConfig::stiffness, "Pa", "stiffened: p_inf (water 600 MPa)").at_least(0);
  k("gas_constant", &GasConfig::gas_constant, "J/kg/K", "ideal: specific gas constant, for temperatures").above(0);
  k("jwl", &GasConfig::jwl, "", "jwl: parameters of the detonation products; not given: TNT");
}

void RegionConfig::keys(Keys<RegionConfig>& k) {
  k("shape", &RegionConfig::shape, "", "form of the region").one_of({"box", "ball", "half_space"});
  k("low", &RegionConfig::low, "m", "box: its low corner");
  k("high", &RegionConfig::high, "m", "box: its high corner");
  k("centre", &RegionConfig::centre, "m", "ball: its centre");
  k("radius", &RegionConfig::radius, "m", "ball: its radius").above(0);
  k("point", &RegionConfig::point, "m", "half_space: a point of its plane");
  k("normal", &RegionConfig::normal, "1", "half_space: direction in which it extends");
  k("density", &RegionConfig::density, "kg/m3", "initial density").required().at_least(0);
  k("pressure", &RegionConfig::pressure, "Pa", "initial pressure").required().at_least(0);
  k("velocity", &RegionConfig::velocity, "m/s", "initial velocity");
  k("cells", &RegionConfig::cells, "", "exact: cell means by covered volume; whole: cells whose centre is inside")
      .one_of({"exact", "whole"});
}

void ChargeConfig::keys(Keys<ChargeConfig>& k) {
  k("model", &ChargeConfig::model, "",
    "balloon: hot gas of the surroundings' law; jwl: detonation products as fluid.products describes them")
      .one_of({"balloon", "jwl"});
  k("tnt", &ChargeConfig::tnt, "",
    "jwl: keep the stated mass of explosive, or the stated energy: `energy`, or `mass` of TNT x 4.184 MJ/kg x "
    "tnt_factor")
      .one_of({"mass", "energy"});
  k("shape", &ChargeConfig::shape, "", "form of the balloon; cylinder: in 3D").one_of({"ball", "box", "cylinder"});
  k("centre", &ChargeConfig::centre, "m", "centre of the balloon").required();
  k("radius", &ChargeConfig::radius, "m", "ball, cylinder: its radius").above(0);
  k("length", &ChargeConfig::length, "m", "cylinder: its length").above(0);
  k("axis", &ChargeConfig::axis, "", "cylinder: direction of its axis").one_of({"x", "y", "z"});
  k("size", &ChargeConfig::size, "m", "box: its lengths along x, y, z");
  k("mass", &ChargeConfig::mass, "kg",
    "mass of explosive, all of it inside the domain (2D: per metre of depth, 1D: per square metre)")
      .above(0);
  k("energy", &ChargeConfig::energy, "J",
    "energy it releases; not given: 4.184 MJ/kg x tnt_factor x mass. Given without mass, the mass follows likewise")
      .above(0);
  k("tnt_factor", &ChargeConfig::tnt_factor, "1",
    "energy relative to TNT of the same mass; not given: 1, or what mass and energy say")
      .above(0);
  k("density", &ChargeConfig::density, "kg/m3",
    "density of the balloon: in place of a ball's radius, or of its gas state")
      .above(0);
  k("pressure", &ChargeConfig::pressure, "Pa", "pressure, for a charge given by its gas state").above(0);
}

void ProductsConfig::keys(Keys<ProductsConfig>& k) {
  k("law", &ProductsConfig::law, "", "equation of state of the detonation products").one_of({"jwl"});
  k("jwl", &ProductsConfig::jwl, "", "parameters of the explosive; not given: TNT");
}

void FlowConfig::keys(Keys<FlowConfig>& k) {
  k("low", &FlowConfig::low, "m", "low corner of the grid");
  k("high", &FlowConfig::high, "m", "high corner of the grid").required();
  k("cells", &FlowConfig::cells, "", "cells along each direction; their number is the dimension")
      .required()
      .at_least(1);
  k("block", &FlowConfig::block, "",
    "largest side of a block in cells; not given: 48 in 3D, 64 in 2D, in 1D a sixteenth of the line within 64 to 4096")
      .at_least(1);
  k("sleep", &FlowConfig::sleep, "",
    "blocks whose cells and ends hold one and the same state are not swept; the bits are the same without");
  k("gas", &FlowConfig::gas, "", "the gas");
  k("ambient", &FlowConfig::ambient, "", "initial state outside all regions and charges");
  k("euler", &FlowConfig::euler, "", "motion of the gas by the OSMP scheme");
  k("viscosity", &FlowConfig::viscosity, "", "viscous stress and heat conduction of an ideal gas");
  k("gravity", &FlowConfig::gravity, "", "a constant acceleration of the gas");
  k("boundary", &FlowConfig::boundary, "", "sides of the grid");
  k("inflow", &FlowConfig::inflow, "", "states of the inflow sides");
  k("wall", &FlowConfig::wall, "", "viscosity: friction, heat and motion of the reflecting sides");
  k("far_field", &FlowConfig::far_field, "", "states outside the far_field sides");
  k("moving_wall", &FlowConfig::moving_wall, "", "motion of the moving_wall sides");
  k("patch", &FlowConfig::patch, "", "parts of sides with a law of their own; later ones overwrite earlier ones");
  k("region", &FlowConfig::region, "", "regions with their own initial state; later ones overwrite earlier ones");
  k("charge", &FlowConfig::charge, "", "explosive charges");
  k("products", &FlowConfig::products, "",
    "detonation products as a substance of their own beside the gas: two more fields per cell");
}

int dimension(FlowConfig const& config) {
  int n = static_cast<int>(config.cells.size());
  demand(n >= 1 && n <= 3, config.at, "fluid.cells: give one, two or three numbers of cells.");
  while (n > 1 && config.cells[static_cast<std::size_t>(n) - 1] == 1) --n;
  return n;
}

namespace {

/// Small enough to stay in cache, large against the stencil. In 1D the kernel cuts a line into one part per lane, each
/// with ghosts of its own: long blocks pay, while short lines keep several blocks for several ranks.
Index default_block(Grid const& grid) {
  if (grid.dimension == 3) return 48;
  return grid.dimension == 2 ? 64 : std::clamp<Index>(grid.cells[0] / 16, 64, 4096);
}

}  // namespace

Grid make_grid(FlowConfig const& config) {
  check(config);
  Grid grid;
  grid.dimension = dimension(config);
  grid.low = {0, 0, 0};
  for (int d = 0; d < grid.dimension; ++d) {
    std::size_t const s = static_cast<std::size_t>(d);
    Real const length = config.high[d] - config.low[d];
    demand(length > 0, config.at,
           std::string("fluid: the grid has no extent along ") + axis_names[d] + ": `high` must exceed `low`.");
    grid.cells[s] = config.cells[s];
    grid.low[d] = config.low[d];
    grid.spacing[d] = length / config.cells[s];
    bool const low = config.boundary.side(d, 0) == "periodic", high = config.boundary.side(d, 1) == "periodic";
    demand(low == high, config.boundary.at,
           std::string("fluid.boundary: ") + side_names[2 * d] + " and " + side_names[2 * d + 1] +
               " must both be periodic, or neither.");
    grid.periodic[s] = low;
  }
  Index const block = config.block.value_or(default_block(grid));
  try {
    divide(grid, block, ghost_depth(config.order()));
  } catch (Error const& e) {
    throw Error(e.kind(), place(config.at, e.what()));
  }
  check_patches(config, grid);
  return grid;
}

Gas make_gas(FlowConfig const& config) {
  Real density = config.ambient.density, pressure = config.ambient.pressure;
  if (!(density > 0) || !(pressure > 0)) {
    density = pressure = 0;
    auto const include = [&](Real rho, Real p) { density = max(density, rho), pressure = max(pressure, p); };
    for (RegionConfig const& region : config.region) include(region.density, region.pressure);
    for (ChargeConfig const& charge : config.charge) include(charge.density.value_or(0), charge.pressure.value_or(0));
  }
  Gas gas;
  gas.gamma = config.gas.gamma;
  gas.gas_constant = config.gas.gas_constant;
  if (config.gas.law == "stiffened") gas.curve.stiffness = config.gas.stiffness;
  if (config.gas.law == "jwl") {
    JwlConfig const& jwl = config.gas.jwl;
    gas.gamma = 1 + jwl.omega;
    gas.curve = {0, jwl.a, jwl.b, jwl.r1, jwl.r2, jwl.density};
  }
  gas.vacuum_density = 1e-10 * density;
  gas.vacuum_energy = 1e-12 * (pressure + gas.curve.stiffness) / gas.kappa();
  return gas;
}

std::optional<Mixture> make_mixture(FlowConfig const& config) {
  if (!config.products) return std::nullopt;
  JwlConfig const& jwl = config.products->jwl;
  Mixture mixture;
  mixture.ambient = make_gas(config);
  mixture.products.gamma = 1 + jwl.omega;
  mixture.products.curve = {0, jwl.a, jwl.b, jwl.r1, jwl.r2, jwl.density};
  return mixture;
}

Real products_mass(ChargeConfig const& charge, JwlConfig const& jwl) {
  if (charge.tnt == "mass") return *charge.mass;
  Real const energy = charge.energy ? *charge.energy : *charge.mass * charge.tnt_factor.value_or(1) * tnt_energy;
  return energy / (jwl.energy / jwl.density);
}

namespace {

/// What a scene with products asks of the rest of [fluid].
void check_products(FlowConfig const& config) {
  Location const& at = config.products->at;
  demand(config.gas.law == "ideal", at,
         "fluid.products: the gas beside the products must be ideal, but fluid.gas.law is " + config.gas.law +
             "; products in water lose their internal energy so far.");
  demand(!config.viscosity, at, "fluid.products: the viscous terms are those of one gas; leave [fluid.viscosity] out.");
  demand(config.ambient.density > 0, at, "fluid.products: the ambient state is vacuum; give the gas there a density.");
  for (int d = 0; d < dimension(config); ++d)
    for (int side = 0; side < 2; ++side)
      demand(carries_products(config.boundary.side(d, side)), config.boundary.at,
             std::string("fluid.boundary.") + side_names[2 * d + side] + ": `" + config.boundary.side(d, side) +
                 "` does not know products; use reflecting, moving_wall, outflow, inflow or periodic.");
  if (!config.patch.empty())
    demand(false, config.patch[0].at, "fluid.patch: parts of sides do not know products; give whole sides.");
  JwlConfig const& jwl = config.products->jwl;
  Real const least = make_mixture(config)->products.reference_energy(jwl.density);
  demand(jwl.energy > least, at,
         "fluid.products.jwl: an energy of " + std::to_string(jwl.energy) +
             " J/m3 is below the reference curve at the " + "density of the explosive; it must exceed " +
             std::to_string(least) + " J/m3.");
}

/// States off the admissible set of the equation of state (theory/fluid.md 1.2).
void check_states(FlowConfig const& config) {
  Gas const gas = make_gas(config);
  auto const check_state = [&](Location const& at, std::string const& name, Real density, Real pressure) {
    if (!(density > 0) || gas.curve.zero()) return;
    Real const least = gas.reference_pressure(density);
    demand(pressure > least, at,
           name + ": a pressure of " + std::to_string(pressure) + " Pa is below the reference curve of the " +
               config.gas.law + " law at this density; it must exceed " + std::to_string(least) + " Pa.");
  };
  check_state(config.at, "fluid.ambient", config.ambient.density, config.ambient.pressure);
  for (std::size_t r = 0; r < config.region.size(); ++r)
    check_state(config.region[r].at, "fluid.region[" + std::to_string(r) + "]", config.region[r].density,
                config.region[r].pressure);
  for (std::size_t c = 0; c < config.charge.size(); ++c)
    if (ChargeConfig const& charge = config.charge[c]; charge.density && charge.pressure)
      check_state(charge.at, "fluid.charge[" + std::to_string(c) + "]", *charge.density, *charge.pressure);
}

}  // namespace

void check(FlowConfig const& config) {
  int const n = dimension(config);
  for (int d = n; d < 3; ++d)
    demand(config.low[d] == 0 && config.high[d] == 0, config.at,
           std::string("fluid: there are no cells along ") + axis_names[d] +
               ", so low and high must not give it an extent (a "
               "2D grid is 1 m deep).");
  check_sides(config);
  for (std::size_t r = 0; r < config.region.size(); ++r)
    check_region(config.region[r], "fluid.region[" + std::to_string(r) + "]");
  for (std::size_t c = 0; c < config.charge.size(); ++c)
    check_charge(config.charge[c], n, "fluid.charge[" + std::to_string(c) + "]", config);
  if (config.products) check_products(config);
  demand(!(config.euler && config.euler->smooth && (config.gas.law == "jwl" || config.products)),
         config.euler ? config.euler->at : config.at,
         "fluid.euler.smooth: the terms of smooth flow are those of ideal and stiffened gas, not of the jwl law and of "
         "products; set it to false.");
  check_states(config);
  check_diffusion(config);
  require(!config.gravity || config.euler, config.gravity ? config.gravity->at : config.at,
          "fluid.gravity needs the effect fluid.euler: add euler = {} to [fluid].");
}

}  // namespace brisance::fluid
