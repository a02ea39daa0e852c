// The stability matrix of theory/fluid.md 8.3 and 8.4, and cases that are in no table: orders 1, 5, 11 at CFL 0.3 and
// 0.9, with the program's defaults and, in 1D, with the terms of smooth flow; in the full suite also as the theory's
// tables were made, without the switch at pressure jumps. Every cell admissible after every pair of steps, mass,
// momentum and energy kept to 1e-12.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "tests/support/evidence.hpp"
#include "tests/support/hard_cases.hpp"
#include "tests/support/hostile_cases.hpp"

namespace brisance::testing {
namespace {

constexpr double allowed_defect = 1e-12;

void expect_endurance(HardCase const& c, int order, Real cfl) {
  HardRun run(c, order);
  run.run(cfl);
  char setting[64];
  std::snprintf(setting, sizeof setting, ", order %d, CFL %.1f%s%s", order, cfl,
                c.config.euler->hybrid ? "" : ", semi-local", c.config.euler->smooth ? ", smooth" : "");
  bool const ok = run.failure.empty() && run.health == 0 && run.conservation <= allowed_defect;
  EXPECT_TRUE(evidence::endured(
      c.id, c.name + setting, ok,
      {run.density_min, run.pressure_min, run.conservation, run.clock.fallback_faces, run.clock.retry.rejected()}))
      << c.id << " " << c.name << setting << ": " << run.failure << " health " << run.health << ", conservation "
      << run.conservation;
}

/// A case that may depend on order and CFL.
using Maker = std::function<HardCase(int order, Real cfl)>;

void expect_endurance(Maker const& make) {
  for (int const order : {1, 5, 11})
    for (Real const cfl : {0.3, 0.9}) {
      HardCase c = make(order, cfl);
      expect_endurance(c, order, cfl);
      if (order > 1 && c.config.gas.law != "jwl" && (evidence::full() || dimension(c.config) == 1)) {
        c.config.euler->smooth = true;
        expect_endurance(c, order, cfl);
        c.config.euler->smooth = false;
      }
      c.config.euler->hybrid = false;
      if (evidence::full() && order > 1) expect_endurance(c, order, cfl);
    }
}
void expect_endurance(HardCase const& c) {
  expect_endurance([&](int, Real) { return c; });
}

/// Cells along a side: fewer in the short run.
int cells(int few, int many) { return evidence::full() ? many : few; }

TEST(Stability, TubesOfTheTable) {
  for (auto const* const list : {&shocks(), &hard_shocks()})
    for (Shock const& s : *list) expect_endurance(tube_case(s, 200));
  expect_endurance(shu_osher_case(200));
  expect_endurance(blast_waves_case(200));
}

TEST(Stability, TwoDimensions) {
  expect_endurance(sedov(2, cells(30, 50)));
  expect_endurance([](int order, Real) { return noh(2, cells(30, 60), order); });
  expect_endurance([](int order, Real) { return double_mach(cells(20, 40), order); });
  expect_endurance([](int order, Real cfl) { return jet(2, cells(40, 60), order, cfl); });
  expect_endurance(vacuum_ball(2, cells(40, 80)));
  expect_endurance(odd_even(2, cells(10, 20)));
  expect_endurance(implosion(cells(30, 60)));
}

TEST(Stability, ThreeDimensions) {
  expect_endurance(sedov(3, cells(14, 20)));
  expect_endurance([](int order, Real) { return noh(3, cells(14, 20), order); });
  expect_endurance([](int order, Real cfl) { return jet(3, cells(16, 20), order, cfl); });
  expect_endurance(vacuum_ball(3, cells(20, 30)));
}

class Hostile : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Hostile, ::testing::Values(1, 2, 3));

TEST_P(Hostile, CasesInNoTable) {
  int const dimension = GetParam(), n[] = {cells(100, 150), cells(24, 32), cells(12, 16)};
  for (HardCase const& c : hostile_cases(dimension, n[dimension - 1])) expect_endurance(c);
}

TEST_P(Hostile, RandomCells) {
  int const dimension = GetParam(), n[] = {200, cells(24, 32), cells(12, 16)}, steps[] = {1000, 400, 200};
  for (fluid::Gas const& gas : {ideal_gas(1.4), ideal_gas(1.05), water_gas(), tnt_products()})
    for (unsigned seed = 1; seed <= (evidence::full() ? 3u : 1u); ++seed)
      expect_endurance(random_box(dimension, n[dimension - 1], seed, steps[dimension - 1], gas));
}

}  // namespace
}  // namespace brisance::testing
