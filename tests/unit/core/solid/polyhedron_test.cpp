#include "core/solid/polyhedron.hpp"

#include <gtest/gtest.h>

namespace brisance::solid {
namespace {

Polyhedron brick(Vec3 const& low, Vec3 const& high) {
  Polyhedron p;
  for (int c = 0; c < 8; ++c)
    p.vertices.push_back({c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z});
  p.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return p;
}

TEST(Polyhedron, BrickHasItsVolumeCentreAndSecondMoments) {
  Moments const m = moments(brick({1, 2, 3}, {2, 4, 6}));
  EXPECT_NEAR(m.volume, 6, 1e-14);
  EXPECT_NEAR(norm(m.centre - Vec3{1.5, 3, 4.5}), 0, 1e-14);
  EXPECT_NEAR(m.second[0].x, 6 * 1.0 / 12, 1e-14);
  EXPECT_NEAR(m.second[1].y, 6 * 4.0 / 12, 1e-14);
  EXPECT_NEAR(m.second[2].z, 6 * 9.0 / 12, 1e-13);
  EXPECT_NEAR(m.second[0].y, 0, 1e-14);
}

TEST(Polyhedron, FaceHasItsAreaAndSecondMoment) {
  FaceGeometry const f = face_geometry(brick({0, 0, 0}, {1, 2, 3}), 1);
  EXPECT_NEAR(f.area, 6, 1e-14);
  EXPECT_NEAR(norm(f.normal - Vec3{1, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(f.second[1].y, 6 * 4.0 / 12, 1e-14);
  EXPECT_NEAR(f.second[2].z, 6 * 9.0 / 12, 1e-14);
  EXPECT_NEAR(f.second[0].x, 0, 1e-14);
}

TEST(Polyhedron, FaultNamesWhatIsWrong) {
  Polyhedron const good = brick({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(fault(good));
  Polyhedron open = good;
  open.faces.pop_back();
  EXPECT_NE(fault(open)->what.find("not closed"), std::string::npos);
  Polyhedron inward = good;
  for (auto& f : inward.faces) std::swap(f[1], f[3]);
  EXPECT_NE(fault(inward)->what.find("inward"), std::string::npos);
  Polyhedron bent = good;
  bent.vertices[7] = {0.8, 0.9, 0.7};
  EXPECT_NE(fault(bent)->what.find("not plane"), std::string::npos);
}

TEST(Polyhedron, OverlapDepthIsTheSmallestShift) {
  Polyhedron const a = brick({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(overlap_depth(a, brick({0.9, 0.5, 0.5}, {2, 2, 2})), 0.1, 1e-14);
  EXPECT_LE(overlap_depth(a, brick({1, 0, 0}, {2, 1, 1})), 1e-15);
  EXPECT_LT(overlap_depth(a, brick({1.5, 0, 0}, {2, 1, 1})), -0.4);
  // Two crossed edges: apart only along the product of the edges.
  Polyhedron roof = brick({-0.5, -0.5, -2}, {0.5, 0.5, 2});
  for (Vec3& v : roof.vertices) v = {0.5 + 1.42 + (v.x - v.y) * 0.70710678, 0.5 + (v.x + v.y) * 0.70710678, v.z};
  Polyhedron lying = brick({-2, -0.5, -0.5}, {2, 0.5, 0.5});
  EXPECT_GT(overlap_depth(roof, lying), 0);
}

}  // namespace
}  // namespace brisance::solid
