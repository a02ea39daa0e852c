#include "fluid/flow_config.hpp"

#include <gtest/gtest.h>

#include "parallel/error.hpp"
#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

FlowConfig read(std::string const& text) { return read_keys<FlowConfig>(parse_toml(text, "scene.toml")); }

std::string scene_error_of(std::string const& text) {
  try {
    FlowConfig const config = read(text);
    check(config);
    make_grid(config);
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
    return e.what();
  }
  return "";
}

TEST(FlowConfig, ReadsASceneWithAllItsParts) {
  FlowConfig const config = read(R"(
low = ["0 m", "0 m"]
high = ["12 m", "6 m"]
cells = [600, 300]
gas = { law = "ideal", gamma = 1.4 }
ambient = { density = "1.2 kg/m3", pressure = "1 atm" }
euler = { order = 11, cfl = 0.4 }
boundary = { x_low = "outflow", y_low = "inflow" }
[inflow.y_low]
density = "2 kg/m3"
pressure = "2 bar"
velocity = ["0 m/s", "10 m/s"]
[[region]]
shape = "ball"
centre = ["1 m", "3 m"]
radius = "0.564 m"
density = "99.9 kg/m3"
pressure = "50662500 Pa"
cells = "whole"
[[charge]]
centre = ["4 m", "3 m"]
mass = "1 kg"
density = "1000 kg/m3"
)");
  check(config);
  Grid const grid = make_grid(config);
  EXPECT_EQ(grid.dimension, 2);
  EXPECT_EQ(grid.cells, (CellIndex{600, 300, 1}));
  EXPECT_DOUBLE_EQ(grid.spacing.x, 0.02);
  EXPECT_EQ(grid.spacing.z, 1);
  EXPECT_EQ(grid.blocks_along(0), 10);
  EXPECT_EQ(config.order(), 11);
  EXPECT_EQ(config.ambient.pressure, 101325);
  EXPECT_EQ(config.inflow.y_low->velocity.y, 10);
  EXPECT_EQ(config.region.at(0).cells, "whole");
  EXPECT_EQ(config.charge.at(0).mass, 1);
  EXPECT_EQ(read_keys<FlowConfig>(parse_toml(write_keys(config), "resolved.toml")).high, config.high);
}

TEST(FlowConfig, TrailingOnesAreAbsentDirections) {
  EXPECT_EQ(make_grid(read("high = [1, 1]\ncells = [20, 20, 1]")).dimension, 2);
  EXPECT_EQ(make_grid(read("high = [1]\ncells = [20]")).dimension, 1);
}

TEST(FlowConfig, BlocksFollowTheDimensionAndTheLineAlone) {
  EXPECT_EQ(make_grid(read("high = [1, 1, 1]\ncells = [96, 97, 30]")).cuts[0], (std::vector<Index>{0, 48, 96}));
  EXPECT_EQ(make_grid(read("high = [1, 1]\ncells = [128, 30]")).cuts[0], (std::vector<Index>{0, 64, 128}));
  EXPECT_EQ(make_grid(read("high = [1]\ncells = [256]")).blocks_along(0), 4);
  EXPECT_EQ(make_grid(read("high = [1]\ncells = [10000]")).blocks_along(0), 16);
  EXPECT_EQ(make_grid(read("high = [1]\ncells = [819200]")).blocks_along(0), 200);
  EXPECT_EQ(make_grid(read("high = [1]\ncells = [10000]\nblock = 100")).blocks_along(0), 100);
}

TEST(FlowConfig, ErrorsNameWhatIsMissing) {
  EXPECT_NE(scene_error_of("high = [1]\ncells = [20]\n[boundary]\nx_low = \"periodic\"").find("x_low and x_high"),
            std::string::npos);
  EXPECT_NE(scene_error_of("high = [1]\ncells = [20]\n[boundary]\nx_low = \"inflow\"").find("[fluid.inflow.x_low]"),
            std::string::npos);
  EXPECT_NE(scene_error_of("high = [1, 1, 1]\ncells = [20, 20]").find("no cells along z"), std::string::npos);
  EXPECT_NE(scene_error_of("high = [0, 1]\ncells = [20, 20]").find("no extent along x"), std::string::npos);
  EXPECT_NE(scene_error_of("high = [1]\ncells = [20]\n[[region]]\ndensity = 1\npressure = 1").find("a box needs"),
            std::string::npos);
  EXPECT_NE(scene_error_of("high = [1]\ncells = [20]\n[[charge]]\ncentre = [0.5]\nmass = 1").find("fluid.charge[0]"),
            std::string::npos);
  EXPECT_NE(scene_error_of("high = [1]\ncells = [20]\neuler = { smooth = true }\ngas = { law = \"jwl\" }")
                .find("fluid.euler.smooth"),
            std::string::npos);
  EXPECT_NE(scene_error_of("high = [1, 1]\ncells = [20, 4]\neuler = { order = 11 }").find("fluid.cells[1] = 4"),
            std::string::npos);
}

TEST(FlowConfig, ChargesAreNeitherUnderNorOverdetermined) {
  auto const said = [](std::string const& charge, int dimension = 3) {
    std::string const low = dimension == 3 ? "high = [1, 1, 1]\ncells = [9, 9, 9]" : "high = [1, 1]\ncells = [9, 9]";
    return scene_error_of(low + "\n[[charge]]\ncentre = [0.5, 0.5]\n" + charge);
  };
  for (char const* good :
       {"mass = 1\nradius = 0.1", "energy = 1e6\ndensity = 9", "mass = 1\nenergy = 1e6\nradius = 0.1",
        "energy = 1e6\ntnt_factor = 1.2\nradius = 0.1", "shape = \"box\"\nsize = [0.1, 0.2, 0.1]\nmass = 1",
        "shape = \"cylinder\"\nradius = 0.1\nlength = 0.3\naxis = \"x\"\nenergy = 1e6",
        "radius = 0.1\ndensity = 9\npressure = 1e7",
        "shape = \"box\"\nsize = [0.1, 0.2, 0.1]\ndensity = 9\npressure = 1e7"})
    EXPECT_EQ(said(good), "") << good;
  struct Fault {
    char const *charge, *message;
  };
  for (Fault const& f : {Fault{"mass = 1\nenergy = 1e6\ntnt_factor = 1\nradius = 0.1", "overdetermine"},
                         {"mass = 1", "one of `radius` and `density`"},
                         {"mass = 1\nradius = 0.1\ndensity = 9", "one of `radius` and `density`"},
                         {"mass = 1\nradius = 0.1\npressure = 9", "leave `pressure` out"},
                         {"radius = 0.1\ndensity = 9", "give either how much it is"},
                         {"radius = 0.1\ndensity = 9\npressure = 1e6\ntnt_factor = 1.1", "give either how much it is"},
                         {"shape = \"box\"\nmass = 1", "as `size`"},
                         {"shape = \"box\"\nsize = [0.1, 0.2]\nmass = 1", "must be above 0"},
                         {"shape = \"box\"\nsize = [0.1, 0.2, 1]\nmass = 1\ndensity = 9", "leave `density` out"},
                         {"shape = \"cylinder\"\nradius = 0.1\nmass = 1", "`radius`, `length` and `axis`"},
                         {"length = 0.1\nradius = 0.1\nmass = 1", "a ball has a `radius`"}})
    EXPECT_NE(said(f.charge).find(f.message), std::string::npos) << f.charge << ": " << said(f.charge);
  EXPECT_NE(said("shape = \"cylinder\"\nradius = 0.1\nlength = 0.1\nmass = 1", 2).find("three dimensions"),
            std::string::npos);
}

TEST(FlowConfig, ReadsTheLawsOfTheSides) {
  FlowConfig const config = read(R"(
high = ["1 m", "1 m"]
cells = [20, 20]
[boundary]
x_low = "inflow"
x_high = "far_field"
y_low = "moving_wall"
y_high = "inflow"
[inflow.x_low]
history = [
  { time = "0 ms", density = 1.2, pressure = "1 bar" },
  { time = "1 ms", density = 2.4, pressure = "3 bar", velocity = ["100 m/s", 0] } ]
[inflow.y_high]
density = 1
pressure = 2
front = { point = [0, 1], normal = [1, 0], speed = 5, density = 4, pressure = 9 }
[far_field.x_high]
density = 1.1
pressure = "0.9 bar"
[moving_wall.y_low]
speed = "0.1 m/s"
[[patch]]
side = "x_high"
law = "reflecting"
low = [0, 0]
high = [0, 0.5]
)");
  check(config);
  make_grid(config);
  ASSERT_EQ(config.inflow.x_low->history.size(), 2u);
  EXPECT_EQ(config.inflow.x_low->history[1].time, 1e-3);
  EXPECT_EQ(config.inflow.y_high->front->density, 4);
  EXPECT_EQ(config.far_field.x_high->pressure, 0.9e5);
  EXPECT_EQ(config.moving_wall.y_low->speed, 0.1);
  FlowConfig const again = read_keys<FlowConfig>(parse_toml(write_keys(config), "resolved.toml"));
  check(again);
  EXPECT_EQ(write_keys(again), write_keys(config));
}

TEST(FlowConfig, ErrorsOfSidesNameWhatIsWrong) {
  auto const says = [](std::string const& text, std::string const& part) {
    std::string const error = scene_error_of("high = [1, 1]\ncells = [20, 20]\n" + text);
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  says("[boundary]\nx_low = \"moving_wall\"", "[fluid.moving_wall.x_low]");
  says(
      "[boundary]\nx_low = \"inflow\"\n[inflow.x_low]\nhistory = [{ time = 1, density = 1, pressure = 1 },"
      "{ time = 1, density = 1, pressure = 1 }]",
      "times must ascend");
  says(
      "[boundary]\nx_low = \"inflow\"\n[inflow.x_low]\ndensity = 2\nhistory = [{ time = 1, density = 1, "
      "pressure = 1 }]",
      "either a constant");
  says(
      "[boundary]\nx_low = \"inflow\"\n[inflow.x_low]\ndensity = 2\nfront = { point = [0, 0], normal = [0, 0], "
      "density = 1, pressure = 1 }",
      "`normal` is zero");
  says("[[patch]]\nside = \"x_low\"", "needs `low` and `high`");
  says("[[patch]]\nside = \"z_low\"\nlow = [0, 0]\nhigh = [1, 1]", "normal of z_low");
  says("[[patch]]\nside = \"x_low\"\nlaw = \"outflow\"\nlow = [0, 0.51]\nhigh = [0, 0.52]", "no centre of a face");
  says("[[patch]]\nside = \"x_low\"\nlow = [0, 0]\nhigh = [1, 1]", "[fluid.patch[0].inflow]");
  says(
      "[boundary]\nx_low = \"periodic\"\nx_high = \"periodic\"\n[[patch]]\nside = \"x_low\"\nlaw = "
      "\"outflow\"\nlow = [0, 0]\nhigh = [1, 1]",
      "x_low is periodic");
}

TEST(FlowConfig, VacuumThresholdsFollowTheAmbientStateOrElseTheLargestRegion) {
  FlowConfig config = testing::unit_box(1, 20);
  config.ambient = {2, 8, {}};
  EXPECT_DOUBLE_EQ(make_gas(config).vacuum_density, 2e-10);
  EXPECT_DOUBLE_EQ(make_gas(config).vacuum_energy, 8e-12 / 0.4);
  config.ambient = {0, 0, {}};
  config.region.resize(2);
  config.region[0].density = 3, config.region[0].pressure = 1;
  config.region[1].density = 1, config.region[1].pressure = 5;
  EXPECT_DOUBLE_EQ(make_gas(config).vacuum_density, 3e-10);
  EXPECT_DOUBLE_EQ(make_gas(config).vacuum_energy, 5e-12 / 0.4);
}

}  // namespace
}  // namespace brisance::fluid
