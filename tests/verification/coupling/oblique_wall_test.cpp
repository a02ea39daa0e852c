// V3: a parallel flow of Mach 1.5 along an oblique wall, which stands or slides along itself (theory/coupling.md
// sections 1.5, 7).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

/// The wall is the upper side of a block that reaches far beyond the domain.
std::string scene(Real angle, Real sliding, int order) {
  Vec3 const along{std::cos(angle), std::sin(angle), 0}, up{-along.y, along.x, 0};
  Vec3 const velocity = 1.5 * along, point{0.5, 0.317, 0}, half{3, 1, 0};
  std::string const state = gas_state(1.4, 1, velocity);
  std::string const everywhere = "{ low = [\"-9 m\", \"-9 m\"], high = [\"9 m\", \"9 m\"]";
  std::string const motion = sliding == 0 ? "hold = [" + everywhere + " }]\n"
                                          : "prescribed = [" + everywhere + ", velocity = " +
                                                quantities({sliding * along.x, sliding * along.y}, "m/s") + " }]\n";
  return "end_time = \"9 s\"\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = [\"1 m\", \"1 m\"]\ncells = [40, 40]\n"
         "ambient = " +
         state + "\neuler = { order = " + std::to_string(order) + ", cfl = 0.5 }\n" + inflow_everywhere(state) +
         "[solid]\n" + rigid_material(3) + polygon_body(rectangle(point - half.y * up, half, angle), motion) +
         "[coupling]\ncut_cells = {}\n";
}

void check(Real degrees, Real sliding, int order) {
  Real const angle = degrees * std::numbers::pi / 180;
  Vec3 const velocity = 1.5 * Vec3{std::cos(angle), std::sin(angle), 0};
  CoupledCase c(scene(angle, sliding, order));
  Real largest = 0;
  c.run(100, [&] { largest = max(largest, deviation(c, 1.4, velocity, 1)); });
  ASSERT_EQ(c.step(), 100);
  std::ostringstream variant;
  variant << degrees << " degrees; " << (sliding == 0 ? "fixed" : "sliding") << "; order " << order;
  EXPECT_TRUE(evidence::at_most("V3", "parallel flow along an oblique wall", variant.str(), "largest deviation",
                                largest, 1e-12));
}

TEST(ObliqueWall, Fixed) {
  for (Real const degrees : {0.0, 10.0, 30.0, 37.123, 45.0})
    for (int const order : evidence::full() ? std::vector{1, 5, 11} : std::vector{11}) check(degrees, 0, order);
}

TEST(ObliqueWall, SlidingAlongItself) {
  for (Real const degrees : {0.0, 10.0, 30.0, 37.123, 45.0})
    for (int const order : evidence::full() ? std::vector{1, 5, 11} : std::vector{11}) check(degrees, 0.6, order);
}

}  // namespace
}  // namespace brisance
