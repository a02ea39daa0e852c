#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

/// Sum of S n over all faces of a particle, and sum of S G x n - V 1.
void expect_closed(Shape const& s) {
  Vec3 sum{};
  Mat3 tensor{};
  for (FaceGeometry const& f : s.faces) {
    sum += f.area * f.normal;
    tensor = tensor + f.area * outer(f.centroid, f.normal);
  }
  Real const size = std::cbrt(s.volume);
  EXPECT_NEAR(norm(sum), 0, 1e-11 * size * size);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(tensor[r][c], r == c ? s.volume : 0, 1e-11 * s.volume);
}

Real total_volume(Mesh const& mesh) {
  Real v = 0;
  for (GlobalId p = 0; p < mesh.size(); ++p) v += mesh.shape(p).volume;
  return v;
}

/// Every face is linked or free, and both sides of a link agree on it.
void expect_matched(Mesh const& mesh) {
  std::size_t faces = 0;
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    expect_closed(mesh.shape(p));
    for (FaceGeometry const& f : mesh.shape(p).faces)
      if (!is_side_of_slab(f, mesh.dimension) && f.area > 1e-9 * std::pow(mesh.shape(p).volume, 2.0 / 3)) ++faces;
  }
  std::size_t found = mesh.free_faces.size();
  for (Link const& l : mesh.links) {
    if (l.j == Link::wall) continue;
    FaceGeometry const &a = mesh.face(l.i, l.face_i), &b = mesh.face(l.j, l.face_j);
    if (a.area > 1e-9 * std::pow(mesh.shape(l.i).volume, 2.0 / 3)) found += 2;
    Real const size = std::sqrt(a.area);
    EXPECT_NEAR(a.area, b.area, 1e-8 * std::cbrt(mesh.shape(l.i).volume) * size);
    EXPECT_LT(l.i, l.j);
    EXPECT_GT(l.rest_length, 0);
    EXPECT_GT(l.weight, 0);
    EXPECT_LT(l.weight, 1);
  }
  EXPECT_EQ(found, faces);
}

Mesh built(BodyConfig body, int dimension = 3) {
  SolidConfig config = testing::one_material(2, 1, 0.3);
  body.material = "m";
  config.body.push_back(body);
  return build_mesh(config, dimension);
}

BodyConfig round(char const* shape, char const* tessellation, std::array<Index, 3> cells) {
  BodyConfig b;
  b.shape = shape;
  b.tessellation = tessellation;
  b.cells = cells;
  b.centre = Vec3{1, -2, 0.5};
  b.radius = 1.0;
  b.inner_radius = 0.6;
  b.outer_radius = 1.0;
  b.length = 2.0;
  return b;
}

TEST(Shapes, CartesianBox) {
  Mesh const mesh = built(testing::box({0, 0, 0}, {3, 2, 1}, {6, 4, 2}));
  EXPECT_EQ(mesh.size(), 48);
  EXPECT_EQ(mesh.links.size(), 5u * 8 + 6 * 3 * 2 + 24);
  EXPECT_NEAR(total_volume(mesh), 6, 1e-12);
  expect_matched(mesh);
}

TEST(Shapes, PlateAlongAnyNormal) {
  BodyConfig b;
  b.shape = "plate";
  b.centre = Vec3{1, 2, 3};
  b.axis = {1, 1, 0.5};
  b.length = 2.0, b.width = 1.0, b.thickness = 0.1;
  b.cells = {8, 4, 2};
  Mesh const mesh = built(b);
  EXPECT_NEAR(total_volume(mesh), 0.2, 1e-12);
  expect_matched(mesh);
}

TEST(Shapes, PolarTubeOfTheExplosion) {
  BodyConfig b = round("tube", "polar", {1, 50, 1});
  b.inner_radius = 1.00, b.outer_radius = 1.05, b.phase = 0.013;
  Mesh const mesh = built(b, 2);
  EXPECT_EQ(mesh.size(), 50);
  EXPECT_EQ(mesh.links.size(), 50u);
  EXPECT_EQ(mesh.free_faces.size(), 100u);
  Real const s = std::sin(2 * std::numbers::pi / 50) / 2;
  EXPECT_NEAR(total_volume(mesh), 50 * s * (1.05 * 1.05 - 1), 1e-12);
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    EXPECT_EQ(mesh.particle(p).centre.z, 0.5);
    // First corner at the phase: some corner lies there exactly.
  }
  Real nearest = 1;
  for (Vec3 const& v : mesh.shape(0).polyhedron.vertices) {
    Vec3 const y = v + mesh.particle(0).centre - *b.centre;
    Real const turns = (std::atan2(y.y, y.x) - 0.013) / (2 * std::numbers::pi / 50);
    nearest = min(nearest, std::abs(turns - std::round(turns)));
  }
  EXPECT_NEAR(nearest, 0, 1e-12);
  expect_matched(mesh);
}

TEST(Shapes, PolarCylinderTubeSphereAndShell) {
  Real const a = std::sin(2 * std::numbers::pi / 12) / 2 * 12;
  Mesh const cylinder = built(round("cylinder", "polar", {3, 12, 4}));
  EXPECT_NEAR(total_volume(cylinder), a * 2, 1e-12);
  expect_matched(cylinder);
  Mesh const tube = built(round("tube", "polar", {2, 12, 4}));
  EXPECT_NEAR(total_volume(tube), a * 2 * (1 - 0.36), 1e-12);
  expect_matched(tube);
  Mesh const sphere = built(round("sphere", "polar", {2, 12, 6}));
  expect_matched(sphere);
  Mesh const shell = built(round("shell", "polar", {2, 12, 6}));
  EXPECT_NEAR(total_volume(shell), total_volume(sphere) * (1 - 0.216), 1e-12);
  expect_matched(shell);
}

TEST(Shapes, VoronoiFillsABoxExactly) {
  BodyConfig b = testing::box({0, 0, 0}, {2, 1, 1}, {1, 1, 1});
  b.tessellation = "voronoi";
  b.particles = 60;
  b.lloyd = 5;
  Mesh const mesh = built(b);
  EXPECT_EQ(mesh.size(), 60);
  EXPECT_NEAR(total_volume(mesh), 2, 1e-9);
  expect_matched(mesh);
  for (Link const& l : mesh.links) EXPECT_NEAR(l.weight, 0.5, 1e-7);
}

TEST(Shapes, VoronoiFitsCurvedBoundaries) {
  struct Case {
    char const* shape;
    Real volume;
  };
  Real const pi = std::numbers::pi;
  for (Case const& c : {Case{"sphere", 4 * pi / 3}, Case{"shell", 4 * pi / 3 * (1 - 0.216)}, Case{"cylinder", 2 * pi},
                        Case{"tube", 2 * pi * 0.64}}) {
    BodyConfig b = round(c.shape, "voronoi", {1, 1, 1});
    b.particles = 250;
    b.lloyd = 8;
    Mesh const mesh = built(b);
    EXPECT_NEAR(total_volume(mesh) / c.volume, 1, 0.08) << c.shape;
    expect_matched(mesh);
    Surface const surface(mesh);  // throws unless closed
    EXPECT_GT(surface.elements().size(), 100u);
  }
}

TEST(Shapes, VoronoiInThePlane) {
  BodyConfig b = round("tube", "voronoi", {1, 1, 1});
  b.particles = 60;
  b.lloyd = 10;
  Mesh const mesh = built(b, 2);
  EXPECT_NEAR(total_volume(mesh) / (std::numbers::pi * 0.64), 1, 0.05);
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    EXPECT_EQ(mesh.particle(p).centre.z, 0.5);
    EXPECT_EQ(mesh.inertia(p)[0].z, 0);
  }
  expect_matched(mesh);
  Surface const surface(mesh);
}

TEST(Shapes, PrismIsOneParticle) {
  BodyConfig b;
  b.shape = "prism";
  b.corners = {0, 0, 2, 0, 2, 1, 0, 1};
  Mesh const mesh = built(b, 2);
  EXPECT_EQ(mesh.size(), 1);
  EXPECT_NEAR(mesh.particle(0).mass, 4, 1e-14);
  EXPECT_NEAR(mesh.inertia(0)[2].z, 4 * (4 + 1) / 12.0, 1e-14);
}

}  // namespace
}  // namespace brisance::solid
