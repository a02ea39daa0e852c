// S20 and S21 of theory/solid.md section 19: no trend of energy and no loss of angular momentum over many steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

constexpr Real pi = std::numbers::pi;

/// What a long run shows.  Energies relative to that at the start.
struct Trace {
  Real largest = 0;           ///< largest |H/H0 - 1|
  std::vector<Real> windows;  ///< means of H/H0 - 1 over tenths of the run
  Real angular = 0;           ///< largest |L - L0| / |L0|
};

/// `stride`: steps between two looks at the energy.
Trace follow(testing::Lone& body, Real dt, long steps, long stride) {
  constexpr long windows = 10;
  auto const start = body.measure();
  Real const energy = body.energy();
  Vec3 const spin = start.vector(Measures::angular);
  Trace trace;
  for (long w = 0; w < windows; ++w) {
    Real sum = 0;
    long looks = 0;
    for (long n = 0; n < steps / windows; ++n) {
      body.solid.step(dt);
      if (n % stride != stride - 1) continue;
      Real const defect = body.energy() / energy - 1;
      trace.largest = max(trace.largest, std::abs(defect));
      sum += defect;
      ++looks;
    }
    trace.windows.push_back(sum / static_cast<Real>(looks));
    trace.angular = max(trace.angular, norm(body.measure().vector(Measures::angular) - spin) / norm(spin));
  }
  return trace;
}

/// Largest less smallest of the last `count` window means.
Real spread(Trace const& trace, std::ptrdiff_t count) {
  auto const [low, high] = std::minmax_element(trace.windows.end() - count, trace.windows.end());
  return *high - *low;
}

/// The spinning, bending and twisting bar of theory section 10.
std::unique_ptr<testing::Lone> bar() {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({-3, -1, -1}, {3, 1, 1}, {6, 2, 2}));
  auto made = std::make_unique<testing::Lone>(config);
  testing::Lone& body = *made;
  Vec3 const omega{0.02, 0.01, 0.06};
  Vec3 mean{};
  for (std::size_t p = 0; p < body.solid.motion().size(); ++p) {
    Vec3 const x = body.solid.pose()[p].x;
    Real const zeta = x.x / 3;
    Motion& m = body.solid.motion()[p];
    m.v = cross(omega, x) + Vec3{0, 0.05 * (zeta * zeta - 0.35), 0} + cross(Vec3{0.05 * zeta, 0, 0}, Vec3{0, x.y, x.z});
    m.spin = (1.0 / 6) * (omega + Vec3{0.05 * zeta, 0, 0.1 * zeta});
    mean += (1.0 / 24) * m.v;
  }
  for (Motion& m : body.solid.motion()) m.v = m.v - mean;
  return made;
}

TEST(Energy, OfASpinningBarOscillatesWithoutTrend) {
  long const steps = 1000000;
  std::string const variant = std::to_string(steps) + " steps of 0.15";
  auto const body = bar(), finer = bar();
  Trace const trace = follow(*body, 0.15, steps, 5);
  EXPECT_TRUE(
      evidence::at_most("S20", "spinning flexing bar", variant, "largest defect of energy", trace.largest, 9e-4));
  EXPECT_TRUE(evidence::at_most("S20", "spinning flexing bar", variant, "spread of the last 5 window means",
                                spread(trace, 5), 3e-5));
  EXPECT_TRUE(
      evidence::at_most("S20", "spinning flexing bar", variant, "defect of angular momentum", trace.angular, 1e-12));
  Real const ratio = trace.largest / follow(*finer, 0.075, steps / 2, 5).largest;
  EXPECT_TRUE(evidence::near("S20", "spinning flexing bar", variant, "largest defect over that at half the step", ratio,
                             4, 0.6));
}

TEST(Energy, OfATumblingBrickHasNoTrend) {
  long const steps = 1000000;
  SolidConfig config = testing::one_material(1, 1e4, 0.3);
  config.body.push_back(testing::box({-0.5, -0.75, -1}, {0.5, 0.75, 1}, {2, 3, 4}));
  testing::Lone body(config);
  Vec3 const omega{0.3, 1, 0.2};
  for (std::size_t p = 0; p < body.solid.motion().size(); ++p) {
    Vec3 const x = body.solid.pose()[p].x;
    Motion& m = body.solid.motion()[p];
    m.v = cross(omega, x) + 0.01 * Vec3{std::sin(pi * x.x), std::sin(pi * x.y / 1.5), std::sin(pi * x.z / 2)};
    m.spin = body.mesh.inertia(body.solid.id(static_cast<Index>(p))) * omega;
  }
  Trace const trace = follow(body, 0.5 * body.solid.link_limit().dt, steps, 5);
  std::string const variant = std::to_string(steps) + " steps";
  EXPECT_TRUE(
      evidence::at_most("S21", "tumbling brick", variant, "spread of the window means", spread(trace, 10), 1e-9));
  EXPECT_TRUE(evidence::at_most("S21", "tumbling brick", variant, "defect of angular momentum", trace.angular, 1e-12));
}

}  // namespace
}  // namespace brisance::solid
