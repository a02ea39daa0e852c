// The nearest point of a wall found under a bound is the one that all pieces in reach give, whatever the hint.
#include <gtest/gtest.h>

#include <limits>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/wall_record.hpp"
#include "tests/support/wild_bodies.hpp"

namespace brisance::coupling {
namespace {

constexpr Index cells = 24;

struct Record : WallRecord {
  explicit Record(fluid::Grid const& grid) {
    set_grid(grid);
    set_region({CellBox{{0, 0, 0}, grid.cells}});
  }
};

fluid::Grid box_of_cells(int dimension) {
  fluid::Grid grid;
  grid.dimension = dimension;
  grid.cells = {cells, cells, dimension == 3 ? cells : 1};
  grid.spacing = {1, 1.25, dimension == 3 ? 0.8 : 1};
  return grid;
}

/// Every piece of the cells in reach, from the inner shell to the outer one: theory/coupling.md 1.9 to the letter.
Projection every_piece(WallRecord const& record, CellIndex c, int direction, int side) {
  fluid::Grid const& grid = record.grid();
  Vec3 const centre = grid.centre(c);
  Real const h = smallest_spacing(grid);
  Real best = std::numeric_limits<Real>::max();
  Projection p;
  for (Index shell = 0; shell <= 6; ++shell) {
    for_shell(grid, c, shell, [&](CellIndex n) {
      if (record.cut_index(n) < 0) return;
      CutCell const& cut = record.cut(record.cut_index(n));
      for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
        Piece const& piece = record.geometry.pieces[static_cast<std::size_t>(f)];
        if (direction >= 0 &&
            (piece.area[direction] * side <= 0.05 * norm(piece.area) || dot(centre - piece.centroid, piece.area) > 0))
          continue;
        Nearest const found = closest_point(record.lattice(), record.geometry, piece, centre);
        if (!(found.distance2 < best)) continue;
        best = found.distance2;
        p = {true, found.point, {}, record.wall_velocity(piece.triangle, found.bary)};
      }
    });
    if (p.found && best <= square((shell + 0.5) * h)) break;
  }
  return p;
}

TEST(Projection, IsThatOfAllPieces) {
  int found = 0, none = 0, ties = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    int const dimension = seed % 3 ? 3 : 2;
    testing::WildBodies random(seed);
    fluid::Grid const grid = box_of_cells(dimension);
    Record record(grid);
    for (int b = 0; b < 3; ++b) {
      Vec3 const at{random.uniform(5, 19), random.uniform(6, 24), random.uniform(4, 15)};
      auto const first = static_cast<GlobalId>(record.triangles.size());
      Vec3 const on_planes{std::round(at.x), 1.25 * std::round(at.y / 1.25), 0.8 * std::round(at.z / 0.8)};
      testing::Shape const body = dimension == 2
                                      ? testing::disk({at.x, at.y, 0}, random.uniform(1, 4), 4 + random.pick(9))
                                  : b == 0 ? testing::box(on_planes, on_planes + Vec3{3, 5, 2.4})
                                           : testing::icosphere(at, random.uniform(1, 4), 2);
      for (SurfaceTriangle t : testing::surface(body, body, dimension)) {
        t.id += first;
        t.surface = first;
        for (Vec3& v : t.velocity) v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        record.triangles.push_back(t);
      }
    }
    record.rebuild();
    auto const pieces = static_cast<Real>(record.geometry.pieces.size());
    ASSERT_GT(pieces, 20);
    Index last = -1;
    for (int n = 0; n < 3000; ++n) {
      auto const any = [&] { return static_cast<Index>(random.uniform(-2, cells + 2)); };
      CellIndex const c{any(), any(), dimension == 3 ? any() : 0};
      int const direction = static_cast<int>(random.uniform(-1, dimension));
      int const side = random.uniform(0, 1) < 0.5 ? -1 : 1;
      Projection const all = every_piece(record, c, direction, side);
      (all.found ? found : none)++;
      Index none_given = -1;
      Projection const p = record.project(c, direction, side, none_given);
      ASSERT_EQ(p.found, all.found);
      if (!p.found) continue;
      Real const distance = norm(all.point - grid.centre(c));
      ASSERT_NEAR(norm(p.point - grid.centre(c)), distance, 1e-13) << "seed " << seed << ", query " << n;
      ties += !(p.point == all.point);  // equally close but for the last bit
      for (Index hint : {last, static_cast<Index>(random.uniform(0, pieces)), none_given}) {
        Projection const again = record.project(c, direction, side, hint);
        ASSERT_TRUE(again.found);
        ASSERT_EQ(again.point, p.point) << "seed " << seed << ", query " << n;
        ASSERT_EQ(again.velocity, p.velocity);
        ASSERT_EQ(hint, none_given);
      }
      last = none_given;
    }
  }
  EXPECT_LT(ties, found / 100);
  EXPECT_GT(found, 5000);
  EXPECT_GT(none, 1000);
}

}  // namespace
}  // namespace brisance::coupling
