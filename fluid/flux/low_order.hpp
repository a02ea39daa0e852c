// The positive flux of one face, for the occasional faces no pencil runs through (between two solid cells).
#pragma once
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// Low-order flux between two cells in real coordinates, per unit area: HLLE; LLF where sigma(|u|+c) exceeds 0.905
/// (0.8 above gamma = 5/3, 0.5 above 3) in one of them or where one is vacuum, whose analytic flux is zero in all
/// components. Source: theory/fluid.md 4.1, 4.3. Units: sigma = dt/h in s/m.
State low_order_flux(State const& left, State const& right, int direction, Real sigma, Gas const& gas);

}  // namespace brisance::fluid
