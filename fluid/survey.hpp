// One look at all cells of a block: what the time step limit, the audit and the summary want to know of it.
#pragma once
#include <array>
#include <limits>

#include "fluid/gas/gas.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::fluid {

/// Of whole cells, ghosts not included. Sums are made in a fixed order: lane by lane along rows, rows by planes.
struct Survey {
  std::array<Real, 3> speed{};                                ///< largest |u_d| + c of gas, m/s; vacuum has none
  Real density_min = std::numeric_limits<Real>::infinity();   ///< of gas, kg/m3
  Real pressure_min = std::numeric_limits<Real>::infinity();  ///< of gas, Pa
  Real mach_max = 0;                                          ///< of gas
  State sum{};                                                ///< of the states of all cells
  Real momentum_size = 0;                                     ///< sum of |momentum|, per volume
  Real products = 0;                                          ///< sum of the mass of products, per volume
};

/// Cost: one read of the block; 1 to 3 ns a cell.
Survey survey(Block const& block, Gas const& gas);

/// The same of a block with detonation products.
Survey survey_mixture(Block const& block, Mixture const& mixture);

/// |u_d| + c of one cell, m/s; 0 in vacuum.
std::array<Real, 3> signal_speeds(State const& u, Gas const& gas);

}  // namespace brisance::fluid
