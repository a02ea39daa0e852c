// The same bits on any number of ranks and for any dealing of particles.
#include <gtest/gtest.h>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

SolidConfig block() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {5, 4, 3}, {5, 4, 3}));
  config.body[0].clamp.push_back({{0, 0, 0}, {0, 4, 3}});
  config.gravity = Vec3{0, 0, -1e-3};
  return config;
}

SolidConfig tube() {
  SolidConfig config = testing::one_material(7860, 210e9, 0);
  BodyConfig b;
  b.material = "m";
  b.shape = "tube";
  b.tessellation = "polar";
  b.cells = {1, 50, 1};
  b.centre = Vec3{4, 3, 0};
  b.inner_radius = 1.0, b.outer_radius = 1.05, b.phase = 0.013;
  config.body.push_back(b);
  return config;
}

SolidConfig pebble() {
  SolidConfig config = testing::one_material(1, 1, 0.45);
  BodyConfig b;
  b.material = "m";
  b.shape = "sphere";
  b.tessellation = "voronoi";
  b.particles = 80;
  b.lloyd = 5;
  b.centre = Vec3{0, 0, 0};
  b.radius = 2.0;
  b.spin = {0.01, 0.02, 0.03};
  config.body.push_back(b);
  return config;
}

/// Three levels of steps, a clamped end, and a layer that moves as prescribed.
SolidConfig graded_bar(int dimension) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig bar = testing::box({0, 0, 0}, {5, 2, 2}, {1, 2, dimension == 3 ? 2 : 1});
  bar.layers_x = {1, 1, 0.5, 0.2, 0.1, 0.05, 0.1, 0.2, 0.5, 1, 1, 1};
  bar.clamp.push_back({{0, 0, 0}, {0, 2, 2}});
  bar.prescribed.push_back({{4.5, 0, 0}, {5, 2, 2}, {0, 0.01, 0}});
  config.body.push_back(bar);
  config.gravity = Vec3{0, 0, -1e-3};
  config.motion.multirate = MultirateConfig{4, {}};
  return config;
}

SolidConfig rough_pebble() {
  SolidConfig config = pebble();
  config.body[0].lloyd = 0;
  config.motion.multirate = MultirateConfig{3, {}};
  return config;
}

/// Digest, energy and first vertex after some steps from a random motion.
struct Outcome {
  parallel::Digest digest;
  Real energy = 0, estimated_limit = 0, work = 0;
  Vec3 impulse{};
  bool operator==(Outcome const&) const = default;
};

/// `struck`: only the particles below this number move at the start.
Outcome run(SolidConfig const& config, int dimension, std::vector<int> const& owner, parallel::Comm& comm,
            GlobalId struck = 1 << 30) {
  Mesh const mesh = build_mesh(config, dimension);
  Surface const surface(mesh);
  Solid solid(mesh, config, owner, comm, dimension, &surface);
  solid.let_sleep();
  Real step = solid.stable_step();
  comm.min(std::span(&step, 1));
  for (Index p = 0; p < solid.owned(); ++p) {
    if (solid.id(p) >= struck) continue;
    testing::Random random(static_cast<std::uint64_t>(solid.id(p)) + 1);
    random();
    Vec3 const v = random.vector();
    solid.motion()[static_cast<std::size_t>(p)].v += (0.01 / step * std::cbrt(mesh.shape(0).volume)) * v;
  }
  // Every vertex that an owned particle shares must be known here.
  bool all_known = true;
  for (Index v = 0; v < surface.vertices(); ++v)
    for (Corner const& c : surface.corners(v))
      if (solid.owner(c.particle) == comm.rank()) all_known = all_known && surface.known(v, solid);
  EXPECT_TRUE(all_known);
  solid.take_reactions();
  for (int n = 0; n < 40; ++n) solid.step(step);
  Outcome outcome;
  outcome.estimated_limit = solid.estimated_limit();
  solid.digest(outcome.digest);
  comm.sum(outcome.digest);
  Measures m;
  solid.measure(m);
  comm.sum(std::span(m.sums));
  Reactions reactions = solid.take_reactions();
  comm.sum(std::span(reactions.sums));
  outcome.impulse = reactions.impulse();
  outcome.work = reactions.work();
  outcome.energy = m.value(Measures::kinetic) + m.value(Measures::elastic);
  return outcome;
}

void expect_same(SolidConfig const& config, int dimension) {
  Mesh const mesh = build_mesh(config, dimension);
  auto const alone = parallel::serial();
  Outcome const reference = run(config, dimension, testing::slices(mesh, 1), *alone);
  EXPECT_TRUE(std::isfinite(reference.energy));
  parallel::Comm& comm = testing::comm();
  EXPECT_EQ(run(config, dimension, testing::slices(mesh, comm.size()), comm), reference);
  std::vector<int> scattered;
  for (GlobalId p = 0; p < mesh.size(); ++p) scattered.push_back(static_cast<int>(p * 7 % 5 % comm.size()));
  EXPECT_EQ(run(config, dimension, scattered, comm), reference);
}

TEST(SolidBits, OfABarAndABallThatSleepUntilAWaveComes) {
  SolidConfig config = pebble();
  config.body[0].spin = {};
  config.body[0].centre = Vec3{30, 5, 5};
  config.body.push_back(testing::box({0, 0, 0}, {60, 3, 3}, {60, 3, 3}));
  SolidConfig awake = config;
  awake.sleep = false;
  Mesh const mesh = build_mesh(config, 3);
  auto const alone = parallel::serial();
  Outcome const reference = run(awake, 3, testing::slices(mesh, 1), *alone, 5);
  EXPECT_EQ(run(config, 3, testing::slices(mesh, 1), *alone, 5), reference);
  parallel::Comm& comm = testing::comm();
  EXPECT_EQ(run(config, 3, testing::slices(mesh, comm.size()), comm, 5), reference);
  std::vector<int> scattered;
  for (GlobalId p = 0; p < mesh.size(); ++p) scattered.push_back(static_cast<int>(p * 7 % 5 % comm.size()));
  EXPECT_EQ(run(config, 3, scattered, comm, 5), reference);
}
TEST(SolidBits, OfAClampedBlock) { expect_same(block(), 3); }
TEST(SolidBits, OfATubeInThePlane) { expect_same(tube(), 2); }
TEST(SolidBits, OfAVoronoiBall) { expect_same(pebble(), 3); }
TEST(SolidBits, OfAGradedBarWithStepsOfItsOwnForEachLevel) { expect_same(graded_bar(3), 3); }
TEST(SolidBits, OfAGradedStripInThePlane) { expect_same(graded_bar(2), 2); }
TEST(SolidBits, OfAVoronoiBallWithStepsOfItsOwnForEachLevel) { expect_same(rough_pebble(), 3); }

}  // namespace
}  // namespace brisance::solid
