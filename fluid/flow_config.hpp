// The scene's [fluid] section.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/keys.hpp"
#include "fluid/diffusion/diffusion_config.hpp"
#include "fluid/flux/sweep.hpp"
#include "fluid/gas/mixture.hpp"
#include "fluid/grid/grid.hpp"
#include "fluid/source/gravity_config.hpp"

namespace brisance::fluid {

/// Energy of TNT by convention, J/kg (theory/fluid.md 1.3).
inline constexpr Real tnt_energy = 4.184e6;

/// Detonation products; the defaults are TNT (Dobratz & Crawford 1985).
struct JwlConfig {
  double a = 371.2e9, b = 3.231e9, r1 = 4.15, r2 = 0.95, omega = 0.30, density = 1630, energy = 7.0e9;
  static void keys(Keys<JwlConfig>& k);
};

struct GasConfig {
  std::string law = "ideal";
  double gamma = 1.4;
  double stiffness = 0;
  double gas_constant = 287.05;
  JwlConfig jwl;
  Location at;
  static void keys(Keys<GasConfig>& k);
};

/// Detonation products beside the gas: the scene then carries their mass and volume fraction (theory/fluid.md 1.4).
struct ProductsConfig {
  std::string law = "jwl";
  JwlConfig jwl;
  Location at;
  static void keys(Keys<ProductsConfig>& k);
};

struct GasState {
  double density = 1.2;
  double pressure = 101325;
  Vec3 velocity{};
  /// The keys of a state, for what is one and holds more.
  template <class T>
  static void declare(Keys<T>& k) {
    k("density", &GasState::density, "kg/m3", "density; 0 is vacuum").at_least(0);
    k("pressure", &GasState::pressure, "Pa", "absolute pressure; 0 is vacuum").at_least(0);
    k("velocity", &GasState::velocity, "m/s", "velocity");
  }
  static void keys(Keys<GasState>& k) { declare(k); }
};

/// How the sweeps of two steps follow each other (time_step.hpp).
enum class Splitting { pair, merged };

struct EulerConfig {
  int order = 5;
  double cfl = 0.8;
  bool hybrid = true;
  double shear_dissipation = 1.3;
  bool smooth = false;
  std::string splitting = "pair";
  Location at;
  static void keys(Keys<EulerConfig>& k) {
    k("order", &EulerConfig::order, "", "order of the OSMP flux").one_of({1, 3, 5, 7, 9, 11});
    k("cfl", &EulerConfig::cfl, "1",
      "Courant number of each sweep; above 0.9 pairs of steps may be rejected and redone")
        .above(0)
        .at_most(0.9);
    k("hybrid", &EulerConfig::hybrid, "",
      "third-order terms of acoustic waves with frozen coefficients in strong expansions (JWL: compressions), which "
      "sharpens blasts; false: everywhere semi-local");
    k("shear_dissipation", &EulerConfig::shear_dissipation, "1",
      "2D and 3D: least speed, in sound speeds, of shear and entropy waves beside shocks that run across a sweep; "
      "keeps "
      "strong shocks along the grid whole; 0: off")
        .at_least(0)
        .at_most(2);
    k("smooth", &EulerConfig::smooth, "",
      "orders 3 to 11: terms that make smooth nonlinear flow third-order accurate when cells hold point values, for a "
      "sixth more work; ideal and stiffened gas; no effect beside shocks and vacuum");
    k("splitting", &EulerConfig::splitting, "",
      "2D and 3D: pair: XY|YX; merged: X/2 Y X Y X/2, a quarter of the splitting error for 5/4 (2D) or 3/2 (3D) of the "
      "sweeps")
        .one_of({"pair", "merged"});
  }
};

/// What stands at the six sides of the grid.
struct BoundaryConfig {
  std::string x_low = "reflecting", x_high = "reflecting", y_low = "reflecting", y_high = "reflecting",
              z_low = "reflecting", z_high = "reflecting";
  Location at;
  std::string const& side(int d, int side) const;
  static void keys(Keys<BoundaryConfig>& k);
};

/// State of an inflow at a time.
struct TimedState {
  double time = 0, density = 0, pressure = 0;
  Vec3 velocity{};
  Location at;
  static void keys(Keys<TimedState>& k);
};

/// A plane that moves along its normal, with a state of its own behind it.
struct FrontConfig {
  Vec3 point{}, normal{};
  double speed = 0, density = 0, pressure = 0;
  Vec3 velocity{};
  Location at;
  static void keys(Keys<FrontConfig>& k);
};

/// What enters: a constant state, a history, or two states separated by a front.
struct InflowState : GasState {
  std::vector<TimedState> history;
  std::optional<FrontConfig> front;
  Location at;
  InflowState() = default;
  InflowState(GasState const& constant) : GasState(constant) {}
  static constexpr char const* meaning = "state that enters through this side";
  static void keys(Keys<InflowState>& k);
};

/// State far outside a far_field side.
struct FarState : GasState {
  Location at;
  FarState() = default;
  FarState(GasState const& state) : GasState(state) {}
  static constexpr char const* meaning = "state far outside this side; not given: the ambient state";
  static void keys(Keys<FarState>& k) { GasState::declare(k); }
};

struct TimedSpeed {
  double time = 0, speed = 0;
  Location at;
  static void keys(Keys<TimedSpeed>& k);
};

/// A wall that moves along its normal by less than a cell.
struct WallMotion {
  double speed = 0;
  std::vector<TimedSpeed> history;
  Location at;
  static constexpr char const* meaning = "motion of the wall at this side";
  static void keys(Keys<WallMotion>& k);
};

constexpr char const* side_names[6] = {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"};

/// What a law needs to know, side by side.
template <class T>
struct PerSide {
  std::optional<T> x_low, x_high, y_low, y_high, z_low, z_high;
  std::optional<T> const& side(int d, int side) const {
    std::optional<T> const* const all[6] = {&x_low, &x_high, &y_low, &y_high, &z_low, &z_high};
    return *all[2 * d + side];
  }
  static void keys(Keys<PerSide>& k) {
    std::optional<T> PerSide::*const members[6] = {&PerSide::x_low,  &PerSide::x_high, &PerSide::y_low,
                                                   &PerSide::y_high, &PerSide::z_low,  &PerSide::z_high};
    for (int s = 0; s < 6; ++s) k(side_names[s], members[s], "", T::meaning);
  }
};
using InflowConfig = PerSide<InflowState>;
using FarFieldConfig = PerSide<FarState>;
using MovingWallConfig = PerSide<WallMotion>;

/// A part of a side with a law of its own, such as a nozzle; later patches overwrite earlier ones.
struct PatchConfig {
  std::string side, law = "inflow", shape = "box";
  std::optional<Vec3> low, high, centre;
  std::optional<double> radius;
  std::optional<InflowState> inflow;
  std::optional<FarState> far_field;
  std::optional<WallMotion> moving_wall;
  Location at;
  static void keys(Keys<PatchConfig>& k);
};

/// A part of the domain with its own initial state; later regions overwrite earlier ones.
struct RegionConfig {
  std::string shape = "box";
  std::optional<Vec3> low, high, centre, point, normal;
  std::optional<double> radius;
  double density = 0, pressure = 0;
  Vec3 velocity{};
  std::string cells = "exact";
  Location at;
  static void keys(Keys<RegionConfig>& k);
};

/// An explosive charge at rest, of which the mass and the energy are two figures (theory/fluid.md 1.3): a balloon of
/// hot gas, or detonation products with an equation of state of their own. The grid is 1 m deep in absent directions:
/// in 2D both are per metre of depth, in 1D per square metre.
struct ChargeConfig {
  std::string model = "balloon", tnt = "mass";
  std::string shape = "ball";
  Vec3 centre{};
  std::optional<double> radius, length;
  std::optional<Vec3> size;
  std::string axis = "z";
  std::optional<double> mass, energy, tnt_factor;  ///< two of them say how much; tnt_factor not given: 1
  std::optional<double> density, pressure;
  Location at;
  static void keys(Keys<ChargeConfig>& k);
};

struct FlowConfig {
  Vec3 low{}, high{};
  std::vector<int> cells;
  std::optional<int> block;
  bool sleep = true;
  GasConfig gas;
  GasState ambient;
  std::optional<EulerConfig> euler;
  std::optional<ViscosityConfig> viscosity;
  std::optional<GravityConfig> gravity;
  BoundaryConfig boundary;
  InflowConfig inflow;
  WallsConfig wall;
  FarFieldConfig far_field;
  MovingWallConfig moving_wall;
  std::vector<PatchConfig> patch;
  std::vector<RegionConfig> region;
  std::vector<ChargeConfig> charge;
  std::optional<ProductsConfig> products;
  Location at;

  int order() const { return euler ? euler->order : 1; }
  Splitting splitting() const { return euler && euler->splitting == "merged" ? Splitting::merged : Splitting::pair; }
  SweepOptions options() const {
    return euler ? SweepOptions{euler->hybrid, euler->shear_dissipation, euler->smooth} : SweepOptions{};
  }
  static void keys(Keys<FlowConfig>& k);
};

/// Number of directions with more than one cell; trailing ones in `cells` are absent directions.
int dimension(FlowConfig const& config);

/// The grid and its blocks.  Errors: those of check(), an empty box, sides that disagree about periodicity, too few
/// cells.
Grid make_grid(FlowConfig const& config);

/// The gas with its vacuum thresholds, relative to the ambient state or, where that is vacuum, to the largest initial
/// values. Source: theory/fluid.md 1.5.
Gas make_gas(FlowConfig const& config);

/// Products and gas of a scene that has [fluid.products].
std::optional<Mixture> make_mixture(FlowConfig const& config);
/// Mass of products in a charge of model `jwl`, kg (2D: per metre): the stated mass, or that which holds the stated
/// energy, given as such or by a mass of TNT. Source: theory/fluid.md 1.3.
Real products_mass(ChargeConfig const& charge, JwlConfig const& jwl);

/// Checks what keys alone cannot: shapes have their dimensions, charges are determined, inflow sides have a state.
/// Errors: scene errors with the place in the scene.
void check(FlowConfig const& config);

}  // namespace brisance::fluid
