// Bodies that collide in a gas while the solid takes many steps in one of the gas.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/coupled_case.hpp"
#include "tests/support/evidence.hpp"

namespace brisance {
namespace {

using namespace testing;

/// Two stiff blocks that fly at each other, askew, in gas at rest with a sound speed of 1.
std::string blocks(std::string const& coupling) {
  return R"(end_time = 1.2
[fluid]
low = [0, 0]
high = [2, 1]
cells = [60, 30]
block = 15
euler = { order = 5, cfl = 0.5 }
ambient = { density = 1.4, pressure = 1 }
boundary = { x_low = "outflow", x_high = "outflow", y_low = "outflow", y_high = "outflow" }
[solid]
links = {}
contact = { friction = 0.2 }
[solid.material.stiff]
density = 40
young_modulus = 20000
poisson_ratio = 0.2
[[solid.body]]
name = "left"
material = "stiff"
low = [0.6, 0.32]
high = [0.9, 0.62]
cells = [2, 2]
velocity = [0.15, 0]
[[solid.body]]
name = "right"
material = "stiff"
low = [1.0, 0.4]
high = [1.3, 0.7]
cells = [2, 2]
velocity = [-0.15, 0]
spin = [0, 0, 0.2]
[coupling]
)" + coupling +
         "\ncut_cells = {}\n";
}

struct Outcome {
  std::int64_t steps = 0;
  Vec3 left, right;              ///< mean velocities at the end
  Real lowest = 1, highest = 1;  ///< pressures of the gas over the run
  Conservation defects;
  StepStatistics statistics;
};

Outcome collide(std::string const& coupling) {
  CoupledCase c(blocks(coupling));
  Outcome o;
  fluid::Gas const& gas = c.world->flow->gas();
  c.run(-1, [&] {
    c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) {
      Real const p = gas.pressure(u);
      o.lowest = min(o.lowest, p), o.highest = max(o.highest, p);
    });
  });
  for (Index p = 0; p < c.world->solid->owned(); ++p)
    (c.world->mesh->particle(c.world->solid->id(p)).body == 0 ? o.left : o.right) += 0.25 * c.velocity(p);
  o.steps = c.step();
  o.defects = c.conservation();
  o.statistics = c.simulation().statistics();
  return o;
}

TEST(ContactInSubSteps, IsThatOfShortSteps) {
  Outcome const fine = collide("sub_steps = 1");
  EXPECT_EQ(fine.statistics.sub_steps_max, 1);
  for (std::string const scheme : {"lag", "semi", "explicit"}) {
    SCOPED_TRACE(scheme);
    Outcome const o = collide("scheme = \"" + scheme + "\"");
    std::string const variant = "blocks, " + scheme;
    EXPECT_LT(o.steps, 0.3 * static_cast<Real>(fine.steps));
    EXPECT_GT(o.statistics.sub_steps_max, 4);
    EXPECT_TRUE(evidence::at_most("V11", "contact in sub-steps", variant, "mass defect", o.defects.mass, 1e-12));
    EXPECT_TRUE(evidence::at_most("V11", "contact in sub-steps", variant, "momentum defect",
                                  max(o.defects.momentum.x, o.defects.momentum.y), 1e-12));
    EXPECT_TRUE(evidence::at_most("V11", "contact in sub-steps", variant, "exchange energy defect",
                                  o.defects.exchange_energy, 1e-12));
    Real const change = norm(fine.left - Vec3{0.15, 0, 0});
    EXPECT_TRUE(evidence::at_most("V11", "contact in sub-steps", variant, "change of velocities against short steps",
                                  max(norm(o.left - fine.left), norm(o.right - fine.right)) / change, 0.02));
    EXPECT_TRUE(evidence::at_most("V11", "contact in sub-steps", variant, "largest overpressure against short steps",
                                  std::abs(o.highest - fine.highest) / (fine.highest - 1), 0.2));
  }
}

}  // namespace
}  // namespace brisance
