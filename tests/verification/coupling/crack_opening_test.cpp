// V12: two blocks that touch are torn apart in gas: the crack starts as a vacuum and fills, whatever its angle to the
// grid and its speed (theory/coupling.md sections 3.2, 3.3, 7).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

std::string scene(Real speed, Real angle, int order) {
  Vec3 const along{std::cos(angle), std::sin(angle), 0}, across{-along.y, along.x, 0}, middle{0.5, 0.5, 0};
  std::string text = "end_time = " + quantity(0.1 / max(1, speed), "s") +
                     "\n[fluid]\nhigh = [\"1 m\", \"1 m\"]\ncells = [100, 100]\nambient = " + gas_state(1.4, 1, {}) +
                     "\neuler = { order = " + std::to_string(order) +
                     ", cfl = 0.5 }\n[solid.material.m]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1e5 Pa\"\n"
                     "[coupling]\ncut_cells = {}\n";
  for (Real const side : {-1.0, 1.0}) {
    std::string corners;
    Real const low = min(0, 0.15 * side), high = max(0, 0.15 * side);
    for (auto const& [x, y] : {std::pair{low, -0.15}, {high, -0.15}, {high, 0.15}, {low, 0.15}}) {
      Vec3 const p = middle + x * along + y * across;
      corners += (corners.empty() ? "" : ", ") + digits(p.x) + ", " + digits(p.y);
    }
    text += "[[solid.body]]\nmaterial = \"m\"\nshape = \"prism\"\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\ncorners = [" +
            corners + "]\nvelocity = [" + digits(side * speed * along.x) + ", " + digits(side * speed * along.y) +
            ", 0]\n";
  }
  return text;
}

TEST(CrackOpening, KeepsMassAndEnergyAndStaysPositive) {
  for (int const order : {5, 11})
    for (Real const speed : {0.5, 3.0, 10.0})
      for (Real const angle : {0.0, 0.4}) {
        if (!evidence::full() && order == 5 && angle == 0) continue;
        CoupledCase c(scene(speed, angle, order));
        bool positive = true;
        c.run(-1, [&] {
          c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) {
            positive = positive && u[0] >= 0 && 2 * u[0] * u[4] - u[1] * u[1] - u[2] * u[2] >= -1e-13 * u[0] * u[4];
          });
        });
        std::string const variant =
            "order " + std::to_string(order) + "; +-" + digits(speed) + " c; " + digits(angle) + " rad";
        EXPECT_TRUE(evidence::at_most("V12", "crack opening", variant, "mass defect", c.conservation().mass, 1e-12));
        EXPECT_TRUE(
            evidence::at_most("V12", "crack opening", variant, "energy defect", c.conservation().energy, 1e-12));
        EXPECT_TRUE(evidence::at_most("V12", "crack opening", variant, "cells below zero", positive ? 0 : 1, 0));
        EXPECT_TRUE(evidence::at_most("V12", "crack opening", variant, "rejected pairs",
                                      static_cast<double>(c.simulation().statistics().retries), 0));
      }
}

}  // namespace
}  // namespace brisance
