// Walls thinner than two cells keep the gas on their two sides apart (coupling/README.md, thin walls).
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"
#include "tests/support/shipped_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

bool at_most(std::string const& name, std::string const& variant, std::string const& quantity, Real got, Real limit) {
  return evidence::at_most("thin-walls", name, variant, quantity, got, limit);
}

/// Mass of the gas on the inner side of a closed wall around `centre`, kg; `radius`: between those of the wall.
Real mass_inside(CoupledCase& c, Vec3 const& centre, Real radius) {
  fluid::Grid const& grid = c.world->flow->grid();
  auto const from_centre = [&](fluid::CellIndex cell) {
    Vec3 x = grid.centre(cell) - centre;
    if (grid.dimension == 2) x.z = 0;
    return x;
  };
  std::set<fluid::CellIndex> cut;
  Real mass = 0;
  c.world->cut_cells->for_parts([&](fluid::CellIndex cell, Vec3 const& area, fluid::State const& content) {
    cut.insert(cell);
    if (dot(area, from_centre(cell)) < 0) mass += content[0];
  });
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real volume) {
    if (!cut.contains(cell) && norm(from_centre(cell)) < radius) mass += u[0] * volume;
  });
  return mass;
}

void check_conservation(CoupledCase& c, std::string const& name, std::string const& variant) {
  Conservation const& k = c.conservation();
  EXPECT_TRUE(at_most(name, variant, "mass defect", k.mass, 1e-12));
  EXPECT_TRUE(at_most(name, variant, "momentum defect", max(k.momentum.x, max(k.momentum.y, k.momentum.z)), 1e-12));
  EXPECT_TRUE(at_most(name, variant, "exchange energy defect", k.exchange_energy, 1e-12));
}

constexpr Real inner_radius = 0.45, h = 0.04;
Vec3 const centre{0.013, 0.007, 0};

enum class Ring { held, breathing, drifting };

/// A ring of 0.9 m across, oblique to the grid all around, with ten times the pressure inside: 20 ms are 10 crossings.
/// `options`: of coupling.cut_cells.
std::string ring(Real cells_thick, Ring kind, std::string const& options) {
  return "end_time = \"20 ms\"\n[fluid]\nlow = [\"-1 m\", \"-1 m\"]\nhigh = [\"1 m\", \"1 m\"]\ncells = [50, 50]\n"
         "ambient = { density = \"1.2 kg/m3\", pressure = \"101325 Pa\" }\neuler = { order = 5, cfl = 0.5 }\n"
         "[[fluid.region]]\nshape = \"ball\"\ncentre = [\"0.013 m\", \"0.007 m\"]\nradius = \"0.45 m\"\n"
         "density = \"12 kg/m3\"\npressure = \"1013250 Pa\"\ncells = \"whole\"\n"
         "[solid]\nlinks = {}\n[solid.material.steel]\ndensity = \"7860 kg/m3\"\nyoung_modulus = \"" +
         digits(kind == Ring::held ? 210 : 2 / cells_thick) +
         " GPa\"\npoisson_ratio = 0.0\n[[solid.body]]\nmaterial = \"steel\"\nshape = \"tube\"\ntessellation = "
         "\"polar\"\n"
         "centre = [\"0.013 m\", \"0.007 m\"]\ninner_radius = \"0.45 m\"\nouter_radius = " +
         quantity(inner_radius + cells_thick * h, "m") + "\ncells = [1, 50, 1]\nphase = \"0.013 rad\"\n" +
         (kind == Ring::held ? "hold = [{ low = [\"-2 m\", \"-2 m\", \"-1 m\"], high = [\"2 m\", \"2 m\", \"2 m\"] }]\n"
                             : "") +
         (kind == Ring::drifting
              ? "velocity = [\"13 m/s\", \"7 m/s\", \"0 m/s\"]\nspin = [\"0 rad/s\", \"0 rad/s\", \"20 rad/s\"]\n"
              : "") +
         "[coupling]\ncut_cells = { " + options + " }\n";
}

void check_ring(Real cells_thick, Ring kind, std::string const& options = "", std::string const& scheme = "lag") {
  CoupledCase c(ring(cells_thick, kind, options), {"coupling.scheme=\"" + scheme + "\""});
  Vec3 const drift = kind == Ring::drifting ? Vec3{13, 7, 0} : Vec3{};
  Real const before = mass_inside(c, centre, inner_radius + 0.4 * cells_thick * h);
  Real lost = 0;
  c.run(-1, [&] {
    Real const now = mass_inside(c, centre + c.time() * drift, inner_radius + 0.4 * cells_thick * h);
    lost = max(lost, std::abs(now / before - 1));
  });
  Real speed = 0;
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real) {
    Vec3 x = c.world->flow->grid().centre(cell) - centre;
    x.z = 0;
    if (norm(x) > inner_radius + 2 * h && u[0] > 0) speed = max(speed, norm({u[1], u[2], u[3]}) / u[0]);
  });
  std::string const name = "ring of ten times the pressure";
  std::string const variant = digits(cells_thick) + " cells thick; " +
                              (kind == Ring::held        ? "held"
                               : kind == Ring::breathing ? "breathing"
                                                         : "drifting, spinning") +
                              (options.empty() ? "" : "; " + options) + (scheme == "lag" ? "" : "; " + scheme);
  EXPECT_TRUE(at_most(name, variant, "share of the gas that is lost", lost, 1e-12));
  check_conservation(c, name, variant);
  if (kind == Ring::held) {
    EXPECT_TRUE(at_most(name, variant, "speed of the outer air, m/s", speed, 1e-6));
  }
}

TEST(ThinWalls, HeldRing) {
  for (Real const t : {0.2, 0.32, 0.8, 1.2}) check_ring(t, Ring::held);
}
TEST(ThinWalls, BreathingRing) {
  for (Real const t : {0.2, 0.32, 0.8, 1.2}) check_ring(t, Ring::breathing);
}
TEST(ThinWalls, DriftingRing) {
  for (Real const t : {0.2, 0.32, 0.8, 1.2}) check_ring(t, Ring::drifting);
}

TEST(ThinWalls, RingWithExplicitLoads) {
  for (Real const t : {0.2, 0.8})
    for (Ring const kind : {Ring::held, Ring::breathing, Ring::drifting}) check_ring(t, kind, "", "explicit");
}

// Cells beside the wall keep their mean and are merged, the others have profiles and are redistributed.
TEST(ThinWalls, RingWithProfilesAndRedistribution) {
  std::string const profile = "profile = \"density\"", redistribution = "small_cells = \"redistribution\"";
  for (std::string const& options : {profile, redistribution, profile + ", " + redistribution})
    for (Ring const kind : {Ring::held, Ring::breathing, Ring::drifting})
      check_ring(evidence::full() ? 0.32 : 0.8, kind, options);
}

/// A channel that an oblique plate closes, through both of its walls; a shock meets the plate.
TEST(ThinWalls, ShockDoesNotShowBehindAPlate) {
  for (Real const thickness : {0.2, 0.5, 0.9}) {
    Real const width = 0.02, angle = 0.35;
    std::string const plate =
        polygon_body(rectangle({0.52, 0.25, 0}, {0.5 * thickness * width, 0.6, 0}, angle),
                     "hold = [{ low = [\"-2 m\", \"-2 m\", \"-1 m\"], high = [\"2 m\", \"2 m\", \"2 m\"] }]\n");
    CoupledCase c(
        "end_time = \"0.5 s\"\n[fluid]\nhigh = [\"1 m\", \"0.5 m\"]\ncells = [50, 25]\nambient = " +
        gas_state(1.4, 1, {}) +
        "\neuler = { order = 5, cfl = 0.5 }\nboundary = { x_low = \"outflow\", x_high = \"outflow\", y_low = "
        "\"reflecting\", y_high = \"reflecting\" }\n[[fluid.region]]\nshape = \"box\"\nlow = [\"-1 m\", \"-1 "
        "m\"]\nhigh = "
        "[\"0.2 m\", \"1 m\"]\ndensity = \"3.7333333333333334 kg/m3\"\npressure = \"4.5 Pa\"\nvelocity = [\"1.25 "
        "m/s\", \"0 m/s\"]\n[solid]\n" +
        rigid_material(10) + plate + "[coupling]\ncut_cells = {}\n");
    c.run();
    Vec3 const across{std::cos(angle), std::sin(angle), 0};
    Real behind = 0, before = 0;
    c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real) {
      Real const away = dot(c.world->flow->grid().centre(cell) - Vec3{0.52, 0.25, 0}, across);
      Real const excess = std::abs(c.world->flow->gas().pressure(u) - 1);
      if (away > 1.5 * width) behind = max(behind, excess);
      if (away < 0) before = max(before, excess);
    });
    std::string const variant = digits(thickness) + " cells thick";
    EXPECT_TRUE(at_most("shock on an oblique plate", variant, "pressure behind it", behind, 1e-10));
    EXPECT_GT(before, 8);
    EXPECT_TRUE(at_most("shock on an oblique plate", variant, "mass defect", c.conservation().mass, 1e-12));
  }
}

/// V2 with plates of a fifth of a cell at any angle.
TEST(ThinWalls, PlateInCommonMotion) {
  Vec3 const velocity{0.61, 0.37, 0};
  std::string const state = gas_state(1.4, 1, velocity);
  for (Real const angle : {0.0, 0.05, 0.35, 0.785398163397448, 1.2, 1.5707963267948966}) {
    CoupledCase c("end_time = \"1 s\"\n[fluid]\nhigh = [\"1 m\", \"1 m\"]\ncells = [40, 40]\nambient = " + state +
                  "\neuler = { order = 5, cfl = 0.5 }\n" + inflow_everywhere(state) + "[solid]\n" + rigid_material(30) +
                  polygon_body(rectangle({0.33, 0.31, 0}, {0.15, 0.1 / 40, 0}, angle)) +
                  "velocity = " + vector(velocity, "m/s") + "\n[coupling]\ncut_cells = {}\n");
    Real largest = 0;
    c.run(60, [&] {
      largest = max(largest, deviation(c, 1.4, velocity, 1));
      c.world->cut_cells->for_parts([&](fluid::CellIndex, Vec3 const&, fluid::State const& m) {
        if (m[0] > 1e-9 / 1600) largest = max(largest, norm(Vec3{m[1], m[2], m[3]} / m[0] - velocity));
      });
      largest = max(largest, norm(c.velocity() - velocity));
    });
    EXPECT_TRUE(at_most("plate of 0.2 cells in common motion", "at " + digits(angle) + " rad",
                        "largest deviation of gas and body", largest, 1e-11));
  }
}

TEST(ThinWalls, ShellInSpace) {
  CoupledCase c(shipped_scene("thin-shell"),
                evidence::full() ? std::vector<std::string>{} : std::vector<std::string>{"end_time=0.2"});
  auto const place = [&] { return Vec3{0.013, 0.007, -0.011} + c.time() * Vec3{0.05, 0.02, 0.03}; };
  Real const before = mass_inside(c, place(), 0.276);
  Real lost = 0;
  c.run(-1, [&] {
    Real const now = mass_inside(c, place(), 0.276);
    lost = max(lost, std::abs(now / before - 1));
  });
  EXPECT_TRUE(at_most("shell in space", "0.34 cells thick", "share of the gas that is lost", lost, 1e-12));
  check_conservation(c, "shell in space", "0.34 cells thick");
}

}  // namespace
}  // namespace brisance
