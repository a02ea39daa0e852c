// Breaking has the same bits on any number of ranks and for any dealing of particles, and a pair taken back leaves no
// trace.
#include <gtest/gtest.h>

#include "tests/support/breaking_solid.hpp"

namespace brisance::solid {
namespace {

using testing::BreakingSolid;

/// A ball of Voronoi cells that bursts under cohesive and brittle laws.
SolidConfig ball() {
  SolidConfig config = testing::one_material(1, 1, 0.4);
  BodyConfig b;
  b.material = "m";
  b.shape = "sphere";
  b.tessellation = "voronoi";
  b.particles = 70;
  b.lloyd = 4;
  b.centre = Vec3{0, 0, 0};
  b.radius = 2.0;
  b.spin = {0.075, 0.15, 0.225};
  config.body.push_back(b);
  config.body.push_back(testing::box({5, 0, 0}, {8, 3, 2}, {3, 3, 2}));
  config.body[1].name = "brick";
  config.body[1].spin = {0.08, 0.05, 0.03};
  LawConfig soft;
  soft.cohesive = Cohesive{0.05, 5e-3, {}, 2, 0.8};
  soft.weibull = Weibull{5, 0.1, 3};
  LawConfig brittle = testing::stress_law(0.06, 0.7);
  brittle.body = "brick";
  brittle.stress->rate = RateHardening{0.05, 1e-3};
  config.fracture.emplace().law = {soft, brittle};
  return config;
}

struct Outcome {
  parallel::Digest digest;
  Real broken = 0, dissipated = 0, energy = 0;
  std::string census;
  bool operator==(Outcome const&) const = default;
};

Outcome outcome(BreakingSolid& body) {
  Outcome o;
  o.digest = body.simulation.digest();
  o.broken = body.broken(), o.dissipated = body.dissipated(), o.energy = body.ledger().total(Entry::energy);
  std::string rows;
  for (FragmentFigures const& f : take_census(body.solid, body.fracture().fragments(), body.comm))
    rows += census_row(f, body.mesh, 0, 0);
  parallel::Bytes bytes(rows.size());
  std::memcpy(bytes.data(), rows.data(), rows.size());
  body.comm.broadcast(bytes, 0);
  o.census.assign(reinterpret_cast<char const*>(bytes.data()), bytes.size());
  return o;
}

Outcome run(std::vector<int> const& owner, parallel::Comm& comm) {
  BreakingSolid body(ball(), 3, 1e3, comm, owner);
  body.start();
  for (int n = 0; n < 30; ++n) body.simulation.pair();
  return outcome(body);
}

TEST(FractureBits, AreThoseOfOneRankForAnyDealing) {
  Mesh const mesh = build_mesh(ball(), 3);
  auto const alone = parallel::serial();
  Outcome const reference = run(testing::slices(mesh, 1), *alone);
  EXPECT_GT(reference.broken, 50);
  EXPECT_LT(reference.broken, 0.9 * static_cast<Real>(mesh.links.size()));
  EXPECT_GT(std::count(reference.census.begin(), reference.census.end(), '\n'), 4);
  parallel::Comm& comm = testing::comm();
  EXPECT_EQ(run(testing::slices(mesh, comm.size()), comm), reference);
  std::vector<int> scattered;
  for (GlobalId p = 0; p < mesh.size(); ++p) scattered.push_back(static_cast<int>(p * 7 % 5 % comm.size()));
  EXPECT_EQ(run(scattered, comm), reference);
}

TEST(FractureBits, OfAPairTakenBackAreThoseOfOneThatWasNot) {
  parallel::Comm& comm = testing::comm();
  Mesh const mesh = build_mesh(ball(), 3);
  BreakingSolid through(ball(), 3, 1e3, comm, testing::slices(mesh, comm.size()));
  BreakingSolid again(ball(), 3, 1e3, comm, testing::slices(mesh, comm.size()));
  for (BreakingSolid* body : {&through, &again}) {
    body->start();
    for (int n = 0; n < 10; ++n) body->simulation.pair();
  }
  // A step of another length breaks other links; then it is taken back as the simulation does it.
  for (Plan::Keep const& keep : again.plan.kept()) keep.save();
  std::size_t const broken = again.solid.broken();
  Clock clock = again.simulation.clock();
  clock.dt *= 0.9;
  for (int n = 0; n < 5; ++n)
    for (Stage const stage :
         {Stage::kick, Stage::drift, Stage::forces, Stage::kick_again, Stage::fracture, Stage::forces})
      for (Plan::Task const& task : again.plan.tasks(stage)) task.run(clock);
  again.plan.take_asked_forces();
  std::int64_t more = static_cast<std::int64_t>(again.solid.broken() - broken);
  comm.sum(std::span(&more, 1));
  EXPECT_GT(more, 0);
  for (Plan::Keep const& keep : again.plan.kept()) keep.restore();
  EXPECT_EQ(again.simulation.digest(), through.simulation.digest());
  for (int n = 0; n < 10; ++n) through.simulation.pair(), again.simulation.pair();
  EXPECT_EQ(outcome(again), outcome(through));
}

}  // namespace
}  // namespace brisance::solid
