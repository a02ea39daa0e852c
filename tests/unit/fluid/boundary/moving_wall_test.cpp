#include "fluid/boundary/moving_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/advance.hpp"
#include "fluid/boundary/boundary_config.hpp"
#include "fluid/initial_state.hpp"
#include "parallel/error.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

TEST(MovingWall, AtRestIsTheReflectingWallBitForBit) {
  State const u{1.3, 0.7, -0.2, 0.9, 4.1};
  for (int d = 0; d < 3; ++d) EXPECT_EQ(MovingWall{0}(u, {d, 1}), Reflecting{}(u, {d, 1}));
  EXPECT_EQ(MovingWall{2}(State{}, {0, 0}), State{});  // vacuum stays vacuum
}

TEST(MovingWall, MirrorsTheNormalVelocityInItsOwnFrameAndKeepsTheRest) {
  Gas const gas{1.4, 1e-10, 1e-12};
  State const u = gas.conserved(2, {1, 3, -4}, 5), expected = gas.conserved(2, {1, -2, -4}, 5);
  State const ghost = MovingWall{0.5}(u, {1, 0});
  for (std::size_t q = 0; q < 5; ++q) EXPECT_NEAR(ghost[q], expected[q], 1e-13);
}

TEST(MovingWall, GasThatMovesWithItStaysUniform) {
  for (int dimension : {1, 2, 3}) {
    FlowConfig config = testing::unit_box(dimension, 12);
    config.ambient.velocity = {0.3, -0.2, 0.1};
    testing::set_boundaries(config, "moving_wall");
    auto const motion = [](Real speed) {
      WallMotion wall;
      wall.speed = speed;
      return wall;
    };
    config.moving_wall = {motion(0.3), motion(0.3), motion(-0.2), motion(-0.2), motion(0.1), motion(0.1)};
    auto const flow = testing::make_flow(config, testing::comm());
    fill(*flow, config);
    State const initial = flow->gas().conserved(1, config.ambient.velocity, 1);
    FlowClock clock;
    advance(*flow, clock, {.end = 10, .cfl = 0.8, .steps = 8});
    for (Block const& block : flow->blocks()) EXPECT_EQ(block.load(0, 0, 0), initial);
    for (Block const& block : flow->blocks()) EXPECT_EQ(block.load(block.size()[0] - 1, 0, 0), initial);
  }
}

WallHistory history(std::vector<Real> times, std::vector<Real> speeds) {
  WallHistory wall;
  wall.table.times = std::move(times);
  for (Real const v : speeds) wall.table.values.push_back({v});
  return wall;
}

TEST(WallHistory, KnowsHowFarItGoes) {
  EXPECT_DOUBLE_EQ(history({0}, {-2}).largest_displacement(3), 6);
  EXPECT_DOUBLE_EQ(history({1, 2}, {0, 2}).largest_displacement(1.5), 0.25);
  EXPECT_DOUBLE_EQ(history({0, 2}, {1, -1}).largest_displacement(2), 0.5);  // where it turns
  EXPECT_DOUBLE_EQ(history({0, 2}, {1, -1}).largest_displacement(4), 2);    // and then beyond its start
  EXPECT_DOUBLE_EQ(history({-5, -1}, {7, 1}).largest_displacement(2), 2);   // what was before time 0 does not count
}

TEST(MovingWalls, ThatLeaveTheirCellAreRefused) {
  FlowConfig config = testing::unit_box(1, 10);
  config.boundary.x_low = "moving_wall";
  config.moving_wall.x_low.emplace().speed = 0.5;
  Grid const grid = make_grid(config);
  EXPECT_NO_THROW(check_walls(config, grid, 0.19));
  try {
    check_walls(config, grid, 0.21);
    FAIL();
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    EXPECT_NE(std::string(e.what()).find("moves by 0.105 m"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace brisance::fluid
