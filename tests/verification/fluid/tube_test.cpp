// Riemann problems of theory/fluid.md 8.2 at all orders: L1 error of the cell means of density.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/gases.hpp"
#include "tests/support/tables.hpp"
#include "tests/support/tube.hpp"

namespace brisance::testing {
namespace {

struct Shock {
  char const *id, *name;
  Primitive left, right;
  double x0, end_time;
  fluid::Gas gas;
  double length;
  double table[6];
};
void PrintTo(Shock const& s, std::ostream* out) { *out << s.id; }

Shock const shocks[] = {
    {"F6",
     "Toro 1",
     {1, .75, 1},
     {.125, 0, .1},
     .3,
     .2,
     ideal_gas(1.4),
     1,
     {7.77e-3, 1.92e-3, 1.43e-3, 1.31e-3, 1.24e-3, 1.22e-3}},
    {"F7",
     "123",
     {1, -2, .4},
     {1, 2, .4},
     .5,
     .15,
     ideal_gas(1.4),
     1,
     {1.15e-2, 6.05e-3, 5.66e-3, 5.73e-3, 5.75e-3, 5.77e-3}},
    {"F8",
     "Toro 3",
     {1, 0, 1000},
     {1, 0, .01},
     .5,
     .012,
     ideal_gas(1.4),
     1,
     {.152, 4.74e-2, 3.58e-2, 3.28e-2, 3.11e-2, 3.00e-2}},
    {"F9",
     "Toro 4",
     {5.99924, 19.5975, 460.894},
     {5.99242, -6.19633, 46.0950},
     .4,
     .035,
     ideal_gas(1.4),
     1,
     {.538, .138, .104, 9.20e-2, 8.73e-2, 8.41e-2}},
    {"F10",
     "Toro 5",
     {1, -19.59745, 1000},
     {1, -19.59745, .01},
     .8,
     .012,
     ideal_gas(1.4),
     1,
     {3.37e-2, 2.52e-2, 2.51e-2, 2.53e-2, 2.54e-2, 2.54e-2}},
    {"F11",
     "LeBlanc",
     {1, 0, .2 / 3},
     {1e-3, 0, 2e-10 / 3},
     3,
     6,
     ideal_gas(5. / 3),
     9,
     {7.41e-2, 2.84e-2, 2.60e-2, 2.53e-2, 2.49e-2, 2.48e-2}},
    {"F12a",
     "123 with vacuum",
     {1, -4, .4},
     {1, 4, .4},
     .5,
     .1,
     ideal_gas(1.4),
     1,
     {9.87e-3, 5.92e-3, 5.39e-3, 5.18e-3, 5.33e-3, 5.41e-3}},
    {"F12b",
     "gas into vacuum",
     {1, 0, 1},
     {0, 0, 0},
     .3,
     .12,
     ideal_gas(1.4),
     1,
     {5.84e-3, 1.91e-3, 1.55e-3, 1.49e-3, 1.49e-3, 1.50e-3}},
    {"F13b",
     "slow contact",
     {1.4, .1, 1},
     {1, .1, 1},
     .5,
     2,
     ideal_gas(1.4),
     1,
     {9.71e-3, 2.51e-3, 1.77e-3, 1.52e-3, 1.39e-3, 1.31e-3}},
    {"F14",
     "slow shock",
     {3.86, -.81, 10.3334},
     {1, -3.44, 1},
     .5,
     4,
     ideal_gas(1.4),
     1,
     {5.3e-3, 1.80e-2, 4.09e-2, 4.80e-2, 4.83e-2, 4.85e-2}},
    {"F15",
     "stiffened tube",
     {1000, 0, 1e9},
     {1000, 0, 1e5},
     .5,
     1.6e-4,
     water_gas(),
     1,
     {3.97, 1.02, .765, .678, .639, .618}},
    {"F16",
     "stiffened, tension",
     {1000, -150, 1e8},
     {1000, 150, 1e8},
     .5,
     1e-4,
     water_gas(),
     1,
     {1.72, .600, .496, .464, .449, .440}},
    {"F17a",
     "JWL TNT",
     {1630, 0, 8e9},
     {100, 0, 1e7},
     .5,
     4e-5,
     tnt_products(),
     1,
     {6.93, 2.19, 1.89, 1.77, 1.72, 1.68}},
    {"F17b",
     "JWL TNT into thin products",
     {1000, 0, 2e9},
     {1, 0, 1e5},
     .4,
     6e-5,
     tnt_products(),
     1,
     {4.26, 1.92, 1.70, 1.63, 1.59, 1.58}},
    {"F18a",
     "Sod",
     {1, 0, 1},
     {.125, 0, .1},
     .5,
     .2,
     ideal_gas(1.4),
     1,
     {9.11e-3, 2.18e-3, 1.75e-3, 1.60e-3, 1.53e-3, 1.49e-3}},
    {"F18b",
     "Lax",
     {.445, .698, 3.528},
     {.5, 0, .571},
     .5,
     .14,
     ideal_gas(1.4),
     1,
     {2.54e-2, 5.77e-3, 3.85e-3, 3.26e-3, 2.97e-3, 2.80e-3}},
    {"F18c",
     "air blast",
     {99.9, 0, 50662500},
     {1.1845467, 0, 101325},
     .5,
     3e-4,
     ideal_gas(1.4),
     1,
     {.905, .218, .179, .172, .169, .168}},
    {"F18d",
     "Mach 100 flow-off",
     {1, 0, 1},
     {1, -129.1, 1},
     .5,
     .002,
     ideal_gas(5. / 3),
     1,
     {2.64e-2, 9.99e-3, 9.90e-3, 1.01e-2, 1.04e-2, 1.05e-2}},
    {"F18e",
     "Noh 1D",
     {1, 1, 1e-6},
     {1, -1, 1e-6},
     .5,
     .6,
     ideal_gas(5. / 3),
     1,
     {1.32e-2, 9.89e-3, 9.49e-3, 8.92e-3, 8.55e-3, 8.47e-3}},
};

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
  for (int o = 0; o < 6; ++o) {
    Tube tube = make_tube(s, 200);
    tube.run(orders[o], s.end_time);
    EXPECT_EQ(tube.health, 0u);
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(orders[o]), "L1 density N=200", density_error(tube, exact),
                                  allowance * s.table[o]));
  }
}
INSTANTIATE_TEST_SUITE_P(Tubes, RiemannTable, ::testing::ValuesIn(shocks));

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
