// The scenes of jobs/scenes that are cases of theory/coupling.md section 7, or of bodies that break: the figures their
// headers promise. V6, V7, V9 and V10 have tests of their own.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"
#include "tests/support/shipped_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

bool near(std::string const& id, std::string const& scene, std::string const& quantity, Real got, Real expected,
          Real tolerance) {
  return evidence::near(id, scene, "shipped scene", quantity, got, expected, tolerance);
}
bool at_most(std::string const& id, std::string const& scene, std::string const& quantity, Real got, Real limit) {
  return evidence::at_most(id, scene, "shipped scene", quantity, got, limit);
}

/// Mass, momentum and exchanged energy to round-off, the energy to `energy`.
void expect_balance(std::string const& id, std::string const& scene, Conservation const& k, Real energy) {
  EXPECT_TRUE(at_most(id, scene, "mass defect", k.mass, 1e-12));
  EXPECT_TRUE(at_most(id, scene, "momentum defect", max(k.momentum.x, max(k.momentum.y, k.momentum.z)), 1e-12));
  EXPECT_TRUE(at_most(id, scene, "exchange energy defect", k.exchange_energy, 1e-12));
  EXPECT_TRUE(at_most(id, scene, "energy defect", k.energy, energy));
}

TEST(ShippedCases, FreePiston) {
  CoupledCase c(shipped_scene("free-piston"));
  Real const start = c.mass_centre().x;
  c.run();
  EXPECT_TRUE(near("V1", "free-piston", "speed of the piston", c.velocity().x, 0.4831705, 5e-6));
  EXPECT_TRUE(near("V1", "free-piston", "way of the piston", c.mass_centre().x - start, 0.0945168, 1e-6));
  expect_balance("V1", "free-piston", c.conservation(), 1e-14);
}

TEST(ShippedCases, NothingHappensInUniformMotion) {
  struct Case {
    std::string id, scene;
    Real limit;
    std::int64_t steps;
  };
  for (Case const& k : {Case{"V2", "body-in-common-motion", 1e-11, 100}, Case{"V3", "sliding-wall", 1e-12, 100},
                        Case{"V4", "spinning-cylinder", 3e-3, 100},
                        Case{"V5", "bodies-in-a-cell", 1e-11, evidence::full() ? 100 : 6}}) {
    CoupledCase c(shipped_scene(k.scene));
    fluid::GasState const& start = c.scene.fluid->ambient;
    Real largest = 0;
    c.run(k.steps, [&] { largest = max(largest, deviation(c, start.density, start.velocity, start.pressure)); });
    EXPECT_GT(c.step(), 4);
    EXPECT_TRUE(at_most(k.id, k.scene, "largest change of the gas", largest, k.limit));
    expect_balance(k.id, k.scene, c.conservation(), 1e-12);
  }
}

TEST(ShippedCases, CylinderLiftOff) {
  CoupledCase c(shipped_scene("cylinder-lift-off"));
  c.run();
  EXPECT_TRUE(near("V8", "cylinder-lift-off", "x of the centre", c.mass_centre().x, 0.3534, 0.001));
  EXPECT_TRUE(near("V8", "cylinder-lift-off", "y of the centre", c.mass_centre().y, 0.0843, 0.004));
  expect_balance("V8", "cylinder-lift-off", c.conservation(), 1e-11);
}

TEST(ShippedCases, ElasticShell) {
  CoupledCase c(shipped_scene("elastic-shell"));
  c.run(evidence::full() ? -1 : 200);
  expect_balance("V11", "elastic-shell", c.conservation(), 2.3e-7);
}

TEST(ShippedCases, OpeningCrack) {
  CoupledCase c(shipped_scene("opening-crack"));
  c.run();
  expect_balance("V12", "opening-crack", c.conservation(), 1e-12);
}

TEST(ShippedCases, FreeExpansion) {
  CoupledCase c(shipped_scene("free-expansion"));
  c.run();
  Real error = 0;
  Real const h = c.world->flow->grid().spacing.x;
  c.for_fluid([&](fluid::CellIndex const& cell, fluid::State const& u, Real volume) {
    if (cell[1] != 3) return;
    Real const s = ((cell[0] + 0.5) * h - 0.50185) / c.time();
    Real const exact = s <= -1 ? 1.4 : s >= 5 ? 0 : 1.4 * std::pow((5 - s) / 6, 5);
    error += std::abs(u[0] - exact) * volume / h;
  });
  EXPECT_TRUE(at_most("V13", "free-expansion", "L1 error of the density", error, 3.6e-3));
  expect_balance("V13", "free-expansion", c.conservation(), 1e-13);
}

/// Bodies that break, and bodies in 3D: all balances through every break. The short form stops soon after the first.
TEST(ShippedCases, BodiesThatBreak) {
  struct Case {
    std::string id, scene;
    std::vector<std::string> shorter;
    Real energy;
    int least_breaks;
  };
  for (Case const& k :
       {Case{"V10", "bursting-tube", {"fluid.cells=[96, 96]", "end_time=\"0.8 ms\""}, 1e-4, 5},
        Case{"V11", "bursting-shell", {"fluid.cells=[60, 60]", "end_time=0.2"}, 1e-4, 5},
        Case{"V11", "bursting-sphere", {"fluid.cells=[20, 20, 20]", "fluid.block=10", "end_time=0.15"}, 1e-3, 5},
        Case{"V12", "breaking-wall", {"fluid.cells=[24, 16, 12]", "fluid.block=12", "end_time=\"3 ms\""}, 1e-4, 5}}) {
    CoupledCase c(shipped_scene(k.scene), evidence::full() ? std::vector<std::string>{} : k.shorter);
    c.run();
    EXPECT_GE(c.simulation().ledger().received(Entry::links_broken), k.least_breaks) << k.scene;
    expect_balance(k.id, k.scene, c.conservation(), k.energy);
  }
}

TEST(ShippedCases, SphereLiftOff) {
  std::vector<std::string> changes{"solid.body.0.mesh.file=\"" BRISANCE_SOURCE_DIR
                                   "/jobs/meshes/geodesic-sphere.off\""};
  if (!evidence::full()) changes.insert(changes.end(), {"fluid.cells=[30, 12, 10]", "fluid.block=10"});
  CoupledCase c(shipped_scene("sphere-lift-off"), changes);
  Vec3 const start = c.mass_centre();
  c.run();
  Vec3 const way = c.mass_centre() - start;
  EXPECT_TRUE(near("V8", "sphere-lift-off", "way along", way.x, 0.158, evidence::full() ? 0.002 : 0.03));
  EXPECT_TRUE(at_most("V8", "sphere-lift-off", "way out of the plane of symmetry", std::abs(way.y), 1e-4));
  EXPECT_GT(way.z, 0);
  expect_balance("V8", "sphere-lift-off", c.conservation(), 1e-9);
}

}  // namespace
}  // namespace brisance
