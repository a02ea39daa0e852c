// V13: a piston recedes faster than gas can follow: the expansion into the vacuum it leaves is that without a piston
// (theory/coupling.md section 7).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

constexpr Real end_time = 0.07, speed = 6;

std::string scene(int cells, int order) {
  Real const h = 1.0 / cells, face = 0.5 + 0.37 * h, height = 8 * h;
  std::ostringstream text;
  text << "end_time = " << quantity(end_time, "s")
       << "\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = " << quantities({1, height}, "m") << "\ncells = [" << cells
       << ", 8]\n"
       << "ambient = " << gas_state(0, 0, {}) << "\neuler = { order = " << order << ", cfl = 0.5 }\n"
       << "[[fluid.region]]\nshape = \"box\"\nlow = " << quantities({-1, -1}, "m")
       << "\nhigh = " << quantities({face + 0.02, 1}, "m") << "\ndensity = \"1.4 kg/m3\"\npressure = \"1 Pa\"\n"
       << "[solid]\n"
       << rigid_material(1) << "[[solid.body]]\nmaterial = \"rigid\"\nlow = " << quantities({face, -h}, "m")
       << "\nhigh = " << quantities({face + 0.04, height + h}, "m")
       << "\n[[solid.body.prescribed]]\nlow = " << quantities({face, -h}, "m")
       << "\nhigh = " << quantities({face + 0.04, height + h}, "m") << "\nvelocity = " << quantities({speed, 0}, "m/s")
       << "\n[coupling]\ncut_cells = {}\n";
  return text.str();
}

/// Mean of the exact density over a cell, by Simpson's rule.
Real exact(Real low, Real high, Real start) {
  auto const density = [&](Real x) {
    Real const s = (x - start) / end_time;
    return s <= -1 ? 1.4 : s >= 5 ? 0 : 1.4 * std::pow((5 - s) / 6, 5);
  };
  return (density(low) + 4 * density(0.5 * (low + high)) + density(high)) / 6;
}

Real error(int cells, int order) {
  CoupledCase c(scene(cells, order));
  c.run();
  Real const h = 1.0 / cells;
  Real sum = 0;
  c.for_fluid([&](fluid::CellIndex const& cell, fluid::State const& u, Real volume) {
    Real const low = cell[0] * h;
    if (cell[1] == 3) sum += std::abs(u[0] - exact(low, low + h, 0.5 + 0.37 * h)) * min(h, volume / h);
  });
  std::string const variant = std::to_string(cells) + " cells; order " + std::to_string(order);
  EXPECT_TRUE(
      evidence::at_most("V13", "free expansion", variant, "L1 error of the density", sum, 3.6e-3 * 200 / cells));
  EXPECT_TRUE(evidence::at_most("V13", "free expansion", variant, "mass defect", c.conservation().mass, 1e-13));
  EXPECT_TRUE(evidence::at_most("V13", "free expansion", variant, "energy defect", c.conservation().energy, 1e-13));
  Real push = 0;
  for (solid::Wrench const& w : std::as_const(*c.world->solid).load()) push += std::abs(w.force.x);
  EXPECT_TRUE(evidence::at_most("V13", "free expansion", variant, "push on the piston over p A", push / (8 * h), 1e-6));
  return sum;
}

TEST(FreeExpansion, ErrorFallsInFirstOrder) {
  for (int const order : evidence::full() ? std::vector{5, 11} : std::vector{11}) {
    Real const coarse = error(100, order), fine = error(200, order);
    EXPECT_TRUE(evidence::at_most("V13", "free expansion", "200 against 100 cells; order " + std::to_string(order),
                                  "ratio of errors", fine / coarse, 0.6));
  }
}

}  // namespace
}  // namespace brisance
