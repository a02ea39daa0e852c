// What supports and damping do is in the account, with and without a gas.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/coupled_case.hpp"
#include "tests/support/evidence.hpp"

namespace brisance {
namespace {

std::string scene(std::string const& name) {
  std::ifstream file(BRISANCE_SOURCE_DIR "/tests/support/scenes/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Real largest_momentum_defect(Conservation const& c) { return max(c.momentum.x, max(c.momentum.y, c.momentum.z)); }

TEST(MovingSupports, TheirWorkReachesTheGas) {
  auto run = [](std::string const& cfl) {
    testing::CoupledCase paddle(scene("paddle.toml"), {"fluid.euler.cfl=" + cfl});
    paddle.run();
    Ledger const& ledger = paddle.simulation().ledger();
    EXPECT_GT(ledger.received(Entry::in_energy), 0);
    return paddle.conservation();
  };
  Conservation const coarse = run("0.4"), fine = run("0.2");
  EXPECT_TRUE(evidence::at_most("V2", "moving supports", "paddle and plate", "momentum defect",
                                max(largest_momentum_defect(coarse), largest_momentum_defect(fine)), 1e-14));
  EXPECT_TRUE(evidence::at_most("V2", "moving supports", "paddle and plate", "exchange energy defect",
                                max(coarse.exchange_energy, fine.exchange_energy), 1e-14));
  EXPECT_LT(coarse.energy, 1e-3);
  EXPECT_NEAR(coarse.energy / fine.energy, 4, 0.8);
}

TEST(MovingSupports, DampingAndSupportsBalanceWithoutAGas) {
  auto run = [](std::string const& damping, std::string const& cfl) {
    testing::CoupledCase bodies(scene("supports.toml"), {"solid.damping=" + damping, "solid.motion.cfl=" + cfl});
    bodies.run();
    EXPECT_GT(bodies.simulation().ledger().received(Entry::dissipated), 0);
    EXPECT_LT(largest_momentum_defect(bodies.conservation()), 1e-14);
    return bodies.conservation().energy;
  };
  for (std::string const damping : {R"({ rate = 200, relative_to = "bodies", until = 0.03 })", "{ rate = 100 }"}) {
    Real const coarse = run(damping, "0.4"), fine = run(damping, "0.2");
    EXPECT_LT(coarse, 5e-3);
    EXPECT_NEAR(coarse / fine, 4, 0.8) << damping;
  }
  // A stop is another one when steps are halved, so that no ratio is asked for.
  EXPECT_LT(run(R"({ law = "kinetic" })", "0.2"), 2e-3);
}

}  // namespace
}  // namespace brisance
