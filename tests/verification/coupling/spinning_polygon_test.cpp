// V4: a regular 400-gon spins in gas at rest: only its own corners may stir the gas (theory/coupling.md sections 1.5,
// 7).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

TEST(SpinningPolygon, LeavesTheGasAtRest) {
  std::string const state = gas_state(1.4, 1, {});
  for (int const order : evidence::full() ? std::vector{1, 5, 11} : std::vector{11}) {
    CoupledCase c(
        "end_time = \"9 s\"\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = [\"1 m\", \"1 m\"]\ncells = [80, 80]\n"
        "ambient = " +
        state + "\neuler = { order = " + std::to_string(order) + ", cfl = 0.5 }\n" + inflow_everywhere(state) +
        "[solid]\n" + rigid_material(7) +
        polygon_body(regular_polygon(400, 0.2, {0.5, 0.5, 0}, 0), "spin = [\"0 rad/s\", \"0 rad/s\", \"2 rad/s\"]\n") +
        "[coupling]\ncut_cells = {}\n");
    Real largest = 0;
    c.run(100, [&] { largest = max(largest, deviation(c, 1.4, {}, 1)); });
    ASSERT_EQ(c.step(), 100);
    EXPECT_TRUE(evidence::at_most("V4", "spinning 400-gon", "order " + std::to_string(order),
                                  "largest change of the gas", largest, 3e-3));
  }
}

}  // namespace
}  // namespace brisance
