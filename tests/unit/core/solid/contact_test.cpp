// The pieces of contact: clipping, laws, search.
#include <gtest/gtest.h>

#include "core/solid/contact/contact_law.hpp"
#include "core/solid/contact/meeting_spheres.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

/// One brick about its centre.
Convex brick(Vec3 const& size, int dimension = 3) {
  SolidConfig config = testing::one_material(1, 1, 0);
  config.body.push_back(testing::box({0, 0, 0}, size, {1, 1, 1}));
  return make_convex(build_mesh(config, dimension).shapes[0], dimension);
}

PlacedConvex placed(Convex const& shape, Vec3 const& turn = {}) {
  PlacedConvex p;
  p.place(shape, testing::rotation(turn));
  return p;
}

TEST(Clipper, FindsTheCommonBrickOfTwoBricks) {
  Convex const a = brick({1, 1, 1}), b = brick({2, 1, 0.5});
  Clipper clipper;
  Intersection const o = clipper.intersect(placed(a), placed(b), {1.4, 0.25, 0.125});
  EXPECT_NEAR(o.volume, 0.1 * 0.75 * 0.5, 1e-15);
  EXPECT_NEAR(norm(o.centroid - Vec3{0.45, 0.125, 0.125}), 0, 1e-15);
  // B covers A's face x = 1/2 between y = -1/4 and 1/2, z = -1/8 and 3/8, and a strip of its face y = 1/2.
  EXPECT_NEAR(norm(o.area - Vec3{0.75 * 0.5, 0.1 * 0.5, 0}), 0, 1e-15);
  EXPECT_NEAR(o.order, 1, 1e-12);
}

TEST(Clipper, TouchingAndSeparateBricksShareNothing) {
  Convex const a = brick({1, 1, 1});
  Clipper clipper;
  EXPECT_EQ(clipper.intersect(placed(a), placed(a), {1, 0, 0}).volume, 0);
  EXPECT_EQ(clipper.intersect(placed(a), placed(a), {1, 1, 1}).volume, 0);
  EXPECT_EQ(clipper.intersect(placed(a), placed(a), {1.5, 0.2, 0}).volume, 0);
  // Edges that pass each other: no face separates them.
  PlacedConvex const tilted = placed(a, {std::atan(1.0), 0, 0}), other = placed(a, {0, std::atan(1.0), 0});
  EXPECT_EQ(clipper.intersect(tilted, other, {0, 0, std::sqrt(2.0) + 1e-6}).volume, 0);
  EXPECT_GT(clipper.intersect(tilted, other, {0, 0, std::sqrt(2.0) - 1e-3}).volume, 0);
}

TEST(Clipper, FlushFacesCountOnce) {
  Convex const a = brick({1, 1, 1});
  Clipper clipper;
  for (Real const turn : {0.0, 1e-16, 1e-15, 1e-12}) {
    Intersection const o = clipper.intersect(placed(a), placed(a, {0, 0, turn}), {0, 0, 0.99});
    EXPECT_NEAR(o.volume, 0.01, 1e-12) << turn;
    EXPECT_NEAR(norm(o.area - Vec3{0, 0, 1}), 0, 1e-3) << turn;
  }
}

TEST(Clipper, VolumesOfPartsAddUp) {
  // A turned brick against a brick in one piece and in eight.
  Convex const a = brick({1, 0.8, 0.6}), whole = brick({2, 2, 2}), part = brick({1, 1, 1});
  Clipper clipper;
  testing::Random random(3);
  for (int n = 0; n < 200; ++n) {
    PlacedConvex const turned = placed(a, 3.0 * random.vector());
    Vec3 const shift = 1.4 * random.vector();
    Intersection const all = clipper.intersect(turned, placed(whole), shift);
    Real sum = 0;
    Vec3 first{};
    for (int c = 0; c < 8; ++c) {
      Vec3 const corner{c & 1 ? 0.5 : -0.5, c & 2 ? 0.5 : -0.5, c & 4 ? 0.5 : -0.5};
      Intersection const o = clipper.intersect(turned, placed(part), shift + corner);
      sum += o.volume;
      first += o.volume * o.centroid;
    }
    EXPECT_NEAR(all.volume, sum, 1e-14);
    EXPECT_NEAR(norm(all.volume * all.centroid - first), 0, 1e-14);
    // The same from the other side.
    Intersection const back = clipper.intersect(placed(whole), turned, -shift);
    EXPECT_NEAR(all.volume, back.volume, 1e-14);
    EXPECT_NEAR(norm(all.area + back.area), 0, 1e-13);
  }
}

TEST(Convex, GapsAreLowerBoundsAndSeparationNeedsOne) {
  Convex const a = brick({1, 1, 1}), b = brick({2, 1, 0.2});
  testing::Random random(5);
  Clipper clipper;
  int apart = 0;
  for (int n = 0; n < 500; ++n) {
    PlacedConvex const p = placed(a, 3.0 * random.vector()), q = placed(b, 3.0 * random.vector());
    Vec3 const shift = 1.6 * random.vector();
    int hint = n % 12;
    bool const separate = separated_by_face(p, q, shift, hint);
    Real const gap = gap_along_normals(p, q, shift).width;
    EXPECT_EQ(separate, gap >= 0);
    if (!separate) continue;
    ++apart;
    EXPECT_EQ(clipper.intersect(p, q, shift).volume, 0);
    Vec3 const closer = shift - (0.999 * gap / norm(shift)) * shift;
    EXPECT_EQ(clipper.intersect(p, q, closer).volume, 0);
  }
  EXPECT_GT(apart, 100);
}

TEST(MeetingSpheres, AreThoseOfAllPairs) {
  testing::Random random(11);
  std::vector<Sphere> spheres;
  for (int n = 0; n < 400; ++n) spheres.push_back({2.0 * random.vector(), 0.1 * (1.01 + random())});
  spheres.push_back({{0, 0, 0}, 2.5});  // one large body among many small ones
  spheres.push_back({{1e30, 0, 0}, 0.1});
  std::vector<std::pair<Index, Index>> expected;
  for (std::size_t a = 0; a < spheres.size(); ++a)
    for (std::size_t b = a + 1; b < spheres.size(); ++b)
      if (norm(spheres[a].centre - spheres[b].centre) < spheres[a].radius + spheres[b].radius)
        expected.emplace_back(a, b);
  EXPECT_GT(expected.size(), 300u);
  EXPECT_EQ(meeting_spheres(spheres), expected);
}

TEST(Barrier, ForcesAreTheGradientOfItsEnergy) {
  Convex const shapes[2] = {brick({1, 0.8, 0.2}), brick({0.3, 0.9, 1.2})};
  BarrierLaw const law{0.2, 3, 0.05 * 0.008};
  testing::Random random(7);
  Clipper clipper;
  int met = 0;
  for (int n = 0; n < 2000; ++n) {
    Vec3 x[2] = {{}, 0.7 * random.vector()};
    Quaternion q[2] = {testing::rotation(3.0 * random.vector()), testing::rotation(3.0 * random.vector())};
    DepthAxis axis;
    auto const find = [&](bool choose) {
      PlacedConvex a, b;
      a.place(shapes[0], q[0]), b.place(shapes[1], q[1]);
      Vec3 const shift = x[1] - x[0];
      Intersection const o = clipper.intersect(a, b, shift);
      if (choose && o.volume > 0) axis = choose_axis({}, law, o, a, b, q[0], q[1], shift), axis.start = 0.02;
      return find_barrier(axis, law, o, clipper, q[0], q[1], shift);
    };
    Barrier const here = find(true);
    if (!(here.energy > 1e-6)) continue;
    ++met;
    EXPECT_NEAR(norm(here.torque_a + here.torque_b - cross(x[1] - x[0], here.force)), 0, 1e-13 * norm(here.force));
    for (int body = 0; body < 2; ++body)
      for (int d = 0; d < 3; ++d) {
        Vec3 axis_d{};
        axis_d[d] = 1;
        Vec3 const x0 = x[body];
        Quaternion const q0 = q[body];
        auto const energy = [&](Real shift, Real turn) {
          x[body] = x0 + shift * axis_d, q[body] = testing::rotation(turn * axis_d) * q0;
          Real const e = find(false).energy;
          x[body] = x0, q[body] = q0;
          return e;
        };
        Real const h = 1e-5, sign = body == 0 ? 1 : -1;
        Real const by_shift = (energy(h, 0) - energy(-h, 0)) / (2 * h),
                   by_turn = (energy(0, h) - energy(0, -h)) / (2 * h);
        EXPECT_NEAR(by_shift, -sign * here.force[d], 1e-5 * norm(here.force) + 1e-9) << n;
        EXPECT_NEAR(by_turn, -(body == 0 ? here.torque_a : here.torque_b)[d], 1e-5 * norm(here.force) + 1e-9) << n;
      }
  }
  EXPECT_GT(met, 200);
}

TEST(Barrier, KeepsItsSideWhileItIsDeepAndFollowsTheOverlapWhileItIsShallow) {
  Convex const plate = brick({2, 2, 0.1}), block = brick({1, 0.1, 1});
  BarrierLaw const law{0.1, 1, 0.05e-3};
  Clipper clipper;
  auto const axis_at = [&](DepthAxis const& before, Vec3 const& shift) {
    PlacedConvex const a = placed(plate), b = placed(block);
    return choose_axis(before, law, clipper.intersect(a, b, shift), a, b, {}, {}, shift);
  };
  DepthAxis axis = axis_at({}, {0, 0, 0.54});
  EXPECT_NEAR(axis.outward.z, -1, 1e-12);  // the block is the longer one: its lower face
  EXPECT_TRUE(axis.of_b);
  for (Real z = 0.53; z > -0.5; z -= 0.02) {
    axis = axis_at(axis, {0, 0, z});
    EXPECT_NEAR(axis.outward.z, -1, 1e-12) << z;
    PlacedConvex const a = placed(plate), b = placed(block);
    Intersection const o = clipper.intersect(a, b, {0, 0, z});
    Barrier const barrier = find_barrier(axis, law, o, clipper, {}, {}, {0, 0, z});
    if (z < 0.49) {
      EXPECT_LT(barrier.force.z, 0) << z;
    }
  }
  // A shallow overlap goes over the edge of the plate and down its side, and the axis with it.
  axis = {};
  axis = axis_at(axis, {0.4, 0, 0.545});
  EXPECT_NEAR(std::abs(axis.outward.z), 1, 1e-12);
  for (Real x = 0.4; x < 1.495; x += 0.005) axis = axis_at(axis, {x, 0, 0.545});
  for (Real z = 0.545; z > 0; z -= 0.005) axis = axis_at(axis, {1.495, 0, z});
  EXPECT_NEAR(std::abs(axis.outward.x), 1, 1e-12);
}

TEST(PairLaw, PressureIsTheSlopeOfTheEnergy) {
  PairLaw law;
  law.stiffness = 3, law.knee = 0.2;
  for (Real const v : {0.05, 0.19, 0.21, 0.7}) {
    Real const h = 1e-5;
    EXPECT_NEAR((law.energy(v + h) - law.energy(v - h)) / (2 * h), law.pressure(v), 1e-8);
    EXPECT_NEAR((law.pressure(v + h) - law.pressure(v - h)) / (2 * h), law.slope(v), 1e-8);
  }
  EXPECT_DOUBLE_EQ(law.pressure(0.2), 0.6);
}

TEST(PairLaw, DampingGivesTheRestitution) {
  for (Real const e : {0.1, 0.3, 0.5, 0.9}) {
    Real const c = damping_for(e);
    Real x = 0, v = 1, dt = 1e-5;  // x'' = -x (1 + c v)
    do {
      v -= 0.5 * dt * x * (1 + c * v);
      x += dt * v;
      v -= 0.5 * dt * x * (1 + c * v);
    } while (x > 0);
    EXPECT_NEAR(-v, e, 1e-3);
  }
  EXPECT_EQ(damping_for(1), 0);
}

TEST(ContactForce, MomentaSumToZeroWithFrictionAndDamping) {
  Convex const a = brick({1, 1, 1}), b = brick({1, 0.7, 1.2});
  PairLaw law;
  law.stiffness = 1, law.knee = 0.14, law.damping = 0.6, law.friction = 0.4, law.shear_ratio = 0.8;
  testing::Random random(2);
  Clipper clipper;
  int met = 0;
  for (int n = 0; n < 300; ++n) {
    Vec3 const ta = 3.0 * random.vector(), tb = 3.0 * random.vector(), shift = 0.8 * random.vector();
    Intersection const o = clipper.intersect(placed(a, ta), placed(b, tb), shift);
    if (o.volume == 0) continue;
    ++met;
    PairEnd ends[2];
    for (PairEnd& e : ends) e.v = random.vector(), e.omega = random.vector(), e.contact_a = random.vector();
    ends[0].q = testing::rotation(ta), ends[1].q = testing::rotation(tb);
    PairMemory before;
    before.shear = random.vector(), before.shear_stiffness = 0.3;
    PairForce const f = contact_force(law, o, shift, ends[0], ends[1], 0.01, n % 2 ? &before : nullptr);
    Real const scale = norm(f.force) + norm(f.torque_a);
    EXPECT_NEAR(norm(f.torque_a + f.torque_b - cross(shift, f.force)), 0, 1e-14 * scale);
    // Friction stays in its cone.
    Vec3 const normal = normalized(o.area);
    Vec3 const along = dot(f.force, normal) * normal;
    EXPECT_LE(norm(f.force - along), law.friction * norm(along) * (1 + 1e-9));
    EXPECT_LE(dot(f.force, normal), 1e-15);  // never pulls
    EXPECT_EQ(PairMemory::unpack(f.memory.pack().data()).pack(), f.memory.pack());
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace brisance::solid
