// S23 of theory/solid.md section 19: multi-rate steps on bars and balls with thin particles.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

/// A bar of 24 x 2 x 2 particles, four slices of it five times thinner than the others.
SolidConfig graded_bar() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig bar = testing::box({0, 0, 0}, {20.8, 2, 2}, {1, 2, 2});
  bar.layers_x.assign(24, 1.0);
  for (std::size_t i = 10; i < 14; ++i) bar.layers_x[i] = 0.2;
  bar.spin = {0.002, 0.001, 0.006};
  config.body.push_back(bar);
  return config;
}

/// One layer of forty is twenty times thinner: a sliver that sets the step of a whole structure.
SolidConfig bar_with_a_sliver(Real nu) {
  SolidConfig config = testing::one_material(1, 1, nu);
  BodyConfig bar = testing::box({0, 0, 0}, {39.05, 2, 2}, {1, 2, 2});
  bar.layers_x.assign(40, 1.0);
  bar.layers_x[17] = 0.05;
  bar.spin = {0.002, 0.001, 0.006};
  config.body.push_back(bar);
  return config;
}

/// Voronoi cells of random generators, which keep 0.3 spacings apart: little to gain, three levels to keep stable.
SolidConfig rough_ball(Real nu) {
  SolidConfig config = testing::one_material(1, 1, nu);
  BodyConfig ball;
  ball.material = "m";
  ball.shape = "sphere";
  ball.tessellation = "voronoi";
  ball.particles = 600;
  ball.seed = 3;
  ball.lloyd = 0;
  ball.centre = Vec3{0, 0, 0};
  ball.radius = 3.0;
  ball.spin = {0.01, 0.02, 0.03};
  config.body.push_back(ball);
  return config;
}

/// Bends, stretches and twists slowly: the motion a structure has.
void set_off(Solid& solid, Real length, Real speed) {
  for (std::size_t p = 0; p < solid.motion().size(); ++p) {
    Vec3 const x = solid.pose()[p].x;
    Real const phase = std::numbers::pi * x.x / length;
    solid.motion()[p].v += speed * Vec3{std::cos(phase), std::cos(2 * phase), std::sin(phase) * std::cos(x.y)};
  }
}

struct Outcome {
  Real energy = 0, early = 0;      ///< largest |H/H0 - 1|
  Real late = 0;                   ///< the same in the second half
  Real momentum = 0, angular = 0;  ///< largest change, relative to sum of |m v| and to |L0|
  Real seconds = 0;                ///< processor time in steps
};

Real processor_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}

Outcome run(testing::Lone& body, Real dt, int steps) {
  auto const before = body.measure();
  Real const energy = body.energy(), scale = before.value(Measures::momentum_scale);
  Outcome out;
  for (int n = 0; n < steps; ++n) {
    Real const start = processor_time();
    body.solid.step(dt);
    out.seconds += processor_time() - start;
    if (n % 7 != 0 && n + 1 != steps) continue;
    auto const now = body.measure();
    Real const defect = std::abs(body.energy() / energy - 1);
    out.energy = max(out.energy, defect);
    Real& half = n < steps / 2 ? out.early : out.late;
    half = max(half, defect);
    out.momentum = max(out.momentum, norm(now.vector(Measures::momentum) - before.vector(Measures::momentum)) / scale);
    out.angular = max(out.angular, norm(now.vector(Measures::angular) - before.vector(Measures::angular)) /
                                       norm(before.vector(Measures::angular)));
  }
  return out;
}

/// `gain`: at least, in links computed per time.
void compare(char const* name, SolidConfig config, Real length, Real speed, int levels, int steps, Real gain) {
  testing::Lone plain(config);
  config.motion.multirate = MultirateConfig{levels, {}};
  testing::Lone body(config);
  set_off(plain.solid, length, speed);
  set_off(body.solid, length, speed);
  Real const dt = body.solid.stable_step(), fine = plain.solid.stable_step();
  Outcome const out = run(body, dt, steps);
  Outcome const reference = run(plain, fine, static_cast<int>(steps * dt / fine));
  std::string const variant = std::to_string(levels) + " levels; " + std::to_string(steps) + " coarse steps";
  Real const links_per_s = static_cast<Real>(plain.solid.link_updates()) / fine,
             fewer = static_cast<Real>(body.solid.link_updates()) / dt;
  EXPECT_NEAR(links_per_s / fewer, body.solid.levels()->gain(), 1e-12);
  EXPECT_TRUE(evidence::at_most("S23", name, variant, "1 / gain in link updates", fewer / links_per_s, 1 / gain));
  std::printf("S23 %s [%s]: processor time %.2f of that of one step for all\n", name, variant.c_str(),
              out.seconds / reference.seconds);
  EXPECT_TRUE(evidence::at_most("S23", name, variant, "largest defect of energy", out.energy, 3e-4));
  EXPECT_TRUE(evidence::at_most("S23", name, variant, "largest defect of energy; second half over first",
                                out.late / out.early, 1.1));
  EXPECT_TRUE(
      evidence::at_most("S23", name, variant, "largest defect of energy; one step for all", reference.energy, 3e-4));
  EXPECT_TRUE(evidence::at_most("S23", name, variant, "change of momentum", out.momentum, 1e-12));
  EXPECT_TRUE(evidence::at_most("S23", name, variant, "change of angular momentum", out.angular, 1e-12));
}

TEST(Multirate, OfAGradedBar) {
  compare("graded bar", graded_bar(), 20.8, 0.01, 2, evidence::full() ? 60000 : 6000, 1.4);
}

TEST(Multirate, OfABarWithASliver) {
  std::vector<Real> const ratios = evidence::full() ? std::vector<Real>{-0.5, 0, 0.3, 0.45} : std::vector<Real>{0.3};
  for (Real const nu : ratios)
    compare(("bar with a sliver; nu " + std::to_string(nu).substr(0, 5)).c_str(), bar_with_a_sliver(nu), 39.05, 0.01, 4,
            evidence::full() ? 20000 : 2000, 1.9);
}

TEST(Multirate, OfARoughBall) {
  std::vector<Real> const ratios = evidence::full() ? std::vector<Real>{-0.5, 0, 0.3, 0.49} : std::vector<Real>{0.3};
  // Close to incompressible the volumetric term couples each particle to all around it, and all want the same step.
  for (Real const nu : ratios)
    compare(("ball of random Voronoi cells; nu " + std::to_string(nu).substr(0, 5)).c_str(), rough_ball(nu), 3, 0.01, 3,
            evidence::full() ? 5000 : 300, nu < 0.49 ? 1.05 : 1);
}

}  // namespace
}  // namespace brisance::solid
