// How much of a cell the walls leave to the fluid, as the coupling tells it.
#pragma once
#include <functional>

#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Fluid volume of an owned cell, m3; 0 in solid cells. An empty function stands for uncut cells.
using FluidVolume = std::function<Real(CellIndex)>;

}  // namespace brisance::fluid
