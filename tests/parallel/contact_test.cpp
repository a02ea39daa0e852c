// Contact has the same bits on any number of ranks, for any dealing of particles, with broken links, and after restart.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/solid/contact/contact.hpp"
#include "parallel/archive.hpp"
#include "tests/support/breaking_solid.hpp"
#include "tests/support/solid_run.hpp"

namespace brisance::solid {
namespace {

using testing::SolidRun;

/// Three linked bodies that run into each other over a held floor, with friction and damping.
SolidConfig crowd() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.contact.emplace();
  config.contact->friction = 0.3;
  config.contact->restitution = 0.5;
  config.gravity = Vec3{0, 0, -0.01};
  BodyConfig floor = testing::box({-3, -3, -1}, {6, 3, 0}, {3, 2, 1});
  floor.hold.push_back({{-9, -9, -9}, {9, 9, 0}});
  BodyConfig left = testing::box({0, 0, 0.1}, {2, 2, 2.1}, {2, 2, 2}),
             right = testing::box({2.3, 0.3, 0.2}, {4.3, 2.3, 1.2}, {2, 2, 1});
  left.velocity = {0.1, 0, 0}, left.spin = {0.01, 0.02, 0.03};
  right.velocity = {-0.1, 0, -0.05};
  BodyConfig ball = testing::box({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  ball.shape = "sphere", ball.tessellation = "voronoi", ball.low.reset(), ball.high.reset();
  ball.centre = Vec3{0.9, 1.1, 3.55}, ball.radius = 0.8, ball.particles = 20;
  ball.velocity = {0, 0, -0.1};
  config.body = {floor, left, right, ball};
  return config;
}

/// Breaks the links between two layers of the left body.
void crack(SolidRun& run) {
  run.solid.allow_damage();
  for (std::size_t k = 0; k < run.solid.links(); ++k) {
    Link const& link = run.mesh.links[run.solid.mesh_link(k)];
    if (link.j != Link::wall && run.mesh.particle(link.i).body == 1 &&
        std::abs(run.mesh.face(link.i, link.face_i).normal.z) > 0.5)
      run.solid.weaken(k, 0);
  }
}

struct Outcome {
  parallel::Digest digest;
  std::int64_t overlaps = 0;
  bool operator==(Outcome const&) const = default;
};

Outcome outcome_of(SolidRun& run) {
  Outcome o;
  o.digest = run.simulation.digest();
  for (auto const& effect : run.effects)
    if (auto const* contact = dynamic_cast<Contact const*>(effect.get())) o.overlaps = contact->overlapping_pairs();
  run.comm.sum(std::span(&o.overlaps, 1));
  return o;
}

std::vector<int> scattered(int ranks, GlobalId particles) {
  std::vector<int> owner;
  for (GlobalId p = 0; p < particles; ++p) owner.push_back(static_cast<int>(p * 7 % 5 % ranks));
  return owner;
}

constexpr int steps = 60;

Outcome through(parallel::Comm& comm, std::vector<int> const& owner) {
  SolidRun run(crowd(), 3, 1000, comm, owner);
  crack(run);
  run.start();
  for (int n = 0; n < steps; ++n) run.simulation.pair();
  EXPECT_LT(run.simulation.ledger().conservation().momentum.x, 1e-13);
  return outcome_of(run);
}

TEST(ContactBits, DoNotDependOnTheDealing) {
  auto const alone = parallel::serial();
  Outcome const reference = through(*alone, {});
  EXPECT_GT(reference.overlaps, 5);
  parallel::Comm& comm = testing::comm();
  EXPECT_EQ(through(comm, {}), reference);
  EXPECT_EQ(through(comm, scattered(comm.size(), build_mesh(crowd(), 3).size())), reference);
}

TEST(ContactBits, GoOnAfterARestartAmongOverlaps) {
  parallel::Comm& comm = testing::comm();
  std::string const path = "contact-restart-" + std::to_string(comm.size()) + ".h5";
  Outcome const reference = through(comm, {});
  {
    SolidRun run(crowd(), 3, 1000, comm, {});
    crack(run);
    run.start();
    for (int n = 0; n < steps / 2; ++n) run.simulation.pair();
    EXPECT_GT(outcome_of(run).overlaps, 0);
    parallel::ArchiveWriter file(comm, path);
    run.simulation.write(file);
    file.close();
  }
  SolidRun again(crowd(), 3, 1000, comm, scattered(comm.size(), build_mesh(crowd(), 3).size()));
  again.solid.allow_damage();
  {
    parallel::ArchiveReader file(comm, path);
    again.simulation.read(file);
  }
  for (auto const& effect : again.effects) effect->start();
  for (int n = steps / 2; n < steps; ++n) again.simulation.pair();
  EXPECT_EQ(outcome_of(again), reference);
  comm.barrier();
  if (comm.rank() == 0) std::remove(path.c_str());
}

/// The crowd, of stuff that breaks.
SolidConfig brittle_crowd() {
  SolidConfig config = crowd();
  LawConfig law = testing::stress_law(0.03, 0.8);
  law.weibull = Weibull{6, 0.1, 3};
  config.fracture.emplace().law = {law};
  return config;
}

TEST(ContactBits, GoOnAfterARestartInTheMiddleOfBreaking) {
  parallel::Comm& comm = testing::comm();
  std::string const path = "contact-fracture-restart-" + std::to_string(comm.size()) + ".h5";
  auto const alone = parallel::serial();
  auto const broken = [](SolidRun& run) {
    std::int64_t count = 0;
    for (std::size_t k = 0; k < run.solid.links(); ++k)
      count += run.solid.intact(k) == 0 && run.solid.link_store().end_i(k) < run.solid.owned();
    run.comm.sum(std::span(&count, 1));
    return count;
  };
  Outcome reference;
  std::int64_t broken_half = 0, broken_end = 0;
  {
    SolidRun run(brittle_crowd(), 3, 1000, *alone);
    run.start();
    for (int n = 0; n < 2 * steps; ++n) {
      run.simulation.pair();
      if (n + 1 == steps) broken_half = broken(run);
    }
    reference = outcome_of(run), broken_end = broken(run);
  }
  EXPECT_GT(broken_half, 0);
  EXPECT_GT(broken_end, broken_half);
  std::vector<int> const owner = scattered(comm.size(), build_mesh(crowd(), 3).size());
  {
    SolidRun run(brittle_crowd(), 3, 1000, comm, {});
    run.start();
    for (int n = 0; n < steps; ++n) run.simulation.pair();
    EXPECT_GT(outcome_of(run).overlaps, 5);
    parallel::ArchiveWriter file(comm, path);
    run.simulation.write(file);
    file.close();
    for (int n = steps; n < 2 * steps; ++n) run.simulation.pair();
    EXPECT_EQ(outcome_of(run), reference);
  }
  SolidRun again(brittle_crowd(), 3, 1000, comm, owner);
  {
    parallel::ArchiveReader file(comm, path);
    again.simulation.read(file);
  }
  for (auto const& effect : again.effects) effect->start();
  for (int n = steps; n < 2 * steps; ++n) again.simulation.pair();
  EXPECT_EQ(outcome_of(again), reference);
  comm.barrier();
  if (comm.rank() == 0) std::remove(path.c_str());
}

TEST(ContactBits, RejectedStepsLeaveNoTrace) {
  parallel::Comm& comm = testing::comm();
  SolidRun plain(crowd(), 3, 1000, comm, {}), redone(crowd(), 3, 1000, comm, {});
  plain.start(), redone.start();
  for (int n = 0; n < 30; ++n) plain.simulation.pair(), redone.simulation.pair();
  for (int n = 0; n < 10; ++n) {
    for (Plan::Keep const& keep : redone.plan.kept()) keep.save();
    Clock clock = redone.simulation.clock();
    clock.dt = 0.3;  // a step that is thrown away
    for (int s = 0; s < static_cast<int>(Stage::count); ++s)
      for (Plan::Task const& task : redone.plan.tasks(static_cast<Stage>(s))) task.run(clock);
    for (Plan::Keep const& keep : redone.plan.kept()) keep.restore();
    plain.simulation.pair(), redone.simulation.pair();
    EXPECT_EQ(outcome_of(redone), outcome_of(plain)) << n;
  }
}

}  // namespace
}  // namespace brisance::solid
