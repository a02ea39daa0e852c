// Riemann problems of theory/fluid.md 8.2 at all orders: L1 error of the cell means of density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/shocks.hpp"
#include "tests/support/tables.hpp"
#include "tests/support/tube.hpp"

namespace brisance::testing {
namespace {

std::vector<double> exact_means(Tube const& tube, Shock const& s) {
  RiemannProblem const exact(s.left, s.right, s.gas);
  std::vector<double> means;
  for (int i = 0; i < tube.size(); ++i)
    means.push_back(exact.mean_density(tube.edge(i) - s.x0, tube.edge(i + 1) - s.x0, s.end_time));
  return means;
}

double density_error(Tube const& tube, std::vector<double> const& exact) {
  double error = 0;
  for (int i = 0; i < tube.size(); ++i)
    error += tube.h() * std::abs(tube.cell(i)[0] - exact[static_cast<std::size_t>(i)]);
  return error;
}

Tube make_tube(Shock const& s, int n) {
  Tube tube(n, 0, s.length, s.gas, Ends::outflow, std::max(s.left.density, s.right.density),
            std::max(s.left.pressure, s.right.pressure));
  tube.fill(s.left, s.right, s.x0);
  return tube;
}

class RiemannTable : public ::testing::TestWithParam<Shock> {};

TEST_P(RiemannTable, DensityIsAsGoodAsTheTable) {
  Shock const& s = GetParam();
  std::vector<double> const exact = exact_means(make_tube(s, 200), s);
  for (int o = 0; o < 6; ++o)
    for (bool const hybrid : {false, true}) {
      Tube tube = make_tube(s, 200);
      tube.options.hybrid = hybrid;
      tube.run(orders[o], s.end_time);
      EXPECT_EQ(tube.health, 0u);
      EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(orders[o]) + (hybrid ? " hybrid" : ""), "L1 density N=200",
                                    density_error(tube, exact), allowance * s.table[o]));
    }
}
INSTANTIATE_TEST_SUITE_P(Tubes, RiemannTable, ::testing::ValuesIn(shocks()));

/// The terms of smooth flow lose nothing at shocks; no scene has them with JWL.
class SmoothTubes : public ::testing::TestWithParam<Shock> {};

TEST_P(SmoothTubes, DensityIsAsGoodAsTheTable) {
  Shock const& s = GetParam();
  std::vector<double> const exact = exact_means(make_tube(s, 200), s);
  for (int o = 1; o < 6; ++o) {
    Tube tube = make_tube(s, 200);
    tube.options = {true, 0, true};
    tube.run(orders[o], s.end_time);
    EXPECT_EQ(tube.health, 0u);
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(orders[o]) + " hybrid smooth", "L1 density N=200",
                                  density_error(tube, exact), allowance * s.table[o]));
  }
}
std::vector<Shock> shocks_without_jwl() {
  std::vector<Shock> list = shocks();
  std::erase_if(list, [](Shock const& s) { return s.gas.curve.exponential(); });
  return list;
}
INSTANTIATE_TEST_SUITE_P(Tubes, SmoothTubes, ::testing::ValuesIn(shocks_without_jwl()));

/// The switch at pressure jumps where the theory gives its figures (2.4).
TEST(HybridTubes, DensityIsAsGoodAsTheTable) {
  struct Measured {
    char const* id;
    int order;
    double error;
  };
  for (Measured const& m : {Measured{"F18a", 5, 1.50e-3},
                            {"F18a", 11, 1.16e-3},
                            {"F6", 5, 1.23e-3},
                            {"F9", 11, 9.12e-2},
                            {"F11", 5, 2.04e-2},
                            {"F11", 11, 1.90e-2},
                            {"F18c", 5, .149},
                            {"F18c", 11, .135}}) {
    auto const s =
        std::find_if(shocks().begin(), shocks().end(), [&](Shock const& x) { return m.id == std::string(x.id); });
    ASSERT_NE(s, shocks().end());
    Tube tube = make_tube(*s, 200);
    tube.options.hybrid = true;
    tube.run(m.order, s->end_time);
    EXPECT_EQ(tube.health, 0u);
    EXPECT_TRUE(evidence::at_most(s->id, s->name, variant(m.order) + " hybrid",
                                  "L1 density N=200, against the theory's switch",
                                  density_error(tube, exact_means(tube, *s)), allowance * m.error));
  }
}

TEST(Contact, AtRestIsExact) {
  Shock const s{"F13a", "contact at rest", {1.4, 0, 1}, {1, 0, 1}, .5, 2, ideal_gas(1.4), 1, {}};
  std::vector<double> const exact = exact_means(make_tube(s, 200), s);
  for (int order : orders) {
    Tube tube = make_tube(s, 200);
    tube.run(order, s.end_time);
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(order), "L1 density N=200", density_error(tube, exact), 1e-14));
  }
}

}  // namespace
}  // namespace brisance::testing
