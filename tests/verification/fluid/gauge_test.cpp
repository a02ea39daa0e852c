// Gauges in flows with exact solutions: the shock of a tube, and a small wave that passes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "core/model/simulation.hpp"
#include "fluid/euler.hpp"
#include "fluid/gauges/gauges.hpp"
#include "fluid/initial_state.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/riemann.hpp"

namespace brisance::fluid {
namespace {

struct Row {
  double time, overpressure, impulse;
};
struct Record {
  std::vector<Row> rows;
  GaugeFigures figures;
};

/// Runs the flow from `state` (of the centre of a cell) to `end_time` with one gauge.
Record record(FlowConfig const& config, GaugeConfig gauge, Real end_time, std::function<State(Real)> const& state) {
  auto const comm = parallel::serial();
  auto const flow = testing::make_flow(config, *comm);
  Grid const& grid = flow->grid();
  fill(*flow, [&](CellIndex c) { return state(grid.centre(c).x); });
  Euler euler(*config.euler, *flow);
  gauge.name = "gauge";
  gauge.quantities = {"overpressure", "impulse"};
  Gauges gauges({gauge}, config, *flow, {});
  Plan plan;
  euler.join(plan);
  gauges.join(plan);
  Simulation simulation(plan, *comm, {end_time, 1, 0});
  simulation.audit();
  std::string const directory = ::testing::TempDir() + "brisance_gauge." + std::to_string(getpid());
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  gauges.open(directory, simulation.clock());
  while (!simulation.finished()) {
    simulation.pair();
    gauges.accept(simulation.clock());
  }
  gauges.flush();
  Record result{{}, gauges.figures(0)};
  std::ifstream file(directory + "/gauges/gauge.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    for (char& c : line)
      if (c == ',') c = ' ';
    Row row{};
    std::istringstream(line) >> row.time >> row.overpressure >> row.impulse;
    result.rows.push_back(row);
  }
  std::filesystem::remove_all(directory);
  return result;
}

TEST(Gauge, ShockOfSodArrivesWhenItShouldAndStaysOnItsPlateau) {
  int const n = 400;
  FlowConfig config = testing::unit_box(1, n);
  config.ambient = {0.125, 0.1, {}};
  testing::set_boundaries(config, "outflow");
  testing::RiemannProblem const exact({1, 0, 1}, {.125, 0, .1}, 1.4);
  Real const plateau = exact.star_pressure() - 0.1;
  Real const speed = std::sqrt(1.4 * 0.1 / 0.125 * (1 + 2.4 / 2.8 * (exact.star_pressure() / 0.1 - 1)));
  GaugeConfig gauge;
  gauge.position = {0.8, 0, 0};
  gauge.interval = 0.001;
  gauge.arrival_pressure = 0.5 * plateau;  // the middle of the front
  Record const got = record(config, gauge, 0.2, [&](Real x) {
    Gas const gas;
    return x < 0.5 ? gas.conserved(1, {}, 1) : gas.conserved(0.125, {}, 0.1);
  });
  ASSERT_EQ(got.rows.size(), 201u);
  Real const arrival = 0.3 / speed, crossing = 1. / n / speed;
  EXPECT_TRUE(evidence::near("F18a", "Sod", "gauge, order 5, N 400", "arrival of the shock at x = 0.8",
                             got.figures.arrival, arrival, 0.5 * crossing));
  EXPECT_TRUE(evidence::near("F18a", "Sod", "gauge, order 5, N 400", "peak overpressure", got.figures.peak, plateau,
                             5e-3 * plateau));
  EXPECT_TRUE(evidence::near("F18a", "Sod", "gauge, order 5, N 400", "overpressure at t = 0.2",
                             got.rows.back().overpressure, plateau, 1e-3 * plateau));
  EXPECT_TRUE(evidence::near("F18a", "Sod", "gauge, order 5, N 400", "impulse at t = 0.2", got.rows.back().impulse,
                             plateau * (0.2 - arrival), plateau * 0.5 * crossing));
  for (Row const& row : got.rows)
    if (row.time < arrival - 4 * crossing) {
      ASSERT_LT(std::abs(row.overpressure), 1e-3 * plateau) << row.time;
    }
}

/// A pulse of sin^2 form that runs to the right through gas at rest, so small that it keeps its form.
TEST(Gauge, OfASmallWaveIsSecondOrderBetweenCellsAndSteps) {
  Real const size = 1e-7, length = 0.4, sound = std::sqrt(1.4);
  auto const form = [&](Real s) { return s > 0 && s < length ? square(std::sin(std::numbers::pi * s / length)) : 0; };
  Real error[2] = {}, impulse[2] = {};
  for (int refined = 0; refined < 2; ++refined) {
    FlowConfig config = testing::unit_box(1, 50 << refined);
    config.euler->order = 7;
    testing::set_boundaries(config, "outflow");
    GaugeConfig gauge;
    gauge.position = {0.613, 0, 0};
    gauge.interval = 0.0037;
    gauge.arrival_pressure = 0.01 * size;
    Record const got = record(config, gauge, 0.5, [&](Real x) {
      Real const p = size * form(x - 0.1);
      return Gas{}.conserved(1 + p / 1.4, {p / sound, 0, 0}, 1 + p);
    });
    for (Row const& row : got.rows)
      error[refined] = max(error[refined], std::abs(row.overpressure / size - form(0.613 - sound * row.time - 0.1)));
    impulse[refined] = std::abs(got.figures.phase_impulse / (0.5 * size * length / sound) - 1);
  }
  EXPECT_TRUE(
      evidence::at_most("gauges", "small wave", "gauge, order 7, N 50", "largest error of a row", error[0], 0.02));
  EXPECT_TRUE(
      evidence::at_most("gauges", "small wave", "gauge, order 7, N 100", "largest error of a row", error[1], 0.005));
  EXPECT_TRUE(evidence::near("gauges", "small wave", "gauge, order 7", "observed order", std::log2(error[0] / error[1]),
                             2, 0.3));
  EXPECT_TRUE(evidence::at_most("gauges", "small wave", "gauge, order 7, N 100", "relative error of the impulse",
                                impulse[1], 1e-4));
}

}  // namespace
}  // namespace brisance::fluid
