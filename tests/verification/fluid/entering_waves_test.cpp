// F28 of theory/fluid.md 6, variants with a given motion: what inflow histories and moving walls send into the domain,
// against exact simple waves and shocks.
#include <gtest/gtest.h>

#include <numbers>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/simple_wave.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

using namespace testing;

constexpr Real width = 0.12, middle = 0.45, path = 0.9;  // of the pulse, and of the sound from start to end
constexpr int entries = 4000;

/// Pulse of Mach `mach`, half of it through the side at c_0 t = 0.45.
Real pulse(Real mach, Real t) { return mach * rest_sound * std::exp(-square((rest_sound * t - middle) / width)); }

FlowConfig tube(int cells, int order, std::string const& source) {
  FlowConfig config = unit_box(1, cells);
  config.euler->order = order;
  config.boundary.x_low = source;
  config.boundary.x_high = "far_field";
  return config;
}

/// L1 error of the density, relative to that of the pulse.
template <class Path>
Real error_of_pulse(FlowConfig const& config, Real mach, Path const& source) {
  auto const flow = make_flow(config, comm());
  fill(*flow, config);
  FlowClock clock;
  Real const end = path / rest_sound;
  advance(*flow, clock, {.end = end, .cfl = 0.8});
  Real error = 0, size = 0;
  for_cells(*flow, [&](CellIndex c, State const& u) {
    State const exact = line_mean(flow->grid(), c[0], [&](Real x) {
      GasState const s = on_wave(speed_of_wave(
                                     x, end, [&](Real t) { return pulse(mach, t); }, source),
                                 0);
      return flow->gas().conserved(s.density, s.velocity, s.pressure);
    });
    error += std::abs(u[0] - exact[0]);
    size += std::abs(exact[0] - 1);
  });
  return error / size;
}

Real inflow_error(int cells, int order) {
  FlowConfig config = tube(cells, order, "inflow");
  InflowState& inflow = config.inflow.x_low.emplace();
  for (int i = 0; i <= entries; ++i) {
    TimedState& entry = inflow.history.emplace_back();
    entry.time = static_cast<Real>(i) / entries;
    GasState const s = on_wave(pulse(0.1, entry.time), 0);
    entry.density = s.density, entry.pressure = s.pressure, entry.velocity = s.velocity;
  }
  return error_of_pulse(config, 0.1, [](Real) { return 0.0; });
}

Real piston_error(int cells, int order, Real mach) {
  FlowConfig config = tube(cells, order, "moving_wall");
  WallMotion& wall = config.moving_wall.x_low.emplace();
  for (int i = 0; i <= entries; ++i) {
    TimedSpeed& entry = wall.history.emplace_back();
    entry.time = static_cast<Real>(i) / entries;
    entry.speed = pulse(mach, entry.time);
  }
  Real const half_way = 0.5 * std::sqrt(std::numbers::pi) * width * mach;
  return error_of_pulse(config, mach,
                        [&](Real t) { return half_way * (1 + std::erf((rest_sound * t - middle) / width)); });
}

/// Both halve the time step with the cells: second order in all, whatever the order of the flux.
void expect_second_order(std::string const& name, int order, Real coarse, Real fine) {
  std::string const variant = "order " + std::to_string(order) + "; 50 and 100 cells";
  EXPECT_TRUE(
      evidence::near("F28", name, variant, "observed order", std::log2(coarse / fine), order == 1 ? 1 : 2, 0.3));
}

TEST(EnteringWaves, AHistoryEntersAtSecondOrder) {
  for (int const order : {1, 5, 11}) {
    Real const coarse = inflow_error(50, order), fine = inflow_error(100, order);
    expect_second_order("simple wave of Mach 0.1 enters through an inflow with history", order, coarse, fine);
    if (order == 1) continue;
    EXPECT_TRUE(evidence::at_most("F28", "simple wave of Mach 0.1 enters through an inflow with history",
                                  "order " + std::to_string(order) + "; 100 cells", "L1 density / pulse", fine, 1e-3));
  }
}

/// The side of the grid stays where it is: from there on the error is that of the wall's displacement.
TEST(EnteringWaves, AMovingWallSendsItsWaveAtSecondOrder) {
  Real const mach = 1e-4;
  for (int const order : {1, 5, 11})
    expect_second_order("piston with a history", order, piston_error(50, order, mach), piston_error(100, order, mach));
}

TEST(EnteringWaves, ThePlaceOfAMovingWallIsItsWholeError) {
  for (Real const mach : {1e-3, 1e-4}) {
    Real const displacement = std::sqrt(std::numbers::pi) * width * mach;
    char variant[64];
    std::snprintf(variant, sizeof variant, "order 5; 400 cells; displacement %.2g", displacement);
    EXPECT_TRUE(evidence::at_most("F28", "piston with a history", variant, "L1 density / pulse",
                                  piston_error(400, 5, mach), 0.6 * displacement / width));
  }
}

/// Gas at rest, a wall that starts at once: a shock runs from it, or a fan.
void expect_piston(Real speed, int order) {
  FlowConfig config = tube(200, order, "moving_wall");
  config.moving_wall.x_low.emplace().speed = speed;
  auto const flow = make_flow(config, comm());
  fill(*flow, config);
  Totals const before = totals(*flow);
  FlowClock clock;
  Real const end = 0.6 / rest_sound;
  advance(*flow, clock, {.end = end, .cfl = 0.8});
  Totals const after = totals(*flow);
  auto const gained = flow->ledger().totals(comm());

  GasState star = on_wave(speed, 0);  // Rankine-Hugoniot or the fan
  if (speed > 0) {
    Real const a = 2 / (wave_gamma + 1), b = (wave_gamma - 1) / (wave_gamma + 1);
    for (int pass = 0; pass < 60; ++pass) star.pressure = 1 + speed / std::sqrt(a / (star.pressure + b));
    star.density = (star.pressure + b) / (1 + b * star.pressure);
  }
  Real worst_pressure = 0, worst_speed = 0;
  for_cells(*flow, [&](CellIndex c, State const& u) {
    if (flow->grid().centre(c).x > 0.45) return;
    worst_pressure = max(worst_pressure, std::abs(flow->gas().pressure(u) - star.pressure));
    worst_speed = max(worst_speed, std::abs(u[1] / u[0] - speed));
  });
  std::string const name = speed > 0 ? "piston drives a shock" : "piston recedes";
  std::string const variant = "order " + std::to_string(order) + "; 200 cells";
  Real const rise = std::abs(star.pressure - 1);
  EXPECT_TRUE(evidence::at_most("F28", name, variant, "pressure error / rise", worst_pressure / rise, 1e-4));
  EXPECT_TRUE(evidence::at_most("F28", name, variant, "speed error / wall speed", worst_speed / std::abs(speed), 1e-4));
  // The gas is continued from the wall to the side: its energy and the work of the wall cross it.
  Real const work = (star.pressure * wave_k / 2 + 0.5 * star.density * square(speed) + star.pressure) * speed * end;
  EXPECT_TRUE(evidence::near("F28", name, variant, "(work and energy of the gas behind) / exact",
                             gained.through[0][4] / work, 1, 1e-4));
  EXPECT_TRUE(evidence::at_most("F28", name, variant, "mass defect",
                                std::abs(after.mass - before.mass - gained.gained[0]), 1e-14));
  EXPECT_TRUE(evidence::at_most("F28", name, variant, "energy defect / energy",
                                std::abs(after.energy - before.energy - gained.gained[4]) / before.energy, 1e-14));
}

TEST(EnteringWaves, APistonDrivesItsShockOrFanAndItsWorkIsAccountedFor) {
  for (int const order : {1, 5, 11})
    for (Real const speed : {0.008, -0.008}) expect_piston(speed, order);
}

}  // namespace
}  // namespace brisance::fluid
