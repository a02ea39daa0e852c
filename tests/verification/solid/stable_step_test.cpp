// S22 of theory/solid.md section 19: the stable step of a free block of 8^3 cubes.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

/// Energy after `steps` over energy at the start, from a small random motion; infinite after an overflow.
Real growth(SolidConfig const& config, Real dt, int steps) {
  testing::Lone body(config);
  testing::Random random(5);
  for (Motion& m : body.solid.motion()) {
    m.v = 1e-7 * random.vector();
    m.spin = 1e-8 * random.vector();
  }
  Real const before = body.energy();
  for (int n = 0; n < steps; ++n) {
    body.solid.step(dt);
    if (n % 50 == 49) {
      Real worst = 0;
      for (Motion const& m : body.solid.motion()) worst = max(worst, norm(m.v));
      if (!(worst < 1e-3)) return 1e300;
    }
  }
  return body.energy() / before;
}

TEST(StableStep, BoundIsSafeAndNearTheLimitOfABlock) {
  struct Row {
    Real nu, limit;  // dt_max c_p / h, observed (theory section 11)
  };
  for (Row const& row : {Row{-0.9, 0.445}, Row{0, 0.538}, Row{0.3, 0.709}, Row{0.45, 1.085}, Row{0.49, 1.21}}) {
    SolidConfig config = testing::one_material(1, 1, row.nu);
    config.body.push_back(testing::box({0, 0, 0}, {8, 8, 8}, {8, 8, 8}));
    Material const m{"m", 1, 1, row.nu};
    Real const limit = row.limit / std::sqrt(m.lame() + 2 * m.shear());
    std::string const variant = "nu " + std::to_string(row.nu).substr(0, 5);
    EXPECT_TRUE(evidence::at_most("S22", "stable step 8^3", variant, "growth of energy at 0.97 of the limit",
                                  growth(config, 0.97 * limit, 2000), 2));
    // Inverted: at most one over the growth, so that a scheme too stable would fail too.
    EXPECT_TRUE(evidence::at_most("S22", "stable step 8^3", variant, "1 / growth at 1.03 of the limit",
                                  1 / growth(config, 1.03 * limit, 2000), 1e-6));
    testing::Lone body(config);
    Real const bound = body.solid.link_limit().dt;
    EXPECT_TRUE(
        evidence::near("S22", "stable step 8^3", variant, "guaranteed bound / limit", bound / limit, 0.87, 0.13));
    EXPECT_TRUE(evidence::at_most("S22", "stable step 8^3", variant, "growth of energy at the guaranteed bound",
                                  growth(config, bound, 2000), 2));
    EXPECT_TRUE(evidence::near("S22", "stable step 8^3", variant, "estimate of the limit by 30 products / limit",
                               body.solid.estimated_limit() / limit, 1, 0.03));
    config.motion.step = "sharp";
    config.motion.cfl = 1;
    Real const sharp = testing::Lone(config).solid.stable_step();
    EXPECT_TRUE(evidence::at_most("S22", "stable step 8^3", variant, "growth of energy at the sharp step",
                                  growth(config, sharp, 2000), 2));
  }
}

/// Blow-up above the estimate and none at the sharp step, where one thin slice sets the step.
TEST(StableStep, SharpStepOfAVoronoiBallAndOfARodInThePlane) {
  SolidConfig ball = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = "m";
  b.shape = "sphere";
  b.tessellation = "voronoi";
  b.particles = 120;
  b.lloyd = 2;
  b.centre = Vec3{0, 0, 0};
  b.radius = 2.0;
  ball.body.push_back(b);
  ball.motion.step = "sharp";
  ball.motion.cfl = 1;
  testing::Lone body(ball);
  Real const estimate = body.solid.estimated_limit(), sharp = body.solid.stable_step();
  EXPECT_TRUE(evidence::at_most("S22", "stable step of a Voronoi ball", "2 Lloyd sweeps", "guaranteed bound / estimate",
                                body.solid.link_limit().dt / estimate, 1));
  EXPECT_TRUE(evidence::at_most("S22", "stable step of a Voronoi ball", "2 Lloyd sweeps",
                                "growth of energy at the sharp step", growth(ball, sharp, 2000), 2));
  EXPECT_TRUE(evidence::at_most("S22", "stable step of a Voronoi ball", "2 Lloyd sweeps",
                                "1 / growth at 1.03 of the estimate", 1 / growth(ball, 1.03 * estimate, 2000), 1e-6));
  EXPECT_NEAR(body.solid.estimated_limit(60) / estimate, 1, 0.01);

  // One particle and its wall, in one dimension: two masses never pass 2 / sqrt(k / m).
  SolidConfig rod = testing::one_material(2, 3, 0);
  rod.body.push_back(testing::box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  rod.body[0].clamp.push_back({{0, 0, 0}, {0, 1, 1}});
  testing::Lone spring(rod, 1);
  EXPECT_NEAR(spring.solid.estimated_limit(), 2 / std::sqrt(2 * 1.5 / 0.5 * 1.0 / 2), 1e-14);
}

}  // namespace
}  // namespace brisance::solid
