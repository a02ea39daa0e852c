// Which spheres of very different sizes meet: grids of cells, one per power of two of the size.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/base/vec3.hpp"

namespace brisance::solid {

struct Sphere {
  Vec3 centre{};
  Real radius = 0;  ///< > 0
};

/// All pairs of places (first < second) whose spheres share a point, sorted.
/// Each sphere sits in one cell of the grid of its own size and looks into 27 cells of every coarser one, so a few
/// large bodies among many fragments do not make the cells coarse.  Cost: about 1 us a sphere and size.
std::vector<std::pair<Index, Index>> meeting_spheres(std::span<Sphere const> spheres);

}  // namespace brisance::solid
