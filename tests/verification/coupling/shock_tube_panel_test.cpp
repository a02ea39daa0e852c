// V9: an elastic panel in a shock tube, the scene that is shipped (Giordano et al. 2005; theory/coupling.md section 7).
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/shipped_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

/// Deflection of the panel's tip, m: of the particle at its end, carried on by its rotation over half its height.
Real tip(CoupledCase const& c) {
  solid::Solid const& s = *c.world->solid;
  for (Index i = 0; i < s.owned(); ++i) {
    Vec3 const start = c.world->mesh->particle(s.id(i)).centre;
    if (std::abs(start.y - 0.06375) > 1e-6 || start.x < 0.26 || start.x > 0.27) continue;
    solid::Pose const& pose = s.pose()[static_cast<std::size_t>(i)];
    return pose.x.x - start.x + rotate(pose.q, {0, 0.00125, 0}).x;
  }
  ADD_FAILURE() << "no particle at the tip";
  return 0;
}

TEST(ShockTubePanel, BendsAsTheReference) {
  // The short form: the start of the motion, between ends that no wave comes back from in time.
  std::vector<std::string> const shorter{"end_time=\"0.4 ms\"", "fluid.low=[\"180 mm\", \"0 m\"]",
                                         "fluid.high=[\"350 mm\", \"80 mm\"]", "fluid.cells=[170, 80]"};
  CoupledCase c(shipped_scene("panel-in-a-shock-tube"), evidence::full() ? std::vector<std::string>{} : shorter);
  struct Place {
    Real time, deflection, tolerance;
  };
  // The start of the motion is steep: 0.1 mm are 20 microseconds there.
  std::vector<Place> places{{0.4e-3, 1.28e-3, 0.04e-3}};
  if (evidence::full())
    places = {{0.2e-3, 0.12e-3, 0.02e-3}, {0.4e-3, 1.28e-3, 0.04e-3}, {0.6e-3, 2.67e-3, 0.08e-3},
              {0.8e-3, 4.37e-3, 0.13e-3}, {1.0e-3, 5.90e-3, 0.18e-3}, {1.2e-3, 6.82e-3, 0.2e-3}};
  std::string const variant = evidence::full() ? "shipped scene" : "shipped scene; to 0.4 ms";
  std::size_t next = 0;
  Real before = 0, time_before = 0, largest = 0, time_of_largest = 0;
  c.run(-1, [&] {
    Real const now = tip(c);
    while (next < places.size() && c.time() >= places[next].time * (1 - 1e-12)) {
      Real const share = (places[next].time - time_before) / (c.time() - time_before);
      std::ostringstream what;
      what << "deflection of the tip at " << 1e3 * places[next].time << " ms";
      EXPECT_TRUE(evidence::near("V9", "elastic panel in a shock tube", variant, what.str(),
                                 before + share * (now - before), places[next].deflection, places[next].tolerance));
      ++next;
    }
    if (now > largest) largest = now, time_of_largest = c.time();
    before = now, time_before = c.time();
  });
  EXPECT_EQ(next, places.size());
  Conservation const& k = c.conservation();
  EXPECT_TRUE(evidence::at_most("V9", "elastic panel in a shock tube", variant, "energy defect", k.energy, 1e-9));
  EXPECT_TRUE(evidence::at_most("V9", "elastic panel in a shock tube", variant, "mass defect", k.mass, 1e-12));
  if (!evidence::full()) return;
  // 7.58, 7.58 and 7.56 mm on 520, 780 and 1040 cells. The theory's 7.41 and 7.47 mm (520 and 780 cells) rise with the
  // resolution; walls as thin as this panel let gas through there (section 1.9), which a finer grid lessens.
  EXPECT_TRUE(
      evidence::near("V9", "elastic panel in a shock tube", variant, "largest deflection", largest, 7.57e-3, 0.03e-3));
  EXPECT_TRUE(
      evidence::near("V9", "elastic panel in a shock tube", variant, "time of it", time_of_largest, 1.40e-3, 0.02e-3));
}

/// At its foot the panel turns by a thousandth: one half of its base lifts off the step, the other sinks into it. Where
/// the step lies on a grid plane the faces between the cells there are inside out all over; elsewhere a wedge of gas
/// lies in cells that count as solid. No force and no gas may come of either: before the shock has come around the
/// panel the gas behind it only gives way to the panel. On 133 cells the pivot lies inside a cell: through the slit
/// under the half that lifts off no more comes than a slit lets through, with either wall pressure.
void foot(int cells, std::string const& wall_pressure) {
  Real const h = 100e-3 / cells;
  std::ostringstream grid;
  grid << "fluid.cells=[" << cells << ", " << cells * 7 / 10 << "]";
  CoupledCase c(shipped_scene("panel-in-a-shock-tube"),
                {"end_time=\"0.12 ms\"", "fluid.low=[\"200 mm\", \"10 mm\"]",
                 "fluid.high=[\"300 mm\", \"" + std::to_string(10 + 100.0 * (cells * 7 / 10) / cells) + " mm\"]",
                 grid.str(), "coupling.cut_cells.wall_pressure=\"" + wall_pressure + "\""});
  c.run();
  fluid::Gas const& gas = c.world->flow->gas();
  Real const still = 100e3 / std::pow(1.2, 1.4);
  Real fastest = 0, least = 1, most = 1;
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real volume) {
    Vec3 const x = c.world->flow->grid().centre(cell);
    if (volume < 0.5 * h * h || x.y > 30e-3 || std::abs(x.x - 265.5e-3) > 5e-3) return;
    if (x.x > 265.5e-3) fastest = max(fastest, norm(Vec3{u[1], u[2], 0}) / u[0]);
    Real const entropy = gas.pressure(u) / std::pow(u[0], 1.4) / still;
    least = min(least, entropy);
    most = max(most, entropy);
  });
  std::string const variant = "foot of the panel; " + grid.str() + "; " + wall_pressure;
  EXPECT_TRUE(
      evidence::at_most("V9", "elastic panel in a shock tube", variant, "speed behind the panel, m/s", fastest, 2));
  EXPECT_TRUE(evidence::at_most("V9", "elastic panel in a shock tube", variant, "entropy above that of still air",
                                most - 1, 0.05));
  EXPECT_TRUE(evidence::at_most("V9", "elastic panel in a shock tube", variant, "entropy below that of still air",
                                1 - least, 0.005));
}

TEST(ShockTubePanel, NothingComesThroughItsFoot) {
  for (int const cells : {100, 133, 150, 200}) foot(cells, "half_riemann");
  foot(133, "cell");
}

}  // namespace
}  // namespace brisance
