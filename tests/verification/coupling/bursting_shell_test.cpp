// V11 with fracture: a brittle shell around hot gas bursts. Mass, momentum and the exchanged energy balance to
// round-off through every break, the energy with what the breaks dissipated to second order in the step
// (theory/coupling.md sections 1.7, 3).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

std::string shell(int dimension, Real motion_cfl, Real end_time) {
  std::string const low = quantities(std::vector<Real>(static_cast<std::size_t>(dimension), -0.5), "m"),
                    high = quantities(std::vector<Real>(static_cast<std::size_t>(dimension), 0.5), "m");
  std::string const cells = dimension == 2 ? "[80, 80]" : "[24, 24, 24]";
  return "end_time = " + quantity(end_time, "s") + "\n[fluid]\nlow = " + low + "\nhigh = " + high +
         "\ncells = " + cells + "\nambient = " + gas_state(1.4, 1, {}, dimension) +
         "\neuler = { order = 5, cfl = 0.5 }\n[[fluid.region]]\nshape = \"ball\"\ncentre = " +
         (dimension == 2 ? "[0.03, 0.02]" : "[0.03, 0.02, 0.01]") +
         "\nradius = 0.15\ndensity = 28\npressure = 40\n[solid]\nlinks = {}\nmotion = { cfl = " + digits(motion_cfl) +
         " }\n[solid.material.shell]\ndensity = 50\nyoung_modulus = 2500\npoisson_ratio = " +
         (dimension == 2 ? "0.0" : "0.2") + "\n[[solid.body]]\nmaterial = \"shell\"\ncentre = [0, 0, 0]\n" +
         (dimension == 2
              ? "shape = \"tube\"\ntessellation = \"polar\"\nouter_radius = 0.28\ncells = [1, 50]\nphase = 0.013\n"
              : "shape = \"shell\"\ntessellation = \"voronoi\"\nparticles = 60\nouter_radius = 0.33\n") +
         "inner_radius = 0.25\n[[solid.fracture.law]]\nstress = { tensile_strength = " +
         (dimension == 2 ? "40" : "25") + " }\n[coupling]\nsub_steps = 1\ncut_cells = {}\n";
}

/// Largest energy defect.
Real burst(int dimension, Real motion_cfl, Real end_time, std::string const& variant, int least_breaks) {
  CoupledCase c(shell(dimension, motion_cfl, end_time));
  bool positive = true;
  c.run(-1, [&] {
    c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) {
      positive =
          positive && u[0] >= 0 && 2 * u[0] * u[4] - u[1] * u[1] - u[2] * u[2] - u[3] * u[3] >= -2e-13 * u[0] * u[4];
    });
  });
  Conservation const& k = c.conservation();
  char const* const name = "bursting shell";
  EXPECT_TRUE(positive);
  EXPECT_GE(c.simulation().ledger().received(Entry::links_broken), least_breaks);
  EXPECT_GT(c.simulation().ledger().received(Entry::dissipated), 0);
  EXPECT_TRUE(evidence::at_most("V11", name, variant, "mass defect", k.mass, 1e-12));
  for (int d = 0; d < dimension; ++d)
    EXPECT_TRUE(
        evidence::at_most("V11", name, variant, std::string("momentum defect ") + "xyz"[d], k.momentum[d], 1e-12));
  EXPECT_TRUE(evidence::at_most("V11", name, variant, "exchange energy defect", k.exchange_energy, 1e-12));
  return k.energy;
}

TEST(BurstingShell, BalancesThroughEveryBreak) {
  Real const coarse = burst(2, 0.4, 0.2, "2D; cfl 0.4", 25), fine = burst(2, 0.1, 0.2, "2D; cfl 0.1", 25);
  EXPECT_TRUE(evidence::at_most("V11", "bursting shell", "2D; cfl 0.1 against 0.4", "ratio of energy defects",
                                fine / coarse, 0.15));
}

TEST(BurstingShell, BalancesInThreeDimensions) { burst(3, 0.9, 0.14, "3D", 20); }

}  // namespace
}  // namespace brisance
