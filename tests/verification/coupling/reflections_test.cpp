// V6 and V7: shocks on wedges that cut obliquely through the grid (theory/coupling.md section 7). The first case of
// each is the scene that is shipped.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"
#include "tests/support/shipped_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

Real radians(Real degrees) { return degrees * std::numbers::pi / 180; }

/// Gas behind a shock of Mach number m that enters gas at rest of density 1.4 and pressure 1 (sound speed 1).
struct Behind {
  explicit Behind(Real m)
      : density(1.4 * 2.4 * m * m / (0.4 * m * m + 2)), pressure((2.8 * m * m - 0.4) / 2.4), speed((m - 1 / m) / 1.2) {}
  /// Ratio of the pressures across the shock that a wall sends back.
  Real reflected() const { return (3.2 * pressure - 0.4) / (0.4 * pressure + 2.4); }
  Real density, pressure, speed;
};

/// Means of pressure and density over the cells that the wall cuts, between `from` and 92 % of the way from the corner
/// to the foot of the shock; the wall rises to the right of `corner`.
struct WallMeans {
  Real pressure = 0, density = 0;
  int cells = 0;
};
WallMeans wall_means(CoupledCase& c, Vec3 const& corner, Real angle, Real foot_x, Real from = 0.68) {
  WallMeans means;
  fluid::Grid const& grid = c.world->flow->grid();
  Real const length = (foot_x - corner.x) / std::cos(angle);
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real volume) {
    if (volume >= grid.cell_volume()) return;
    Vec3 const x = grid.centre(cell) - corner;
    Real const along = x.x * std::cos(angle) + x.y * std::sin(angle);
    if (x.y < 0 || along < from * length || along > 0.92 * length) return;
    means.pressure += c.world->flow->gas().pressure(u);
    means.density += u[0] / 1.4;
    ++means.cells;
  });
  means.pressure /= means.cells;
  means.density /= means.cells;
  return means;
}

void expect_means(std::string const& variant, WallMeans const& means, Real pressure, Real density) {
  EXPECT_GT(means.cells, 10) << variant;
  EXPECT_TRUE(evidence::near("V6", "regular reflection on a wedge", variant, "p3 / p1 on the wall", means.pressure,
                             pressure, 0.01 * pressure));
  EXPECT_TRUE(evidence::near("V6", "regular reflection on a wedge", variant, "rho3 / rho1 on the wall", means.density,
                             density, 0.01 * density));
}

TEST(ShockOnAWedge, ReflectsAsTheTwoShockTheorySays) {
  CoupledCase c(shipped_scene("shock-on-a-wedge"));
  c.run();
  expect_means("shipped scene; Mach 2; 60 degrees", wall_means(c, {0.2, 0, 0}, radians(60), 0.15 + 2 * c.time()),
               13.7833, 5.7017);
  EXPECT_TRUE(evidence::at_most("V6", "regular reflection on a wedge", "shipped scene; Mach 2; 60 degrees",
                                "mass defect", c.conservation().mass, 1e-12));
}

/// A wedge with a lower half like the upper one, so that all can move with the frame.
std::string wedge(Real mach, Real degrees, int cells, Vec3 const& frame, Real end_time) {
  Real const run = 3 / std::tan(radians(degrees));
  Behind const b(mach);
  Vec3 const behind = frame + Vec3{b.speed, 0, 0};
  std::string const everywhere = "{ low = [-9, -9], high = [9, 9]";
  return "end_time = " + digits(end_time) + "\n[fluid]\nlow = [-0.3, -1]\nhigh = [0.9, 1.2]\ncells = [" +
         std::to_string(cells * 6 / 5) + ", " + std::to_string(cells * 11 / 5) +
         "]\nambient = " + gas_state(1.4, 1, frame) +
         "\neuler = { order = 11, cfl = 0.5 }\nboundary = { x_low = \"inflow\", x_high = \"outflow\", y_low = "
         "\"outflow\", "
         "y_high = \"outflow\" }\ninflow = { x_low = " +
         gas_state(b.density, b.pressure, behind) +
         " }\n[[fluid.region]]\nlow = [-1, -9]\nhigh = [0.15, 9]\ndensity = " + digits(b.density) +
         "\npressure = " + digits(b.pressure) + "\nvelocity = [" + digits(behind.x) + ", " + digits(behind.y) +
         "]\n[solid]\n" + rigid_material(1) + polygon_body({0.2, 0, 0.2 + run, -3, 0.2 + run, 3}) +
         (norm(frame) > 0
              ? "prescribed = [" + everywhere + ", velocity = " + quantities({frame.x, frame.y}, "m/s") + " }]\n"
              : "hold = [" + everywhere + " }]\n") +
         "[coupling]\ncut_cells = {}\n";
}

TEST(ShockOnAWedge, OtherPairsAndAMovingFrame) {
  if (!evidence::full()) GTEST_SKIP() << "full suite only";
  struct Case {
    Real mach, degrees, pressure, density;
    Vec3 frame;
    Real from =
        0.68;  // of the uniform part: what the corner sends out has come 64 % of the way at 60, 80 % at 55 degrees
  };
  for (Case const& k : {Case{2, 60, 13.7833, 5.7017, {}}, Case{2, 60, 13.7833, 5.7017, {-0.8, 0.35, 0}},
                        Case{1.2, 60, 2.2133, 1.7574, {}}, Case{1.5, 60, 5.2063, 3.1441, {}},
                        Case{10, 60, 748.04, 18.184, {}}, Case{2, 55, 13.7238, 5.6866, {}, 0.82}}) {
    Real const end_time = 0.5 / k.mach;
    CoupledCase c(wedge(k.mach, k.degrees, 160, k.frame, end_time));
    c.run();
    Vec3 const corner = Vec3{0.2, 0, 0} + end_time * k.frame;
    std::ostringstream variant;
    variant << "Mach " << k.mach << "; " << k.degrees << " degrees; frame at (" << k.frame.x << " " << k.frame.y << ")";
    expect_means(variant.str(),
                 wall_means(c, corner, radians(k.degrees), 0.15 + end_time * (k.mach + k.frame.x), k.from), k.pressure,
                 k.density);  // the density at Mach 10 misses by 2 % (coupling/README.md)
  }
}

/// Density and pressure of the cell beside a wall, over the exact ones.
struct WallCell {
  Real density = 0, pressure = 0;
};
/// The cell that the wall cuts in a strip of 8 cells, in units of `density` and `pressure`.
WallCell wall_cell(CoupledCase& c, Real density, Real pressure) {
  WallCell found;
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real volume) {
    if (cell[1] != 3 || volume >= c.world->flow->grid().cell_volume()) return;
    found = {u[0] / density, c.world->flow->gas().pressure(u) / pressure};
  });
  return found;
}

/// A strip of 100 cells along x with a wall that faces its low end at `face`.
std::string strip(Real face, Real end_time, std::string const& fluid, std::string const& motion) {
  std::string const everywhere = "{ low = [-9, -9], high = [19, 9]";
  return "end_time = " + digits(end_time) +
         "\n[fluid]\nhigh = [1, 0.08]\ncells = [100, 8]\nambient = " + gas_state(1.4, 1, {}) +
         "\neuler = { order = 11, cfl = 0.5 }\n" + fluid + "[solid]\n" + rigid_material(1) +
         polygon_body({face, -3, 9, -3, 9, 3, face, 3}) +
         (motion.empty() ? "hold = [" + everywhere + " }]\n"
                         : "prescribed = [" + everywhere + ", velocity = " + motion + " }]\n") +
         "[coupling]\ncut_cells = {}\n";
}

// At Mach 10 the gas comes to the wall at 1.6 times its speed of sound. The limits are one and a half times what the
// reflecting side of a grid shows (density 0.9, 1.1 and 1.3 % off in its first two cells).
TEST(NormalShock, ReflectsFromAWallBetweenGridLines) {
  for (Real const mach : {3.0, 10.0, 100.0})
    for (Real const part : {0.63, 0.95}) {  // of the cut cell is fluid
      Behind const b(mach);
      Real const density = b.density * (2.4 * b.reflected() + 0.4) / (0.4 * b.reflected() + 2.4);
      Real const back = b.speed * b.density / (density - b.density), face = 0.9 + 0.01 * part;
      CoupledCase c(strip(face, (face - 0.5) / mach + 0.2 / back,
                          "boundary = { x_low = \"inflow\", x_high = \"outflow\" }\ninflow = { x_low = " +
                              gas_state(b.density, b.pressure, {b.speed, 0, 0}) +
                              " }\n[[fluid.region]]\nlow = [-9, -9]\nhigh = [0.5, 9]\ndensity = " + digits(b.density) +
                              "\npressure = " + digits(b.pressure) + "\nvelocity = [" + digits(b.speed) + ", 0]\n",
                          ""));
      c.run();
      WallCell const w = wall_cell(c, density, b.pressure * b.reflected());
      std::string const variant = "Mach " + digits(mach) + "; " + digits(part) + " of the cell is fluid";
      EXPECT_TRUE(evidence::near("V6", "normal reflection", variant, "density at the wall", w.density, 1, 0.015));
      EXPECT_TRUE(evidence::near("V6", "normal reflection", variant, "pressure at the wall", w.pressure, 1, 0.005));
    }
}

TEST(NormalShock, RunsAheadOfAFastWall) {
  for (Real const speed : {2.0, 5.0, 10.0}) {
    Real const mach = 0.6 * speed + std::sqrt(0.36 * speed * speed + 1);
    Behind const b(mach);
    CoupledCase c(strip(0.6037, 0.35 / (1.5 * speed), "boundary = { x_low = \"outflow\", x_high = \"outflow\" }\n",
                        quantities({-speed, 0}, "m/s")));
    c.run();
    WallCell const w = wall_cell(c, b.density, b.pressure);
    std::string const variant = "wall at " + digits(speed) + " c";
    EXPECT_TRUE(evidence::near("V6", "shock of a wall", variant, "density at the wall", w.density, 1, 0.035));
    EXPECT_TRUE(evidence::near("V6", "shock of a wall", variant, "pressure at the wall", w.pressure, 1, 0.005));
  }
}

/// Way along the wall from the corner to where the pressure in the cells beside the wall passes half of what is behind
/// the Mach stem; means over bins one cell wide.
Real mach_stem_foot(CoupledCase& c, Real corner_x, Real angle) {
  fluid::Grid const& grid = c.world->flow->grid();
  Real const h = grid.spacing.x;
  std::map<int, std::array<Real, 2>> bins;
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real volume) {
    if (volume >= grid.cell_volume()) return;
    Vec3 const x = grid.centre(cell);
    std::array<Real, 2>& bin =
        bins[static_cast<int>(std::floor(((x.x - corner_x) * std::cos(angle) + x.y * std::sin(angle)) / h))];
    bin[0] += c.world->flow->gas().pressure(u), bin[1] += 1;
  });
  Real largest = 0, last = 0, foot = 0;
  for (auto const& [bin, sum] : bins)
    if (bin * h > 2) largest = max(largest, sum[0] / sum[1]);
  for (auto const& [bin, sum] : bins) {
    Real const p = sum[0] / sum[1];
    if (p < 0.5 * largest && last >= 0.5 * largest) foot = h * (bin + 0.5 - (0.5 * largest - p) / (last - p));
    last = p;
  }
  return foot;
}

TEST(DoubleMachReflection, StemRunsAheadOfTheShock) {
  for (int const cells : evidence::full() ? std::vector{130, 260} : std::vector{130}) {
    CoupledCase c(shipped_scene("double-mach-ramp"),
                  {"fluid.cells=[" + std::to_string(cells) + "," + std::to_string(cells * 19 / 26) + "]"});
    c.run();
    Real const h = c.world->flow->grid().spacing.x, shock = 10 * c.time() / std::cos(radians(30));
    std::string const variant = (cells == 260 ? "shipped scene; " : "") + std::to_string(cells) + " cells along";
    EXPECT_TRUE(evidence::near("V7", "double Mach reflection on a plane", variant,
                               "foot of the stem over that of the shock", mach_stem_foot(c, 0.15, radians(30)) / shock,
                               1.13, h / shock));
    EXPECT_TRUE(evidence::at_most("V7", "double Mach reflection on a plane", variant, "mass defect",
                                  c.conservation().mass, 1e-12));
  }
}

}  // namespace
}  // namespace brisance
