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

/// Digest, energy and first vertex after some steps from a random motion.
struct Outcome {
  parallel::Digest digest;
  Real energy = 0;
  bool operator==(Outcome const&) const = default;
};

Outcome run(SolidConfig const& config, int dimension, std::vector<int> const& owner, parallel::Comm& comm) {
  Mesh const mesh = build_mesh(config, dimension);
  Surface const surface(mesh);
  Solid solid(mesh, config, owner, comm, dimension, &surface);
  Real step = solid.stable_step();
  comm.min(std::span(&step, 1));
  for (Index p = 0; p < solid.owned(); ++p) {
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
  for (int n = 0; n < 40; ++n) solid.step(step);
  Outcome outcome;
  solid.digest(outcome.digest);
  comm.sum(outcome.digest);
  Measures m;
  solid.measure(m);
  comm.sum(std::span(m.sums));
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

TEST(SolidBits, OfAClampedBlock) { expect_same(block(), 3); }
TEST(SolidBits, OfATubeInThePlane) { expect_same(tube(), 2); }
TEST(SolidBits, OfAVoronoiBall) { expect_same(pebble(), 3); }

}  // namespace
}  // namespace brisance::solid
