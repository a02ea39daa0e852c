// The stability matrix of theory/fluid.md 8.3 and 8.4, and cases that are in no table: orders 1, 5, 11 at CFL 0.3 and
// 0.9. Every cell admissible after every pair of steps, mass, momentum and energy kept to 1e-12, retries counted.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "tests/support/evidence.hpp"
#include "tests/support/hard_cases.hpp"

namespace brisance::testing {
namespace {

constexpr double allowed_defect = 1e-12;

void expect_endurance(HardCase const& c, int order, Real cfl) {
  HardRun run(c, order);
  run.run(cfl);
  char text[64];
  std::snprintf(text, sizeof text, " order %d CFL %.1f", order, cfl);
  bool const ok = run.failure.empty() && run.health == 0 && run.conservation <= allowed_defect;
  EXPECT_TRUE(evidence::endured(
      c.id, c.name + text, ok,
      {run.density_min, run.pressure_min, run.conservation, run.clock.fallback_faces, run.clock.retry.rejected()}))
      << c.id << " " << c.name << text << ": " << run.failure << " health " << run.health << " conservation "
      << run.conservation;
}

/// A case that may depend on order and CFL.
using Maker = std::function<HardCase(int order, Real cfl)>;

void expect_endurance(Maker const& make) {
  for (int const order : {1, 5, 11})
    for (Real const cfl : {0.3, 0.9}) expect_endurance(make(order, cfl), order, cfl);
}
void expect_endurance(HardCase const& c) {
  expect_endurance([&](int, Real) { return c; });
}

/// Cells along a side: fewer in the short run.
int cells(int few, int many) { return evidence::full() ? many : few; }

class Tubes : public ::testing::TestWithParam<Shock> {};
TEST_P(Tubes, Endure) { expect_endurance(tube_case(GetParam(), 200)); }
INSTANTIATE_TEST_SUITE_P(Table, Tubes, ::testing::ValuesIn(shocks()));
INSTANTIATE_TEST_SUITE_P(Hard, Tubes, ::testing::ValuesIn(hard_shocks()));

TEST(Stability1D, ShuOsher) { expect_endurance(shu_osher_case(200)); }
TEST(Stability1D, BlastWaves) { expect_endurance(blast_waves_case(200)); }
TEST(Stability1D, RandomCells) {
  for (unsigned seed = 1; seed <= 4; ++seed) expect_endurance(random_box(1, 200, seed, 1000));
}

TEST(Stability2D, Sedov) { expect_endurance(sedov(2, cells(30, 60))); }
TEST(Stability2D, Noh) {
  expect_endurance([](int order, Real) { return noh(2, cells(30, 100), order); });
}
TEST(Stability2D, DoubleMach) {
  expect_endurance([](int order, Real) { return double_mach(cells(20, 60), order); });
}
TEST(Stability2D, Jet) {
  expect_endurance([](int order, Real cfl) { return jet(2, cells(40, 100), order, cfl); });
}
TEST(Stability2D, Vacuum) { expect_endurance(vacuum_ball(2, cells(40, 100))); }
TEST(Stability2D, OddEven) { expect_endurance(odd_even(cells(10, 20))); }
TEST(Stability2D, Implosion) { expect_endurance(implosion(cells(30, 100))); }
TEST(Stability2D, Collision) { expect_endurance(collision(2, cells(40, 100))); }
TEST(Stability2D, HotBall) { expect_endurance(hot_ball(2, cells(40, 100), 1e10)); }
TEST(Stability2D, RandomCells) {
  for (unsigned seed = 1; seed <= 2; ++seed) expect_endurance(random_box(2, cells(24, 40), seed, 400));
}

TEST(Stability3D, Sedov) { expect_endurance(sedov(3, cells(16, 40))); }
TEST(Stability3D, Noh) {
  expect_endurance([](int order, Real) { return noh(3, cells(16, 40), order); });
}
TEST(Stability3D, Jet) {
  expect_endurance([](int order, Real cfl) { return jet(3, cells(20, 40), order, cfl); });
}
TEST(Stability3D, Vacuum) { expect_endurance(vacuum_ball(3, cells(20, 48))); }
TEST(Stability3D, Collision) { expect_endurance(collision(3, cells(20, 40))); }
TEST(Stability3D, HotBall) { expect_endurance(hot_ball(3, cells(20, 40), 1e10)); }
TEST(Stability3D, RandomCells) {
  for (unsigned seed = 1; seed <= 2; ++seed) expect_endurance(random_box(3, cells(12, 20), seed, 200));
}

}  // namespace
}  // namespace brisance::testing
