// Supports and damping give the same bits on any number of ranks and for any dealing of particles.
#include <gtest/gtest.h>

#include "core/solid/damping/damping.hpp"
#include "core/solid/supports/moving_supports.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

SolidConfig periodic_wave() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b = testing::box({0, 0, 0}, {6, 2, 3}, {6, 2, 3});
  b.periodic = {"x", "y", "z"};
  b.initial_velocity.push_back({Vec3{0, 0, 0}, Vec3{3, 2, 3}, {0.01, 0.02, 0}});
  config.body.push_back(b);
  return config;
}

SolidConfig quarter() {
  SolidConfig config = testing::one_material(1, 1, 0.45);
  BodyConfig b = testing::box({0, 0, 0}, {5, 3, 2}, {5, 3, 2});
  b.tessellation = "voronoi";
  b.particles = 60;
  b.lloyd = 4;
  b.symmetry = {{{0, 0, 0}, {5, 0, 2}}, {{0, 0, 0}, {5, 3, 0}}};
  DrivenConfig wall{{0, 0, 0}, {0, 3, 2}};
  wall.history = {{0, {}, {}}, {3, {0.01, 0, 0}, {0.01, 0, 0}}, {9, {0, 0, 0.01}, {}}};
  wall.centre = Vec3{0, 0, 0};
  b.clamp.push_back(wall);
  DrivenConfig end{{4.3, 0, 0}, {5, 3, 2}};
  end.history = {{0, {}, {}}, {5, {-0.01, 0.01, 0}, {0, 0.02, 0.01}}};
  end.centre = Vec3{5, 1, 1};
  b.prescribed.push_back(end);
  config.body.push_back(b);
  config.gravity = Vec3{0, 0, -1e-3};
  return config;
}

SolidConfig free_bodies() {
  SolidConfig config = testing::one_material(1, 1, 0.2);
  for (Real const x : {0.0, 7.0}) {
    BodyConfig b = testing::box({x, 0, 0}, {x + 4, 2, 2}, {4, 2, 2});
    b.name = x == 0 ? "left" : "right";
    b.velocity = {0.01 * (3 - x), 0.02, 0};
    b.spin = {0.01, 0.02, 0.03};
    b.initial_velocity.push_back({Vec3{x + 2, 0, 0}, {}, {0, 0.03, 0.01}});
    config.body.push_back(b);
  }
  return config;
}

/// Digest, damping ledger and energy after some steps.
struct Outcome {
  parallel::Digest digest;
  Real energy = 0, work = 0;
  bool operator==(Outcome const&) const = default;
};

Outcome run(SolidConfig const& config, std::optional<DampingConfig> const& how, std::vector<int> const& owner,
            parallel::Comm& comm) {
  Mesh const mesh = build_mesh(config, 3);
  Solid solid(mesh, config, owner, comm, 3);
  MovingSupports supports(solid);
  std::optional<Damping> damping;
  if (how) damping.emplace(*how, config, solid, comm);
  Real dt = solid.stable_step();
  comm.min(std::span(&dt, 1));
  for (int n = 0; n < 40; ++n) {
    supports.set_off(n * dt, dt);
    if (damping && how->rate) damping->half_decay(dt);
    solid.step(dt);
    if (damping && how->rate) damping->half_decay(dt);
    if (damping && !how->rate) damping->stop_at_maximum();
    supports.arrive((n + 1) * dt);
  }
  Outcome outcome;
  solid.digest(outcome.digest);
  comm.sum(outcome.digest);
  Measures m;
  solid.measure(m);
  comm.sum(std::span(m.sums));
  outcome.energy = m.value(Measures::kinetic) + m.value(Measures::elastic);
  Reactions reactions = solid.take_reactions();
  comm.sum(std::span(reactions.sums));
  outcome.work = reactions.work();
  return outcome;
}

void expect_same(SolidConfig const& config, std::optional<DampingConfig> const& how = {}) {
  Mesh const mesh = build_mesh(config, 3);
  auto const alone = parallel::serial();
  Outcome const reference = run(config, how, testing::slices(mesh, 1), *alone);
  EXPECT_TRUE(std::isfinite(reference.energy));
  parallel::Comm& comm = testing::comm();
  EXPECT_EQ(run(config, how, testing::slices(mesh, comm.size()), comm), reference);
  std::vector<int> scattered;
  for (GlobalId p = 0; p < mesh.size(); ++p) scattered.push_back(static_cast<int>(p * 7 % 5 % comm.size()));
  EXPECT_EQ(run(config, how, scattered, comm), reference);
}

TEST(SupportBits, OfAPeriodicBox) { expect_same(periodic_wave()); }
TEST(SupportBits, OfAQuarterWithMovingSupports) { expect_same(quarter()); }

TEST(SupportBits, OfDampedBodies) {
  for (bool decay : {true, false})
    for (std::string const relative_to : {"ground", "bodies"}) {
      DampingConfig how;
      how.relative_to = relative_to;
      if (decay)
        how.rate = 0.1;
      else
        how.law = "kinetic";
      expect_same(free_bodies(), how);
      expect_same(quarter(), how);
    }
}

}  // namespace
}  // namespace brisance::solid
