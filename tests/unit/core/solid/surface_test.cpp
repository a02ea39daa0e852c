#include "core/solid/surface.hpp"

#include <gtest/gtest.h>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

TEST(Surface, OfABoxIsClosedAndEnclosesItsVolume) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {3, 2, 1}, {3, 2, 1}));
  testing::Lone body(config);
  Surface const surface(body.mesh);
  EXPECT_EQ(surface.elements().size(), 4u * 2 * (6 + 3 + 2));
  Real volume = 0;
  for (Element const& e : surface.elements()) {
    Vec3 const a = surface.position(e.vertex[0], body.solid), b = surface.position(e.vertex[1], body.solid),
               c = surface.position(e.vertex[2], body.solid);
    volume += dot(a, cross(b, c)) / 6;
  }
  EXPECT_NEAR(volume, 6, 1e-12);
}

TEST(Surface, VerticesMoveWithTheMeanOfTheirParticles) {
  SolidConfig config = testing::one_material(1, 1, 0);
  config.body.push_back(testing::box({0, 0, 0}, {2, 1, 0}, {2, 1, 1}));
  testing::Lone body(config, 2);
  Surface const surface(body.mesh);
  EXPECT_EQ(surface.elements().size(), 6u);
  Real area = 0;
  for (Element const& e : surface.elements()) {
    Vec3 const a = surface.position(e.vertex[0], body.solid), b = surface.position(e.vertex[1], body.solid);
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  EXPECT_NEAR(area, 2, 1e-14);
  body.solid.pose()[0].x.y += 0.5;
  int moved = 0;
  for (Index v = 0; v < surface.vertices(); ++v) {
    Real const shift = norm(surface.position(v, body.solid) - surface.reference(v, body.mesh));
    moved += std::abs(shift - 0.25) < 1e-14;  // the two vertices shared with the particle that stays
  }
  EXPECT_EQ(moved, 2);
}

TEST(Surface, OfASlabInOneDimensionIsTwoPoints) {
  SolidConfig config = testing::one_material(1, 1, 0);
  config.body.push_back(testing::box({1, 0, 0}, {2, 0, 0}, {4, 1, 1}));
  testing::Lone body(config, 1);
  Surface const surface(body.mesh);
  ASSERT_EQ(surface.elements().size(), 2u);
  for (Element const& e : surface.elements())
    EXPECT_NEAR(surface.position(e.vertex[0], body.solid).x, e.side > 0 ? 2 : 1, 1e-14);
}

}  // namespace
}  // namespace brisance::solid
