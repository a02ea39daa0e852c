// A shock of Mach 3 meets a flat wall that stands, or moves through the grid with the gas ahead of the shock: what the
// wall receives does not depend on the order of the fluxes (theory/coupling.md sections 1.4, 1.9).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

constexpr Real shock_speed = 3, gas_behind = 20.0 / 9.0, pressure_behind = 31.0 / 3.0;
/// Behind the reflected shock, for gamma = 1.4: 5 times that behind the incident one.
constexpr Real pressure_on_wall = 5 * pressure_behind;
constexpr Real start = 0.3, after = 0.1;  ///< of the shock, m; time from the reflection to the end, s

struct Case {
  int cells, order;
  std::string wall_pressure;
  Real speed;  ///< of the frame, m/s: the wall and the gas ahead of the shock move with it
  Real face() const { return 0.7 + 0.37 / cells; }
  Real meets() const { return (face() - start) / shock_speed; }
  std::string name() const {
    std::ostringstream text;
    text << cells << " cells; order " << order << "; " << wall_pressure << "; wall "
         << (speed == 0  ? "at rest"
             : speed < 0 ? "advancing"
                         : "receding");
    return text.str();
  }
};

/// The wall is a heavy box that reaches beyond the sides by a cell: it keeps its velocity, and what it gains of it
/// tells the impulse.
constexpr Real density = 1e7;

std::string scene(Case const& c) {
  Real const h = 1.0 / c.cells, height = 8 * h;
  std::string const behind = gas_state(5.4, pressure_behind, {gas_behind + c.speed, 0, 0});
  std::ostringstream text;
  text << "end_time = " << quantity(c.meets() + after, "s")
       << "\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = " << quantities({1, height}, "m") << "\ncells = [" << c.cells
       << ", 8]\nambient = " << gas_state(1.4, 1, {c.speed, 0, 0}) << "\neuler = { order = " << c.order
       << ", cfl = 0.5 }\n"
       << "boundary = { x_low = \"inflow\" }\ninflow = { x_low = " << behind
       << " }\n[[fluid.region]]\nlow = [\"-1 m\", \"-1 m\"]\nhigh = " << quantities({start, 1}, "m")
       << "\ndensity = \"5.4 kg/m3\"\npressure = " << quantity(pressure_behind, "Pa")
       << "\nvelocity = " << quantities({gas_behind + c.speed, 0}, "m/s") << "\n[solid]\n"
       << rigid_material(density) << "[[solid.body]]\nmaterial = \"rigid\"\nlow = " << quantities({c.face(), -h}, "m")
       << "\nhigh = " << quantities({2, height + h}, "m") << "\nvelocity = " << quantities({c.speed, 0}, "m/s")
       << "\n[coupling]\ncut_cells = { wall_pressure = \"" << c.wall_pressure << "\" }\n";
  return text.str();
}

/// Relative to the exact impulse, which it misses by what the start of a sharp shock leaves behind: first order.
Real impulse(Case const& c) {
  CoupledCase run(scene(c));
  run.run();
  Real const h = 1.0 / c.cells, height = 8 * h;
  Real const mass = density * (2 - c.face()) * (height + 2 * h);
  Real const exact = c.meets() + pressure_on_wall * after;  // p = 1 ahead of the shock
  Conservation const& k = run.conservation();
  EXPECT_TRUE(evidence::at_most("V8", "shock on a wall", c.name(), "mass defect", k.mass, 1e-13));
  EXPECT_TRUE(evidence::at_most("V8", "shock on a wall", c.name(), "energy defect", k.energy, 1e-13));
  return mass * (run.velocity().x - c.speed) / height / exact;
}

TEST(ShockOnWall, ImpulseDoesNotDependOnTheOrder) {
  for (std::string const wall : {"cell", "half_riemann"})
    for (Real const speed : evidence::full() ? std::vector{0.0, -0.4, 0.4} : std::vector{0.0, -0.4}) {
      Real const fifth = impulse({200, 5, wall, speed});
      for (int const order : {1, 3, 5, 11}) {
        Case const c{200, order, wall, speed};
        Real const got = order == 5 ? fifth : impulse(c);
        EXPECT_TRUE(evidence::near("V8", "shock on a wall", c.name(), "impulse over the exact one", got, 1,
                                   order == 1 ? 3e-3 : 1.6e-3));
        if (order == 3 || order == 11) {
          EXPECT_TRUE(evidence::near("V8", "shock on a wall", c.name(), "impulse over that of order 5", got / fifth, 1,
                                     1.2e-4));
        }
      }
    }
}

TEST(ShockOnWall, ImpulseConverges) {
  if (!evidence::full()) GTEST_SKIP() << "full suite only";
  for (int const order : {5, 11})
    for (std::string const wall : {"cell", "half_riemann"}) {
      Case const c{800, order, wall, 0};
      EXPECT_TRUE(
          evidence::near("V8", "shock on a wall", c.name(), "impulse over the exact one", impulse(c), 1, 2.5e-4));
    }
}

}  // namespace
}  // namespace brisance
