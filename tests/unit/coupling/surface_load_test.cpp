#include <gtest/gtest.h>

#include <random>

#include "coupling/cut_cells/wall_surface.hpp"

namespace brisance::coupling {
namespace {

using Triangle = std::array<std::size_t, 3>;

Vec3 anywhere(std::mt19937_64& random) {
  std::uniform_real_distribution<Real> in(-1, 1);
  Real const x = in(random), y = in(random), z = in(random);
  return {x, y, z};
}

Vec3 area(int dimension, Real depth, std::array<Vec3, 3> const& x) {
  if (dimension == 2) return {depth * (x[1].y - x[0].y), depth * (x[0].x - x[1].x), 0};
  return 0.5 * cross(x[1] - x[0], x[2] - x[0]);
}

TEST(AreaGained, IsTheDifferenceFromTheMiddleOfTheStep) {
  std::mt19937_64 random(1);
  for (int const dimension : {2, 3})
    for (int n = 0; n < 100; ++n) {
      std::array<Vec3, 3> before, middle, after;
      for (std::size_t a = 0; a < 3; ++a) {
        before[a] = anywhere(random), after[a] = anywhere(random);
        if (dimension == 2) before[a].z = after[a].z = 0;
        middle[a] = 0.5 * (before[a] + after[a]);
      }
      Real const depth = 0.3;
      Vec3 sum;
      for (Vec3 const& g : area_gained(dimension, depth, before, after)) sum += g;
      Vec3 const wanted = area(dimension, depth, after) - area(dimension, depth, middle);
      EXPECT_LE(norm(sum - wanted), 1e-15) << dimension << "D, triangle " << n;
    }
}

TEST(AreaGained, MovesNoClosedSurfaceWhateverThePressuresOfItsVertices) {
  // An octahedron that deforms at will, its vertices under pressures of their own.
  std::vector<Triangle> const faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  std::mt19937_64 random(2);
  for (int n = 0; n < 100; ++n) {
    std::array<Vec3, 6> before, after;
    std::array<Real, 6> pressure{};
    for (std::size_t v = 0; v < 6; ++v)
      before[v] = anywhere(random), after[v] = anywhere(random), pressure[v] = anywhere(random).x;
    Vec3 sum;
    for (Triangle const& f : faces) {
      auto const gained =
          area_gained(3, 1, {before[f[0]], before[f[1]], before[f[2]]}, {after[f[0]], after[f[1]], after[f[2]]});
      for (std::size_t a = 0; a < 3; ++a) sum += pressure[f[a]] * gained[a];
    }
    EXPECT_LE(norm(sum), 4e-15) << "octahedron " << n;
  }
}

}  // namespace
}  // namespace brisance::coupling
