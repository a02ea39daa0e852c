// What stays in contact: closed cracks, blocks held by friction, heaps.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/contact_bodies.hpp"
#include "tests/support/evidence.hpp"

namespace brisance::solid {
namespace {

using evidence::at_most;
using evidence::near;
using namespace testing;

/// A rod of 160 cells.
SolidConfig rod() {
  SolidConfig config = testing::one_material(1, 1, 0);
  config.contact.emplace();
  config.body.push_back(testing::box({0, 0, 0}, {160, 1, 1}, {160, 1, 1}));
  return config;
}

/// Sets its first 32 cells in smooth motion: a pulse of pressure 64 cells long, of momentum 16 `speed`.
void push(SolidRun& run, Real speed) {
  for (std::size_t p = 0; p < run.solid.motion().size(); ++p)
    if (Real const x = run.solid.pose()[p].x.x; x < 32)
      run.solid.motion()[p].v.x = speed * square(std::sin(std::numbers::pi * x / 32));
}

/// Breaks the link at x = 80; returns how many there were.
int crack(Solid& solid) {
  int broken = 0;
  for (std::size_t k = 0; k < solid.links(); ++k) {
    Link const& link = solid.mesh().links[solid.mesh_link(k)];
    Vec3 const face = solid.mesh().particle(link.i).centre + solid.mesh().face(link.i, link.face_i).centroid;
    if (std::abs(face.x - 80) < 0.1) solid.weaken(k, 0), ++broken;
  }
  return broken;
}

Real mean_velocity(SolidRun const& run, Real from, Real to) {
  Real sum = 0;
  int count = 0;
  for (Index p = 0; p < run.solid.owned(); ++p)
    if (Real const x = run.mesh.particle(run.solid.id(p)).centre.x; x > from && x < to)
      sum += run.solid.motion()[static_cast<std::size_t>(p)].v.x, ++count;
  return sum / count;
}

TEST(Contact, AClosedCrackTransmitsPressureAndNoTension) {
  Real const speed = 0.01;
  SolidRun run(rod(), 3, 320, testing::comm());
  push(run, speed);
  run.solid.allow_damage();
  ASSERT_EQ(crack(run.solid), 1);
  run.start();
  run.to_the_end();
  // The pulse, 64 cells long, goes through, turns round at the far end and takes the far half with it.
  EXPECT_TRUE(near("S32", "pulse through a closed crack", "160 cells", "velocity of the far half / (v0 / 5)",
                   mean_velocity(run, 80, 160) / (0.2 * speed), 1, 0.02));
  EXPECT_TRUE(near("S32", "pulse through a closed crack", "160 cells", "velocity of the near half / (v0 / 5)",
                   mean_velocity(run, 0, 80) / (0.2 * speed), 0, 0.02));
  EXPECT_LT(run.simulation.ledger().conservation().energy, 0.02);
  EXPECT_LT(run.simulation.ledger().conservation().momentum.x, 1e-13);
}

/// Breaks the link at x = 80 at a time and books the elastic energy that leaves with it.
class Breaker : public Effect {
 public:
  Breaker(Solid& solid, Real time) : solid_(solid), time_(time) {}
  void join(Plan& plan) override {
    solid_.allow_damage();
    plan.effect("test.breaker", [] { return std::size_t{0}; });
    plan.at(Stage::fracture, [this, &plan](Clock const& clock) {
      if (released != 0 || clock.time < time_) return;
      Measures before, after;
      solid_.measure(before);
      crack(solid_);
      solid_.compute_forces();
      solid_.measure(after);
      released = before.value(Measures::elastic) - after.value(Measures::elastic);
      plan.ask_for_forces();
    });
    plan.account([this](Ledger& ledger) { ledger.add(Entry::dissipated, released - booked_), booked_ = released; });
  }
  Real released = 0;

 private:
  Solid& solid_;
  Real time_;
  Real booked_ = 0;
};

TEST(Contact, TakesOverFromALinkThatBreaksUnderPressure) {
  SolidRun run(rod(), 3, 70, testing::comm());
  push(run, 0.01);
  Breaker breaker(run.solid, 64);
  breaker.join(run.plan);
  run.start();
  Real const energy = run.energy();
  run.to_the_end();
  EXPECT_GT(breaker.released / energy, 0.01);
  EXPECT_EQ(contact_of(run).overlapping_pairs(), 1);
  // K_c = E is the stiffness of the link itself (nu = 0): nearly all of the energy stays.
  EXPECT_LT(std::abs(run.dissipated()) / energy, 1e-3);
  EXPECT_LT(run.simulation.ledger().conservation().energy, 0.02);
}

/// A flat block on a floor in a gravity that leans by `angle`: where it is and how fast after `time`.
struct Slide {
  Real way, speed, defect;
};
Slide slide(Real angle, Real friction, Real time, int dimension) {
  SolidConfig config = rigid(1e5);
  config.contact->friction = friction;
  config.contact->restitution = 0.3;
  config.gravity =
      dimension == 3 ? Vec3{std::sin(angle), 0, -std::cos(angle)} : Vec3{std::sin(angle), -std::cos(angle), 0};
  Vec3 const low = dimension == 3 ? Vec3{-2, -2, -1} : Vec3{-2, -1, 0},
             high = dimension == 3 ? Vec3{6, 2, 0} : Vec3{6, 0, 0};
  Vec3 const to = dimension == 3 ? Vec3{1, 1, 0.4} : Vec3{1, 0.4, 0};
  config.body = {held(testing::box(low, high, {4, 1, 1})), testing::box({0, 0, 0}, to, {1, 1, 1})};
  SolidRun run(config, dimension, time, testing::comm());
  run.start();
  run.to_the_end();
  Index block = 0;
  while (run.mesh.particle(run.solid.id(block)).body != 1) ++block;
  return {run.solid.pose()[static_cast<std::size_t>(block)].x.x - 0.5, run.velocity(1).x,
          run.simulation.ledger().conservation().energy};
}

TEST(Contact, BlocksStickBelowTheAngleOfFrictionAndSlideAbove) {
  Real const mu = 0.5, time = 2;
  for (int const dimension : {2, 3}) {
    std::string const variant = std::to_string(dimension) + "D, mu 0.5";
    Slide const rests = slide(0.9 * std::atan(mu), mu, time, dimension);
    EXPECT_TRUE(at_most("S28", "block on a slope", variant + ", 0.9 of the angle", "way", std::abs(rests.way), 1e-4));
    EXPECT_TRUE(
        at_most("S28", "block on a slope", variant + ", 0.9 of the angle", "speed", std::abs(rests.speed), 1e-4));
    Real const angle = 1.3 * std::atan(mu), a = std::sin(angle) - mu * std::cos(angle);
    Slide const slides = slide(angle, mu, time, dimension);
    EXPECT_TRUE(near("S28", "block on a slope", variant + ", 1.3 of the angle", "speed / (g (sin - mu cos) t)",
                     slides.speed / (a * time), 1, 0.01));
    EXPECT_TRUE(near("S28", "block on a slope", variant + ", 1.3 of the angle", "way / expected",
                     slides.way / (0.5 * a * time * time), 1, 0.01));
    EXPECT_LT(slides.defect, 1e-3);
  }
}

TEST(Contact, AHeapComesToRest) {
  SolidConfig config = rigid(1e4);
  config.contact->friction = 0.4;
  config.contact->restitution = 0.3;
  config.gravity = Vec3{0, 0, -1};
  config.body = {held(testing::box({-4, -4, -1}, {4, 4, 0}, {4, 4, 1}))};
  testing::Random random(9);
  for (int layer = 0; layer < 3; ++layer)
    for (int k = 0; k < 3 - layer; ++k) {
      Vec3 const c{1.1 * k - 0.55 * (2 - layer) + 0.1 * random(), 0.1 * random(), 0.4 + 1.1 * layer};
      config.body.push_back(
          moving(testing::box(c - Vec3{0.5, 0.5, 0.3}, c + Vec3{0.5, 0.5, 0.3}, {1, 1, 1}), {}, 0.3 * random.vector()));
    }
  SolidRun run(config, 3, 60, testing::comm());
  run.start();
  run.to_the_end();
  Real const kinetic = run.measure().value(Measures::kinetic), mass = 0.6;
  EXPECT_TRUE(at_most("S28", "heap of six blocks", "mu 0.4, e 0.3", "kinetic energy / (m g h)", kinetic / mass, 1e-20));
  EXPECT_TRUE(at_most("S28", "heap of six blocks", "mu 0.4, e 0.3", "energy defect",
                      run.simulation.ledger().conservation().energy, 1e-3));
  for (Index p = 0; p < run.solid.owned(); ++p) EXPECT_GT(run.solid.pose()[static_cast<std::size_t>(p)].x.z, -0.6);
}

}  // namespace
}  // namespace brisance::solid
