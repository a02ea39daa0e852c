// Contact: S28 (gradient, tumbling cubes), S32 (impact of rods), bounces, friction, heaps, and nothing passes through.
#include <gtest/gtest.h>

#include <numbers>

#include "core/solid/contact/contact.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/solid_run.hpp"

namespace brisance::solid {
namespace {

using evidence::at_most;
using evidence::near;
using testing::SolidRun;

SolidConfig rigid(Real young_modulus = 1) {
  SolidConfig config = testing::one_material(1, young_modulus, 0);
  config.links.reset();
  config.contact.emplace();
  return config;
}

Contact& contact_of(SolidRun& run) {
  for (auto const& effect : run.effects)
    if (auto* contact = dynamic_cast<Contact*>(effect.get())) return *contact;
  throw std::logic_error("no contact");
}

BodyConfig held(BodyConfig body) {
  body.hold.push_back({{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}});
  return body;
}

BodyConfig moving(BodyConfig body, Vec3 const& velocity, Vec3 const& spin = {}) {
  body.velocity = velocity;
  body.spin = spin;
  return body;
}

/// E(x) of two placed convex bodies, and its derivative along a shift or a turn of one of them by differences.
struct Placing {
  Convex shape[2];
  Vec3 x[2], turn[2];
  Quaternion q[2];
  PairLaw law;
  Clipper clipper;

  Intersection overlap() {
    PlacedConvex a, b;
    a.place(shape[0], q[0]), b.place(shape[1], q[1]);
    return clipper.intersect(a, b, x[1] - x[0]);
  }
  Real energy() { return law.energy(overlap().volume); }
  Real slope(int body, Vec3 const& shift, Vec3 const& spin) {
    Vec3 const x0 = x[body];
    Quaternion const q0 = q[body];
    Real const h = 1e-4;
    auto const e = [&](Real s) {
      x[body] = x0 + s * shift;
      q[body] = testing::rotation(s * spin) * q0;
      return energy();
    };
    Real const d = (8 * (e(h) - e(-h)) - (e(2 * h) - e(-2 * h))) / (12 * h);
    x[body] = x0, q[body] = q0;
    return d;
  }
};

TEST(Contact, ForceIsTheGradientOfTheEnergyOfTheOverlap) {
  testing::Random random(28);
  SolidConfig cells = testing::one_material(1, 1, 0);
  cells.body.push_back(testing::box({0, 0, 0}, {3, 3, 3}, {1, 1, 1}));
  cells.body[0].tessellation = "voronoi";
  cells.body[0].particles = 27;
  cells.body[0].lloyd = 3;
  Mesh const voronoi = build_mesh(cells, 3);
  Real worst = 0;
  int met = 0;
  for (int n = 0; n < 2000; ++n) {
    Placing pair;
    for (int b = 0; b < 2; ++b) {
      SolidConfig one = testing::one_material(1, 1, 0);
      Vec3 const r = random.vector();
      one.body.push_back(testing::box({0, 0, 0}, {1.2 + 0.6 * r.x, 1.2 + 0.6 * r.y, 1.2 + 0.6 * r.z}, {1, 1, 1}));
      bool const cell = n % 2;
      pair.shape[b] = make_convex(
          cell ? voronoi.shapes[static_cast<std::size_t>((n + 7 * b) % 27)] : build_mesh(one, 3).shapes[0], 3);
      pair.q[b] = testing::rotation(3.0 * random.vector());
    }
    pair.x[1] = 1.3 * random.vector();
    Real const smaller = min(pair.shape[0].volume, pair.shape[1].volume);
    pair.law.stiffness = 1 / smaller, pair.law.knee = 0.2 * smaller;
    Intersection const o = pair.overlap();
    if (o.volume < 1e-2 * smaller || std::abs(o.volume - pair.law.knee) < 1e-2 * smaller) continue;
    ++met;
    PairEnd ends[2];
    PairForce const f = contact_force(pair.law, o, pair.x[1], ends[0], ends[1], 0, nullptr);
    Real const scale = norm(f.force);
    for (int d = 0; d < 3; ++d) {
      Vec3 axis{};
      axis[d] = 1;
      worst = max(worst, std::abs(pair.slope(0, axis, {}) + f.force[d]) / scale);
      worst = max(worst, std::abs(pair.slope(1, axis, {}) - f.force[d]) / scale);
      worst = max(worst, std::abs(pair.slope(0, {}, axis) + f.torque_a[d]) / scale);
      worst = max(worst, std::abs(pair.slope(1, {}, axis) + f.torque_b[d]) / scale);
    }
  }
  EXPECT_GT(met, 500);
  // Differences see a jump of the second derivative where a corner crosses a face within their reach.
  EXPECT_TRUE(
      at_most("S28", "contact gradient", std::to_string(met) + " pairs", "largest |F + dE/dx| / |F|", worst, 1e-7));
}

TEST(Contact, TumblingCubesKeepEnergyAndMomenta) {
  for (Real const cfl : {0.05, 0.025}) {
    SolidConfig config = rigid();
    config.contact->cfl = cfl;
    config.body = {
        moving(testing::box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), {0.02, 0, 0}, {0.01, 0.02, 0.03}),
        moving(testing::box({1.5, 0.3, 0.2}, {2.5, 1.3, 1.2}, {1, 1, 1}), {-0.02, 0, 0}, {-0.02, 0.01, 0.01})};
    SolidRun run(config, 3, 60, testing::comm());
    run.start();
    Real const energy = run.energy();
    auto const before = run.measure();
    int touching = 0;
    while (!run.simulation.finished()) {
      run.simulation.pair();
      touching += contact_of(run).overlapping_pairs() > 0;
    }
    EXPECT_GT(touching, 100);
    EXPECT_LT(run.velocity(0).x, -0.01);
    auto const after = run.measure();
    Real const scale = before.value(Measures::momentum_scale);
    std::string const variant = "cfl " + std::to_string(cfl);
    EXPECT_TRUE(
        at_most("S28", "tumbling cubes", variant, "energy after contact", std::abs(run.energy() / energy - 1), 1e-6));
    EXPECT_TRUE(at_most("S28", "tumbling cubes", variant, "momentum",
                        norm(after.vector(Measures::momentum) - before.vector(Measures::momentum)) / scale, 1e-12));
    EXPECT_TRUE(at_most("S28", "tumbling cubes", variant, "angular momentum",
                        norm(after.vector(Measures::angular) - before.vector(Measures::angular)) / scale, 1e-12));
  }
}

TEST(Contact, SquaresInThePlaneKeepEnergyAndMomenta) {
  SolidConfig config = rigid();
  config.contact->cfl = 0.05;
  config.body = {moving(testing::box({0, 0, 0}, {1, 1, 0}, {1, 1, 1}), {0.02, 0, 0}, {0, 0, 0.03}),
                 moving(testing::box({1.5, 0.3, 0}, {2.5, 1.3, 0}, {1, 1, 1}), {-0.02, 0, 0}, {0, 0, 0.01})};
  SolidRun run(config, 2, 60, testing::comm());
  run.start();
  Real const energy = run.energy();
  auto const before = run.measure();
  run.to_the_end();
  auto const after = run.measure();
  EXPECT_LT(run.velocity(0).x, -0.005);
  EXPECT_NEAR(run.energy() / energy, 1, 1e-5);
  Real const scale = before.value(Measures::momentum_scale);
  EXPECT_NEAR(norm(after.vector(Measures::momentum) - before.vector(Measures::momentum)) / scale, 0, 1e-13);
  EXPECT_NEAR(norm(after.vector(Measures::angular) - before.vector(Measures::angular)) / scale, 0, 1e-13);
  EXPECT_EQ(run.solid.pose()[0].x.z, 0.5);
}

TEST(Contact, EqualRodsExchangeTheirVelocities) {
  Real const length = 40, speed = 0.01;
  for (int const dimension : {1, 3}) {
    SolidConfig config = testing::one_material(1, 1, 0);
    config.contact.emplace();
    Real const side = dimension == 3 ? 1 : 0;
    config.body = {moving(testing::box({0, 0, 0}, {length, side, side}, {40, 1, 1}), {speed, 0, 0}),
                   testing::box({length, 0, 0}, {2 * length, side, side}, {40, 1, 1})};
    SolidRun run(config, dimension, 100, testing::comm());
    run.start();
    auto const before = run.measure();
    Real first = -1, last = 0;
    while (!run.simulation.finished()) {
      run.simulation.pair();
      if (contact_of(run).overlapping_pairs() == 0) continue;
      if (first < 0) first = run.simulation.clock().time;
      last = run.simulation.clock().time;
    }
    auto const after = run.measure();
    std::string const variant = std::to_string(dimension) + "D, 40 cells each";
    EXPECT_TRUE(near("S32", "rod impact", variant, "duration / (2 L / c0)", (last - first) / (2 * length), 1, 0.02));
    EXPECT_TRUE(
        near("S32", "rod impact", variant, "velocity of the struck rod / v0", run.velocity(1).x / speed, 1, 0.02));
    EXPECT_TRUE(
        near("S32", "rod impact", variant, "velocity of the striking rod / v0", run.velocity(0).x / speed, 0, 0.02));
    EXPECT_TRUE(at_most("S32", "rod impact", variant, "momentum",
                        norm(after.vector(Measures::momentum) - before.vector(Measures::momentum)) /
                            before.value(Measures::momentum_scale),
                        1e-13));
  }
}

/// Turns a body about its centre, as a rigid one.
void turn(SolidRun& run, Index body, Vec3 const& centre, Quaternion const& q) {
  for (Index p = 0; p < run.solid.owned(); ++p) {
    if (run.mesh.particle(run.solid.id(p)).body != body) continue;
    Pose& pose = run.solid.pose()[static_cast<std::size_t>(p)];
    pose.x = centre + rotate(q, pose.x - centre);
    pose.q = q * pose.q;
  }
}

/// A cube of n^3 cells that falls on a held floor of cells like its own.
struct Fall {
  Index n = 1;
  Real cfl = 0.9, contact_cfl = 0.1;
  Vec3 turned{}, spin{}, aside{};
  Real start = 0.1;  ///< height of its lowest point
};

/// Mean energy after it has bounced off, over that before. One cell is rigid, more are linked.
Real bounce(Fall const& fall) {
  SolidConfig config = rigid();
  if (fall.n > 1) config.links.emplace();
  config.motion.cfl = fall.cfl;
  config.contact->cfl = fall.contact_cfl;
  Real const h = 0.5 * fall.n;
  Quaternion const q = testing::rotation(fall.turned);
  Real lowest = 0;
  for (int corner = 0; corner < 8; ++corner)
    lowest = min(lowest, rotate(q, Vec3{corner & 1 ? h : -h, corner & 2 ? h : -h, corner & 4 ? h : -h}).z);
  Vec3 const centre = fall.aside + Vec3{0, 0, fall.start - lowest}, half{h, h, h};
  config.body = {
      held(testing::box({-2, -2, -1}, {2, 2, 0}, {4, 4, 1})),
      moving(testing::box(centre - half, centre + half, {fall.n, fall.n, fall.n}), {0, 0, -0.02}, fall.spin)};
  SolidRun run(config, 3, 60 + 16 * fall.n, testing::comm());
  turn(run, 1, centre, q);
  run.start();
  Real const energy = run.energy();
  Real mean = 0;
  int free_steps = 0;
  bool met = false;
  while (!run.simulation.finished()) {
    run.simulation.pair();
    if (contact_of(run).overlapping_pairs() > 0)
      mean = 0, free_steps = 0, met = true;
    else
      mean += run.energy(), ++free_steps;
  }
  EXPECT_TRUE(met);
  EXPECT_GT(free_steps, 2);
  return mean / free_steps / energy;
}

TEST(Contact, BouncesReturnTheirEnergy) {
  EXPECT_TRUE(
      at_most("S28", "bounce of a rigid cube", "flat, on four cells", "energy lost", std::abs(bounce({}) - 1), 1e-12));
  Vec3 const edge{0.785, 0, 0}, corner{0.785, 0.6155, 0}, little{0.01, 0.02, 0};
  auto const check = [](char const* body, char const* variant, Fall const& fall) {
    EXPECT_TRUE(at_most("S28", body, variant, "energy lost", std::abs(bounce(fall) - 1), 1e-3));
  };
  for (Real const contact_cfl : {0.1, 0.3}) {
    std::string const at = ", contact.cfl " + std::to_string(contact_cfl);
    Fall fall;
    fall.contact_cfl = contact_cfl;
    // Pressed on one side it leaves askew: what overlaps last is a layer of uneven thickness.
    fall.aside = little;
    check("bounce of a rigid cube", ("off the middle of four cells" + at).c_str(), fall);
    fall.turned = edge, fall.spin = {0.001, 0.0005, 0};
    check("bounce of a rigid cube", ("on an edge" + at).c_str(), fall);
    fall.turned = corner;
    check("bounce of a rigid cube", ("on a corner" + at).c_str(), fall);
  }
  Fall tumbling;
  tumbling.spin = {0.004, 0.003, 0.002};
  check("bounce of a rigid cube", "tumbling", tumbling);
  // An elastic body rings; what is left is Verlet's own error, of second order in its step.
  for (Real const cfl : {0.9, 0.5}) {
    std::string const at = ", motion.cfl " + std::to_string(cfl);
    Fall fall;
    fall.n = 4, fall.cfl = cfl;
    check("bounce of an elastic cube", ("4^3 cells, flat" + at).c_str(), fall);
    fall.aside = little, fall.start = 0.13;
    check("bounce of an elastic cube", ("4^3 cells, flat, askew" + at).c_str(), fall);
    fall.spin = tumbling.spin;
    check("bounce of an elastic cube", ("4^3 cells, tumbling" + at).c_str(), fall);
    fall.turned = edge, fall.spin = {};
    check("bounce of an elastic cube", ("4^3 cells, on an edge" + at).c_str(), fall);
    fall.turned = corner;
    check("bounce of an elastic cube", ("4^3 cells, on a corner" + at).c_str(), fall);
  }
}

TEST(Contact, RestitutionIsAsAskedAndItsLossIsOnTheAccount) {
  for (Real const e : {0.2, 0.5, 0.8}) {
    SolidConfig config = rigid();
    config.contact->restitution = e;
    config.body = {held(testing::box({-2, -2, -1}, {2, 2, 0}, {1, 1, 1})),
                   moving(testing::box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}, {1, 1, 1}), {0, 0, -0.02})};
    SolidRun run(config, 3, 25, testing::comm());
    run.start();
    Real const energy = run.energy();
    run.to_the_end();
    EXPECT_NEAR(run.velocity(1).z / 0.02, e, 0.02);
    EXPECT_NEAR(run.dissipated() / energy, 1 - e * e, 0.02);
    EXPECT_NEAR((run.energy() + run.dissipated()) / energy, 1, 2e-3);
    EXPECT_LT(run.simulation.ledger().conservation().momentum.z, 1e-13);
  }
}

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
