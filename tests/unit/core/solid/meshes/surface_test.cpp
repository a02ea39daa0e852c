// Closed surfaces: readers, checks, and the cells that fill them.
#include <gtest/gtest.h>

#include <set>

#include "core/solid/meshes/closed_surface.hpp"
#include "core/solid/meshes/quality.hpp"
#include "parallel/error.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/surfaces.hpp"

namespace brisance::solid {
namespace {

SolidConfig scene(std::string const& path, int particles, char const* tessellation = nullptr) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = "m";
  b.shape = "mesh";
  b.mesh.emplace();
  b.mesh->file = path;
  b.particles = particles;
  b.lloyd = 6;
  if (tessellation) b.tessellation = tessellation;
  b.at = {"scene.toml", 7, 1};
  config.body.push_back(b);
  return config;
}

std::string what(SolidConfig const& config) {
  try {
    build_mesh(config, 3);
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    return e.what();
  }
  return "";
}

void expect_refused(std::string const& path, std::vector<std::string> words) {
  std::string const text = what(scene(path, 20));
  words.insert(words.end(), {"scene.toml:7:1", path});
  for (auto const& w : words) EXPECT_NE(text.find(w), std::string::npos) << w << " in: " << text;
}

TEST(Surface, TextAndBytesAndOffAreTheSame) {
  auto const box = testing::box_surface({4, 1, 0.5});
  for (auto const& s : {read_stl(testing::write_stl("text", box, false)),
                        read_stl(testing::write_stl("bytes", box, true)), read_off(testing::write_off("box", box))}) {
    EXPECT_EQ(s.vertices.size(), 8u);
    EXPECT_EQ(s.facets.size(), 12u);
    EXPECT_DOUBLE_EQ(enclosed_volume(s), 2);
    TriangleSurface copy = s;
    check_closed(copy);
    auto const convex = convex_body(copy);
    ASSERT_TRUE(convex.has_value());
    EXPECT_EQ(convex->walls().size(), 6u);
  }
}

TEST(Surface, InsideOutIsTurned) {
  auto ball = testing::ball_surface(1);
  for (auto& f : ball.facets) std::swap(f[0], f[1]);
  EXPECT_LT(enclosed_volume(ball), 0);
  check_closed(ball);
  EXPECT_GT(enclosed_volume(ball), 0);
  EXPECT_TRUE(convex_body(ball).has_value());
  auto hollow = testing::with_cavity(testing::ball_surface(1), testing::ball_surface(0));
  for (std::size_t v = 42; v < hollow.vertices.size(); ++v) hollow.vertices[v] *= 0.5;
  Real const volume = enclosed_volume(hollow);
  check_closed(hollow);
  EXPECT_DOUBLE_EQ(enclosed_volume(hollow), volume);  // right as it was
  EXPECT_FALSE(convex_body(hollow).has_value());
}

TEST(BrokenSurface, IsRefusedWithFacetAndPlace) {
  auto const box = testing::box_surface({1, 1, 1});
  auto open = box;
  open.facets.pop_back();
  expect_refused(testing::write_stl("open", open, false), {"open at the edge from (", "of facet"});
  auto turned = box;
  std::swap(turned.facets[3][0], turned.facets[3][1]);
  expect_refused(testing::write_off("turned", turned), {"turned against its neighbour", "face"});
  auto twice = testing::with_cavity(box, box);
  for (std::size_t v = 8; v < 16; ++v) twice.vertices[v] += Vec3{0.5, 0.3, 0.2};
  expect_refused(testing::write_stl("cuts", twice, true), {"cuts itself", "facet"});
  auto touching = testing::with_cavity(box, box);
  for (std::size_t v = 8; v < 16; ++v) touching.vertices[v] += Vec3{1, 0, 0};
  for (std::size_t f = 12; f < 24; ++f) std::swap(touching.facets[f][0], touching.facets[f][1]);
  expect_refused(testing::write_stl("four", touching, false), {"facet"});
  expect_refused(testing::temporary_file("short.stl", "solid x\n facet normal 0 0 1\n outer loop\n vertex 0 0\n"),
                 {":5: ", "expected a number"});
  expect_refused(testing::temporary_file("bytes.stl", std::string(200, 'x')), {"bytes, not 200"});
  expect_refused(testing::temporary_file("face.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 9\n"),
                 {"face 2 has a vertex 9"});
  expect_refused(testing::temporary_file("part.step", ""), {"\".step\" are not read"});
}

/// Volume, closed cells and total surface of a filled body.
struct Filled {
  Real volume = 0, area = 0, worst = 0;
  explicit Filled(Mesh const& mesh) {
    for (GlobalId p = 0; p < mesh.size(); ++p) {
      Shape const& s = mesh.shape(p);
      volume += s.volume;
      EXPECT_FALSE(fault(s.polyhedron).has_value());
      Vec3 closed{};
      Mat3 identity{};
      Real area_of = 0;
      for (FaceGeometry const& f : s.faces) {
        closed += f.area * f.normal;
        identity = identity + f.area * outer(f.centroid, f.normal);
        area_of += f.area;
      }
      worst = max(worst, norm(closed) / area_of);
      for (int r = 0; r < 3; ++r) worst = max(worst, norm(identity[r] - s.volume * Mat3::identity()[r]) / s.volume);
    }
    for (FreeFace const& f : mesh.free_faces) area += mesh.face(f.particle, f.face).area;
  }
};

TEST(FilledSurface, ConvexBodiesAreFilledExactly) {
  Mesh const box = build_mesh(scene(testing::write_stl("box", testing::box_surface({4, 1, 1}), true), 60), 3);
  Filled const b(box);
  EXPECT_NEAR(b.volume, 4, 4e-8);  // single precision of the file is exact for these numbers; slivers are not
  EXPECT_NEAR(b.area, 18, 1e-6);
  EXPECT_LT(b.worst, 1e-14);
  auto const surface = testing::ball_surface(2);
  Mesh const ball = build_mesh(scene(testing::write_off("ball", surface), 60), 3);
  Filled const r(ball);
  EXPECT_NEAR(r.volume / enclosed_volume(surface), 1, 1e-6);
  EXPECT_LT(r.worst, 1e-13);
  EXPECT_EQ(ball.size(), 60);
}

TEST(FilledSurface, OtherBodiesAreFilledByMirroredGenerators) {
  auto const angle = testing::angle_surface();
  Mesh const mesh = build_mesh(scene(testing::write_off("angle", angle), 300), 3);
  MeshQuality const q = measure_quality(mesh, 1)[0];
  EXPECT_EQ(q.parts, 1);
  EXPECT_LT(std::abs(q.volume), 0.025);  // some of the inward edge is lost: of order h2 per length
  EXPECT_LT(q.angle.value, 1e-6);
  EXPECT_LT(Filled(mesh).worst, 1e-13);
}

TEST(FilledSurface, TetrahedraKeepTheSurface) {
  auto const angle = testing::angle_surface();
  SolidConfig const config = scene(testing::write_off("tets", angle), 300, "tetrahedra");
  Mesh const mesh = build_mesh(config, 3), again = build_mesh(config, 3);
  EXPECT_NEAR(Filled(mesh).volume, 5, 1e-9);
  EXPECT_GT(mesh.size(), 100);
  ASSERT_EQ(again.size(), mesh.size());  // every rank meshes for itself
  for (GlobalId p = 0; p < mesh.size(); ++p) EXPECT_EQ(again.particle(p).centre, mesh.particle(p).centre);
}

TEST(FilledSurface, NarrowGapsAreRefused) {
  // Two plates 0.02 apart, joined at one end: a U.
  auto const u = testing::prism_surface(
      {{0, 0, 0}, {2, 0, 0}, {2, 0.4, 0}, {0.4, 0.4, 0}, {0.4, 0.42, 0}, {2, 0.42, 0}, {2, 0.82, 0}, {0, 0.82, 0}},
      {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {0, 4, 7}, {4, 5, 6}, {4, 6, 7}}, 0.4);
  Mesh const mesh = build_mesh(scene(testing::write_off("narrow", u), 200), 3);
  // The mirrored generators keep the legs apart.
  for (Link const& l : mesh.links) {
    Vec3 const a = mesh.particle(l.i).centre, b = mesh.particle(l.j).centre;
    if (a.x < 0.7 || b.x < 0.7) continue;
    EXPECT_GT((a.y - 0.41) * (b.y - 0.41), 0);
  }
}

TEST(FilledSurface, GmshSurfacesGoToTheVoronoiCells) {
  SolidConfig config = scene(testing::brick_mesh({4, 1, 1}, true).write("refill", "4.1", true), 80, "voronoi");
  Mesh const mesh = build_mesh(config, 3);
  EXPECT_EQ(mesh.size(), 80);
  EXPECT_NEAR(Filled(mesh).volume, 4, 1e-6);
  Real area = 0;
  for (FaceId const& f : mesh.face_group("left")) {
    area += mesh.face(f.particle, f.face).area;
    EXPECT_NEAR(mesh.face(f.particle, f.face).normal.x, -1, 1e-9);
  }
  EXPECT_NEAR(area, 1, 1e-6);
}

TEST(Voronoi, GeneratorsKeepTheirDistanceAndStayInside) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = "m";
  b.shape = "sphere";
  b.tessellation = "voronoi";
  b.centre = Vec3{2, 0.5, 3};
  b.radius = 0.8;
  b.particles = 40;
  config.body.push_back(b);
  for (int lloyd : {0, 20}) {
    config.body[0].lloyd = lloyd;
    Mesh const mesh = build_mesh(config, 3);
    EXPECT_EQ(measure_quality(mesh, 1)[0].parts, 1);
    Real const spacing = std::cbrt(4.0 / 3 * std::numbers::pi * 0.512 / 40);
    for (GlobalId p = 0; p < mesh.size(); ++p) {
      Vec3 const pole = mesh.particle(p).centre + mesh.shape(p).pole;
      EXPECT_LT(norm(pole - *b.centre), 0.8);
      for (GlobalId q = 0; q < p; ++q)
        EXPECT_GT(norm(mesh.particle(q).centre + mesh.shape(q).pole - pole), 0.28 * spacing);
    }
  }
}

TEST(Voronoi, ConvexPrismsAreFilled) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = "m";
  b.shape = "prism";
  b.tessellation = "voronoi";
  b.corners = {0, 0, 2, 0, 2.5, 1, 1, 2, 0, 1};
  b.low = Vec3{0, 0, 0}, b.high = Vec3{0, 0, 0.5};
  b.particles = 50;
  config.body.push_back(b);
  Filled const solid(build_mesh(config, 3));
  EXPECT_NEAR(solid.volume, 0.5 * 3.5, 1e-9);
  EXPECT_NEAR(build_mesh(config, 2).bodies[0].mass, 3.5, 1e-9);
  config.body[0].corners = {0, 0, 2, 0, 1, 0.5, 2, 1, 0, 1};
  EXPECT_NE(what(config).find("need a convex prism"), std::string::npos) << what(config);
}

}  // namespace
}  // namespace brisance::solid
