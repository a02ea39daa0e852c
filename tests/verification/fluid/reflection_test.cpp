// F28 of theory/fluid.md 6: what open sides send back of a simple wave that leaves the domain.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

/// Largest deviation of the density from the quiet gas, relative to the amplitude, once a right-going pulse has left.
Real residue(std::string const& law, Real mach, Real amplitude) {
  FlowConfig config = testing::unit_box(1, 200);
  testing::set_boundaries(config, law);
  auto const flow = testing::make_flow(config, testing::comm());
  IdealGas const& gas = flow->gas();
  Real const c0 = std::sqrt(gas.gamma);
  fill(*flow, [&](CellIndex c) {
    Real const s = (flow->grid().centre(c).x - 0.5) / 0.08;
    Real const density = 1 + amplitude * std::exp(-s * s);
    Real const pressure = std::pow(density, gas.gamma), sound = std::sqrt(gas.gamma * pressure / density);
    return gas.conserved(density, {mach * c0 + 2 / gas.kappa() * (sound - c0), 0, 0}, pressure);
  });
  FlowClock clock;
  advance(*flow, clock, {.end = 0.9 / (c0 * (1 + mach)), .cfl = 0.9});
  Real largest = 0;
  for (Block const& block : flow->blocks())
    for (Index i = 0; i < block.size()[0]; ++i) largest = max(largest, std::abs(block.load(i, 0, 0)[0] - 1));
  return largest / amplitude;
}

TEST(Reflection, OutflowLetsSimpleWavesLeave) {
  struct Case {
    Real mach, amplitude, reference;
  };
  for (Case const c : {Case{0, 1e-4, 2.5e-7}, Case{0, 1e-2, 2.4e-5}, Case{0, 0.3, 4.8e-3}, Case{0.3, 1e-2, 2.5e-5},
                       Case{0.3, 0.3, 4.1e-3}}) {
    char variant[64];
    std::snprintf(variant, sizeof variant, "outflow Mach %g amplitude %g", c.mach, c.amplitude);
    // The table states neither the Courant number nor the place of the pulse, which move the residue by factors of two:
    // its order of magnitude is checked. Extrapolation, the wrong law, lies a factor 400 higher.
    EXPECT_TRUE(evidence::at_most("F28", "reflection", variant, "residue / amplitude",
                                  residue("outflow", c.mach, c.amplitude), 3 * c.reference));
  }
}

TEST(Reflection, WallSendsWavesBack) {
  EXPECT_TRUE(evidence::near("F28", "reflection", "wall amplitude 1e-2", "residue / amplitude",
                             residue("reflecting", 0, 1e-2), 1, 0.01));
  // The pulse steepens into a shock on its way: 0.825 to 0.832 for Courant numbers 0.8 to 0.9.
  EXPECT_TRUE(evidence::near("F28", "reflection", "wall amplitude 0.3", "residue / amplitude",
                             residue("reflecting", 0, 0.3), 0.82, 0.02));
}

}  // namespace
}  // namespace brisance::fluid
