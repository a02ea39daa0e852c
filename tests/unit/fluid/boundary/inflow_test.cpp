#include "fluid/boundary/inflow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/advance.hpp"
#include "fluid/boundary/moving_front.hpp"
#include "fluid/initial_state.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

Gas air() { return {1.4, 1e-10, 1e-12}; }

InflowHistory ramp() { return {{{1, 2, 4}, {{{1, 0, 0, 0, 1}}, {{3, 2, 4, 6, 9}}, {{3, 2, 4, 6, 1}}}}, air()}; }

TEST(InflowHistory, IsLinearInDensityVelocityAndPressureBetweenItsEntries) {
  State const expected = air().conserved(1.5, {0.5, 1, 1.5}, 3), got = ramp().at(1.25).given;
  for (std::size_t q = 0; q < 5; ++q) EXPECT_DOUBLE_EQ(got[q], expected[q]);
  EXPECT_EQ(ramp().at(2).given, air().conserved(3, {2, 4, 6}, 9));
}

TEST(InflowHistory, IsConstantBeyondItsEnds) {
  EXPECT_EQ(ramp().at(-7).given, air().conserved(1, {}, 1));
  EXPECT_EQ(ramp().at(1).given, air().conserved(1, {}, 1));
  EXPECT_EQ(ramp().at(4).given, ramp().at(1e9).given);
  EXPECT_EQ(ramp().at(4).given, air().conserved(3, {2, 4, 6}, 1));
}

FlowConfig two_states(int dimension) {
  FlowConfig config = testing::unit_box(dimension, 10);
  config.boundary.x_low = "inflow";
  InflowState state;
  for (Real const t : {0.0, 1.0}) {
    TimedState entry;
    entry.time = t, entry.density = 1 + t, entry.pressure = 1 + 99 * t, entry.velocity = {3 * t, 0, 0};
    state.history.push_back(entry);
  }
  config.inflow.x_low = state;
  return config;
}

/// What enters in a sweep is the state of the middle of the step, on one or several ranks.
TEST(InflowHistory, TheSidesAreTakenInTheMiddleOfTheStep) {
  FlowConfig const config = two_states(2);
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, config);
  FlowClock clock;
  clock.time = 0.25;
  Real const dt = 0.001;
  advance(*flow, clock, {.end = 1, .cfl = 0.8, .steps = 2, .dt_max = dt});
  Block* const corner = flow->find(0);
  if (!corner) return;
  Real const share = 0.25 + 1.5 * dt;  // of the second step of the pair
  EXPECT_NEAR(corner->load(-1, 4, 0)[0], 1 + share, 1e-14);
}

TEST(InflowHistory, LimitsTheTimeStepBeforeItsSignalArrives) {
  FlowConfig const config = two_states(1);
  auto const flow = testing::make_flow(config, testing::comm());
  Boundaries const& sides = flow->boundaries();
  auto const speed = [&](Real t) { return 3 * t + std::sqrt(1.4 * (1 + 99 * t) / (1 + t)); };
  EXPECT_NEAR(sides.signal_speed(0, 0.25, 0.25), speed(0.25), 1e-12);
  EXPECT_NEAR(sides.signal_speed(0, 0.25, 0.75), speed(0.75), 1e-12);
  EXPECT_NEAR(sides.signal_speed(0, 0.25, 7), speed(1), 1e-12);
  Real const dt = side_time_step(*flow, 0.25, 0.8);
  EXPECT_LE(dt * sides.signal_speed(0, 0.25, 0.25 + dt), 0.08 * (1 + 1e-11));
  EXPECT_GT(dt, 0.9 * 0.08 / speed(0.27));
}

TEST(SideTimeStep, IsInfiniteWhereNoStateIsGiven) {
  FlowConfig config = testing::unit_box(2, 10);
  testing::set_boundaries(config, "far_field");
  EXPECT_EQ(side_time_step(*testing::make_flow(config, testing::comm()), 0, 0.8),
            std::numeric_limits<Real>::infinity());
}

TEST(MovingFront, SeparatesTwoStatesByAPlaneThatMoves) {
  Grid const grid = make_grid(testing::unit_box(2, 10));
  State const ahead{1, 0, 0, 0, 2}, behind{5, 1, 0, 0, 30};
  Real const root = std::sqrt(0.5);
  MovingFront const front{{&grid, {0.2, 1, 0}, {root, -root, 0}, ahead, behind}, 2};
  for (Real const time : {0.0, 0.1}) {
    Front const now = front.at(time);
    Real const moved = 2 * time * root;
    for (Index i = 0; i < 10; ++i)
      for (Index j = 10; j < 13; ++j) {
        Vec3 const x = grid.centre({i, j, 0});
        Real const distance = root * (x.x - 0.2 - moved) - root * (x.y - 1 + moved);
        State const u = now({}, {1, 1, {i, j, 0}});
        if (distance > 0.08) {
          EXPECT_EQ(u, ahead);
        } else if (distance < -0.08) {
          EXPECT_EQ(u, behind);
        }
        EXPECT_GE(u[0], 1);
        EXPECT_LE(u[0], 5);
      }
  }
}

TEST(MovingFront, CutGhostsHoldTheMeanByVolume) {
  Grid const grid = make_grid(testing::unit_box(1, 10));
  MovingFront const front{{&grid, {-0.125, 0, 0}, {1, 0, 0}, {1, 0, 0, 0, 2}, {5, 0, 0, 0, 10}}, 1};
  EXPECT_NEAR(front.at(0)({}, {0, 0, {-2, 0, 0}})[0], 1 + 4 * 0.75, 1e-12);
  EXPECT_EQ(front.at(0)({}, {0, 0, {-1, 0, 0}})[0], 1);
  EXPECT_NEAR(front.at(0.075)({}, {0, 0, {-1, 0, 0}})[0], 1 + 4 * 0.5, 1e-12);
  EXPECT_EQ(front.at(0.075)({}, {0, 0, {-2, 0, 0}})[0], 5);
}

}  // namespace
}  // namespace brisance::fluid
