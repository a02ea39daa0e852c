// Waves that interact, of theory/fluid.md 8.2 (F19, F20), against solutions on 12800 cells kept beside this file.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "tests/support/evidence.hpp"
#include "tests/support/quadrature.hpp"
#include "tests/support/tables.hpp"
#include "tests/support/tube.hpp"

namespace brisance::testing {
namespace {

/// A flow whose reference is kept as means of density over `kept` cells.
struct KeptFlow {
  char const *id, *name, *file;
  int kept;
  double end_time;
  std::function<Tube(int)> start;
  std::string path() const { return std::string(BRISANCE_TEST_DATA) + "/" + file; }
};

/// Woodward & Colella 1984.
KeptFlow const blast_waves{"F20", "interacting blasts", "blast_waves.txt", 800, 0.038, [](int n) {
                             Tube tube(n, 0, 1, 1.4, Ends::walls, 1, 1000);
                             for (int i = 0; i < n; ++i) {
                               double const x = (i + 0.5) / n, p = x < 0.1 ? 1000 : x < 0.9 ? 0.01 : 100;
                               tube.cell(i) = tube.gas().conserved(1, {0, 0, 0}, p);
                             }
                             return tube;
                           }};

/// Shu & Osher 1989: a Mach 3 shock meets a sine of density.
KeptFlow const shu_osher{
    "F19", "Shu-Osher", "shu_osher.txt", 400, 1.8, [](int n) {
      Tube tube(n, -5, 5, 1.4, Ends::outflow, 3.857143, 10.33333);
      for (int i = 0; i < n; ++i) {
        double const low = tube.edge(i), high = tube.edge(i + 1);
        double const density = integral([](double x) { return 1 + 0.2 * std::sin(5 * x); }, low, high) / tube.h();
        tube.cell(i) = 0.5 * (low + high) < -4 ? tube.gas().conserved(3.857143, {2.629369, 0, 0}, 10.33333)
                                               : tube.gas().conserved(density, {0, 0, 0}, 1);
      }
      return tube;
    }};

/// Order 5 on 12800 cells, CFL 0.8.
void write_reference(KeptFlow const& flow) {
  constexpr int n = 12800;
  Tube tube = flow.start(n);
  tube.run(5, flow.end_time, 0.8);
  std::ofstream file(flow.path());
  file.precision(12);
  int const group = n / flow.kept;
  for (int i = 0; i < flow.kept; ++i) {
    double sum = 0;
    for (int j = 0; j < group; ++j) sum += tube.cell(i * group + j)[0];
    file << sum / group << '\n';
  }
}
/// Make the references anew with --gtest_also_run_disabled_tests --gtest_filter=*WritesTheReference*.
TEST(BlastWaves, DISABLED_WritesTheReference) { write_reference(blast_waves); }
TEST(ShuOsher, DISABLED_WritesTheReference) { write_reference(shu_osher); }

/// Table values per order; 0: not given.
void expect_errors(KeptFlow const& flow, int n, double const (&table)[6], bool hybrid = false) {
  std::ifstream file(flow.path());
  std::vector<double> reference(static_cast<std::size_t>(flow.kept));
  for (double& x : reference) file >> x;
  ASSERT_TRUE(file);
  int const group = flow.kept / n;
  for (int o = 0; o < 6; ++o) {
    if (table[o] == 0) continue;
    Tube tube = flow.start(n);
    tube.options.hybrid = hybrid;
    tube.run(orders[o], flow.end_time);
    double error = 0;
    for (int i = 0; i < n; ++i) {
      double mean = 0;
      for (int j = 0; j < group; ++j) mean += reference[static_cast<std::size_t>(i * group + j)] / group;
      error += std::abs(tube.cell(i)[0] - mean) * tube.h();
    }
    EXPECT_EQ(tube.health, 0u);
    EXPECT_TRUE(evidence::at_most(flow.id, flow.name, variant(orders[o]) + (hybrid ? " hybrid" : ""),
                                  "L1 density N=" + std::to_string(n), error, allowance * table[o]));
  }
}

TEST(BlastWaves, DensityIsAsGoodAsTheTable) {
  for (bool const hybrid : {false, true})
    expect_errors(blast_waves, 400, {.269, 8.21e-2, 5.60e-2, 4.89e-2, 4.65e-2, 4.53e-2}, hybrid);
  if (evidence::full()) expect_errors(blast_waves, 800, {.210, 4.67e-2, 3.11e-2, 2.65e-2, 2.47e-2, 2.36e-2});
  expect_errors(blast_waves, 400, {0, 0, 5.30e-2, 0, 0, 4.23e-2}, true);
}

TEST(ShuOsher, DensityIsAsGoodAsTheTable) {
  for (bool const hybrid : {false, true}) expect_errors(shu_osher, 200, {.946, .563, .294, .174, .174, .179}, hybrid);
  if (evidence::full()) expect_errors(shu_osher, 400, {.810, .212, 7.64e-2, 6.49e-2, 6.47e-2, 6.71e-2});
  expect_errors(shu_osher, 400, {0, 0, 7.85e-2, 0, 0, 6.33e-2}, true);
}

}  // namespace
}  // namespace brisance::testing
