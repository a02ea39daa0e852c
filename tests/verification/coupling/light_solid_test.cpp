// A panel lighter than the gas of a cell on either side: a small difference of pressure moves it as the acoustics of
// both sides have it, in every time coupling, once the step follows its weight (theory/coupling.md 1.8, "Stability").
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

constexpr int cells = 60;
constexpr Real excess = 0.01, h = 1.0 / cells, end_time = 0.25;

/// `weight`: mass of the panel per area over that of the gas in one cell.
std::string scene(Real weight, std::string const& coupling) {
  Real const face = 0.5 + 0.37 * h, width = 0.1, height = 8 * h;
  Real const density = weight * 1.4 * h * height / (width * (height + 2 * h));
  return "end_time = " + digits(end_time) + "\n[fluid]\nlow = [0, 0]\nhigh = [1, " + digits(height) + "]\ncells = [" +
         std::to_string(cells) + ", 8]\nambient = " + gas_state(1.4, 1, {}) +
         "\neuler = { order = 11, cfl = 0.5 }\n[[fluid.region]]\nlow = [-1, -1]\nhigh = [" +
         digits(face + 0.5 * width) + ", 1]\ndensity = 1.4\npressure = " + digits(1 + excess) + "\n[solid]\n" +
         rigid_material(density) + "[[solid.body]]\nmaterial = \"rigid\"\nlow = [" + digits(face) + ", " + digits(-h) +
         "]\nhigh = [" + digits(face + width) + ", " + digits(height + h) + "]\n[coupling]\ncut_cells = {}\n" +
         coupling;
}

std::string short_number(Real x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

/// Largest error of the panel's velocity over the terminal one.
Real error(CoupledCase& c, Real weight) {
  Real const terminal = excess / (2 * 1.4);
  Real largest = 0;
  c.run(-1, [&] {
    Real const exact = terminal * (1 - std::exp(-2 * c.time() / (weight * h)));
    Real const off = std::abs(c.velocity().x - exact) / terminal;
    largest = std::isfinite(off) ? max(largest, off) : std::numeric_limits<Real>::infinity();
  });
  return largest;
}

TEST(LightSolid, FollowsTheAcousticsOfBothSides) {
  for (std::string const scheme : {"lag", "semi", "explicit"})
    for (Real const weight : evidence::full() ? std::vector{1.0, 0.3, 0.05} : std::vector{0.3}) {
      CoupledCase c(scene(weight, "scheme = \"" + scheme + "\"\n"));
      ASSERT_EQ(c.world->plan.remarks().size(), 1u);
      EXPECT_NE(c.world->plan.remarks()[0].find("light solid"), std::string::npos);
      std::string const variant = scheme + "; panel of " + short_number(weight) + " of the gas of a cell";
      EXPECT_TRUE(
          evidence::at_most("V1", "light panel", variant, "error over the terminal velocity", error(c, weight), 0.06));
      EXPECT_TRUE(evidence::at_most("V1", "light panel", variant, "rejected pairs",
                                    static_cast<double>(c.simulation().statistics().retries), 0));
      EXPECT_GT(c.simulation().statistics().limited_by.at("coupling.light_solid"), c.step() / 2);
    }
}

/// The check tells apart: without the limit the same panel is thrown about; a heavy one asks for nothing.
TEST(LightSolid, LimitIsNeededAndOnlyThere) {
  CoupledCase light(scene(0.3, "light_solids = \"warn\"\n"));
  EXPECT_EQ(light.world->plan.remarks().size(), 1u);
  light.run(30);
  EXPECT_GT(norm(light.velocity()), 10 * excess / (2 * 1.4));
  CoupledCase heavy(scene(2, ""));
  EXPECT_TRUE(heavy.world->plan.remarks().empty());
  Real const off = error(heavy, 2);
  EXPECT_TRUE(evidence::at_most("V1", "light panel", "lag; panel of 2 of the gas of a cell",
                                "error over the terminal velocity", off, 0.06));
  EXPECT_EQ(heavy.simulation().statistics().limited_by.count("coupling.light_solid"), 0u);
}

}  // namespace
}  // namespace brisance
