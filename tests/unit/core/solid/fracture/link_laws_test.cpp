// Which link follows which law, and the figures only some laws want.
#include <gtest/gtest.h>

#include "core/solid/fracture/fracture.hpp"
#include "core/solid/fracture/link_motion.hpp"
#include "parallel/error.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;

LawConfig law_of(Real strength) {
  LawConfig law;
  law.stress.emplace();
  law.stress->tensile_strength = strength;
  return law;
}

SolidConfig two_bodies() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.material["n"] = {1, 2, 0, {}};
  config.body.push_back(testing::box({0, 0, 0}, {3, 1, 1}, {3, 1, 1}));
  config.body.push_back(testing::box({0, 2, 0}, {3, 3, 1}, {3, 1, 1}));
  config.body[0].name = "left", config.body[1].name = "right";
  config.body[1].material = "n";
  config.body[0].clamp.push_back({{0, 0, 0}, {0, 1, 1}});
  return config;
}

std::string complaint(FractureConfig const& config, Solid const& solid) {
  try {
    assign_laws(config, solid);
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), Failure::scene);
    return error.what();
  }
  return "";
}

TEST(LinkLaws, TheLastLawThatFitsCounts) {
  Lone bodies(two_bodies());
  FractureConfig config;
  config.law = {law_of(1), law_of(2), law_of(3)};
  config.law[0].clamps = false;
  config.law[1].body = "right";
  config.law[2].material = "n";
  auto const groups = assign_laws(config, bodies.solid);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].links.size(), 2u);  // of "left", without its clamped face
  EXPECT_EQ(groups[1].links.size(), 0u);
  EXPECT_EQ(groups[2].links.size(), 2u);
  config.law.pop_back();
  config.law[0].clamps = true;
  auto const fewer = assign_laws(config, bodies.solid);
  EXPECT_EQ(fewer[0].links.size(), 3u);
  EXPECT_EQ(fewer[1].links.size(), 2u);
}

TEST(LinkLaws, SaysWhatIsWrongWithALaw) {
  Lone bodies(two_bodies());
  FractureConfig config;
  EXPECT_NE(complaint(config, bodies.solid).find("has no law"), std::string::npos);
  config.law.emplace_back();
  EXPECT_NE(complaint(config, bodies.solid).find("has no criterion"), std::string::npos);
  config.law[0] = law_of(1);
  config.law[0].elongation = Elongation{0.1};
  EXPECT_NE(complaint(config, bodies.solid).find("more than one criterion"), std::string::npos);
  config.law[0] = law_of(1);
  config.law[0].body = "middle";
  EXPECT_NE(complaint(config, bodies.solid).find("no body \"middle\"; the scene has left, right"), std::string::npos);
  config.law[0] = law_of(1);
  config.law[0].between = {"m", "steel"};
  EXPECT_NE(complaint(config, bodies.solid).find("no material \"steel\""), std::string::npos);
  config.law[0] = {};
  config.law[0].cohesive = Cohesive{0.1, 4e-3, {}, 2, 1};  // E = 1: 0.8 m
  std::string const text = complaint(config, bodies.solid);
  EXPECT_NE(text.find("1 m long"), std::string::npos) << text;
  EXPECT_NE(text.find("0.8 m on"), std::string::npos) << text;
}

TEST(LinkFigures, StretchIsThatOfThePolesAndObjective) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {2, 1, 1}, {1, 1, 1}));
  config.body[0].tessellation = "voronoi";
  config.body[0].particles = 12;
  Lone body(config);
  Quaternion const turn = testing::rotation({0.4, -0.9, 0.3});
  for (Pose& p : body.solid.pose()) {
    p.x = rotate(turn, p.x) + Vec3{1, 2, 3};
    p.q = turn;
  }
  for (std::size_t k = 0; k < body.solid.links(); ++k) EXPECT_NEAR(stretch(body.solid, k), 0, 1e-12);
  // All places drawn out by 10 % without rotation: poles move with their particles.
  Lone other(config);
  Real const by = 0.1;
  for (Index p = 0; p < other.solid.owned(); ++p) {
    Pose& pose = other.solid.pose()[static_cast<std::size_t>(p)];
    Vec3 const pole = other.mesh.shape(other.solid.id(p)).pole;
    pose.x = (1 + by) * (pose.x + pole) - pole;
  }
  for (std::size_t k = 0; k < other.solid.links(); ++k) EXPECT_NEAR(stretch(other.solid, k), by, 1e-12);
}

TEST(LinkFigures, GapOpensAtTheSpeedOfItsEnds) {
  SolidConfig config = testing::one_material(1, 1, 0);
  config.body.push_back(testing::box({0, 0, 0}, {2, 1, 1}, {2, 1, 1}));
  Lone body(config);
  ASSERT_EQ(body.solid.links(), 1u);
  Index const i = body.solid.link_store().end_i(0), j = body.solid.link_store().end_j(0);
  body.solid.motion()[static_cast<std::size_t>(j)].v = {0.03, 0.04, 0};
  body.solid.motion()[static_cast<std::size_t>(i)].v = {0, 0, 0};
  body.solid.drift(0.01);
  EXPECT_NEAR(gap_speed(body.solid, 0), 0.05, 1e-15);
  // Rigid rotation about the face opens nothing.
  Lone turning(config);
  Vec3 const omega{0, 0, 0.2}, middle{1, 0.5, 0.5};
  for (Index p = 0; p < 2; ++p) {
    Motion& m = turning.solid.motion()[static_cast<std::size_t>(p)];
    m.v = cross(omega, turning.solid.pose()[static_cast<std::size_t>(p)].x - middle);
    m.spin = turning.mesh.inertia(turning.solid.id(p)) * omega;
  }
  turning.solid.drift(1e-6);
  EXPECT_NEAR(gap_speed(turning.solid, 0), 0, 1e-7);
}

TEST(LinkFigures, OuterFibreCarriesTheBendingMoment) {
  // Two bricks of section b x h turned against each other by phi about z: sigma = E (h / 2) phi / D at the edge.
  Real const b = 0.7, h = 0.4, length = 1, young = 3, phi = 1e-4;
  SolidConfig config = testing::one_material(1, young, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {2 * length, h, b}, {2, 1, 1}));
  for (Vec3 const& axis : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0, 0.6, 0.8}}) {
    Lone body(config);
    body.solid.pose()[1].q = testing::rotation(phi * axis);
    Real const edge = 0.5 * (h * std::abs(axis.z) + b * std::abs(axis.y));
    EXPECT_NEAR(fibre_stress(body.solid, 0), young * edge * phi / length, 1e-6 * young * phi);
  }
  Lone twisted(config);
  twisted.solid.pose()[1].q = testing::rotation({phi, 0, 0});
  EXPECT_NEAR(fibre_stress(twisted.solid, 0), 0, 1e-12);
}

}  // namespace
}  // namespace brisance::solid
