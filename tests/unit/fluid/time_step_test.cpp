#include "fluid/time_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fluid/initial_state.hpp"
#include "parallel/comm.hpp"
#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

/// Whole sweeps as capitals, half ones as small letters.
std::string sequence(int dimension, int steps, Splitting splitting) {
  std::string text;
  for (int n = 0; n < steps; ++n) {
    for (Sweep const& s : sweeps(dimension, n, splitting)) text += (s.share == 1 ? "XYZ" : "xyz")[s.direction];
    text += ' ';
  }
  return text;
}

TEST(Sweeps, ArePalindromicPairsThatRotateInThreeDimensions) {
  EXPECT_EQ(sequence(1, 2, Splitting::pair), "X X ");
  EXPECT_EQ(sequence(2, 4, Splitting::pair), "XY YX XY YX ");
  EXPECT_EQ(sequence(3, 8, Splitting::pair), "XYZ ZYX YZX XZY ZXY YXZ XYZ ZYX ");
  EXPECT_EQ(sequence(1, 2, Splitting::merged), "X X ");
  EXPECT_EQ(sequence(2, 4, Splitting::merged), "xYX Yx yXY Xy ");
  EXPECT_EQ(sequence(3, 6, Splitting::merged), "xyZyX yZyx yzXzY zXzy zxYxZ xYxz ");
}

TEST(Sweeps, TakeTheSidesInTheMiddleOfTheirOwnTime) {
  for (int dimension : {1, 2, 3})
    for (Splitting splitting : {Splitting::pair, Splitting::merged})
      for (std::int64_t first : {0, 2, 4}) {
        std::array<Real, 3> reached{};  // time of each direction, in time steps
        for (std::int64_t s = 0; s < 2; ++s)
          for (Sweep const& sweep : sweeps(dimension, first + s, splitting)) {
            auto const d = static_cast<std::size_t>(sweep.direction);
            EXPECT_EQ(reached[d] + 0.5 * sweep.share, static_cast<Real>(s) + sweep.middle);
            reached[d] += sweep.share;
          }
        for (int d = 0; d < dimension; ++d) EXPECT_EQ(reached[static_cast<std::size_t>(d)], 2);
      }
}

/// Random gas with vacuum cells here and there.
State random_state(std::mt19937& random, Gas const& gas) {
  std::uniform_real_distribution<Real> unit(0, 1);
  Real const kind = unit(random);
  if (kind < 0.1) return {0, 0, 0, 0, 0};
  if (kind < 0.2) return {1e-11, 1, 0, 0, 1};
  Real const rho = std::pow(10, 4 * unit(random) - 2), p = std::pow(10, 4 * unit(random) - 2);
  return gas.conserved(rho, {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5}, p);
}

TEST(SignalSpeeds, AreTheLargestOverGasCells) {
  auto const comm = parallel::serial();
  FlowConfig config = testing::unit_box(3, 21);
  config.block = 11;
  auto const flow = testing::make_flow(config, *comm);
  std::mt19937 random(7);
  std::array<Real, 3> expected{}, masked{};
  std::vector<std::uint8_t> mask(11 * 11 * 11, 0);
  for (std::size_t m = 0; m < mask.size(); m += 3) mask[m] = 1;
  Index const masked_block = 1;
  for (Block& block : flow->blocks()) {
    block.fill({1e-3, 1e3, 1e3, 1e3, 1e12});  // ghosts and padding must not count
    std::size_t at = 0;
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j)
        for (Index i = 0; i < block.size()[0]; ++i, ++at) {
          State const u = random_state(random, flow->gas());
          block.store(i, j, k, u);
          if (flow->gas().vacuum(u)) continue;
          for (std::size_t d = 0; d < 3; ++d) {
            Real const s = std::abs(u[1 + d] / u[0]) + flow->gas().sound_speed(u);
            expected[d] = max(expected[d], s);
            if (block.id() != masked_block || mask[at] == 0) masked[d] = max(masked[d], s);
          }
        }
  }
  auto const speeds = signal_speeds(*flow);
  auto const skipping = signal_speeds(*flow, CellMask([&](Index block) -> std::uint8_t const* {
    return block == masked_block ? mask.data() : nullptr;
  }));
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(speeds[d], expected[d], 1e-12 * expected[d]);
    EXPECT_NEAR(skipping[d], masked[d], 1e-12 * masked[d]);
  }
}

TEST(TimeStep, EachDirectionHasItsOwnLimit) {
  FlowConfig config = testing::unit_box(2, 10);
  config.high.y = 0.5;
  Grid const grid = make_grid(config);
  EXPECT_DOUBLE_EQ(acoustic_time_step(grid, {2, 1.5, 0}, 0.5), 0.5 * 0.05 / 1.5);
  EXPECT_EQ(limiting_direction(grid, {2, 1.5, 0}), 1);
  EXPECT_TRUE(std::isinf(acoustic_time_step(grid, {0, 0, 0}, 0.5)));
}

TEST(TimeStep, StartsSlowly) {
  EXPECT_EQ(courant_number(1, 4, 0.9), 0.3);
  EXPECT_EQ(courant_number(1, 5, 0.9), 0.9);
  EXPECT_EQ(courant_number(2, 9, 0.9), 0.2);
  EXPECT_EQ(courant_number(3, 10, 0.9), 0.9);
  EXPECT_EQ(courant_number(3, 0, 0.1), 0.1);
}

TEST(TimeStep, APairIsShortenedAsAWholeToHitTheEnd) {
  PairStep const last = shorten(1.0, 1.5, 0.4, 2);
  EXPECT_TRUE(last.reaches_end);
  EXPECT_EQ(last.dt, 0.25);
  EXPECT_FALSE(shorten(1.0, 2.0, 0.4, 2).reaches_end);
}

TEST(Retry, HalvesTenTimesThenGivesUpAndDoublesBack) {
  Retry retry;
  for (int n = 0; n < 10; ++n) EXPECT_TRUE(retry.reject());
  EXPECT_FALSE(retry.reject());
  Retry other;
  other.reject();
  other.reject();
  EXPECT_EQ(other.factor(), 0.25);
  other.accept();
  EXPECT_EQ(other.factor(), 0.5);
  other.accept();
  other.accept();
  EXPECT_EQ(other.factor(), 1);
  EXPECT_EQ(other.rejected(), 2);
}

}  // namespace
}  // namespace brisance::fluid
