#include "fluid/survey.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

/// Whatever the length of the rows: all cells, and nothing of what stands beside them.
void expect_survey(int dimension, Index n, Gas const& gas) {
  Block block(make_grid(testing::unit_box(dimension, n)), 0, 3);
  block.fill(gas.conserved(1e-3, {900, 900, 900}, 1e4));  // ghosts and padding would be the extremes of everything
  Survey expected;
  Index count = 0;
  for (Index k = 0; k < block.size()[2]; ++k)
    for (Index j = 0; j < block.size()[1]; ++j)
      for (Index i = 0; i < block.size()[0]; ++i, ++count) {
        Vec3 const v{std::sin(count), 2 * std::cos(3 * count), dimension > 2 ? std::sin(5 * count) : 0};
        Real const density = 1 + 0.5 * std::sin(7 * count), pressure = 2 + std::cos(11 * count);
        State const u = count % 9 == 4 ? gas.conserved(0, {}, 0) : gas.conserved(density, v, pressure);
        block.store(i, j, k, u);
        for (std::size_t q = 0; q < 5; ++q) expected.sum[q] += u[q];
        expected.momentum_size += std::sqrt(u[1] * u[1] + u[2] * u[2] + u[3] * u[3]);
        if (gas.vacuum(u)) continue;
        Real const c = gas.sound_speed(u);
        for (int d = 0; d < 3; ++d) {
          Real& speed = expected.speed[static_cast<std::size_t>(d)];
          speed = max(speed, std::abs(v[d]) + c);
        }
        expected.density_min = min(expected.density_min, density);
        expected.pressure_min = min(expected.pressure_min, pressure);
        expected.mach_max = max(expected.mach_max, norm(v) / c);
      }
  Survey const seen = survey(block, gas);
  Real const round_off = 1e-13 * count;
  for (std::size_t q = 0; q < 5; ++q)
    EXPECT_NEAR(seen.sum[q], expected.sum[q], round_off * (1 + gas.curve.stiffness)) << n << " component " << q;
  EXPECT_NEAR(seen.momentum_size, expected.momentum_size, round_off);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(seen.speed[d], expected.speed[d], 1e-12 * expected.speed[d]);
  EXPECT_NEAR(seen.density_min, expected.density_min, 0);
  EXPECT_NEAR(seen.pressure_min, expected.pressure_min, 1e-11 * (1 + gas.curve.stiffness));
  EXPECT_NEAR(seen.mach_max, expected.mach_max, 1e-12 * expected.mach_max);
}

TEST(Survey, SeesTheCellsAndNothingElse) {
  Gas const ideal{1.4, 1e-10, 1e-12};
  Gas stiff{4.4, 1e-10, 1e-12};
  stiff.curve.stiffness = 6;
  Gas jwl{1.3, 1e-10, 1e-12};
  jwl.curve = {0, 3, 0.1, 4.15, 0.95, 1.6};
  for (Gas const& gas : {ideal, stiff, jwl})
    for (int dimension : {1, 2, 3})
      for (Index n : {3, 7, 8, 9, 17}) expect_survey(dimension, n, gas);
}

TEST(Survey, VacuumHasNoSpeedsAndNoExtremes) {
  Block block(make_grid(testing::unit_box(2, 9)), 0, 3);
  Survey const seen = survey(block, Gas{1.4, 1e-10, 1e-12});
  EXPECT_EQ(seen.speed, (std::array<Real, 3>{}));
  EXPECT_EQ(seen.mach_max, 0);
  EXPECT_EQ(seen.density_min, std::numeric_limits<Real>::infinity());
  EXPECT_EQ(seen.pressure_min, std::numeric_limits<Real>::infinity());
}

TEST(Survey, OfAFlowFollowsWhatIsWrittenAndSwept) {
  auto const comm = parallel::serial();
  FlowConfig config = testing::unit_box(2, 16);
  config.block = 8;
  auto const flow = testing::make_flow(config, *comm);
  Flow const& seen = *flow;
  EXPECT_EQ(seen.survey(3).sum[0], 64);
  EXPECT_EQ(seen.survey(3).mach_max, 0);
  flow->find(3)->store(0, 4, 0, {3, 0, 0, 0, 9});
  EXPECT_EQ(seen.survey(3).sum[0], 66);
  flow->save();
  flow->sweep(0, 1e-2);
  EXPECT_GT(seen.survey(2).mach_max, 0) << "waves reached the block beside";
  EXPECT_GT(seen.survey(3).mach_max, 0);
  flow->restore();
  EXPECT_EQ(seen.survey(2).mach_max, 0);
  EXPECT_EQ(seen.survey(3).sum[0], 66);
}

}  // namespace
}  // namespace brisance::fluid
