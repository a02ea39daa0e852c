// The exact Riemann solver of the tables: star states of textbook and theory, shocks, fans and vacuum of every gas.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gases.hpp"
#include "tests/support/riemann.hpp"

namespace brisance::testing {
namespace {

TEST(RiemannSolver, HasTheStarStatesOfTheTextbook) {
  RiemannProblem const sod({1, 0, 1}, {.125, 0, .1}, 1.4);  // Toro 1999, table 4.2
  EXPECT_NEAR(sod.star_pressure(), 0.30313, 1e-5);
  EXPECT_NEAR(sod.star_velocity(), 0.92745, 1e-5);
  RiemannProblem const blast({1, 0, 1000}, {1, 0, .01}, 1.4);
  EXPECT_NEAR(blast.star_pressure(), 460.894, 1e-3);
  EXPECT_NEAR(blast.star_velocity(), 19.5975, 1e-4);
  RiemannProblem const thin({1, -2, .4}, {1, 2, .4}, 1.4);
  EXPECT_NEAR(thin.star_pressure(), 0.00189, 1e-5);
}

TEST(RiemannSolver, HasTheStarStatesOfTheTheoryForJwl) {
  RiemannProblem const tnt({1630, 0, 8e9}, {100, 0, 1e7}, tnt_products());
  EXPECT_NEAR(tnt.star_pressure(), 6.002191e8, 1e2);
  EXPECT_NEAR(tnt.star_velocity(), 2187.374, 1e-3);
  EXPECT_NEAR(tnt.left_density(), 660.181, 1e-3);
  EXPECT_NEAR(tnt.right_density(), 528.119, 1e-3);
}

TEST(RiemannSolver, HasTheStarStatesOfTheTheoryForTwoGases) {
  RiemannProblem const blast({1630, 0, 8.3837e9}, {1.1845467, 0, 101325}, tnt_products(), ideal_gas(1.4));
  EXPECT_NEAR(blast.star_pressure(), 2.513177e7, 2e2);  // the start's pressure is given with five digits
  EXPECT_NEAR(blast.star_velocity(), 4186.44, 2e-2);
  EXPECT_NEAR(blast.left_density(), 79.159, 2e-3);
  EXPECT_NEAR(blast.right_density(), 6.9441, 1e-4);
}

/// A stiffened gas is an ideal one in p + p_inf.
TEST(RiemannSolver, ShiftsThePressureOfAStiffenedGas) {
  constexpr double stiffness = 6e8;
  RiemannProblem const water({1000, 0, 1e9}, {1000, 50, 1e5}, water_gas());
  RiemannProblem const ideal({1000, 0, 1e9 + stiffness}, {1000, 50, 1e5 + stiffness}, 4.4);
  EXPECT_NEAR(water.star_pressure() + stiffness, ideal.star_pressure(), 1e-12 * ideal.star_pressure());
  EXPECT_NEAR(water.star_velocity(), ideal.star_velocity(), 1e-10);
  for (double const speed : {-2000., -1500., -900., 0., 500., 1500., 2100., 2500.})
    EXPECT_NEAR(water.at(speed).density, ideal.at(speed).density, 1e-9) << speed;
}

TEST(RiemannSolver, OpensAVacuumWhereTensionFails) {
  double const c = std::sqrt(4.4 * 7e8 / 1000), escape = 2 * c / 3.4;
  RiemannProblem const holds({1000, -0.99 * escape, 1e8}, {1000, 0.99 * escape, 1e8}, water_gas());
  EXPECT_FALSE(holds.vacuum());
  EXPECT_LT(holds.star_pressure(), 0);
  RiemannProblem const parts({1000, -1.5 * escape, 1e8}, {1000, 1.5 * escape, 1e8}, water_gas());
  EXPECT_TRUE(parts.vacuum());
  EXPECT_EQ(parts.at(0).density, 0);
  EXPECT_EQ(parts.at(0.49 * escape).density, 0);
  EXPECT_GT(parts.at(0.51 * escape).density, 0);
}

/// Jumps obey Rankine and Hugoniot, and the velocity along a fan integrates c / rho.
TEST(RiemannSolver, KeepsTheJumpAndFanConditionsOfJwl) {
  fluid::Gas const gas = tnt_products();
  Primitive const left{1630, 0, 8e9}, right{100, 0, 1e7};
  RiemannProblem const p(left, right, gas);
  double const shock = p.breaks().back();
  auto const flux = [&](Primitive const& s) {
    double const v = s.velocity - shock;
    fluid::State const u = gas.conserved(s.density, {v, 0, 0}, s.pressure);
    return fluid::State{u[1], u[1] * v + s.pressure, (u[4] + s.pressure) * v, 0, 0};
  };
  fluid::State const ahead = flux(right), behind = flux({p.right_density(), p.star_velocity(), p.star_pressure()});
  for (std::size_t q = 0; q < 3; ++q) EXPECT_NEAR(behind[q] / ahead[q], 1, 1e-11) << q;

  double const head = p.breaks()[0], tail = p.breaks()[1];
  Primitive before = left;
  for (int i = 1; i <= 1000; ++i) {
    Primitive const s = p.at(head + (tail - head) * i / 1000);
    double const middle = 0.5 * (s.density + before.density);
    double const c2 = (s.pressure - before.pressure) / (s.density - before.density);
    EXPECT_NEAR(s.velocity - before.velocity, (before.density - s.density) * std::sqrt(c2) / middle, 1e-4);
    before = s;
  }
  EXPECT_NEAR(before.density, p.left_density(), 1e-6);
}

}  // namespace
}  // namespace brisance::testing
