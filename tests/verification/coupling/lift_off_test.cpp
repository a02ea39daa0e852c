// V8: a shock of Mach 3 lifts a free cylinder off the floor of a channel (theory/coupling.md section 7).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

/// The cylinder is a polygon with one side on the floor: it touches it as the circle does.
std::string scene(int rows, std::string const& wall_pressure) {
  constexpr int sides = 400;
  std::string const behind = gas_state(5.4, 10.0 + 1.0 / 3.0, {20.0 / 9.0, 0, 0});
  return "end_time = \"0.1641 s\"\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = [\"1 m\", \"0.2 m\"]\ncells = [" +
         std::to_string(5 * rows) + ", " + std::to_string(rows) + "]\nambient = " + gas_state(1.4, 1, {}) +
         "\neuler = { order = 11, cfl = 0.5 }\nboundary = { x_low = \"inflow\", x_high = \"outflow\" }\n"
         "inflow = { x_low = " +
         behind +
         " }\n[[fluid.region]]\nlow = [\"-1 m\", \"-1 m\"]\nhigh = [\"0.08 m\", \"1 m\"]\ndensity = \"5.4 kg/m3\"\n"
         "pressure = " +
         quantity(10.0 + 1.0 / 3.0, "Pa") + "\nvelocity = " + quantities({20.0 / 9.0, 0}, "m/s") + "\n[solid]\n" +
         rigid_material(10.77) +
         polygon_body(
             regular_polygon(sides, 0.05, {0.15, 0.05, 0}, -0.5 * std::numbers::pi + std::numbers::pi / sides)) +
         "[coupling]\ncut_cells = { wall_pressure = \"" + wall_pressure + "\" }\n";
}

void check(int rows, std::string const& wall_pressure, Real x_tolerance, Real y_tolerance) {
  CoupledCase c(scene(rows, wall_pressure));
  c.run();
  std::string const variant = std::to_string(5 * rows) + "x" + std::to_string(rows) + "; " + wall_pressure;
  Vec3 const x = c.mass_centre();
  EXPECT_TRUE(evidence::near("V8", "cylinder lift-off", variant, "x of the centre", x.x, 0.3534, x_tolerance));
  EXPECT_TRUE(evidence::near("V8", "cylinder lift-off", variant, "y of the centre", x.y, 0.0843, y_tolerance));
  Conservation const& k = c.conservation();
  EXPECT_TRUE(evidence::at_most("V8", "cylinder lift-off", variant, "mass defect", k.mass, 1e-11));
  EXPECT_TRUE(evidence::at_most("V8", "cylinder lift-off", variant, "x momentum defect", k.momentum.x, 1e-11));
  EXPECT_TRUE(evidence::at_most("V8", "cylinder lift-off", variant, "energy defect", k.energy, 1e-11));
}

TEST(LiftOff, Coarse) {
  for (std::string const wall : {"cell", "half_riemann"}) check(40, wall, 0.001, 0.004);
}

TEST(LiftOff, Fine) {
  if (!evidence::full()) GTEST_SKIP() << "full suite only";
  for (std::string const wall : {"cell", "half_riemann"}) check(80, wall, 0.0005, 0.0025);
}

}  // namespace
}  // namespace brisance
