#include "fluid/gauges/gauge_history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "parallel/error.hpp"
#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

FlowConfig air() {
  FlowConfig config = testing::unit_box(2, 10);
  config.ambient = {1.2, 100, {}};
  return config;
}

GaugeConfig gauge() {
  GaugeConfig g;
  g.name = "g";
  g.position = {0.5, 0.5, 0};
  g.interval = 0.25;
  g.quantities = {"overpressure", "impulse"};
  return g;
}

GaugeHistory history(GaugeConfig const& g = gauge()) { return {g, air(), 2}; }
GaugeValue over(Real o) { return {1.2, 100 + o, {}, 1}; }

std::vector<std::vector<double>> numbers(std::string const& rows) {
  std::vector<std::vector<double>> all;
  std::istringstream lines(rows);
  for (std::string line, cell; std::getline(lines, line);) {
    all.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      all.back().push_back(cell.empty() ? std::nan("") : std::stod(cell));
  }
  return all;
}

/// A triangle: 0 until t = 1, 10 at t = 2, -5 at t = 5, 0 at t = 6.
Real triangle(Real t) { return t < 1 ? 0 : t < 2 ? 10 * (t - 1) : t < 5 ? 10 - 5 * (t - 2) : t < 6 ? 5 * (t - 6) : 0; }

TEST(GaugeHistory, OfATriangleIsExactWhateverTheSteps) {
  for (Real const dt : {0.1, 0.25, 1.0}) {
    GaugeHistory h = history();
    std::string rows;
    h.start(0, over(0), rows);
    for (int n = 1; n * dt < 7 + 1e-9; ++n) h.add(n * dt, over(triangle(n * dt)), rows);
    auto const table = numbers(rows);
    ASSERT_EQ(table.size(), 29u) << dt;
    for (std::size_t k = 0; k < table.size(); ++k) {
      EXPECT_DOUBLE_EQ(table[k][0], 0.25 * static_cast<double>(k));
      EXPECT_NEAR(table[k][1], triangle(table[k][0]), 1e-8) << dt << " " << table[k][0];
    }
    // 5 up, 10 down to 0 at t = 4; 5/2 and 5/2 below.
    EXPECT_NEAR(table[16][2], 15, 1e-8);
    EXPECT_NEAR(table.back()[2], 10, 1e-8);
    EXPECT_NEAR(table.back()[3], 15, 1e-8);
    GaugeFigures const& f = h.figures();
    EXPECT_NEAR(f.arrival, 1.1, 1e-12);  // 1 % of the ambient pressure is 1
    EXPECT_NEAR(f.peak, 10, 1e-12);
    EXPECT_NEAR(f.peak_time, 2, 1e-12);
    EXPECT_NEAR(f.lowest, -5, 1e-12);
    EXPECT_NEAR(f.phase_end - f.phase_start, 2.9, 1e-12);
    EXPECT_NEAR(f.phase_impulse, 15, 1e-12);
    EXPECT_NEAR(f.impulse, 10, 1e-12);
  }
}

TEST(GaugeHistory, ARarefactionArrivesAndHasNoPositivePhase) {
  GaugeHistory h = history();
  std::string rows;
  h.start(0, over(0), rows);
  h.add(1, over(-4), rows);
  h.add(2, over(0.5), rows);
  EXPECT_NEAR(h.figures().arrival, 0.25, 1e-15);
  EXPECT_TRUE(std::isnan(h.figures().phase_start));
  EXPECT_NEAR(h.figures().peak, 0.5, 1e-12);
}

TEST(GaugeHistory, SamplesTheStepThatEndsOnTheTimeUpToRounding) {
  GaugeHistory h = history();
  std::string rows;
  h.start(0, over(0), rows);
  h.add(0.25 * (1 - 1e-15), over(7), rows);
  ASSERT_EQ(numbers(rows).size(), 2u);
  EXPECT_EQ(numbers(rows)[1][1], 7);
}

TEST(GaugeHistory, CoveredByABodyIsEmptyAndAddsNothing) {
  GaugeHistory h = history();
  std::string rows;
  h.start(0, over(2), rows);
  h.add(0.25, over(2), rows);
  h.add(0.5, {0, 0, {}, 0}, rows);
  h.add(0.75, over(4), rows);
  h.add(1.0, over(4), rows);
  auto const table = numbers(rows);
  ASSERT_EQ(table.size(), 5u);
  EXPECT_EQ(table[1][1], 2);
  EXPECT_TRUE(std::isnan(table[2][1]));
  EXPECT_EQ(table[4][1], 4);
  EXPECT_NEAR(table[2][2], 0.5, 1e-9);
  EXPECT_NEAR(table[4][2], 1.5, 1e-9);
  EXPECT_EQ(h.figures().peak, 4);
}

TEST(GaugeHistory, GoesOnFromWhatItStored) {
  std::string whole, parts;
  GaugeHistory one = history(), first = history(), second = history();
  auto const pressure = [](int n) { return over(triangle(0.13 * n) + 0.01 * n); };
  one.start(0, pressure(0), whole);
  first.start(0, pressure(0), parts);
  for (int n = 1; n < 50; ++n) {
    one.add(0.13 * n, pressure(n), whole);
    if (n < 23) first.add(0.13 * n, pressure(n), parts);
    if (n == 23) {
      EXPECT_TRUE(second.restore(first.store()));
    }
    if (n >= 23) second.add(0.13 * n, pressure(n), parts);
  }
  EXPECT_EQ(parts, whole);
  EXPECT_EQ(second.store(), one.store());
  GaugeConfig moved = gauge();
  moved.position.x = 0.6;
  GaugeHistory other = history(moved);
  EXPECT_FALSE(other.restore(first.store()));
  EXPECT_FALSE(other.started());
}

TEST(GaugeHistory, KeepsTheCompleteRowsBeforeItsState) {
  GaugeHistory h = history();
  std::string rows;
  h.start(0, over(0), rows);
  h.add(0.6, over(1), rows);
  std::string const file = h.header() + rows;
  EXPECT_EQ(h.kept_rows(file), rows);
  EXPECT_EQ(h.kept_rows(file + "0.75,1,1,1\n1,2,2,2\n"), rows);
  EXPECT_EQ(h.kept_rows(file + "0.5,"), rows);
  EXPECT_EQ(h.kept_rows("time,density\n" + rows), "");
  EXPECT_EQ(h.kept_rows(""), "");
}

TEST(GaugeHistory, BegunLateStartsAtTheNextMultiple) {
  GaugeHistory h = history();
  std::string rows;
  h.start(0.6, over(0), rows);
  EXPECT_EQ(rows, "");
  h.add(0.8, over(1), rows);
  EXPECT_EQ(numbers(rows).at(0).at(0), 0.75);
}

std::string complaint(GaugeConfig const& a, FlowConfig const& flow, GaugeConfig const& b) {
  try {
    check({a, b}, flow, make_grid(flow), 1);
  } catch (Error const& e) {
    return e.what();
  }
  return "";
}

TEST(GaugeConfig, FaultsAreNamed) {
  GaugeConfig other = gauge();
  other.name = "h";
  EXPECT_EQ(complaint(gauge(), air(), other), "");
  auto const expect = [&](char const* what, auto const& change, FlowConfig flow = air()) {
    GaugeConfig g = gauge();
    change(g);
    std::string const said = complaint(g, flow, other);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  expect("\"h\" is there twice", [](GaugeConfig& g) { g.name = "h"; });
  for (std::string const name : {"", "a/b", ".hidden", "two words"})
    expect("becomes a file", [&](GaugeConfig& g) { g.name = name; });
  expect("stands at y = 1.1 m, outside the grid", [](GaugeConfig& g) { g.position.y = 1.1; });
  expect("stands at z = 0.5 m, outside the grid", [](GaugeConfig& g) { g.position.z = 0.5; });
  expect("1e+12 rows", [](GaugeConfig& g) { g.interval = 1e-12; });
  FlowConfig water = air();
  water.gas.law = "stiffened";
  expect(
      "only an ideal gas", [](GaugeConfig& g) { g.quantities = {"temperature"}; }, water);
  FlowConfig empty = air();
  empty.ambient.pressure = 0;
  expect(
      "give arrival_pressure", [](GaugeConfig&) {}, empty);
}

}  // namespace
}  // namespace brisance::fluid
