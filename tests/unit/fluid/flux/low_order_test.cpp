#include "fluid/flux/low_order.hpp"

#include <gtest/gtest.h>

#include <random>

#include "fluid/flux/sweep.hpp"
#include "tests/support/flux_box.hpp"

namespace brisance::fluid {
namespace {

TEST(LowOrderFlux, IsTheAnalyticFluxOfAUniformState) {
  Gas const gas{1.4, 1e-10, 1e-12};
  State const x = gas.conserved(1.3, {0.4, -0.2, 0.7}, 2.1);
  double const v[3] = {0.4, -0.2, 0.7};
  for (int d = 0; d < 3; ++d) {
    State const f = low_order_flux(x, x, d, 0.1, gas);
    for (std::size_t q = 0; q < 5; ++q) {
      double exact = x[q] * v[d];
      if (static_cast<int>(q) == d + 1) exact += 2.1;
      if (q == 4) exact += 2.1 * v[d];
      EXPECT_NEAR(f[q], exact, 1e-15 * 8);
    }
  }
}

TEST(LowOrderFlux, VacuumTakesTheRusanovFlux) {
  Gas const gas{1.4, 1e-10, 1e-12};
  State const x = gas.conserved(1, {0.5, 0, 0}, 1), none{};
  State const f = low_order_flux(x, none, 0, 0.1, gas);
  double const a = 0.5 + gas.sound_speed(x);
  EXPECT_NEAR(f[0], 0.5 * 0.5 + 0.5 * a, 1e-15);
  EXPECT_EQ(low_order_flux(none, none, 1, 0.1, gas), State{});
}

TEST(LowOrderFlux, KeepsRandomNeighboursAdmissible) {
  // theory/fluid.md 4.1: one step of the low-order flux on random triples, Courant number 1 next to any other
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decade(-3, 3), wide(-6, 6), mach(-30, 30);
  for (double gamma : {1.1, 1.4, 5. / 3, 3.0, 4.4}) {
    Gas const gas{gamma, 1e-30, 1e-30, {}};
    for (int trial = 0; trial < 20000; ++trial) {
      State x[3];
      double signal = 0;
      for (State& s : x) {
        double const rho = std::pow(10, decade(random)), p = std::pow(10, wide(random)), c = std::sqrt(gamma * p / rho);
        s = gas.conserved(rho, {c * mach(random), 0, 0}, p);
        signal = std::max(signal, std::abs(s[1] / s[0]) + c);
      }
      double const sigma = 1 / signal;
      State const low = low_order_flux(x[0], x[1], 0, sigma, gas), high = low_order_flux(x[1], x[2], 0, sigma, gas);
      State y = x[1];
      for (std::size_t q = 0; q < 5; ++q) y[q] -= sigma * (high[q] - low[q]);
      ASSERT_GT(y[0], 0);
      ASSERT_GE(gas.internal_energy(y), -1e-13 * y[4]);
    }
  }
}

TEST(LowOrderFlux, IsTheOrderOneFluxWhereAllWavesRunOneWay) {
  Gas const gas{1.4, 1e-10, 1e-12};
  testing::FluxBox box({8, 8, 1}, 3);
  State const left = gas.conserved(1, {3, 0.1, 0}, 1), right = gas.conserved(0.5, {3.2, 0, 0}, 0.7);
  for (Index j = 0; j < 8; ++j)
    for (Index i = -3; i < 11; ++i) box.set(i, j, 0, i < 0 ? left : right);
  SweepReport const report = sweep_box(1, box.view(), 0, 0.1, gas);
  State const one = low_order_flux(left, right, 0, 0.1, gas);
  for (std::size_t q = 0; q < 5; ++q) EXPECT_NEAR(report.flux_low[q], 8 * one[q], 1e-13);
}

}  // namespace
}  // namespace brisance::fluid
