// Faces of the cells of a block beyond which another gas stands: what the stencils of viscous terms must not reach
// across (README, thin walls).
#include <algorithm>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/openings.hpp"
#include "coupling/cut_cells/wall_sweeper.hpp"

namespace brisance::coupling {

using fluid::Block;

bool WallSweeper::mirrors_another(CellIndex const& solid, CellIndex const& gas, Block const& block,
                                  WallBlock const& wall) {
  fluid::Grid const& grid = flow_.grid();
  CellIndex const first = block.first();
  MirrorCell m;
  CellIndex image{};
  if (MirrorCell const* known = wall.mirror_at({solid[0] - first[0], solid[1] - first[1], solid[2] - first[2]})) {
    m = *known;
    if (m.place >= 0) image = cell_from_id(grid, wall.images[static_cast<std::size_t>(m.place)]);
  } else {
    std::vector<GlobalId> wanted;
    Index hint = -1;
    m = mirror(look(solid, -1, 0, hint), -1, wanted);
    if (m.place >= 0) image = cell_from_id(grid, wanted.front());
  }
  if (m.place < 0) return false;
  // Beside a wall of some cells the nearest point lies towards the gas that asks.
  if (dot(grid.centre(gas) - grid.centre(solid), m.normal) > 0.3 * smallest_spacing(grid)) return false;
  return !one_gas(gas, image);
}

bool WallSweeper::one_gas(CellIndex const& a, CellIndex const& b) {
  if (reaches(a, b)) return true;
  find_same_side(a, std::span(&b, 1), false);
  return same_side_.holds(b);
}

bool WallSweeper::two_gases(CellIndex const& low, int direction) {
  CellIndex const high = beside(low, direction, 1);
  if (!parted(low, direction)) return false;
  // The face may be closed by the corner of a body as well.
  return record_->parts.find(low) || record_->parts.find(high) || !one_gas(low, high);
}

bool WallSweeper::solid_shows_another(CellIndex const& solid, CellIndex const& gas, int direction, Block const& block,
                                      WallBlock const& wall) {
  fluid::Grid const& grid = flow_.grid();
  if (mirrors_another(solid, gas, block, wall)) return true;
  // The stencil of the face between them holds the neighbours of the solid cell along it.
  for (int d = 0; d < grid.dimension; ++d)
    for (int const by : {-1, 1}) {
      CellIndex const n = beside(solid, d, by);
      if (d == direction || !grid.inside(n)) continue;
      if (record_->solid(n) ? mirrors_another(n, gas, block, wall) : !one_gas(gas, n)) return true;
    }
  return false;
}

void WallSweeper::find_apart(Block const& block, WallBlock& wall) {
  wall.apart.clear();
  fluid::Grid const& grid = flow_.grid();
  CellIndex const first = block.first(), size = block.size();
  CellBox const around = grown(grid, box_of(block), 1), cuts = grown(grid, around, 1);
  std::vector<GlobalId> cells;
  auto const offer = [&](CellIndex c) {
    if (around.holds(c) && grid.inside(c) && !record_->solid(c)) cells.push_back(grid.cell_id(c));
  };
  for (CutCell const& cut : record_->geometry.cells) {
    if (!cuts.holds(cut.cell)) continue;
    offer(cut.cell);
    for (int d = 0; d < grid.dimension; ++d)
      for (int const by : {-1, 1}) offer(beside(cut.cell, d, by));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  Index hint = -1;
  std::vector<GlobalId> unwanted;
  for (GlobalId const id : cells) {
    CellIndex const c = cell_from_id(grid, id);
    CellIndex const local{c[0] - first[0], c[1] - first[1], c[2] - first[2]};
    int beyond = 0;  // sides of the block
    for (std::size_t d = 0; d < 3; ++d) beyond += local[d] < 0 || local[d] >= size[d];
    if (beyond > 1) continue;
    for (int d = 0; d < grid.dimension; ++d)
      for (int side = 0; side < 2; ++side) {
        int const out = side == 0 ? -1 : 1;
        CellIndex const n = beside(c, d, out);
        if (!grid.inside(n)) continue;
        bool const solid = record_->solid(n);
        if (solid ? !solid_shows_another(n, c, d, block, wall) : !two_gases(side == 0 ? n : c, d)) continue;
        Seen seen = look(n, d, -out, hint);
        keep_to_own_side(c, std::span(&seen, 1), d, -out);
        MirrorCell const m = mirror(seen, d, unwanted);
        ApartFace const face{local, d, side, solid, m.place >= 0, m.normal, m.wall_velocity};
        wall.apart.push_back(face);
        // The ghosts beyond the sides of the domain are parted like the cells they stand beside.
        for (int e = 0; e < grid.dimension; ++e) {
          if (e == d) continue;
          auto const at = static_cast<std::size_t>(e);
          if (grid.periodic[at]) continue;
          for (int const by : {-1, 1}) {
            if (c[at] != (by < 0 ? 0 : grid.cells[at] - 1) || local[at] < 0 || local[at] >= size[at]) continue;
            wall.apart.push_back(face);
            wall.apart.back().cell[at] += by;
          }
        }
      }
  }
  std::sort(wall.apart.begin(), wall.apart.end());
}

}  // namespace brisance::coupling
