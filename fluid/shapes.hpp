// Parts of grid cells covered by simple shapes. Absent directions of the grid are ignored: a ball in 2D is a disk.
#pragma once
#include "fluid/flow_config.hpp"

namespace brisance::fluid {

/// Share of cell c inside a box (exact).
Real covered_by_box(Grid const& grid, CellIndex c, Vec3 const& low, Vec3 const& high);
/// Share of cell c inside a ball: `samples` points per direction in cells that its surface may cross.
Real covered_by_ball(Grid const& grid, CellIndex c, Vec3 const& centre, Real radius, int samples);
/// Share of cell c inside a cylinder along `axis`: exact along it, sampled across.
Real covered_by_cylinder(Grid const& grid, CellIndex c, Vec3 const& centre, Real radius, Real length, int axis,
                         int samples);
/// Share of cell c on the side of the plane that `normal` points to: exact for normals along an axis, else sampled.
Real covered_by_half_space(Grid const& grid, CellIndex c, Vec3 const& point, Vec3 const& normal, int samples);

/// Share of cell c that a region covers; 0 or 1 by its centre when the region takes whole cells.
Real covered(RegionConfig const& region, Grid const& grid, CellIndex c);

/// Volume of a ball in this many dimensions (1D: its length, 2D: its area; the grid is 1 m deep), and back.
Real ball_volume(int dimension, Real radius);
Real ball_radius(int dimension, Real volume);

}  // namespace brisance::fluid
