// The body of a scene that comes from a file.
#pragma once
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// Cells of a body with shape "mesh": the elements of a .msh, or a closed surface filled.
/// Errors: Failure::scene with the place in the scene, then the file and what is wrong in it.
Cells cells_from_file(BodyConfig const& body, int dimension);

}  // namespace brisance::solid
