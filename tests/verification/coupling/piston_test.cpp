// V1: gas at rest drives a free piston into vacuum (theory/coupling.md section 7; exact solution).
#include <gtest/gtest.h>

#include <array>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

constexpr Real mass_per_area = 0.5, end_time = 0.35;

/// A strip of 8 cells, gas on the left; the piston is a box that reaches beyond the reflecting sides by a cell.
std::string strip(int cells, int order, std::string const& wall_pressure) {
  Real const h = 1.0 / cells, face = 0.5 + 0.37 * h, width = 0.1, height = 8 * h;
  Real const density = mass_per_area * height / (width * (height + 2 * h));
  std::ostringstream text;
  text << "end_time = " << quantity(end_time, "s")
       << "\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = " << quantities({1, height}, "m") << "\ncells = [" << cells
       << ", 8]\n"
       << "ambient = " << gas_state(0, 0, {}) << "\neuler = { order = " << order << ", cfl = 0.5 }\n"
       << "[[fluid.region]]\nshape = \"box\"\nlow = " << quantities({-1, -1}, "m")
       << "\nhigh = " << quantities({face + 0.5 * width, 1}, "m") << "\ndensity = \"1.4 kg/m3\"\npressure = \"1 Pa\"\n"
       << "[solid]\n"
       << rigid_material(density) << "[[solid.body]]\nmaterial = \"rigid\"\nlow = " << quantities({face, -h}, "m")
       << "\nhigh = " << quantities({face + width, height + h}, "m") << "\n[coupling]\ncut_cells = { wall_pressure = \""
       << wall_pressure << "\" }\n";
  return text.str();
}

Real exact_speed(Real t) {
  constexpr Real gamma = 1.4, c = 1, p = 1;
  return 2 * c / (gamma - 1) *
         (1 - std::pow(1 + (gamma + 1) * p * t / (2 * c * mass_per_area), -(gamma - 1) / (gamma + 1)));
}

/// Way of the piston by Simpson's rule.
Real exact_way(Real t) {
  constexpr int n = 2000;
  Real sum = exact_speed(0) + exact_speed(t);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * exact_speed(t * i / n);
  return sum * t / (3 * n);
}

struct Errors {
  Real speed, way;
};

Errors check(int cells, int order, std::string const& wall_pressure, Real speed_limit, Real way_limit) {
  CoupledCase c(strip(cells, order, wall_pressure));
  Real const start = c.mass_centre().x;
  c.run();
  std::string const variant = std::to_string(cells) + " cells; order " + std::to_string(order) + "; " + wall_pressure;
  Errors const e{std::abs(c.velocity().x - exact_speed(end_time)),
                 std::abs(c.mass_centre().x - start - exact_way(end_time))};
  EXPECT_TRUE(evidence::at_most("V1", "free piston", variant, "speed of the piston", e.speed, speed_limit));
  EXPECT_TRUE(evidence::at_most("V1", "free piston", variant, "way of the piston", e.way, way_limit));
  Conservation const& k = c.conservation();
  EXPECT_TRUE(evidence::at_most("V1", "free piston", variant, "mass defect", k.mass, 1e-14));
  EXPECT_TRUE(evidence::at_most("V1", "free piston", variant, "energy defect", k.energy, 1e-14));
  return e;
}

TEST(Piston, ExactSolutionIsThatOfTheTable) {
  EXPECT_NEAR(exact_speed(end_time), 0.483170, 5e-7);
  EXPECT_NEAR(exact_way(end_time), 0.094517, 5e-7);
}

TEST(Piston, CellPressure) {
  for (int const order : evidence::full() ? std::vector{5, 11} : std::vector{11}) check(200, order, "cell", 5e-5, 5e-5);
}

TEST(Piston, HalfRiemannPressure) {
  for (int const order : evidence::full() ? std::vector{5, 11} : std::vector{11})
    check(200, order, "half_riemann", 5e-6, 1e-6);
}

TEST(Piston, WayConvergesInSecondOrder) {
  if (!evidence::full()) GTEST_SKIP() << "full suite only";
  for (std::string const wall : {"cell", "half_riemann"}) {
    Errors const coarse = check(200, 11, wall, wall == "cell" ? 5e-5 : 5e-6, wall == "cell" ? 5e-5 : 1e-6);
    CoupledCase c(strip(400, 11, wall));
    Real const start = c.mass_centre().x;
    c.run();
    Real const fine = std::abs(c.mass_centre().x - start - exact_way(end_time));
    EXPECT_TRUE(evidence::at_most("V1", "free piston", "400 against 200 cells; order 11; " + wall,
                                  "ratio of errors of the way", fine / coarse.way, std::pow(0.5, 1.8)));
  }
}

}  // namespace
}  // namespace brisance
