// Bodies that rest keep their cells, with the bits that cutting everything anew would give; and the identities of a
// step are found broken where they are.
#include <gtest/gtest.h>

#include <set>

#include "coupling/cut_cells/identities.hpp"
#include "tests/support/wild_bodies.hpp"

namespace brisance::coupling {
namespace {

using testing::Shape;

class Record : public WallRecord {
 public:
  explicit Record(int dimension) {
    grid_.dimension = dimension;
    grid_.cells = {24, 24, dimension == 3 ? 24 : 1};
    set_grid(grid_);
    Index const z = dimension == 3 ? 24 : 1;
    set_region({CellBox{{4, 0, 0}, {24, 20, z}}});  // bodies reach beyond what is kept
  }
  void take(std::vector<SurfaceTriangle> const& all) {
    triangles = all;
    rebuild();
  }

 private:
  fluid::Grid grid_;
};

/// Bodies with one closed surface each; those that `moves` names go from `old` to `now`.
std::vector<SurfaceTriangle> scene(std::vector<Shape> const& old, std::vector<Shape> const& now, int dimension) {
  std::vector<SurfaceTriangle> all;
  for (std::size_t b = 0; b < old.size(); ++b) {
    auto const first = static_cast<GlobalId>(all.size());
    for (SurfaceTriangle t : testing::surface(old[b], now[b], dimension)) {
      t.id += first;
      t.surface = first;
      all.push_back(t);
    }
  }
  return all;
}

void expect_same(WallRecord const& a, WallRecord const& b) {
  ASSERT_EQ(a.geometry.cells.size(), b.geometry.cells.size());
  EXPECT_EQ(a.geometry.pieces.size(), b.geometry.pieces.size());
  for (CutCell const& x : a.geometry.cells) {
    Index const at = b.cut_index(x.cell);
    ASSERT_GE(at, 0);
    CutCell const& y = b.cut(at);
    EXPECT_EQ(x.volume, y.volume);
    EXPECT_EQ(x.aperture, y.aperture);
    EXPECT_EQ(x.area, y.area);
    ASSERT_EQ(x.last_piece - x.first_piece, y.last_piece - y.first_piece);
    for (Index f = 0; f < x.last_piece - x.first_piece; ++f) {
      Piece const& p = a.geometry.pieces[static_cast<std::size_t>(x.first_piece + f)];
      Piece const& q = b.geometry.pieces[static_cast<std::size_t>(y.first_piece + f)];
      EXPECT_EQ(a.triangles[static_cast<std::size_t>(p.triangle)].id,
                b.triangles[static_cast<std::size_t>(q.triangle)].id);
      EXPECT_EQ(p.area, q.area);
      EXPECT_EQ(p.centroid, q.centroid);
    }
  }
  CellIndex c;
  for (c[2] = 0; c[2] < a.grid().cells[2]; ++c[2])
    for (c[1] = 0; c[1] < 24; ++c[1])
      for (c[0] = 0; c[0] < 24; ++c[0]) ASSERT_EQ(a.volume(c), b.volume(c)) << c[0] << ' ' << c[1] << ' ' << c[2];
}

TEST(RestingWalls, SameBitsWhileBodiesComeAndGo) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    int const dimension = seed % 3 ? 3 : 2;
    testing::WildBodies random(seed);
    std::vector<Shape> bodies;
    for (int b = 0; b < 6; ++b) {
      Vec3 const at{random.snapped(random.uniform(3, 20)), random.snapped(random.uniform(3, 20)),
                    random.snapped(random.uniform(3, 20))};
      if (dimension == 2)
        bodies.push_back(testing::disk({at.x, at.y, 0}, random.uniform(0.3, 2.5), 3 + random.pick(9)));
      else
        bodies.push_back(random.pick(2) ? testing::box(at, at + Vec3{random.snapped(2.4), 1, 3})
                                        : testing::icosphere(at, random.uniform(0.3, 2.5), 1));
    }
    Record kept[2] = {Record(dimension), Record(dimension)};
    for (int step = 0; step < 40; ++step) {
      std::vector<Shape> now = bodies;
      for (std::size_t b = 0; b < now.size(); ++b) {
        bool const moves = (step / 5 + static_cast<int>(b)) % 3 == 0 && b != 0;
        Vec3 const by{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4),
                      dimension == 3 ? random.uniform(-0.4, 0.4) : 0};
        if (moves) now[b] = testing::mapped(now[b], [&](Vec3 p) { return p + by; });
      }
      auto triangles = scene(bodies, now, dimension);
      if (step % 7 == 3) {  // a body far away comes into sight: the places of the others shift
        auto more = scene({testing::box({90, 90, 90}, {91, 91, 91})}, {testing::box({90, 90, 90}, {91, 91, 91})}, 3);
        if (dimension == 3)
          for (auto t : more) t.id -= 100, t.surface = -100, triangles.insert(triangles.begin() + (t.id + 100), t);
      }
      Record fresh(dimension);
      fresh.take(triangles);
      kept[step % 2].take(triangles);
      expect_same(kept[step % 2], fresh);
      if (HasFatalFailure() || HasNonfatalFailure()) return;
      bodies = now;
    }
  }
}

TEST(RestingWalls, IdentitiesHoldAndAreMissedWhenBroken) {
  for (int const dimension : {2, 3}) {
    auto const body = [&](Vec3 by) {
      Shape const s = dimension == 2 ? testing::disk({9, 9, 0}, 3.3, 30) : testing::icosphere({9, 9, 9}, 3.3, 2);
      return testing::mapped(s, [&](Vec3 p) { return p + by; });
    };
    Vec3 const step{0.3, -0.2, dimension == 3 ? 0.1 : 0};
    CellBox const own{{4, 0, 0}, {24, 20, dimension == 3 ? 24 : 1}};
    Record before(dimension), after(dimension);
    before.take(scene({body({})}, {body({})}, dimension));
    after.take(scene({body({})}, {body(step)}, dimension));
    EXPECT_EQ(broken_identity(before, after, std::span(&own, 1)), "");
    after.triangles[7].x_old[0].x += 1e-6;
    EXPECT_NE(broken_identity(before, after, std::span(&own, 1)).find("volume law (G2) of cell ("), std::string::npos);
    after.triangles[7].x_old[0].x -= 1e-6;
    after.geometry.cells[3].aperture[1][0] += 1e-6;
    EXPECT_NE(broken_identity(before, after, std::span(&own, 1)).find("closure (G1)"), std::string::npos);
  }
}

}  // namespace
}  // namespace brisance::coupling
