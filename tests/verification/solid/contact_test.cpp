// Contact: S28 (gradient, tumbling cubes), S32 (impact of rods), bounces and their losses.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/contact_bodies.hpp"
#include "tests/support/evidence.hpp"

namespace brisance::solid {
namespace {

using evidence::at_most;
using evidence::near;
using namespace testing;

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

}  // namespace
}  // namespace brisance::solid
