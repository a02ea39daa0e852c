#include "core/solid/meshes/gmsh.hpp"

#include <gtest/gtest.h>

#include "core/solid/meshes/elements.hpp"
#include "parallel/error.hpp"
#include "tests/support/msh.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Grid;
using testing::Msh;

/// A hexahedron, a pyramid on its top, a prism at its side and a tetrahedron on the pyramid: every kind once.
Msh all_kinds() {
  Msh m;
  m.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},       {0, 1, 0},   {0, 0, 1},   {1, 0, 1},
             {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 1.5}, {2, 0.5, 0}, {2, 0.5, 1}, {0.5, -0.5, 1.5}};
  m.node_shift = 100;
  m.names = {{{3, 1}, "steel"}, {{3, 2}, "lead"}, {{2, 5}, "bottom"}, {{2, 6}, "inside"}};
  m.add(15, 0, 9, {0});
  m.add(1, 1, 9, {0, 1});
  m.add(3, 2, 5, {0, 1, 2, 3});
  m.add(2, 2, 6, {4, 5, 8});
  m.add(5, 3, 1, {0, 1, 2, 3, 4, 5, 6, 7});
  m.add(7, 3, 1, {4, 5, 6, 7, 8});
  m.add(6, 3, 2, {1, 9, 2, 5, 10, 6});
  m.add(4, 3, 0, {4, 11, 5, 8});
  return m;
}

void expect_all_kinds(ElementMesh const& mesh) {
  ASSERT_EQ(mesh.nodes.size(), 12u);
  EXPECT_EQ(mesh.node_tag[0], 101);
  EXPECT_EQ(mesh.nodes[8], (Vec3{0.5, 0.5, 1.5}));
  ASSERT_EQ(mesh.elements.size(), 7u);  // without the point
  std::vector<ElementKind> kinds;
  std::vector<std::vector<std::string>> groups;
  for (MeshElement const& e : mesh.elements) {
    kinds.push_back(e.kind);
    groups.push_back(mesh.group_sets[static_cast<std::size_t>(e.groups)]);
  }
  using enum ElementKind;
  EXPECT_EQ(kinds, (std::vector{line, quadrangle, triangle, hexahedron, pyramid, prism, tetrahedron}));
  EXPECT_EQ(groups,
            (std::vector<std::vector<std::string>>{{"9"}, {"bottom"}, {"inside"}, {"steel"}, {"steel"}, {"lead"}, {}}));
  EXPECT_EQ(mesh.elements[5].tag, 7);
  EXPECT_EQ(mesh.elements[5].node, (std::array<Index, 8>{1, 9, 2, 5, 10, 6, 0, 0}));
}

TEST(Gmsh, BothFormatsInTextAndBytesGiveTheSameMesh) {
  for (char const* version : {"2.2", "4.1"})
    for (bool binary : {false, true}) {
      SCOPED_TRACE(std::string(version) + (binary ? " binary" : " ascii"));
      expect_all_kinds(read_gmsh(all_kinds().write("kinds", version, binary)));
      if (binary) expect_all_kinds(read_gmsh(all_kinds().write("swapped", version, true, true)));
    }
}

TEST(Gmsh, EveryKindOfElementBecomesAConvexCellWithMatchingFaces) {
  MeshFileConfig file;
  ElementMesh const mesh = read_gmsh(all_kinds().write("cells", "4.1", false));
  Cells const cells = cells_of(mesh, file, 3);
  ASSERT_EQ(cells.count(), 4u);
  Real volume = 0;
  for (Shape const& s : cells.shapes) {
    EXPECT_FALSE(fault(s.polyhedron).has_value());
    Vec3 closed{};
    Mat3 identity{};
    for (FaceGeometry const& f : s.faces) {
      closed += f.area * f.normal;
      identity = identity + f.area * outer(f.centroid, f.normal);
    }
    EXPECT_LT(norm(closed), 1e-14);
    for (int r = 0; r < 3; ++r) EXPECT_LT(norm(identity[r] - s.volume * Mat3::identity()[r]), 1e-14);
    volume += s.volume;
  }
  EXPECT_NEAR(volume, 1 + 1.0 / 6 + 0.5 + 1.0 / 12, 1e-14);
  int linked = 0;
  for (Index n : cells.neighbour) linked += n >= 0;
  EXPECT_EQ(linked, 6);  // three shared faces
  EXPECT_EQ(cells.face_groups.at("bottom").size(), 1u);
  EXPECT_EQ(cells.face_groups.at("inside").size(), 2u);
}

SolidConfig scene(std::string const& path, std::string const& material = "m") {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig b;
  b.material = material;
  b.shape = "mesh";
  b.mesh.emplace();
  b.mesh->file = path;
  b.at = {"scene.toml", 7, 1};
  config.body.push_back(b);
  return config;
}

TEST(Gmsh, PhysicalVolumesBecomeBodiesAndMaterials) {
  std::string const path = all_kinds().write("groups", "2.2", true);
  SolidConfig config = scene(path, "");
  config.material["steel"] = {7860, 210e9, 0.3, {}};
  config.material["lead"] = {11340, 16e9, 0.44, {}};
  config.body[0].mesh->group = "steel";
  config.body.push_back(config.body[0]);
  config.body[1].mesh->group = "lead";
  Mesh const two = build_mesh(config, 3);
  ASSERT_EQ(two.bodies.size(), 2u);
  EXPECT_EQ(two.bodies[0].particles, 2);
  EXPECT_NEAR(two.bodies[0].mass, 7860 * (1 + 1.0 / 6), 1e-9);
  EXPECT_NEAR(two.bodies[1].mass, 11340 * 0.5, 1e-9);
  EXPECT_EQ(two.links.size(), 1u);  // bodies touch without being linked
  EXPECT_EQ(two.face_group("bottom").size(), 1u);
  EXPECT_EQ(two.face_group("top").size(), 0u);
  FaceId const bottom = two.face_group("bottom")[0];
  EXPECT_NEAR(two.face(bottom.particle, bottom.face).normal.z, -1, 1e-14);
}

TEST(Gmsh, TwoMaterialsInOneBodyAreLinkedInSeries) {
  Grid const grid{2, 1, 1};
  Msh m = testing::brick_mesh(grid, false);
  m.names[{3, 1}] = "soft", m.names[{3, 4}] = "hard";
  m.elements[1].physical = 4;
  SolidConfig config = scene(m.write("pair", "4.1", true), "");
  config.material["soft"] = {1, 1, 0, {}};
  config.material["hard"] = {1, 3, 0, {}};
  testing::Lone body(config);
  ASSERT_EQ(body.mesh.links.size(), 1u);
  Link const& link = body.mesh.links[0];
  EXPECT_NEAR(link.stiffness, 1 / (0.5 / 1 + 0.5 / 3), 1e-14);  // E = 2 G: half links of stiffness 2 E
  bool const soft_first = body.mesh.material(link.i).name == "soft";
  EXPECT_NEAR(soft_first ? link.weight : 1 - link.weight, 0.75, 1e-14);
  Mat3 const c = bending_tensor(body.mesh, link);
  EXPECT_NEAR(trace(c), 2 * 1.5 * (1.0 / 12 + 1.0 / 12 + 1.0 / 12), 1e-14);
}

TEST(Gmsh, ElementsOfAPlaneMeshBecomePrisms) {
  Msh m;
  m.nodes = {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}, {2, 0, 2}};
  m.names = {{{2, 1}, "sheet"}, {{1, 2}, "left"}};
  m.add(3, 2, 1, {0, 1, 2, 3});
  m.add(2, 2, 1, {1, 4, 2});
  m.add(1, 1, 2, {3, 0});
  SolidConfig config = scene(m.write("plane", "4.1", false));
  config.body[0].mesh->unit = 1e-3;
  Mesh const mesh = build_mesh(config, 2);
  EXPECT_EQ(mesh.size(), 2);
  EXPECT_EQ(mesh.links.size(), 1u);
  EXPECT_EQ(mesh.free_faces.size(), 5u);
  EXPECT_NEAR(mesh.bodies[0].mass, 1.5e-6, 1e-20);
  ASSERT_EQ(mesh.face_group("left").size(), 1u);
  FaceId const left = mesh.face_group("left")[0];
  EXPECT_NEAR(mesh.face(left.particle, left.face).normal.x, -1, 1e-14);
}

std::string what(SolidConfig const& config, int dimension = 3) {
  try {
    build_mesh(config, dimension);
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    return e.what();
  }
  return "";
}

/// The mesh is refused in a scene, with the place in the scene, the file and these words.
void expect_refused(std::string const& name, Msh const& m, std::vector<std::string> words, int dimension = 3) {
  std::string const path = m.write(name, "2.2", false), text = what(scene(path), dimension);
  words.insert(words.end(), {"scene.toml:7:1", path});
  for (auto const& w : words) EXPECT_NE(text.find(w), std::string::npos) << name << ": " << w << " in: " << text;
}

TEST(BrokenMesh, IsRefusedWithElementAndPlace) {
  Grid const grid{2, 1, 1};
  Msh const good = testing::brick_mesh(grid, false);
  Msh m = good;
  m.elements[1].type = 17;
  for (int k = 0; k < 12; ++k) m.elements[1].nodes.push_back(k);
  expect_refused("order", m, {"element 2", "20-node hexahedron", "order 1"});
  m = good;
  std::swap(m.elements[0].nodes[0], m.elements[0].nodes[4]);
  std::swap(m.elements[0].nodes[1], m.elements[0].nodes[5]);
  std::swap(m.elements[0].nodes[2], m.elements[0].nodes[6]);
  std::swap(m.elements[0].nodes[3], m.elements[0].nodes[7]);
  expect_refused("inside-out", m, {"element 1 (hexahedron)", "negative volume", "(0.5, 0.5, 0.5) m"});
  m = good;
  m.nodes[static_cast<std::size_t>(grid.at(2, 1, 1))].x = 2.25;
  expect_refused("warped", m, {"element 2 (hexahedron)", "not plane", "split"});
  m = good;
  m.elements[1].nodes[0] = m.elements[1].nodes[1];
  expect_refused("repeated-node", m, {"element 2 (hexahedron) has node 3 twice", "(2, 0, 0)"});
  m = good;
  m.add(5, 3, 1, m.elements[0].nodes);
  expect_refused("repeated", m, {"repeats element 1"});
  m = good;
  m.elements[1].nodes[0] = 77;
  expect_refused("unknown-node", m, {"element 2 has a node 78", ":", "$Elements"});
}

TEST(BrokenMesh, FlatAndNonConvexElementsAreNamed) {
  Msh m;
  m.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  m.add(4, 3, 1, {0, 1, 2, 3});
  expect_refused("flat", m, {"element 1 (tetrahedron) has no volume"});
  Msh arrow;
  arrow.nodes = {{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}};
  arrow.add(3, 2, 1, {0, 1, 2, 3});
  expect_refused("arrow", arrow, {"element 1 (quadrangle) is not convex", "(0.5, 0.5, 0)"}, 2);
  m.nodes[3] = {0, 0, 1};
  m.add(4, 3, 1, {0, 1, 2, 3});
  m.elements.resize(1);
  m.nodes.push_back({0.2, 0.2, 0.5});
  m.add(4, 3, 1, {0, 1, 2, 4});
  expect_refused("folded", m, {"elements 1 and 2 lie on the same side of their common face"});
  m.nodes.push_back({0, 0, -1});
  m.elements[1].nodes = {0, 2, 1, 5};
  m.nodes.push_back({0.1, 0.1, -2});
  m.add(4, 3, 1, {0, 2, 1, 6});
  expect_refused("three", m, {"elements 1, 2 and 3 share a face"});
}

TEST(BrokenMesh, FacesThatDoNotMatchAreNamed) {
  // A cube beside four small ones: five nodes hang on its face.
  Msh m;
  Grid const coarse{1, 1, 1}, fine{1, 2, 2};
  m.nodes = coarse.nodes();
  m.add(5, 3, 1, coarse.corners(0, 0, 0));
  int const shift = static_cast<int>(m.nodes.size());
  for (Vec3 x : fine.nodes({1, 0.5, 0.5})) m.nodes.push_back(x + Vec3{1, 0, 0});
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j) {
      auto c = fine.corners(0, j, k);
      for (int& n : c) n += shift;
      m.add(5, 3, 1, c);
    }
  expect_refused("coincident", m, {"lie at one place", "merge"});
  SolidConfig merged = scene(m.write("hanging", "2.2", false));
  merged.body[0].mesh->coincident_nodes = "merge";
  std::string const text = what(merged);
  EXPECT_NE(text.find("hangs on a face of element 1 (hexahedron)"), std::string::npos) << text;
  // A hexahedron against tetrahedra that share its nodes.
  Grid const two{2, 1, 1};
  Msh mixed = testing::brick_mesh(two, true);
  Msh const bricks = testing::brick_mesh(two, false);
  for (int k = 0; k < 6; ++k) mixed.elements.erase(mixed.elements.begin());
  mixed.add(5, 3, 1, bricks.elements[0].nodes);
  expect_refused("quadrangle", mixed, {"quadrangle where", "triangle", "pyramid"});
}

TEST(BrokenMesh, ElementsInEachOtherAreNamed) {
  Msh m = testing::brick_mesh({2, 1, 1}, false);
  int const shift = static_cast<int>(m.nodes.size());
  for (Vec3 const& x : Grid{1, 1, 1}.nodes()) m.nodes.push_back(x + Vec3{1.9, 0.3, 0.2});
  auto c = Grid{1, 1, 1}.corners(0, 0, 0);
  for (int& n : c) n += shift;
  m.add(5, 3, 1, c);
  expect_refused("overlap", m, {"elements 2 and 5 overlap by 0.1", "(1.95, 0.65, 0.6) m"});
}

TEST(BrokenMesh, UnreadableFilesAreNamed) {
  EXPECT_NE(what(scene("/nowhere/a.msh")).find("cannot be read: No such file"), std::string::npos);
  auto refused = [](std::string const& name, std::string const& content, std::string const& word) {
    std::string const path = testing::temporary_file(name + ".msh", content);
    std::string const text = what(scene(path));
    EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_NE(text.find(path), std::string::npos) << text;
  };
  refused("version", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", ":2: format 4 is not read. Save as version 2.2 or 4.1");
  refused("empty", "", "does not begin with $MeshFormat");
  refused("cut", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n", ":7: the file ends too early in $Nodes");
  refused("letters", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 zero 0\n",
          ":6: expected a number and found \"zero\"");
  refused("many", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9999999999\n", "is not possible");
  refused("no-cells",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n"
          "1 2 2 0 1 1 2 3\n$EndElements\n",
          "no tetrahedra");
}

TEST(BrokenMesh, GroupsThatDoNotExistAreNamed) {
  Msh const m = testing::brick_mesh({2, 1, 1}, false);
  SolidConfig config = scene(m.write("no-group", "4.1", true));
  config.body[0].mesh->group = "rode";
  std::string text = what(config);
  EXPECT_NE(text.find("physical volume \"rode\". Physical volumes: rod."), std::string::npos) << text;
  config = scene(config.body[0].mesh->file, "");
  text = what(config);
  EXPECT_NE(text.find("has no material"), std::string::npos) << text;
  EXPECT_NE(text.find("\"rod\", of which none is in solid.material"), std::string::npos) << text;
}

TEST(Gmsh, WarpedHexahedraAreSplitWithMatchingFaces) {
  Grid const grid{2, 2, 2};
  Msh m = testing::brick_mesh(grid, false);
  m.nodes[static_cast<std::size_t>(grid.at(1, 1, 1))] += Vec3{0.1, 0.05, -0.07};
  SolidConfig config = scene(m.write("split", "2.2", false));
  config.body[0].mesh->warped = "split";
  Mesh const mesh = build_mesh(config, 3);
  EXPECT_EQ(mesh.size(), 8 * 9);  // three warped faces a brick, two tetrahedra each, and three pyramids
  EXPECT_NEAR(mesh.bodies[0].mass, 8, 1e-13);
  Real area = 0;
  for (FreeFace const& f : mesh.free_faces) area += mesh.face(f.particle, f.face).area;
  EXPECT_NEAR(area, 24, 1e-13);
  EXPECT_EQ(mesh.face_group("left").size(), 4u);
}

TEST(Gmsh, ThePathIsRelativeToTheScene) {
  MeshFileConfig file;
  file.file = "../meshes/rod.msh";
  file.at.file = "jobs/scenes/rod.toml";
  EXPECT_EQ(file.path(), "jobs/scenes/../meshes/rod.msh");
  file.file = "/data/rod.msh";
  EXPECT_EQ(file.path(), "/data/rod.msh");
}

}  // namespace
}  // namespace brisance::solid
