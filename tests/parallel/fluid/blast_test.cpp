// A blast over many blocks has the same bits on any number of ranks, and in blocks of any size.
#include <gtest/gtest.h>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

struct Result {
  std::string digest;
  State through{};  // the sides of the domain, all components
  Real energy = 0;
  std::int64_t fallback_faces = 0;
  bool operator==(Result const&) const = default;
};

Result blast(FlowConfig const& config, parallel::Comm& comm) {
  auto const flow = testing::make_flow(config, comm);
  fill(*flow, config);
  FlowClock clock;
  advance(*flow, clock, {.end = 1e9, .cfl = config.euler->cfl, .steps = 20});
  EXPECT_EQ(clock.step, 20);
  parallel::Digest digest;
  add_cells(digest, *flow);
  comm.sum(digest);
  return {digest.hex(), flow->ledger().totals(comm).gained, totals(*flow).energy, clock.fallback_faces};
}

/// An off-centre charge beside a wall and an open side, in moving gas, so that nothing is symmetric.
FlowConfig blast_scene(int dimension, int cells, int order) {
  FlowConfig config = testing::unit_box(dimension, cells);
  config.cells[0] += 5;
  config.ambient = {1, 1, {0.3, -0.2, dimension > 2 ? 0.1 : 0.0}};
  config.euler->order = order;
  config.boundary.x_high = "outflow";
  config.boundary.y_low = config.boundary.y_high = "periodic";
  RegionConfig ball;
  ball.shape = "ball";
  ball.centre = Vec3{0.8, 0.12, 0.43};
  ball.radius = 0.22;
  ball.density = 5;
  ball.pressure = 200;
  config.region = {ball};
  return config;
}

void expect_equal_bits(FlowConfig config, std::initializer_list<int> sides) {
  // One rank of its own, whatever the number of ranks of the test, is the answer to compare with.
  auto const alone = parallel::serial();
  std::string cells;
  for (int const side : sides) {
    config.block = side;
    Result const one = blast(config, *alone);
    Result const here = blast(config, testing::comm());
    EXPECT_EQ(here.digest, one.digest) << "block " << side;
    EXPECT_EQ(here.through, one.through) << "block " << side;
    EXPECT_EQ(here.energy, one.energy) << "block " << side;
    EXPECT_EQ(here.fallback_faces, one.fallback_faces) << "block " << side;
    if (cells.empty()) cells = one.digest;
    EXPECT_EQ(one.digest, cells) << "block " << side;
  }
}

TEST(Blast, HasTheSameBitsOnAnyRanksAndBlocksInTwoDimensions) {
  for (int order : {1, 5, 11}) expect_equal_bits(blast_scene(2, 64, order), {16, 24, 48});
}

TEST(Blast, HasTheSameBitsOnAnyRanksAndBlocksInThreeDimensions) {
  expect_equal_bits(blast_scene(3, 32, 5), {16, 24, 48});
  expect_equal_bits(blast_scene(3, 24, 11), {16, 48});
}

TEST(Blast, HasTheSameBitsOnAnyRanksAndBlocksInOneDimension) {
  FlowConfig config = blast_scene(1, 100, 7);
  expect_equal_bits(config, {16, 24, 48});
}

}  // namespace
}  // namespace brisance::fluid
