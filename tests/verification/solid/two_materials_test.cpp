// Bodies of two materials that are glued together: stiffness in series, reflection of waves, bending, stable step.
// Source: theory/solid.md section 1, two materials.
#include <gtest/gtest.h>

#include "parallel/error.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;

/// A bar along x: `cells` cubes of 1 m of the left material, then as many of the right one.
SolidConfig bar(MaterialConfig const& left, MaterialConfig const& right, Index cells, Index across = 1) {
  SolidConfig config = testing::one_material(1, 1, 0);
  config.material["left"] = left;
  config.material["right"] = right;
  Real const width = static_cast<Real>(across), length = static_cast<Real>(cells);
  config.body.push_back(testing::box({0, 0, 0}, {length, width, width}, {cells, across, across}));
  config.body.push_back(testing::box({length, 0, 0}, {2 * length, width, width}, {cells, across, across}));
  config.body[0].name = config.body[0].material = "left";
  config.body[1].name = config.body[1].material = "right";
  config.bond.push_back({{"left", "right"}, {}});
  return config;
}

MaterialConfig material(Real density, Real young, Real nu) { return {density, young, nu, {}}; }

TEST(TwoMaterials, AreStiffInSeries) {
  for (Real nu : {0.0, 0.3}) {
    SolidConfig const config = bar(material(1, 1, nu), material(1, 5, nu), 6);
    Lone body(config);
    ASSERT_EQ(body.mesh.links.size(), 11u);
    Real const stress = 1e-5, dt = body.solid.stable_step();
    std::vector<FaceLoad> loads;
    for (FreeFace const& f : body.mesh.free_faces)
      if (Vec3 const n = body.mesh.face(f.particle, f.face).normal; std::abs(n.x) > 0.5)
        loads.push_back({f.particle, f.face, {stress * n.x, 0, 0}});
    ASSERT_EQ(loads.size(), 2u);
    body.solid.load_faces(loads);
    for (int n = 0; n < static_cast<int>(1200 / dt); ++n) {
      body.solid.step(dt);
      for (Motion& m : body.solid.motion()) m.v *= 1 - 0.2 * dt, m.spin *= 1 - 0.2 * dt;
    }
    Real low = 1e300, high = -1e300;
    for (Pose const& p : body.solid.pose()) low = min(low, p.x.x), high = max(high, p.x.x);
    // From the centre of the first cube to that of the last one.
    Real const exact = stress * (5.5 / 1 + 5.5 / 5);
    std::string const variant = "nu " + std::to_string(nu).substr(0, 3);
    EXPECT_TRUE(evidence::near("S8", "bar of two materials", variant, "elongation / exact", (high - low - 11) / exact,
                               1, 1e-8));
  }
}

/// A pulse that meets the interface: amplitude reflected and transmitted over the incident one.
TEST(TwoMaterials, ReflectWavesByTheirImpedances) {
  struct Pair {
    Real density, young;
  };
  Index const cells = evidence::full() ? 400 : 200;
  for (Pair const& right : {Pair{1, 4}, Pair{4, 1}, Pair{0.25, 1}, Pair{2, 8}}) {
    Real const length = static_cast<Real>(cells), width = 0.1 * length;
    Lone body(bar(material(1, 1, 0), material(right.density, right.young, 0), cells));
    Real const speed = std::sqrt(right.young / right.density), ratio = right.density * speed;  // Z_2 / Z_1, Z_1 = 1
    // To the right: u' = -v / c. The pulse is one arch of a squared sine of the velocity about x = 0.6 L.
    for (std::size_t p = 0; p < body.solid.motion().size(); ++p) {
      Real const s = (body.solid.pose()[p].x.x - 0.6 * length) / width;
      if (std::abs(s) >= 1) {
        if (s < 0) body.solid.pose()[p].x.x += 1e-4 * width;
        continue;
      }
      Real const pi = std::acos(-1.0), bell = std::cos(0.5 * pi * s);
      body.solid.motion()[p].v.x = 1e-4 * bell * bell;
      body.solid.pose()[p].x.x += 1e-4 * width * (0.5 * (1 - s) - std::sin(pi * s) / (2 * pi));
    }
    body.solid.compute_forces();
    Real const end = 0.65 * length;  // the pulse has crossed the interface and met no end
    int const steps = static_cast<int>(std::ceil(end / body.solid.stable_step()));
    Real const dt = end / steps;
    for (int n = 0; n < steps; ++n) body.solid.step(dt);
    Real back = 0, on = 0;
    for (std::size_t p = 0; p < body.solid.motion().size(); ++p) {
      Real const x = body.mesh.particle(static_cast<GlobalId>(p)).centre.x, v = 1e4 * body.solid.motion()[p].v.x;
      Real& of = x < length ? back : on;
      if (std::abs(v) > std::abs(of)) of = v;
    }
    std::string const variant =
        "Z2/Z1 " + std::to_string(ratio).substr(0, 4) + ", c2/c1 " + std::to_string(speed).substr(0, 3);
    EXPECT_TRUE(evidence::near("S8", "wave at an interface", variant, "reflected velocity", back,
                               (1 - ratio) / (1 + ratio), 0.01));
    EXPECT_TRUE(
        evidence::near("S8", "wave at an interface", variant, "transmitted velocity", on, 2 / (1 + ratio), 0.01));
  }
}

TEST(TwoMaterials, OfTheSameKindAreOneBody) {
  SolidConfig glued = bar(material(1, 1, 0.3), material(1, 1, 0.3), 3, 2), whole = testing::one_material(1, 1, 0.3);
  whole.body.push_back(testing::box({0, 0, 0}, {6, 2, 2}, {6, 2, 2}));
  Lone a(glued), b(whole);
  EXPECT_EQ(a.mesh.links.size(), b.mesh.links.size());
  EXPECT_EQ(a.mesh.free_faces.size(), b.mesh.free_faces.size());
  EXPECT_NEAR(a.solid.stable_step(), b.solid.stable_step(), 1e-14);
}

TEST(TwoMaterials, KeepEnergyAtTheStableStep) {
  SolidConfig config = bar(material(1, 1, 0.45), material(3, 20, 0.1), 3, 3);
  config.motion.cfl = 1;
  Lone body(config);
  testing::Random random(5);
  for (Motion& m : body.solid.motion()) m.v = 1e-6 * random.vector(), m.spin = 1e-7 * random.vector();
  Real const before = body.energy(), dt = body.solid.stable_step();
  for (int n = 0; n < 3000; ++n) body.solid.step(dt);
  EXPECT_TRUE(evidence::at_most("S22", "two materials", "nu .45 and .1", "growth of energy at the guaranteed bound",
                                body.energy() / before, 1.5));
}

TEST(TwoMaterials, BondsSayWhatIsWrong) {
  SolidConfig config = bar(material(1, 1, 0), material(1, 1, 0), 2, 2);
  config.body[1].cells = {2, 3, 3};
  EXPECT_THROW(build_mesh(config, 3), Error);
  config.body[1].cells = {2, 2, 2};
  config.bond[0].bodies = {"left", "write"};
  EXPECT_THROW(build_mesh(config, 3), Error);
  config.bond[0].bodies = {"left"};
  EXPECT_THROW(build_mesh(config, 3), Error);
  config.bond[0].bodies = {"left", "right"};
  config.links.reset();
  EXPECT_THROW(build_mesh(config, 3), Error);
}

}  // namespace
}  // namespace brisance::solid
