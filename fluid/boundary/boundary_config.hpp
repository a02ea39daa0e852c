// Checks of the sides of the grid that keys alone cannot make.
#pragma once
#include "fluid/flow_config.hpp"

namespace brisance::fluid {

/// Every law has what it needs, times ascend, states are admissible.  Errors: scene errors with the place in the scene.
void check_sides(FlowConfig const& config);

/// Every patch lies on a side that can have one and holds faces of it.  Errors: as above.
void check_patches(FlowConfig const& config, Grid const& grid);

/// Moving walls stay within their first cell until `end`, s (theory/fluid.md 6).  Errors: as above.
void check_walls(FlowConfig const& config, Grid const& grid, Real end);

/// Does the patch take the face of this side beside cell `c`? By the centre of the face; the extent of the shape along
/// the normal of the side does not count.
bool covers(PatchConfig const& patch, Grid const& grid, int direction, CellIndex c);

/// Place of a side's name in `side_names`.
int side_index(std::string const& name);

}  // namespace brisance::fluid
