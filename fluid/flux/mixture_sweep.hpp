// One OSMP sweep of products and ambient gas: sweep.hpp with seven fields.
#pragma once
#include "fluid/flux/sweep.hpp"
#include "fluid/gas/mixture.hpp"

namespace brisance::fluid {

/// A block, or any strided box of cells: pointers at local cell (0,0,0); components as in MixtureState.
struct MixtureBox {
  std::array<Real*, 7> u;
  std::array<Index, 3> size;
  std::array<std::ptrdiff_t, 3> stride;
  /// Marks of the shock sensor, as CellBox::marks.
  std::uint8_t const* marks = nullptr;
  std::array<std::ptrdiff_t, 3> mark_stride{};
};

/// As SweepReport, with the products that crossed the ends (mass per area and time).
struct MixtureReport : SweepReport {
  Real products_low = 0, products_high = 0;
};

/// In place: cell means at t -> after the sweep along `direction`. Ghosts of that direction must be filled. Density,
/// momentum, energy and the mass of products are conserved to rounding; the volume fraction is carried along. `hybrid`
/// acts beside shocks in products only (fluid/README.md).
/// Units: sigma = dt/h in s/m.  Errors: raises health bits, never throws.  Source: theory/fluid.md 1.4, 2-4.
MixtureReport sweep_mixture(int order, MixtureBox const& box, int direction, Real sigma, Mixture const& mixture,
                            SweepOptions const& options = {});

}  // namespace brisance::fluid
