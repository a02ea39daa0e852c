// Histories, selections of faces, and what a scene is told when a load is impossible.
#include <gtest/gtest.h>

#include "core/base/keys.hpp"
#include "core/solid/loads/face_selection.hpp"
#include "core/solid/loads/history.hpp"
#include "parallel/error.hpp"
#include "tests/support/solid_run.hpp"

namespace brisance::solid {
namespace {

Location const here{"scene.toml", 3, 1};

template <class Function>
std::string complaint(Function&& of) {
  try {
    of();
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    return e.what();
  }
  return "no complaint";
}

void expect_says(std::string const& text, std::string const& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
}

TEST(History, IsLinearBetweenEntriesAndConstantOutside) {
  HistoryConfig config;
  config.history = {{1, 2, {}}, {3, 4, {}}, {4, 0, {}}};
  History const h(config, "load", here);
  EXPECT_EQ(h.at(0), 2);
  EXPECT_EQ(h.at(2), 3);
  EXPECT_EQ(h.at(3.5), 2);
  EXPECT_EQ(h.at(9), 0);
  EXPECT_EQ(History({}, "load", here).at(5), 1);
}

TEST(History, PulsesHaveTheirShapes) {
  auto pulse = [](std::string const& shape, std::optional<double> duration, Real time) {
    HistoryConfig config;
    config.pulse = PulseConfig{shape, 1, duration, {}};
    return History(config, "load", here).at(time);
  };
  for (std::string const shape : {"step", "ramp", "half_sine", "triangle", "smooth"})
    EXPECT_EQ(pulse(shape, 2, 0.999), 0) << shape;
  EXPECT_EQ(pulse("step", std::nullopt, 1), 1);
  EXPECT_EQ(pulse("step", std::nullopt, 100), 1);
  EXPECT_EQ(pulse("step", 2, 3.01), 0);
  EXPECT_EQ(pulse("ramp", 2, 1.5), 0.25);
  EXPECT_EQ(pulse("ramp", 2, 7), 1);
  EXPECT_NEAR(pulse("half_sine", 2, 2), 1, 1e-15);
  EXPECT_EQ(pulse("half_sine", 2, 3.01), 0);
  EXPECT_EQ(pulse("triangle", 2, 1.5), 0.5);
  EXPECT_EQ(pulse("triangle", 2, 2), 1);
  EXPECT_EQ(pulse("triangle", 2, 3.01), 0);
  EXPECT_NEAR(pulse("smooth", 2, 2), 0.5, 1e-15);
  EXPECT_NEAR(pulse("smooth", 2, 1.5), 0.25 - 1 / (2 * std::acos(-1.0)), 1e-15);
  EXPECT_EQ(pulse("smooth", 2, 8), 1);
}

TEST(History, SaysWhatIsImpossible) {
  HistoryConfig both;
  both.history = {{0, 1, {}}};
  both.pulse.emplace();
  expect_says(complaint([&] { History(both, "solid.pressure[0]", here); }),
              "scene.toml:3:1: solid.pressure[0] has a history and a pulse");
  HistoryConfig backwards;
  backwards.history = {{1, 1, {}}, {1, 2, here}};
  expect_says(complaint([&] { History(backwards, "load", here); }), "times must increase");
  HistoryConfig endless;
  endless.pulse = PulseConfig{"ramp", 0, std::nullopt, here};
  expect_says(complaint([&] { History(endless, "load", here); }), "a ramp needs a duration");
}

SolidConfig two_boxes() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {4, 3, 2}, {4, 3, 2}));
  config.body.push_back(testing::box({10, 0, 0}, {14, 3, 2}, {4, 3, 2}));
  config.body[0].name = "left";
  config.body[1].name = "right";
  config.body[0].clamp.push_back({{0, 0, 0}, {0, 3, 2}});
  return config;
}

TEST(FaceSelection, TakesFacesByBodyBoxAndNormal) {
  Mesh const mesh = build_mesh(two_boxes(), 3);
  auto count = [&](FaceSelection const& s) { return select_faces(s, mesh, "load", here).size(); };
  FaceSelection s;
  EXPECT_EQ(count(s), 2 * 52u - 6u);  // clamped faces bear no load
  s.body = "right";
  EXPECT_EQ(count(s), 52u);
  s.normal = Vec3{0, 0, 5};
  EXPECT_EQ(count(s), 12u);
  s.low = Vec3{11, 0, 2}, s.high = Vec3{14, 2, 2};
  EXPECT_EQ(count(s), 6u);
  s.normal.reset();
  EXPECT_EQ(count(s), 6u);
  s.low = Vec3{11, 0, 0};
  EXPECT_EQ(count(s), 6u + 6u + 2 * 6u / 2u + 4u);  // top, bottom, the side y = 0, the end x = 14
}

TEST(FaceSelection, TakesTheInsideOfATube) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  BodyConfig tube;
  tube.material = "m", tube.shape = "tube", tube.tessellation = "polar";
  tube.centre = Vec3{1, 2, 3};
  tube.inner_radius = 1, tube.outer_radius = 1.2, tube.length = 3;
  tube.cells = {2, 24, 5};
  config.body.push_back(tube);
  Mesh const mesh = build_mesh(config, 3);
  FaceSelection s;
  s.facing = Vec3{1, 2, 3};
  auto const faces = select_faces(s, mesh, "load", here);
  EXPECT_EQ(faces.size(), 24u * 5u);
  for (FaceRef const& f : faces) {
    Vec3 const arm = mesh.particle(f.particle).centre + mesh.face(f.particle, f.face).centroid - Vec3{1, 2, 3};
    EXPECT_LT(std::hypot(arm.x, arm.y), 1.01);
  }
}

TEST(FaceSelection, SaysWhatIsImpossible) {
  Mesh const mesh = build_mesh(two_boxes(), 3);
  FaceSelection s;
  s.body = "lift";
  expect_says(complaint([&] { select_faces(s, mesh, "solid.pressure[2]", here); }),
              "scene.toml:3:1: solid.pressure[2]: there is no solid.body \"lift\"; the nearest is \"left\"");
  s.body = "left";
  s.low = Vec3{0, 0, 0}, s.high = Vec3{0, 3, 2};
  expect_says(complaint([&] { select_faces(s, mesh, "solid.pressure[2]", here); }), "selects no face");
  s.normal = Vec3{};
  expect_says(complaint([&] { select_faces(s, mesh, "solid.pressure[2]", here); }), "has no direction");
}

TEST(Loads, RefuseWhatCannotBe) {
  auto run = [](SolidConfig const& config, int dimension = 3) {
    auto const comm = parallel::serial();
    testing::SolidRun(config, dimension, 1, *comm);
  };
  SolidConfig config = two_boxes();
  config.point_force.emplace_back();
  config.point_force[0].position = {7, 1, 1};
  config.point_force[0].at = here;
  expect_says(complaint([&] { run(config); }), "solid.point_force[0]: no particle is near (7, 1, 1) m");
  config.point_force[0].position = {1, 1, 1};
  config.point_force[0].force = {1, 0, 1};
  for (BodyConfig& body : config.body) body.cells[2] = 1;
  expect_says(complaint([&] { run(config, 2); }), "leaves the plane");
  config.point_force.clear();
  config.moment_tensor.emplace_back();
  config.moment_tensor[0].position = {2, 1.5, 1};
  config.moment_tensor[0].moment = {1, 1, 1};
  expect_says(complaint([&] { run(config); }), "needs six numbers");
  config.moment_tensor[0].moment = {1, 1, 1, 0, 0, 0};
  expect_says(complaint([&] { run(config); }), "a particle with a boundary face");
  config.moment_tensor.clear();
  config.pressure.emplace_back();
  config.pressure[0].body = "right";
  config.absorbing.emplace_back();
  config.absorbing[0].normal = Vec3{1, 0, 0};
  config.absorbing[0].at = here;
  expect_says(complaint([&] { run(config); }),
              "scene.toml:3:1: solid.absorbing[0] takes a face of solid.body \"right\" that solid.pressure");
}

TEST(Loads, AreReadFromASceneAndEchoed) {
  auto const text =
      "pressure = [{ pressure = \"2 MPa\", body = \"left\", normal = [0, 0, 1], pulse = { shape = \"ramp\", duration = "
      "\"1 ms\" } }]\n"
      "point_force = [{ position = [1, 0, 0], force = [\"3 kN\"], history = [{ time = 0, factor = 0 }, { time = \"2 "
      "s\", factor = 1 }] }]\n"
      "blast = [{ mass = \"1 kg\", centre = [0, 0, 1], burst = \"surface\" }]\n";
  SolidConfig const config = read_keys<SolidConfig>(parse_toml(text, "scene.toml"));
  ASSERT_EQ(config.pressure.size(), 1u);
  EXPECT_EQ(config.pressure[0].pressure, 2e6);
  EXPECT_EQ(config.pressure[0].pulse->duration, 1e-3);
  EXPECT_EQ(config.point_force[0].history[1].time, 2);
  EXPECT_EQ(config.point_force[0].force.x, 3e3);
  SolidConfig const again = read_keys<SolidConfig>(parse_toml(write_keys(config), "echo.toml"));
  EXPECT_EQ(write_keys(again), write_keys(config));
}

}  // namespace
}  // namespace brisance::solid
