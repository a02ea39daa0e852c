// One-dimensional tables of theory/fluid.md 8.1 and 8.2 at all orders: L1 error of the cell means of density.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "fluid/flux/osmp.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/tube.hpp"

namespace brisance::testing {
namespace {

constexpr int orders[] = {1, 3, 5, 7, 9, 11};
/// What a correct program may add to a table value: rounding of the table and of another order of operations.
constexpr double allowance = 1.10;

std::string variant(int order) { return "order " + std::to_string(order); }

struct Shock {
  char const *id, *name;
  Primitive left, right;
  double x0, end_time, gamma, length;
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
     1.4,
     1,
     {7.77e-3, 1.92e-3, 1.43e-3, 1.31e-3, 1.24e-3, 1.22e-3}},
    {"F7", "123", {1, -2, .4}, {1, 2, .4}, .5, .15, 1.4, 1, {1.15e-2, 6.05e-3, 5.66e-3, 5.73e-3, 5.75e-3, 5.77e-3}},
    {"F8", "Toro 3", {1, 0, 1000}, {1, 0, .01}, .5, .012, 1.4, 1, {.152, 4.74e-2, 3.58e-2, 3.28e-2, 3.11e-2, 3.00e-2}},
    {"F9",
     "Toro 4",
     {5.99924, 19.5975, 460.894},
     {5.99242, -6.19633, 46.0950},
     .4,
     .035,
     1.4,
     1,
     {.538, .138, .104, 9.20e-2, 8.73e-2, 8.41e-2}},
    {"F10",
     "Toro 5",
     {1, -19.59745, 1000},
     {1, -19.59745, .01},
     .8,
     .012,
     1.4,
     1,
     {3.37e-2, 2.52e-2, 2.51e-2, 2.53e-2, 2.54e-2, 2.54e-2}},
    {"F11",
     "LeBlanc",
     {1, 0, .2 / 3},
     {1e-3, 0, 2e-10 / 3},
     3,
     6,
     5. / 3,
     9,
     {7.41e-2, 2.84e-2, 2.60e-2, 2.53e-2, 2.49e-2, 2.48e-2}},
    {"F12a",
     "123 with vacuum",
     {1, -4, .4},
     {1, 4, .4},
     .5,
     .1,
     1.4,
     1,
     {9.87e-3, 5.92e-3, 5.39e-3, 5.18e-3, 5.33e-3, 5.41e-3}},
    {"F12b",
     "gas into vacuum",
     {1, 0, 1},
     {0, 0, 0},
     .3,
     .12,
     1.4,
     1,
     {5.84e-3, 1.91e-3, 1.55e-3, 1.49e-3, 1.49e-3, 1.50e-3}},
    {"F13b",
     "slow contact",
     {1.4, .1, 1},
     {1, .1, 1},
     .5,
     2,
     1.4,
     1,
     {9.71e-3, 2.51e-3, 1.77e-3, 1.52e-3, 1.39e-3, 1.31e-3}},
    {"F14",
     "slow shock",
     {3.86, -.81, 10.3334},
     {1, -3.44, 1},
     .5,
     4,
     1.4,
     1,
     {5.3e-3, 1.80e-2, 4.09e-2, 4.80e-2, 4.83e-2, 4.85e-2}},
    {"F18a", "Sod", {1, 0, 1}, {.125, 0, .1}, .5, .2, 1.4, 1, {9.11e-3, 2.18e-3, 1.75e-3, 1.60e-3, 1.53e-3, 1.49e-3}},
    {"F18b",
     "Lax",
     {.445, .698, 3.528},
     {.5, 0, .571},
     .5,
     .14,
     1.4,
     1,
     {2.54e-2, 5.77e-3, 3.85e-3, 3.26e-3, 2.97e-3, 2.80e-3}},
    {"F18c",
     "air blast",
     {99.9, 0, 50662500},
     {1.1845467, 0, 101325},
     .5,
     3e-4,
     1.4,
     1,
     {.905, .218, .179, .172, .169, .168}},
    {"F18d",
     "Mach 100 flow-off",
     {1, 0, 1},
     {1, -129.1, 1},
     .5,
     .002,
     5. / 3,
     1,
     {2.64e-2, 9.99e-3, 9.90e-3, 1.01e-2, 1.04e-2, 1.05e-2}},
    {"F18e",
     "Noh 1D",
     {1, 1, 1e-6},
     {1, -1, 1e-6},
     .5,
     .6,
     5. / 3,
     1,
     {1.32e-2, 9.89e-3, 9.49e-3, 8.92e-3, 8.55e-3, 8.47e-3}},
};

double density_error(Tube const& tube, Shock const& s) {
  RiemannProblem const exact(s.left, s.right, s.gamma);
  double error = 0;
  for (int i = 0; i < tube.size(); ++i)
    error += tube.h() *
             std::abs(tube.cell(i)[0] - exact.mean_density(tube.edge(i) - s.x0, tube.edge(i + 1) - s.x0, s.end_time));
  return error;
}

Tube make_tube(Shock const& s, int n) {
  Tube tube(n, 0, s.length, s.gamma, Ends::outflow, std::max(s.left.density, s.right.density),
            std::max(s.left.pressure, s.right.pressure));
  tube.fill(s.left, s.right, s.x0);
  return tube;
}

class RiemannTable : public ::testing::TestWithParam<Shock> {};

TEST_P(RiemannTable, DensityIsAsGoodAsTheTable) {
  Shock const& s = GetParam();
  for (int o = 0; o < 6; ++o) {
    Tube tube = make_tube(s, 200);
    tube.run(orders[o], s.end_time);
    EXPECT_EQ(tube.health, 0u);
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(orders[o]), "L1 density N=200", density_error(tube, s),
                                  allowance * s.table[o]));
  }
}
INSTANTIATE_TEST_SUITE_P(Tubes, RiemannTable, ::testing::ValuesIn(shocks));

TEST(Contact, AtRestIsExact) {
  Shock const s{"F13a", "contact at rest", {1.4, 0, 1}, {1, 0, 1}, .5, 2, 1.4, 1, {}};
  for (int order : orders) {
    Tube tube = make_tube(s, 200);
    tube.run(order, s.end_time);
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(order), "L1 density N=200", density_error(tube, s), 1e-14));
  }
}

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

/// Mean of 1 + 0.2 sin 2 pi (x - shift) over a cell.
double sine_mean(double low, double high, double shift) {
  double const k = 2 * std::numbers::pi;
  return std::sin(k * (0.5 * (low + high) - shift)) * std::sin(0.5 * k * (high - low)) / (0.5 * k * (high - low));
}

TEST(EntropyWave, ReachesTheOrderWithTheLimiterOn) {
  double const table[] = {3.33e-2, 1.78e-4, 9.10e-7, 4.90e-9, 2.71e-11, 1.5e-13};
  double const rates[] = {0.80, 2.99, 4.99, 6.98, 8.97, 10.96};
  auto error = [](int order, int n) {
    Tube tube(n, 0, 1, 1.4, Ends::periodic, 1, 1);
    for (int i = 0; i < n; ++i)
      tube.cell(i) = tube.gas().conserved(1 + 0.2 * sine_mean(tube.edge(i), tube.edge(i + 1), 0), {1, 0, 0}, 1);
    tube.run(order, 1);
    EXPECT_EQ(tube.limited_faces, 0);
    double sum = 0;
    for (int i = 0; i < n; ++i)
      sum += tube.h() * std::abs(tube.cell(i)[0] - 1 - 0.2 * sine_mean(tube.edge(i), tube.edge(i + 1), 1));
    return sum;
  };
  for (int o = 0; o < 6; ++o) {
    double const fine = error(orders[o], 40), rate = std::log2(error(orders[o], 20) / fine);
    EXPECT_TRUE(
        evidence::at_most("F3", "entropy wave", variant(orders[o]), "L1 density N=40", fine, allowance * table[o]));
    // rounding hides a tenth of the rate at order 11, where the fine error is 1e-13
    EXPECT_TRUE(evidence::near("F3", "entropy wave", variant(orders[o]), "order 20 to 40", rate, rates[o],
                               orders[o] == 11 ? 0.4 : 0.1));
  }
}

/// One step of u_t + u_x = 0 by the kernel's own correction and bounds.
template <int Order>
void advect(std::vector<double>& u, double nu) {
  using namespace fluid;
  auto const n = static_cast<int>(u.size());
  double const sigma = nu, third_factor = (1 - nu * nu) / 6;  // speed 1
  auto at = [&](int i) { return u[static_cast<std::size_t>((i + 4 * n) % n)]; };
  auto jump = [&](int f) { return at(f) - at(f - 1); };
  Wave<Order, double> wave{false, 1.0, 0.5, 0.5 * (1 - nu), 0.5 * (1 / sigma - 1), {}};
  set_ratios(wave, nu);
  std::vector<double> flux(u.size());
  for (int f = 0; f < n; ++f)
    flux[static_cast<std::size_t>(f)] =
        0.5 * (at(f - 1) + at(f)) + field_flux<Order>(
                                        wave, jump(f), [&](int z) { return jump(f + z); },
                                        [&](int z) { return third_factor * jump(f + z); }, AllOrders{});
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= sigma * (flux[(i + 1) % u.size()] - flux[i]);
}

template <int Order>
double sine_error(int n) {
  double const h = 1.0 / n;
  std::vector<double> u;
  for (int i = 0; i < n; ++i) u.push_back(sine_mean(i * h, (i + 1) * h, 0));
  for (int step = 0; step < 2 * n; ++step) advect<Order>(u, 0.5);
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += h * std::abs(u[static_cast<std::size_t>(i)] - sine_mean(i * h, (i + 1) * h, 0));
  return sum;
}
template <int Order>
void check_sine(double table, double rate) {
  double const fine = sine_error<Order>(40);
  EXPECT_TRUE(evidence::at_most("F1", "scalar sine", variant(Order), "L1 N=40", fine, allowance * table));
  EXPECT_TRUE(evidence::near("F1", "scalar sine", variant(Order), "order 20 to 40",
                             std::log2(sine_error<Order>(20) / fine), rate, 0.1));
}

TEST(ScalarAdvection, SineReachesTheOrder) {
  check_sine<1>(1.39e-1, 0.84);
  check_sine<3>(7.25e-4, 2.99);
  check_sine<5>(3.72e-6, 4.98);
  check_sine<7>(2.00e-8, 6.98);
  check_sine<9>(1.11e-10, 8.97);
  check_sine<11>(6.3e-13, 10.96);
}

// ---- interacting blast waves (Woodward & Colella 1984)

Tube blast_waves(int n) {
  Tube tube(n, 0, 1, 1.4, Ends::walls, 1, 1000);
  for (int i = 0; i < n; ++i) {
    double const x = (i + 0.5) / n, p = x < 0.1 ? 1000 : x < 0.9 ? 0.01 : 100;
    tube.cell(i) = tube.gas().conserved(1, {0, 0, 0}, p);
  }
  return tube;
}
std::string const blast_file = std::string(BRISANCE_TEST_DATA) + "/blast_waves.txt";
constexpr int kept_means = 800;

/// Makes the reference anew: order 5 on 12800 cells, CFL 0.8, kept as means over 800 cells.
/// Run with --gtest_also_run_disabled_tests --gtest_filter=*WritesTheReference*.
TEST(BlastWaves, DISABLED_WritesTheReference) {
  constexpr int n = 12800;
  Tube tube = blast_waves(n);
  tube.run(5, 0.038, 0.8);
  std::ofstream file(blast_file);
  file.precision(12);
  for (int i = 0; i < kept_means; ++i) {
    double sum = 0;
    for (int j = 0; j < n / kept_means; ++j) sum += tube.cell(i * (n / kept_means) + j)[0];
    file << sum / (n / kept_means) << '\n';
  }
}

TEST(BlastWaves, DensityIsAsGoodAsTheTable) {
  std::ifstream file(blast_file);
  std::vector<double> reference(kept_means);
  for (double& x : reference) file >> x;
  ASSERT_TRUE(file);
  double const table[2][6] = {{.269, 8.21e-2, 5.60e-2, 4.89e-2, 4.65e-2, 4.53e-2},
                              {.210, 4.67e-2, 3.11e-2, 2.65e-2, 2.47e-2, 2.36e-2}};
  for (int fine = 0; fine < (evidence::full() ? 2 : 1); ++fine)
    for (int o = 0; o < 6; ++o) {
      int const n = fine ? 800 : 400, group = kept_means / n;
      Tube tube = blast_waves(n);
      tube.run(orders[o], 0.038);
      double error = 0;
      for (int i = 0; i < n; ++i) {
        double mean = 0;
        for (int j = 0; j < group; ++j) mean += reference[static_cast<std::size_t>(i * group + j)] / group;
        error += std::abs(tube.cell(i)[0] - mean) / n;
      }
      EXPECT_EQ(tube.health, 0u);
      EXPECT_TRUE(evidence::at_most("F20", "interacting blasts", variant(orders[o]),
                                    "L1 density N=" + std::to_string(n), error, allowance * table[fine][o]));
    }
}

}  // namespace
}  // namespace brisance::testing
