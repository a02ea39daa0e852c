// Sums, extremes and digest of the cells, the same on any number of ranks.
#pragma once
#include <functional>

#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"
#include "parallel/digest.hpp"

namespace brisance::fluid {

/// Contents of the domain: kg, kg m/s, J (2D: per metre of depth).
struct Totals {
  Real mass = 0;
  Vec3 momentum{};
  Real energy = 0;
  Real momentum_size = 0;  ///< sum of the sizes of the cells' momenta
  Real products = 0;       ///< of the mass: detonation products
};
/// The part of this rank: each block summed in a fixed order, the blocks exactly.
struct LocalTotals {
  parallel::ExactSum mass;
  std::array<parallel::ExactSum, 3> momentum;
  parallel::ExactSum energy, momentum_size, products;
};
LocalTotals local_totals(Flow const& flow, FluidVolume const& volume = {});
/// Collective.
Totals totals(Flow const& flow, FluidVolume const& volume = {});

/// Extremes over the cells of this rank that hold gas; mach 0 and the others infinite where none does.
struct Extremes {
  Real density_min, pressure_min, mach_max;
};
Extremes extremes(Flow const& flow, FluidVolume const& volume = {});

/// Kind of a cell in the state digest.
constexpr std::uint32_t cell_kind = 1;
/// Adds the cells of this rank that hold fluid: their means and fluid volume. Not collective.
void add_cells(parallel::Digest& digest, Flow const& flow, FluidVolume const& volume = {});

}  // namespace brisance::fluid
