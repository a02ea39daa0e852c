// The viscous flux of one face whose stencil is not that of a row.
#pragma once
#include "fluid/diffusion/transport.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// The states around a face: its two cells, and for each direction along it the neighbours of both.
struct FaceStates {
  State low{}, high{};
  struct Beside {
    State low_before{}, low_after{}, high_before{}, high_after{};
  };
  std::array<Beside, 3> beside{};  ///< by direction; unused in that of the normal and in absent ones
};

/// Stress on momentum (Pa) and energy flux (W/m2) through a face normal to `direction`, as they are subtracted from the
/// flux along it: the same expression as that of rows of faces.  Source: theory/fluid.md 5.1.
std::array<Real, 4> viscous_flux(Transport const& transport, Grid const& grid, int direction, FaceStates const& states);

/// The same between two states whose neighbours along the face are like themselves.
std::array<Real, 4> viscous_flux(Transport const& transport, Grid const& grid, int direction, State const& low,
                                 State const& high);

}  // namespace brisance::fluid
