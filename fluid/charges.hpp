// Explosive charges at rest, balloons of hot gas or detonation products, exact in mass and energy over the fluid
// volumes they fill.
#pragma once
#include <string>
#include <vector>

#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"

namespace brisance::fluid {

/// (1 - share) outside + share inside; exactly `inside` for a share of 1.
State mixed(State const& outside, State const& inside, Real share);

/// What a charge is on the grid. Mass and energy are per metre of depth in 2D, per square metre in 1D.
struct ChargeReport {
  std::string name;
  Real mass = 0;      ///< kg, of the gas in it
  Real energy = 0;    ///< J, above the ambient gas in its place
  Real tnt_mass = 0;  ///< kg of TNT with this energy, at 4.184 MJ/kg; another figure than the mass
  std::string shape;
  Real radius = 0;        ///< m: of the ball or cylinder; half the smallest length of a box
  Real cells_across = 0;  ///< the smallest extent in cells
  Real density = 0, pressure = 0;
  Real sound_speed = 0;  ///< m/s
};

/// Below this many cells across (a radius of 4) the first shock is smeared over much of the charge.
constexpr Real fewest_cells_across = 8;

/// Collective. What fill() makes of the charges of the scene, without doing it.  Source: theory/fluid.md 1.3.
/// Errors: scene error for a charge without fluid volume, or with a state that the gas does not have.
std::vector<ChargeReport> measure_charges(Flow& flow, FlowConfig const& config, FluidVolume const& volume);

/// Collective. Stores the charges over the present state.
void add_charges(Flow& flow, FlowConfig const& config, FluidVolume const& volume);

/// One line: both mass and energy, TNT equivalent by energy, extent, cells across.
std::string describe(ChargeReport const& report, int dimension);
/// A warning for people, empty when there is none: too few cells across.
std::string warning(ChargeReport const& report);

}  // namespace brisance::fluid
