// Parts that nothing has reached yet: exactly without force, skipped, and woken by whatever reaches them.
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;

/// A bar of 80 x 3 x 3 cubes at odd places, and a block beside it.
SolidConfig bar_and_block(bool sleep) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0.1, -0.7, 1e3 + 0.3}, {80.1, 2.3, 1e3 + 3.3}, {80, 3, 3}));
  config.body.push_back(testing::box({-20.7, 0, 1e3}, {-10.3, 9, 1e3 + 8}, {8, 8, 8}));
  config.sleep = sleep;
  return config;
}

parallel::Digest digest(Solid const& solid) {
  parallel::Digest d;
  solid.digest(d);
  return d;
}

TEST(SolidSleep, UndisturbedBodiesHaveNoForceAtAll) {
  for (int dimension : {2, 3}) {
    SolidConfig config = bar_and_block(false);
    BodyConfig ball;
    ball.material = "m";
    ball.shape = dimension == 3 ? "sphere" : "cylinder";
    ball.tessellation = "voronoi";
    ball.particles = 90;
    ball.centre = Vec3{10 / 3.0, 20.77, 1e3};
    ball.radius = 2.1;
    config.body.push_back(ball);
    if (dimension == 2)
      for (BodyConfig& b : config.body) b.cells[2] = 1;
    Lone body(config, dimension);
    auto const before = digest(body.solid);
    for (Wrench const& w : std::as_const(body.solid).internal()) EXPECT_EQ(w, Wrench{});
    for (int n = 0; n < 5; ++n) body.solid.step(0.3);
    EXPECT_EQ(digest(body.solid), before);
    EXPECT_EQ(body.energy(), 0);
  }
}

TEST(SolidSleep, AWaveWakesWhatItReachesAndGivesTheSameBits) {
  Lone sleepy(bar_and_block(true)), awake(bar_and_block(false));
  auto const all = static_cast<std::int64_t>(awake.solid.links());
  sleepy.solid.let_sleep();
  sleepy.solid.compute_forces();
  EXPECT_EQ(sleepy.solid.link_updates(), 0);
  for (Lone* body : {&sleepy, &awake})
    for (GlobalId p = 0; p < body->mesh.size(); ++p)
      if (body->mesh.particle(p).centre.x > 79) body->solid.motion()[static_cast<std::size_t>(p)].v = {0.01, 0.002, 0};
  std::int64_t last = 0;
  for (int n = 0; n < 200; ++n) {
    sleepy.solid.step(0.3);
    awake.solid.step(0.3);
    if (n % 10 != 0) continue;
    ASSERT_EQ(digest(sleepy.solid), digest(awake.solid)) << "step " << n;
    EXPECT_EQ(sleepy.energy(), awake.energy());
    EXPECT_GE(sleepy.solid.link_updates(), last);
    last = sleepy.solid.link_updates();
    if (n == 0) {
      EXPECT_LT(last, all / 10);
    }
  }
  EXPECT_EQ(awake.solid.link_updates(), all);
  EXPECT_GT(last, 80 * 21 - 9);        // all of the bar
  EXPECT_LT(last, all - 512 * 3 / 2);  // nothing has reached the block
}

TEST(SolidSleep, LoadsForcesTractionsAndAnyOtherTouchWake) {
  using Touch = std::function<void(Solid&)>;
  std::vector<Touch> const touches{[](Solid& s) {
                                     s.load()[200].force = {0, 1e-3, 0};
                                   },
                                   [](Solid& s) {
                                     s.internal()[200].torque = {0, 1e-3, 0};
                                   },
                                   [](Solid& s) { s.pose()[200].x.z += 1e-3; },
                                   [](Solid& s) {
                                     s.motion()[200].spin = {0, 0, 1e-4};
                                   },
                                   [](Solid& s) {
                                     FreeFace const& face = s.mesh().free_faces.back();
                                     FaceLoad const load{face.particle, face.face, {1e-3, 0, 1e-3}};
                                     s.load_faces(std::span(&load, 1));
                                   }};
  for (std::size_t t = 0; t < touches.size(); ++t) {
    Lone sleepy(bar_and_block(true)), awake(bar_and_block(false));
    auto const before = digest(awake.solid);
    sleepy.solid.let_sleep();
    for (Lone* body : {&sleepy, &awake}) {
      body->solid.step(0.3);
      touches[t](body->solid);
      for (int n = 0; n < 20; ++n) body->solid.step(0.3);
    }
    EXPECT_EQ(digest(sleepy.solid), digest(awake.solid)) << "touch " << t;
    EXPECT_FALSE(digest(sleepy.solid) == before) << "touch " << t;
  }
}

TEST(SolidSleep, ARestoredStateGoesOnWithTheSameBits) {
  Lone sleepy(bar_and_block(true)), awake(bar_and_block(false));
  sleepy.solid.let_sleep();
  for (Lone* body : {&sleepy, &awake}) {
    Solid::Saved start;
    body->solid.save(start);
    body->solid.motion()[10].v = {0.1, 0, 0};
    for (int n = 0; n < 10; ++n) body->solid.step(0.3);
    body->solid.restore(start, Solid::Restore::state_and_load);
    body->solid.motion()[300].v = {0, 0.1, 0};
    for (int n = 0; n < 30; ++n) body->solid.step(0.3);
  }
  EXPECT_EQ(digest(sleepy.solid), digest(awake.solid));
}

}  // namespace
}  // namespace brisance::solid
