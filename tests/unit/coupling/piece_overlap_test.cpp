#include "coupling/cut_cells/piece_overlap.hpp"

#include <gtest/gtest.h>

#include <random>

namespace brisance::coupling {
namespace {

/// A closed sliver of two coincident triangles (2D: of two segments), anywhere on the lattice.
std::vector<SurfaceTriangle> sheet(int dimension, std::array<Vec3, 3> const& x) {
  std::vector<SurfaceTriangle> sheet(2);
  for (GlobalId t = 0; t < 2; ++t) {
    SurfaceTriangle& triangle = sheet[static_cast<std::size_t>(t)];
    triangle.id = t;
    triangle.x_new = x;
    if (t == 1) std::swap(triangle.x_new[0], triangle.x_new[1]);
    if (dimension == 2) triangle.x_new[2] = {};
  }
  return sheet;
}

/// Parts of the pieces of triangle 0 before and after a motion: they add up to each piece, and all to the triangle.
void check(int dimension, std::array<Vec3, 3> const& before, std::array<Vec3, 3> const& after) {
  Lattice lattice;
  lattice.dimension = dimension;
  std::vector<CellBox> const everywhere{{{-50, -50, -50}, {50, 50, 50}}};
  std::vector<SurfaceTriangle> const moved = sheet(dimension, after);
  Geometry a, b;
  build(lattice, sheet(dimension, before), everywhere, a);
  build(lattice, moved, everywhere, b);
  Real shares = 0;
  std::array<Real, 3> moment{};
  for (Piece const& p : a.pieces) {
    if (p.triangle != 0) continue;
    Real covered = 0;
    for (Piece const& q : b.pieces) {
      if (q.triangle != 0) continue;
      TrianglePart const part = part_in_cell(a.corners_of(p), lattice, moved[0], q.cell);
      EXPECT_GE(part.share, 0);
      covered += part.share;
      for (std::size_t v = 0; v < 3; ++v) moment[v] += part.share * part.bary[v];
    }
    EXPECT_NEAR(covered, part_of(a.corners_of(p)).share, 1e-14);
    shares += covered;
  }
  EXPECT_NEAR(shares, 1, 1e-13);
  for (std::size_t v = 0; v < static_cast<std::size_t>(dimension); ++v) EXPECT_NEAR(moment[v], 1.0 / dimension, 1e-13);
}

TEST(PieceOverlap, PartsTileTheTriangle) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> place(-3, 3), step(-0.5, 0.5);
  for (int n = 0; n < 400; ++n)
    for (int const dimension : {2, 3}) {
      std::array<Vec3, 3> before, after;
      for (std::size_t v = 0; v < 3; ++v)
        for (int d = 0; d < dimension; ++d) {
          before[v][d] = n % 3 == 0 ? std::nearbyint(place(random)) : place(random);  // corners on nodes too
          after[v][d] = before[v][d] + (n % 2 == 0 ? step(random) : 0);
        }
      if (dimension == 3 && norm(cross(before[1] - before[0], before[2] - before[0])) < 1e-3) continue;
      if (before[0] == before[1]) continue;
      check(dimension, before, after);
    }
}

TEST(PieceOverlap, CellThatTheTriangleLeaves) {
  Lattice lattice;
  SurfaceTriangle triangle = sheet(3, {Vec3{0.1, 0.1, 0.5}, {0.9, 0.1, 0.5}, {0.1, 0.9, 0.5}})[0];
  auto const corner = [](Real a, Real b) { return Corner{{}, {1 - a - b, a, b}}; };
  std::array<Corner, 3> const whole{corner(0, 0), corner(1, 0), corner(0, 1)};
  EXPECT_EQ(part_in_cell(whole, lattice, triangle, {0, 0, 0}).share, 1);
  EXPECT_EQ(part_in_cell(whole, lattice, triangle, {1, 0, 0}).share, 0);
  for (Vec3& x : triangle.x_new) x.x += 0.5;
  EXPECT_NEAR(part_in_cell(whole, lattice, triangle, {1, 0, 0}).share, 0.25, 1e-15);
  EXPECT_NEAR(part_in_cell(whole, lattice, triangle, {0, 0, 0}).share, 0.75, 1e-15);
}

}  // namespace
}  // namespace brisance::coupling
