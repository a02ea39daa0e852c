#include "fluid/sleep.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

Block uniform_block(int dimension, Index n, State const& u) {
  FlowConfig const config = testing::unit_box(dimension, n);
  Block block(make_grid(config), 0, 3);
  block.fill({-1, -1, -1, -1, -1});  // ghosts do not count
  for (Index k = 0; k < block.size()[2]; ++k)
    for (Index j = 0; j < block.size()[1]; ++j)
      for (Index i = 0; i < block.size()[0]; ++i) block.store(i, j, k, u);
  return block;
}

TEST(UniformBlocks, SeesEveryBitOfEveryCell) {
  State const u{1.2, 0, 0.5, -3, 9};
  for (int dimension : {1, 2, 3}) {
    Block block = uniform_block(dimension, 7, u);
    UniformBlocks blocks(1);
    EXPECT_EQ(blocks.state(0), nullptr) << "not looked at";
    blocks.look(0, block);
    ASSERT_NE(blocks.state(0), nullptr);
    EXPECT_TRUE(same_bits(*blocks.state(0), u));
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j)
        for (Index i = 0; i < block.size()[0]; ++i)
          for (std::size_t q = 0; q < 5; ++q) {
            State other = u;  // the smallest change: one unit in the last place, or the sign of a zero
            other[q] = u[q] == 0 ? -0.0 : std::nextafter(u[q], 10);
            block.store(i, j, k, other);
            blocks.changed(0);
            EXPECT_EQ(blocks.state(0), nullptr);
            blocks.look(0, block);
            EXPECT_EQ(blocks.state(0), nullptr) << i << " " << j << " " << k << " component " << q;
            block.store(i, j, k, u);
            blocks.changed(0);
            blocks.look(0, block);
            EXPECT_NE(blocks.state(0), nullptr) << i << " " << j << " " << k << " component " << q;
          }
  }
}

UniformSweeps::Outcome outcome(int order, int direction, State const& inside, State const& low, State const& high,
                               Gas const& gas, Index cells = 20) {
  UniformSweeps sweeps;
  sweeps.begin(order, 3, direction, 0.1, gas);
  return sweeps.find(inside, low, high, cells);
}

TEST(UniformSweeps, UniformGasAtAnySpeedAndVacuumStayAsTheyAre) {
  Gas const gas{1.4, 1e-10, 1e-12};
  for (int order : {1, 3, 5, 7, 9, 11})
    for (int direction : {0, 1, 2})
      for (State const& u : {gas.conserved(1.2, {}, 1), gas.conserved(1, {0.3, -2, 1.7}, 1), State{}}) {
        EXPECT_TRUE(outcome(order, direction, u, u, u, gas).unchanged) << order << " " << direction;
        EXPECT_TRUE(outcome(order, direction, u, u, u, gas, 3).unchanged) << order << " " << direction;
      }
}

TEST(UniformSweeps, AWallMattersWhereGasRunsAgainstItOnly) {
  Gas const gas{1.4, 1e-10, 1e-12};
  Reflecting const wall;
  for (int order : {1, 5, 11})
    for (int direction : {0, 1, 2})
      for (int moving : {0, 1, 2}) {
        Vec3 v{};
        v[moving] = 0.2;
        State const u = gas.conserved(1, v, 1), rest = gas.conserved(1, {}, 1);
        bool const still = moving != direction;
        EXPECT_EQ(outcome(order, direction, u, wall(u, GhostCell{direction, 0, {}}), u, gas).unchanged, still);
        EXPECT_EQ(outcome(order, direction, u, u, wall(u, GhostCell{direction, 0, {}}), gas).unchanged, still);
        EXPECT_TRUE(outcome(order, direction, rest, wall(rest, GhostCell{direction, 0, {}}),
                            wall(rest, GhostCell{direction, 0, {}}), gas)
                        .unchanged);
      }
}

TEST(UniformSweeps, AnythingElseAtAnEndWakes) {
  Gas const gas{1.4, 1e-10, 1e-12};
  State const u = gas.conserved(1, {0.1, 0, 0}, 1);
  State warmer = u;
  warmer[4] *= 1 + 1e-12;
  for (int order : {1, 5, 11}) {
    EXPECT_FALSE(outcome(order, 0, u, warmer, u, gas).unchanged);
    EXPECT_FALSE(outcome(order, 0, u, u, warmer, gas).unchanged);
    EXPECT_FALSE(outcome(order, 0, u, State{}, u, gas).unchanged);
  }
}

TEST(UniformSweeps, WhatIsUnwellIsSweptSoThatItIsReported) {
  Gas const gas{1.4, 1e-10, 1e-12};
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  State const bad[] = {{1, 0, 0, 0, nan}, {-1, 0, 0, 0, 1}, {1, 0, 0, 0, -1}};
  for (State const& u : bad) EXPECT_FALSE(outcome(5, 0, u, u, u, gas).unchanged);
  State const fast = gas.conserved(1, {20, 0, 0}, 1);  // Courant number 2
  EXPECT_FALSE(outcome(5, 0, fast, fast, fast, gas).unchanged);
}

TEST(SumOfEqual, IsTheSumOneByOne) {
  State const flux{0.1, -0.0, 1e-17, 3, 1.0 / 3};
  State sum{};
  for (int n = 0; n < 7; ++n)
    for (std::size_t q = 0; q < 5; ++q) sum[q] += flux[q];
  EXPECT_EQ(sum_of_equal(flux, 7), sum);
}

}  // namespace
}  // namespace brisance::fluid
