#include "core/solid/solid.hpp"

#include <gtest/gtest.h>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;

TEST(Solid, KeepsMomentumAngularMomentumAndEnergy) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {6, 2, 2}, {6, 2, 2}));
  config.body[0].velocity = {0.1, 0.2, -0.1};
  config.body[0].spin = {0.02, 0.01, 0.06};
  Lone body(config);
  for (std::size_t p = 0; p < body.solid.motion().size(); ++p)
    body.solid.motion()[p].v.y += 0.01 * std::sin(body.solid.pose()[p].x.x);
  auto const before = body.measure();
  Real const energy = body.energy();
  Real const dt = 0.5 * body.solid.stable_step();
  for (int n = 0; n < 400; ++n) body.solid.step(dt);
  auto const after = body.measure();
  Real const scale = before.value(Measures::momentum_scale);
  EXPECT_NEAR(norm(after.vector(Measures::momentum) - before.vector(Measures::momentum)) / scale, 0, 1e-13);
  EXPECT_NEAR(norm(after.vector(Measures::angular) - before.vector(Measures::angular)) / (6 * scale), 0, 1e-13);
  EXPECT_NEAR(body.energy() / energy, 1, 2e-3);
}

TEST(Solid, BrokenLinksLowerTheEnergyAndComeBackWithARestore) {
  for (Real const nu : {-0.9, 0.0, 0.45}) {
    SolidConfig config = testing::one_material(1, 1, nu);
    config.body.push_back(testing::box({0, 0, 0}, {3, 3, 2}, {3, 3, 2}));
    Lone body(config);
    body.solid.allow_damage();
    testing::Random random(7);
    for (Pose& p : body.solid.pose()) p.x += 0.1 * random.vector();
    body.solid.compute_forces();
    Solid::Saved whole;
    body.solid.save(whole);
    auto const elastic = [&] { return body.measure().value(Measures::elastic); };
    Real const before = elastic();
    Real last = before;
    for (Real const intact : {0.6, 0.0})
      for (std::size_t k : {std::size_t{3}, std::size_t{11}, std::size_t{20}}) {
        body.solid.weaken(k, intact);
        body.solid.compute_forces();
        EXPECT_LT(elastic(), last) << "nu " << nu << ", link " << k;
        last = elastic();
      }
    Link const& broken = body.mesh.links[body.solid.mesh_link(11)];
    EXPECT_FALSE(body.solid.linked(broken.i, broken.j));
    Vec3 sum{};
    for (Wrench const& w : body.solid.internal()) sum += w.force;
    EXPECT_NEAR(norm(sum), 0, 1e-14);
    body.solid.restore(whole);
    body.solid.compute_forces();
    EXPECT_EQ(elastic(), before);
    EXPECT_TRUE(std::equal(whole.wrench.begin(), whole.wrench.end() - 1, body.solid.internal().begin()));
    EXPECT_TRUE(body.solid.linked(broken.i, broken.j));
  }
}

TEST(Solid, KickAndDriftInOnePassGivesTheSameBits) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {3, 2, 1}, {3, 2, 1}));
  config.body[0].spin = {0.1, 0.2, 0.3};
  config.gravity = Vec3{0, 0, -1};
  Lone one(config), two(config);
  for (int n = 0; n < 20; ++n) {
    one.solid.step(0.1);
    two.solid.half_kick(0.1);
    two.solid.drift(0.1);
    two.solid.compute_forces();
    two.solid.half_kick(0.1);
  }
  EXPECT_TRUE(std::equal(one.solid.pose().begin(), one.solid.pose().end(), two.solid.pose().begin()));
  EXPECT_TRUE(std::equal(one.solid.motion().begin(), one.solid.motion().end(), two.solid.motion().begin()));
}

TEST(Solid, SupportsBalanceWhatTheyHold) {
  SolidConfig config = testing::one_material(1, 1, 0.2);
  config.body.push_back(testing::box({0, 0, 0}, {4, 1, 1}, {4, 1, 1}));
  config.body[0].hold.push_back({{0, 0, 0}, {1, 1, 1}});
  config.body[0].prescribed.push_back({{3, 0, 0}, {4, 1, 1}, {0.01, 0.02, 0}});
  Lone body(config);
  auto const before = body.measure();
  Real const energy = body.energy();
  for (int n = 0; n < 300; ++n) body.solid.step(0.05);
  auto const after = body.measure();
  Reactions const support = body.solid.take_reactions();
  EXPECT_NEAR(norm(after.vector(Measures::momentum) - before.vector(Measures::momentum) - support.impulse()), 0, 1e-13);
  EXPECT_NEAR(norm(after.vector(Measures::angular) - before.vector(Measures::angular) - support.angular_impulse()), 0,
              2e-3 * norm(support.angular_impulse()));
  EXPECT_NEAR((body.energy() - energy) / support.work(), 1, 1e-2);
  for (Index p = 0; p < body.solid.owned(); ++p) {
    Particle const& held = body.mesh.particle(body.solid.id(p));
    if (held.freedom != Freedom::fixed) continue;
    EXPECT_EQ(body.solid.pose()[static_cast<std::size_t>(p)].x, held.centre);
  }
}

TEST(Solid, FallsUnderGravity) {
  SolidConfig config = testing::one_material(1, 1, 0.2);
  config.body.push_back(testing::box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  config.gravity = Vec3{0, 0, -2};
  Lone body(config);
  auto const before = body.measure().vector(Measures::first_moment);
  for (int n = 0; n < 100; ++n) body.solid.step(0.01);
  EXPECT_NEAR(body.measure().vector(Measures::momentum).z, -2, 1e-12);
  EXPECT_NEAR((body.measure().vector(Measures::first_moment) - before).z, -1, 1e-12);
}

TEST(Solid, NothingLeavesThePlane) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = "m";
  b.shape = "tube";
  b.tessellation = "voronoi";
  b.particles = 40;
  b.centre = Vec3{1, 2, 0};
  b.inner_radius = 0.5, b.outer_radius = 1.0;
  b.spin = {0, 0, 0.3};
  config.body.push_back(b);
  Lone body(config, 2);
  Real const dt = body.solid.stable_step();
  for (int n = 0; n < 50; ++n) body.solid.step(dt);
  for (Pose const& p : body.solid.pose()) {
    EXPECT_EQ(p.x.z, 0.5);
    EXPECT_EQ(p.q.v.x, 0);
    EXPECT_EQ(p.q.v.y, 0);
  }
}

TEST(Solid, RestoreGivesTheSavedStateAndKeepsTheNewLoad) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {2, 1, 1}, {2, 1, 1}));
  config.body[0].spin = {0.1, 0.2, 0.3};
  Lone body(config);
  Solid::Saved saved;
  body.solid.save(saved);
  parallel::Digest before, after;
  body.solid.digest(before);
  body.solid.step(0.1);
  body.solid.load()[0].force = {1, 0, 0};
  body.solid.restore(saved);
  body.solid.digest(after);
  EXPECT_EQ(before, after);
  EXPECT_EQ(body.solid.load()[0].force.x, 1);
  body.solid.restore(saved, Solid::Restore::state_and_load);
  EXPECT_EQ(body.solid.load()[0].force.x, 0);
}

}  // namespace
}  // namespace brisance::solid
