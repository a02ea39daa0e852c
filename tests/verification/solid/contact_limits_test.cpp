// Nothing passes through: the steps that contacts allow, and the barrier of thin bodies.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/contact_bodies.hpp"
#include "tests/support/evidence.hpp"

namespace brisance::solid {
namespace {

using evidence::at_most;
using evidence::near;
using namespace testing;

/// Largest step that the contacts of a rod of wedges allow, over that of its links: the rod stands `gap` above a coarse
/// held block.
Real step_of_a_rod_of_wedges(Real gap) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.contact.emplace();
  BodyConfig rod = testing::box({0, 0, 0}, {1, 1, 1}, {3, 20, 6});
  rod.shape = "cylinder", rod.tessellation = "polar", rod.low.reset(), rod.high.reset();
  rod.centre = Vec3{0.1, 0.2, gap + 3}, rod.radius = 1.5, rod.length = 6;
  rod.velocity = {0, 0, -0.01};
  config.body = {held(testing::box({-4, -4, -3}, {4, 4, 0}, {2, 2, 1})), rod};
  SolidRun run(config, 3, 1, testing::comm());
  run.start();
  return contact_of(run).time_step() / run.solid.stable_limit().dt;
}

TEST(Contact, WedgesAreJudgedByTheFacesThatMeet) {
  // About the axis wedges meet that no few links join: they are of one piece. The target sees their small ends.
  EXPECT_GT(step_of_a_rod_of_wedges(3), 1.5);
  EXPECT_GT(step_of_a_rod_of_wedges(1e-9), 0.7);
}

TEST(Contact, NothingTunnels) {
  // Usual closing speeds are 0.01 to 0.02 c0 (50 to 100 m/s in steel); ten times that, for all phases of the step.
  struct Case {
    char const* name;
    Vec3 target, bullet, turn;
    Real speed, spin;
    Index cells = 1;  ///< along the sides of target and bullet; linked if more than one
    int phases = 24;
  };
  Real const eighth = 0.25 * std::numbers::pi;
  for (Case const& c : {Case{"cube on cube", {1, 1, 1}, {1, 1, 1}, {}, 0.7, 0.3},
                        Case{"cube on a plate", {1, 1, 0.1}, {1, 1, 1}, {}, 0.2, 0.05},
                        Case{"cube on a wide plate", {3, 3, 0.1}, {1, 1, 1}, {}, 0.2, 0.05},
                        Case{"corner of a cube on a plate", {2, 2, 0.1}, {1, 1, 1}, {0.615, 0.785, 0}, 0.2, 0.01},
                        Case{"plate on plate", {2, 2, 0.05}, {1, 1, 0.05}, {}, 0.2, 0.005},
                        Case{"edge of a plate on a plate", {2, 2, 0.05}, {1, 0.05, 1}, {}, 0.2, 0.001},
                        Case{"corner of a plate on a plate", {2, 2, 0.05}, {1, 0.05, 1}, {0, eighth, 0}, 0.2, 0.001},
                        Case{"edge of a plate on the edge of a plate", {1, 0.05, 1}, {0.05, 1, 1}, {}, 0.2, 0.001},
                        Case{"edge of a plate in the plane of another", {1, 0.05, 1}, {1, 0.05, 1}, {}, 0.2, 0.001},
                        Case{"plates askew", {2, 2, 0.05}, {1, 0.05, 1}, {0.4, 0.3, 0.2}, 0.2, 0.01},
                        Case{"tumbling plate on a plate", {2, 2, 0.05}, {1, 0.05, 1}, {}, 0.2, 0.3},
                        Case{"linked plate on edge", {2, 2, 0.1}, {1, 0.1, 1}, {}, 0.2, 0.001, 4, 6},
                        Case{"linked plate on a corner", {2, 2, 0.1}, {1, 0.1, 1}, {0, eighth, 0}, 0.2, 0.01, 4, 6},
                        Case{"linked plate, tumbling", {2, 2, 0.1}, {1, 0.1, 1}, {0.4, 0.3, 0.2}, 0.2, 0.1, 4, 6}}) {
    int passed = 0;
    auto const cells = [&](Vec3 const& size) {
      auto const along = [&](Real length) { return length > 0.5 ? c.cells : 1; };
      return std::array<Index, 3>{along(size.x), along(size.y), along(size.z)};
    };
    for (int n = 0; n < c.phases; ++n) {
      testing::Random random(static_cast<std::uint64_t>(n) + 1);
      random();
      SolidConfig config = rigid();
      if (c.cells > 1) config.links.emplace();
      Vec3 const at{0.2 * random(), 0.2 * random(), 1.5 + 0.37 * n / c.phases + c.bullet.z};
      config.body = {held(testing::box(-0.5 * c.target, 0.5 * c.target, cells(c.target))),
                     moving(testing::box(at - 0.5 * c.bullet, at + 0.5 * c.bullet, cells(c.bullet)), {0, 0, -c.speed},
                            n % 2 ? c.spin * random.vector() : Vec3{})};
      SolidRun run(config, 3, 6 / c.speed, testing::comm());
      turn(run, 1, at, testing::rotation(c.turn));
      run.start();
      std::vector<Index> bullet;
      for (Index p = 0; p < run.solid.owned(); ++p)
        if (run.mesh.particle(run.solid.id(p)).body == 1) bullet.push_back(p);
      while (!run.simulation.finished() && passed < n + 1) {
        // Through it, not round it: a middle crosses the target itself, or stays in it.
        std::vector<Real> before;
        for (Index const p : bullet) before.push_back(run.solid.pose()[static_cast<std::size_t>(p)].x.z);
        run.simulation.pair();
        bool through = false;
        for (std::size_t b = 0; b < bullet.size(); ++b) {
          Vec3 const& x = run.solid.pose()[static_cast<std::size_t>(bullet[b])].x;
          through = through ||
                    (before[b] > 0 && x.z <= 0 && std::abs(x.x) < 0.5 * c.target.x && std::abs(x.y) < 0.5 * c.target.y);
        }
        passed += through;
      }
    }
    EXPECT_TRUE(at_most("S28", "tunnelling", std::string(c.name) + ", " + std::to_string(c.speed) + " c0",
                        "bodies that passed", passed, 0));
  }
}

TEST(Contact, WhatTheBarrierTakesItReturns) {
  // A plate on its edge, hit so fast that it goes two thirds through: elastic, so it leaves as fast as it came.
  SolidConfig config = rigid();
  config.body = {held(testing::box({-1, -1, -0.025}, {1, 1, 0.025}, {1, 1, 1})),
                 moving(testing::box({-0.5, -0.025, 0.1}, {0.5, 0.025, 1.1}, {1, 1, 1}), {0, 0, -0.2})};
  SolidRun run(config, 3, 3, testing::comm());
  run.start();
  Real const energy = run.energy();
  Index bullet = 0;
  while (run.mesh.particle(run.solid.id(bullet)).body != 1) ++bullet;
  Real lowest = 1;
  while (!run.simulation.finished()) {
    run.simulation.pair();
    lowest = min(lowest, run.solid.pose()[static_cast<std::size_t>(bullet)].x.z - 0.5);
  }
  EXPECT_LT(lowest, 0.005);
  EXPECT_GT(lowest, -0.025);
  EXPECT_EQ(contact_of(run).overlapping_pairs(), 0);
  EXPECT_GT(run.velocity(1).z, 0.19);
  EXPECT_TRUE(
      at_most("S28", "plate on its edge at 0.2 c0", "rigid", "energy lost", std::abs(run.energy() / energy - 1), 1e-2));
  EXPECT_LT(run.simulation.ledger().conservation().momentum.z, 1e-12);
}

TEST(Contact, TheStepSeesTheTurningOfDrivenBodies) {
  // A driven paddle whose own centre stands still sweeps its tip over a small cube.
  auto const step = [](Real spin) {
    SolidConfig config = rigid();
    BodyConfig paddle = testing::box({-4, -0.2, -0.5}, {4, 0.2, 0.5}, {1, 1, 1});
    DrivenConfig drive;
    drive.low = Vec3{-9, -9, -9}, drive.high = Vec3{9, 9, 9}, drive.spin = {0, 0, spin}, drive.centre = Vec3{0, 0, 0};
    paddle.prescribed.push_back(drive);
    config.body = {paddle, testing::box({3.6, 0.25, -0.1}, {3.8, 0.45, 0.1}, {1, 1, 1})};
    SolidRun run(config, 3, 1, testing::comm());
    run.start();
    return contact_of(run).time_step();
  };
  // No more than the gap of 0.05 and a fifth of the cube's inner radius a step: the tip goes at 4 spin.
  EXPECT_LT(step(10), 0.08 / 40);
  EXPECT_GT(step(0.01), 0.5 * 0.07 / 0.04 * 0.1);
}

}  // namespace
}  // namespace brisance::solid
