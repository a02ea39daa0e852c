// F23c and F23d of theory/fluid.md 8.4 as a scene states them: a front that runs along a side, and parts of sides with
// laws of their own.
#include <gtest/gtest.h>

#include "tests/support/coupled_case.hpp"
#include "tests/support/evidence.hpp"

namespace brisance {
namespace {

/// Runs the scene. `density`: the largest at the end, of the table, within its 10 %. Not compared where a jet rolls up:
/// it then depends on every detail of the scheme.
void expect_case(std::string const& id, std::string const& scene, int order, std::optional<Real> density) {
  std::string const path = std::string(BRISANCE_SOURCE_DIR) + "/tests/support/scenes/" + scene + ".toml";
  drivers::LoadedScene const loaded = drivers::load_scene(path, {}, testing::comm());
  testing::CoupledCase c(loaded.text, {"fluid.euler.order=" + std::to_string(order)});
  Real pressure_min = std::numeric_limits<Real>::infinity();
  c.run(-1, [&] {
    c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) {
      pressure_min = min(pressure_min, c.world->flow->gas().pressure(u));
    });
  });
  Real density_max = 0;
  c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) { density_max = max(density_max, u[0]); });
  std::string const name = loaded.scene.title, variant = "scene with front and patches; order " + std::to_string(order);
  if (density) {
    EXPECT_TRUE(evidence::near(id, name, variant, "largest density", density_max, *density, 0.1 * *density));
  }
  Real const ambient = loaded.scene.fluid->ambient.pressure;
  EXPECT_TRUE(evidence::near(id, name, variant, "least pressure / ambient", pressure_min / ambient, 1, 0.1));
  EXPECT_TRUE(evidence::at_most(id, name, variant, "defect of mass", c.conservation().mass, 1e-13));
  EXPECT_TRUE(evidence::at_most(id, name, variant, "defect of energy", c.conservation().energy, 1e-13));
}

TEST(GivenSides, AFrontAlongASideMakesTheDoubleMachReflection) {
  expect_case("F23c", "double-mach", 5, 20.9);
  if (!evidence::full()) return;
  expect_case("F23c", "double-mach", 1, 19.9);
  expect_case("F23c", "double-mach", 11, 20.9);
}

TEST(GivenSides, ANozzleInASideMakesTheJet) {
  expect_case("F23d", "jet", 1, 16.4);
  expect_case("F23d", "jet", 5, std::nullopt);
}

}  // namespace
}  // namespace brisance
