#include "core/solid/mesh.hpp"

#include <gtest/gtest.h>

#include "core/solid/space_curve.hpp"
#include "parallel/error.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

std::string scene_error(SolidConfig const& config, int dimension) {
  try {
    build_mesh(config, dimension);
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    return e.what();
  }
  return "";
}

void expect_words(std::string const& text, std::vector<std::string> const& words) {
  for (auto const& w : words) EXPECT_NE(text.find(w), std::string::npos) << w << " in: " << text;
}

TEST(Mesh, NumbersFollowTheCurveAndLinksAreSorted) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {8, 8, 8}, {8, 8, 8}));
  Mesh const mesh = build_mesh(config, 3);
  // Neighbours along a Hilbert curve of cubes share a face.
  for (GlobalId p = 1; p < mesh.size(); ++p)
    EXPECT_NEAR(norm(mesh.particle(p).centre - mesh.particle(p - 1).centre), 1, 1e-12);
  for (std::size_t l = 1; l < mesh.links.size(); ++l)
    EXPECT_LT(std::pair(mesh.links[l - 1].i, mesh.links[l - 1].j), std::pair(mesh.links[l].i, mesh.links[l].j));
}

TEST(Mesh, OverlappingBodiesAreNamedWithThePlace) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  config.body.push_back(testing::box({0.9, 0, 0}, {2, 1, 1}, {2, 2, 2}));
  config.body[0].name = "left";
  config.body[1].name = "right";
  config.body[1].at = {"scene.toml", 12, 1};
  expect_words(scene_error(config, 3), {"scene.toml:12", "left", "right", "overlap", "0.1", "m"});
  config.body[1].low = Vec3{1, 0, 0};
  EXPECT_EQ(scene_error(config, 3), "");  // touching is allowed
}

TEST(Mesh, NonConvexCellIsNamedWithThePlace) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.name = "arrow";
  b.material = "m";
  b.shape = "prism";
  b.corners = {0, 0, 2, 0, 1, 0.5, 2, 1, 0, 1};
  b.at = {"scene.toml", 7, 3};
  config.body.push_back(b);
  expect_words(scene_error(config, 2), {"scene.toml:7:3", "arrow", "cell 0", "not convex", "(1, 0.5"});
}

TEST(Mesh, MissingDimensionsAndMaterialsAreNamed) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = "m";
  b.shape = "tube";
  b.tessellation = "polar";
  config.body.push_back(b);
  expect_words(scene_error(config, 2), {"centre"});
  config.body[0].centre = Vec3{0, 0, 0};
  expect_words(scene_error(config, 2), {"inner_radius"});
  config.body[0].tessellation = "cartesian";
  expect_words(scene_error(config, 2), {"polar", "voronoi"});
  config.body[0].material = "cheese";
  expect_words(scene_error(config, 2), {"cheese", "solid.material"});
}

TEST(Mesh, HoldsAndClamps) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b = testing::box({0, 0, 0}, {4, 1, 1}, {4, 1, 1});
  b.hold.push_back({{3, 0, 0}, {4, 1, 1}});
  b.clamp.push_back({{0, 0, 0}, {0, 1, 1}});
  config.body.push_back(b);
  Mesh const mesh = build_mesh(config, 3);
  int fixed = 0, clamped = 0, walls = 0;
  for (Particle const& p : mesh.particles) fixed += p.freedom == Freedom::fixed;
  for (FreeFace const& f : mesh.free_faces) clamped += f.clamped;
  for (Link const& l : mesh.links) walls += l.j == Link::wall;
  EXPECT_EQ(fixed, 1);
  EXPECT_EQ(clamped, 1);
  EXPECT_EQ(walls, 1);
}

}  // namespace
}  // namespace brisance::solid
