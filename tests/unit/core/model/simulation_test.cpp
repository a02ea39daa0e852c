#include "core/model/simulation.hpp"

#include <gtest/gtest.h>

#include "parallel/error.hpp"

namespace brisance {
namespace {

/// A state that bears steps up to a bound.
struct Delicate {
  std::unique_ptr<parallel::Comm> comm = parallel::serial();
  Plan plan;
  Real bound = 1;
  Simulation simulation{plan, *comm, {1e9, 1, 0}};

  Delicate() {
    plan.effect("test", [] { return std::size_t{0}; });
    plan.limit("test", [](Clock const&) { return 1.0; });
    plan.health([this](Clock const& clock) { return Verdict{clock.dt <= bound, "too large a step for the test"}; });
    plan.keep(
        {[](parallel::ArchiveWriter&) {}, [](parallel::ArchiveReader&) {}, [] {}, [] {}, [](parallel::Digest&) {}});
  }
};

TEST(Simulation, ARejectedPairIsRedoneSmallerAndTheStepRecovers) {
  Delicate run;
  run.simulation.pair();
  EXPECT_EQ(run.simulation.clock().time, 1);
  run.bound = 0.3;
  run.simulation.pair();
  EXPECT_EQ(run.simulation.clock().time, 1.25);
  EXPECT_EQ(run.simulation.statistics().retries, 2);
  run.bound = 1;
  run.simulation.pair();
  EXPECT_EQ(run.simulation.clock().time, 1.75);
  run.simulation.pair();
  EXPECT_EQ(run.simulation.clock().time, 2.75);
}

TEST(Simulation, EverSmallerStepsEndTheRunWithTheCause) {
  Delicate run;
  try {
    for (int pairs = 0; pairs < 100; ++pairs) {
      run.simulation.pair();
      run.bound *= 0.2;  // each pair passes after a few halvings
    }
    FAIL() << "100 pairs, the last with dt = " << run.simulation.clock().dt;
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), Failure::numerical);
    EXPECT_NE(std::string(error.what()).find("too large a step for the test (step "), std::string::npos)
        << error.what();
  }
  EXPECT_GT(run.simulation.statistics().dt_min, 1e-7);
}

}  // namespace
}  // namespace brisance
