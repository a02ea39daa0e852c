// The simple wave F4 of theory/fluid.md 8.1 up to half its shock time.
#pragma once
#include <cmath>
#include <numbers>

#include "fluid/gas/gas.hpp"
#include "tests/support/quadrature.hpp"

namespace brisance::testing {

/// Characteristics x = xi + (u + c) t carry u = 0.2 sin 2 pi xi, c = 1 + 0.2 u, rho = 1.4 c^5, p = c^7
/// (p + p_inf of a stiffened gas).
struct SimpleWave {
  double t;
  double velocity(double xi) const { return 0.2 * std::sin(2 * std::numbers::pi * xi); }
  double sound(double xi) const { return 1 + 0.2 * velocity(xi); }
  double origin(double x) const {
    double xi = x;
    for (int turn = 0; turn < 50; ++turn) {
      double const slope = 1 + t * 1.2 * 0.4 * std::numbers::pi * std::cos(2 * std::numbers::pi * xi);
      double const step = (xi + (velocity(xi) + sound(xi)) * t - x) / slope;
      xi -= step;
      if (std::abs(step) < 1e-15) break;
    }
    return xi;
  }
  fluid::State at(fluid::Gas const& gas, double x) const {
    double const xi = origin(x), c = sound(xi);
    return gas.conserved(1.4 * std::pow(c, 5), {velocity(xi), 0, 0}, std::pow(c, 7) - gas.curve.stiffness);
  }
  fluid::State mean(fluid::Gas const& gas, double low, double high) const {
    fluid::State u;
    for (std::size_t q = 0; q < 5; ++q)
      u[q] = integral([&](double x) { return at(gas, x)[q]; }, low, high) / (high - low);
    return u;
  }
};

}  // namespace brisance::testing
