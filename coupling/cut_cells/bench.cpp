#include "coupling/cut_cells/bench.hpp"

#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

GeometryRate bench_projections() {
  fluid::Grid grid;
  grid.cells = {bench_cells, bench_cells, bench_cells};
  WallRecord record;
  record.set_grid(grid);
  record.set_region({CellBox{{0, 0, 0}, grid.cells}});
  record.triangles = bench_sphere();
  record.rebuild();
  std::size_t missed = 0;
  auto rate = best_rate([&] {
    std::size_t items = 0;
    Index beside[2] = {-1, -1};  // what the run before found
    auto const behind = [&](CellIndex last, int outwards) {
      Index hint = beside[outwards > 0];
      for (Index m = 1; m <= 3; ++m, ++items) {
        CellIndex const c{last[0] + outwards * m, last[1], last[2]};
        missed += record.project(c, 0, -outwards, hint).found ? 0 : 1;
        if (m == 1) beside[outwards > 0] = hint;
      }
    };
    CellIndex c{};
    for (c[2] = 0; c[2] < bench_cells; ++c[2])
      for (c[1] = 0; c[1] < bench_cells; ++c[1])
        for (c[0] = 0; c[0] + 1 < bench_cells; ++c[0]) {
          CellIndex const next{c[0] + 1, c[1], c[2]};
          bool const here = record.solid(c), there = record.solid(next);
          if (!here && there) behind(c, +1);
          if (here && !there) behind(next, -1);
        }
    return items;
  });
  if (missed > 0) rate.items = 0;
  return rate;
}

}  // namespace brisance::coupling
