// The time couplings lag, semi and explicit on the same cases: accuracy, balance and cost of each (theory/coupling.md
// section 1.8, its table).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

std::string const schemes[] = {"lag", "semi", "explicit"};

std::string coupling(std::string const& scheme, std::string const& cut_cells = "", int sub_steps = 1) {
  return "[coupling]\nscheme = \"" + scheme + "\"\nsub_steps = " + std::to_string(sub_steps) + "\ncut_cells = {" +
         cut_cells + "}\n";
}

/// Runs and prints the time per step, which is no figure to be judged.
void timed_run(CoupledCase& c, std::string const& what, std::int64_t steps = -1,
               std::function<void()> const& each = {}) {
  auto const begin = std::chrono::steady_clock::now();
  c.run(steps, each);
  Real const seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - begin).count();
  std::printf("  %s: %.3g ms a step\n", what.c_str(), 1e3 * seconds / static_cast<Real>(c.step()));
}

void expect_balance(CoupledCase const& c, std::string const& id, std::string const& name, std::string const& variant) {
  Conservation const& k = c.conservation();
  EXPECT_TRUE(evidence::at_most(id, name, variant, "mass defect", k.mass, 1e-12));
  EXPECT_TRUE(evidence::at_most(id, name, variant, "momentum defect",
                                max(k.momentum.x, max(k.momentum.y, k.momentum.z)), 1e-12));
  EXPECT_TRUE(evidence::at_most(id, name, variant, "exchange energy defect", k.exchange_energy, 1e-12));
}

std::string spinning_polygon(std::string const& scheme) {
  std::string const state = gas_state(1.4, 1, {});
  return "end_time = \"9 s\"\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = [\"1 m\", \"1 m\"]\ncells = [80, 80]\n"
         "ambient = " +
         state + "\neuler = { order = 11, cfl = 0.5 }\n" + inflow_everywhere(state) + "[solid]\n" + rigid_material(7) +
         polygon_body(regular_polygon(400, 0.2, {0.5, 0.5, 0}, 0), "spin = [\"0 rad/s\", \"0 rad/s\", \"2 rad/s\"]\n") +
         coupling(scheme);
}

/// V4. The closure of the cut cells is lost by `explicit` alone: loads on the boundary at the start, apertures of the
/// end.
TEST(TimeCoupling, SpinningPolygon) {
  for (std::string const& scheme : schemes) {
    CoupledCase c(spinning_polygon(scheme));
    Real largest = 0;
    timed_run(c, "V4 " + scheme, 100, [&] { largest = max(largest, deviation(c, 1.4, {}, 1)); });
    ASSERT_EQ(c.step(), 100);
    char const* const name = "spinning 400-gon";
    if (scheme == "explicit")
      EXPECT_TRUE(evidence::near("V4", name, scheme, "largest change of the gas", largest, 0.235, 0.03));
    else
      EXPECT_TRUE(evidence::at_most("V4", name, scheme, "largest change of the gas", largest, 3e-3));
    expect_balance(c, "V4", name, scheme);
    EXPECT_TRUE(evidence::at_most("V4", name, scheme, "energy defect", c.conservation().energy, 1e-12));
  }
}

}  // namespace
}  // namespace brisance
