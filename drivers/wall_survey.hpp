// The cut cells of the bodies in their initial positions: how many, what they will cost, and where walls are too thin.
#pragma once
#include <string>
#include <vector>

#include "core/solid/mesh.hpp"
#include "core/solid/surface.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::drivers {

struct WallSurvey {
  std::vector<Index> cells;        ///< cut cells of each block
  std::vector<std::int64_t> work;  ///< what they cost, in plain cells
  std::string thin;                ///< a warning for people: cells that thin walls do not divide; empty: none
};

/// Errors: scene or numerical error when the surface is not closed, or is inside out.
WallSurvey survey_walls(fluid::Grid const& grid, solid::Mesh const& mesh, solid::Surface const& surface);

}  // namespace brisance::drivers
