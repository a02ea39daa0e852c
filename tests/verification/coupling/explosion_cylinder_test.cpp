// V10: an explosion in a steel tube, and its variant with the tube held fixed (theory/coupling.md section 7).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/support/coupled_case.hpp"
#include "tests/support/evidence.hpp"

namespace brisance {
namespace {

using testing::CoupledCase;

std::string scene_text() {
  std::ifstream file(BRISANCE_SOURCE_DIR "/jobs/scenes/explosion-cylinder.toml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Mean distance of the mass centres from the centre of the tube.
Real mean_radius(CoupledCase const& c) {
  solid::Solid const& s = *c.world->solid;
  Real sum = 0;
  for (Index i = 0; i < s.owned(); ++i) sum += norm(s.pose()[static_cast<std::size_t>(i)].x - Vec3{4, 3, 0.5});
  return sum / s.owned();
}

/// Largest speed of the air outside the tube, m/s.
Real outer_speed(CoupledCase& c) {
  Real fastest = 0;
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real) {
    Vec3 const x = c.world->flow->grid().centre(cell) - Vec3{4, 3, 0.5};
    if (std::hypot(x.x, x.y) > 1.025 && u[0] > 0) fastest = max(fastest, norm({u[1], u[2], u[3]}) / u[0]);
  });
  return fastest;
}

TEST(ExplosionCylinder, MeanRadiusFollowsTheReference) {
  CoupledCase c(scene_text(), {"output.interval=\"0.2 ms\""});
  EXPECT_NEAR(mean_radius(c), 1.0232, 1e-4);
  Real largest = 0, time_of_largest = 0, previous_time = 0, previous = mean_radius(c);
  std::map<int, Real> at;  // tenths of ms
  Real speed = 0;
  c.run(-1, [&] {
    Real const r = mean_radius(c);
    if (r > largest) largest = r, time_of_largest = c.time();
    for (int const tenth : {6, 16, 20}) {
      Real const t = tenth * 1e-4;
      if (previous_time < t && c.time() >= t * (1 - 1e-12))
        at[tenth] = previous + (r - previous) * (t - previous_time) / (c.time() - previous_time);
    }
    if (c.time() <= 0.6e-3 * (1 + 1e-12)) speed = outer_speed(c);
    previous_time = c.time(), previous = r;
  });
  EXPECT_TRUE(
      evidence::near("V10", "explosion in a cylinder", "order 11", "mean radius at 0.60 ms", at[6], 1.0254, 3e-4));
  EXPECT_TRUE(
      evidence::near("V10", "explosion in a cylinder", "order 11", "largest mean radius", largest, 1.0279, 3e-4));
  EXPECT_TRUE(
      evidence::near("V10", "explosion in a cylinder", "order 11", "time of it", time_of_largest, 0.93e-3, 0.04e-3));
  EXPECT_TRUE(
      evidence::near("V10", "explosion in a cylinder", "order 11", "mean radius at 1.60 ms", at[16], 1.0230, 3e-4));
  EXPECT_TRUE(
      evidence::near("V10", "explosion in a cylinder", "order 11", "mean radius at 2.00 ms", at[20], 1.0254, 3e-4));
  EXPECT_TRUE(
      evidence::at_most("V10", "explosion in a cylinder", "order 11", "speed of the outer air at 0.6 ms", speed, 13));
  Conservation const& k = c.conservation();
  EXPECT_TRUE(evidence::at_most("V10", "explosion in a cylinder", "order 11", "mass defect", k.mass, 1e-12));
  EXPECT_TRUE(evidence::at_most("V10", "explosion in a cylinder", "order 11", "momentum defect",
                                max(k.momentum.x, k.momentum.y), 1e-12));
  EXPECT_TRUE(evidence::at_most("V10", "explosion in a cylinder", "order 11", "exchange energy defect",
                                k.exchange_energy, 1e-12));
  EXPECT_TRUE(evidence::at_most("V10", "explosion in a cylinder", "order 11", "energy defect", k.energy, 2.5e-7));
}

TEST(ExplosionCylinder, EnergyDefectFallsAsTheSquareOfTheStep) {
  // Steps limited far below the fluid's: what remains is the oscillation of Verlet and the cross term.
  std::array<Real, 2> defect{};
  for (std::size_t i = 0; i < 2; ++i) {
    CoupledCase c(scene_text(), {"end_time=\"0.8 ms\"", i == 0 ? "fluid.euler.cfl=0.4" : "fluid.euler.cfl=0.2"});
    c.run();
    defect[i] = c.conservation().energy;
  }
  EXPECT_TRUE(evidence::at_most("V10", "explosion in a cylinder", "CFL 0.2 against 0.4", "ratio of energy defects",
                                defect[1] / defect[0], 0.35));
}

TEST(ExplosionCylinder, FixedTubeLeavesTheOuterAirAtRest) {
  CoupledCase c(scene_text(), {"end_time=\"0.6 ms\"",
                               "solid.body.0.hold=[{low=[\"0 m\",\"0 m\",\"-1 m\"],high=[\"12 m\",\"6 m\",\"2 m\"]}]"});
  c.run();
  EXPECT_TRUE(evidence::at_most("V10", "tube held fixed", "order 11", "speed of the outer air", outer_speed(c), 1e-6));
  EXPECT_TRUE(evidence::at_most("V10", "tube held fixed", "order 11", "energy defect", c.conservation().energy, 1e-12));
}

}  // namespace
}  // namespace brisance
