// Initial states: regions as cell means, charges exact in mass and energy.
#pragma once
#include <functional>

#include "fluid/flow.hpp"
#include "fluid/totals.hpp"

namespace brisance::fluid {

/// Collective. Ambient state, regions in their order, then charges. `volume`: fluid volume of the cells (empty: uncut);
/// the masses and energies of charges are exact over these volumes.  Source: theory/fluid.md 1.3. Errors: scene error
/// for a charge without any fluid volume.
void fill(Flow& flow, FlowConfig const& config, FluidVolume const& volume = {});

/// Sets every owned cell to what `state` gives for it.
void fill(Flow& flow, std::function<State(CellIndex)> const& state);

}  // namespace brisance::fluid
