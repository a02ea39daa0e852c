// Cases of theory/fluid.md 8.4: F21 to F25, with the program's defaults and as the tables were made: without the switch
// at pressure jumps (hybrid), the transverse cure at eta = 0.3 (F24: off).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/hard_cases.hpp"
#include "tests/support/tables.hpp"

namespace brisance::testing {
namespace {

using fluid::CellIndex;
using fluid::State;

enum class Scheme { defaults, table, no_cure };

HardRun finished(HardCase c, int order, Scheme scheme, Real cfl = 0.9) {
  if (scheme != Scheme::defaults) {
    c.config.euler->hybrid = false;
    c.config.euler->shear_dissipation = scheme == Scheme::table ? 0.3 : 0;
  }
  HardRun run(c, order);
  run.run(cfl);
  EXPECT_EQ(run.failure, "") << c.name;
  EXPECT_EQ(run.health, 0u) << c.name;
  return run;
}

/// Orders of the short run; all of them in the full one.
std::vector<int> tried(std::vector<int> const& few = {1, 5, 11}) {
  return evidence::full() ? std::vector<int>{1, 3, 5, 7, 9, 11} : few;
}
/// The defaults and the table's scheme; in the short run the latter at order 5 only.
std::vector<Scheme> schemes(int order) {
  if (evidence::full() || order == 5) return {Scheme::defaults, Scheme::table};
  return {Scheme::defaults};
}
/// Place of an order in a table.
std::size_t column(int order) { return static_cast<std::size_t>(order - 1) / 2; }

std::string text(int order, Scheme scheme) {
  return variant(order) + (scheme == Scheme::defaults ? ""
                           : scheme == Scheme::table  ? " semi-local eta 0.3"
                                                      : " semi-local without cure");
}

Real largest_density(HardRun const& run) {
  Real largest = 0;
  for_cells(run, [&](CellIndex, State const& u) { largest = max(largest, u[0]); });
  return largest;
}

/// Largest difference of density between a cell and its mirror image in the diagonal.
Real asymmetry(HardRun const& run) {
  Real largest = 0;
  for_cells(run, [&](CellIndex c, State const& u) {
    largest = max(largest, std::abs(u[0] - load(*run.flow, {c[1], c[0], c[2]})[0]));
  });
  return largest;
}

/// Largest difference of density between a cell and the mean over its layer along x.
Real transverse_error(HardRun const& run) {
  auto const n = static_cast<std::size_t>(run.flow->grid().cells[0]);
  std::vector<Real> sum(n), count(n);
  for_cells(run, [&](CellIndex c, State const& u) {
    sum[static_cast<std::size_t>(c[0])] += u[0], count[static_cast<std::size_t>(c[0])] += 1;
  });
  Real largest = 0;
  for_cells(run, [&](CellIndex c, State const& u) {
    auto const i = static_cast<std::size_t>(c[0]);
    largest = max(largest, std::abs(u[0] - sum[i] / count[i]));
  });
  return largest;
}

TEST(OddEven, DoesNotGrow) {
  auto const check = [](int dimension, int n, int order, Scheme scheme) {
    HardCase const c = odd_even(dimension, n);
    EXPECT_TRUE(evidence::at_most(c.id, c.name, text(order, scheme), "transverse density error",
                                  transverse_error(finished(c, order, scheme)), 1e-4));
  };
  for (int const order : tried())
    for (Scheme const scheme : schemes(order)) check(2, 20, order, scheme);
  check(3, 8, 5, Scheme::defaults);
}

/// The residue is chaotic: the worst of several seeds of the noise counts. The theory's cure, eta = 0.3, ends between
/// 0.5 and 1.0 and is no row here.
TEST(SteadyShock, DoesNotBreakUp) {
  auto const check = [](int dimension, int order, unsigned seeds) {
    Real worst = 0;
    for (unsigned seed = 1; seed <= seeds; ++seed)
      worst = max(worst, transverse_error(finished(steady_shock(dimension, order, seed), order, Scheme::defaults)));
    EXPECT_TRUE(evidence::at_most("F22", "steady shock " + std::to_string(dimension) + "D", variant(order),
                                  "transverse density error, worst of " + std::to_string(seeds), worst, 0.6));
  };
  for (int const order : tried()) check(2, order, evidence::full() ? 6 : 3);
  for (int const order : tried({5})) check(3, order, 1);
}

TEST(Sedov, HasThePeaksOfTheTable) {
  Real const table[6][2] = {{2.98, 3.35}, {4.19, 4.30}, {4.57, 4.52}, {4.52, 4.69}, {4.55, 4.76}, {4.55, 4.78}};
  auto const check = [&](int order, Scheme scheme) {
    HardRun const run = finished(sedov(2, 60), order, scheme);
    Real axis = 0, diagonal = 0, place = 0;
    for_cells(run, [&](CellIndex c, State const& u) {
      if (c[1] == 0 && u[0] > axis) axis = u[0], place = run.flow->grid().centre(c).x;
      if (c[1] == c[0]) diagonal = max(diagonal, u[0]);
    });
    std::string const name = text(order, scheme);
    Real const(&expected)[2] = table[column(order)];
    EXPECT_TRUE(evidence::near("F23", "Sedov", name, "peak density on the axis", axis, expected[0], 0.1 * expected[0]));
    EXPECT_TRUE(
        evidence::near("F23", "Sedov", name, "peak density on the diagonal", diagonal, expected[1], 0.1 * expected[1]));
    // one cell of 0.02
    EXPECT_TRUE(evidence::near("F23", "Sedov", name, "radius of the peak on the axis", place, 0.983, 0.02));
    EXPECT_TRUE(
        evidence::at_most("F23", "Sedov", name, "largest defect of mass, momentum, energy", run.conservation, 1e-13));
  };
  for (int const order : tried())
    for (Scheme const scheme : schemes(order)) check(order, scheme);
}

TEST(Noh, IsAsGoodAsTheTable) {
  constexpr int n = 100, samples = 8;
  constexpr Real h = 1.0 / n, front = 2. / 3;
  struct Expected {
    Real l1, inner;  // L1 of density, mean error for r < 0.5 (0: not given)
  };
  Expected const table[6] = {{.267, .59}, {.112, 0}, {.114, .18}, {.128, 0}, {.138, 0}, {.173, .24}};
  auto const check = [&](int order, Scheme scheme) {
    HardRun const run = finished(noh(2, n, order), order, scheme);
    Real l1 = 0, inner = 0, count = 0;
    for_cells(run, [&](CellIndex c, State const& u) {
      Real exact = 0;
      for (int a = 0; a < samples; ++a)
        for (int b = 0; b < samples; ++b) {
          Real const r = std::hypot(c[0] + (a + 0.5) / samples, c[1] + (b + 0.5) / samples) * h;
          exact += (r < front ? 16 : 1 + 2 / r) / (samples * samples);
        }
      l1 += std::abs(u[0] - exact) * h * h;
      if (std::hypot(c[0] + 0.5, c[1] + 0.5) * h < 0.5) inner += std::abs(u[0] - 16), count += 1;
    });
    std::string const name = text(order, scheme);
    Expected const& expected = table[column(order)];
    EXPECT_TRUE(evidence::at_most("F23b", "Noh", name, "L1 density", l1, allowance * expected.l1));
    if (expected.inner > 0) {
      EXPECT_TRUE(evidence::at_most("F23b", "Noh", name, "mean error of density within r = 0.5", inner / count,
                                    allowance * expected.inner));
    }
    // 18.8 to 14.1 in the table: the wall heating of the first cell
    EXPECT_TRUE(evidence::near("F23b", "Noh", name, "density at the centre", load(*run.flow, {0, 0, 0})[0], 16, 3.1));
  };
  for (int const order : tried())
    for (Scheme const scheme : schemes(order)) check(order, scheme);
}

TEST(DoubleMach, HasThePeakOfTheTable) {
  Real const table[6] = {19.9, 20.8, 20.9, 20.9, 20.9, 20.9};
  for (int const order : tried({5}))
    for (Scheme const scheme : schemes(order)) {
      HardRun const run = finished(double_mach(60, order), order, scheme);
      Real const expected = table[column(order)];
      EXPECT_TRUE(evidence::near("F23c", "double Mach reflection", text(order, scheme), "largest density",
                                 largest_density(run), expected, 0.05 * expected));
      EXPECT_TRUE(evidence::at_most("F23c", "double Mach reflection", text(order, scheme),
                                    "largest defect of mass, momentum, energy", run.conservation, 1e-13));
    }
}

/// Its peak density moves with every detail of the head that rolls up, so only what must hold is asked.
TEST(Jet, StaysAdmissible) {
  for (int const order : tried()) {
    HardRun const run = finished(jet(2, 100, order, 0.9), order, Scheme::defaults);
    EXPECT_TRUE(evidence::at_most("F23d", "Mach 2000 jet", variant(order), "largest defect of mass, momentum, energy",
                                  run.conservation, 1e-13));
    EXPECT_GT(run.density_min, 0);
    EXPECT_GT(run.pressure_min, 0);
  }
}

TEST(Riemann2D, IsAsTheTableWithoutTheCure) {
  struct Expected {
    Real density, asymmetry;  // 0: not given
  };
  Expected const table[6] = {{1.698, .05}, {1.760, 0}, {1.748, .61}, {1.753, 0}, {1.757, 0}, {1.750, .66}};
  for (int const order : tried({5})) {
    HardRun const run = finished(riemann_2d(200), order, Scheme::no_cure);
    Expected const& expected = table[column(order)];
    EXPECT_TRUE(evidence::near("F24a", "2D Riemann problem 3", text(order, Scheme::no_cure), "largest density",
                               largest_density(run), expected.density, 0.02 * expected.density));
    if (expected.asymmetry > 0) {
      EXPECT_TRUE(evidence::at_most("F24a", "2D Riemann problem 3", text(order, Scheme::no_cure),
                                    "asymmetry of density", asymmetry(run), allowance * expected.asymmetry));
    }
  }
}

TEST(Implosion, IsAsTheTableWithoutTheCure) {
  Real const table[6] = {5e-3, 0, .37, 0, 0, .35};
  for (int const order : tried({5})) {
    HardRun const run = finished(implosion(100), order, Scheme::no_cure);
    EXPECT_TRUE(evidence::at_most("F24b", "implosion", text(order, Scheme::no_cure),
                                  "largest defect of mass, momentum, energy", run.conservation, 1e-13));
    if (Real const expected = table[column(order)]; expected > 0) {
      EXPECT_TRUE(evidence::at_most("F24b", "implosion", text(order, Scheme::no_cure), "asymmetry of density",
                                    asymmetry(run), allowance * expected));
    }
  }
}

/// As the table was made: no rejection, but at order 11 a sweep meets a Courant number above 1 (theory, end of 8.4),
/// and that pair must be taken back. The default's switch lets more sweeps exceed it (1.037 there).
TEST(Vacuum, IsEntered) {
  for (int const order : {1, 5, 11})
    for (Real const cfl : {0.3, 0.9})
      for (Scheme const scheme : {Scheme::defaults, Scheme::table}) {
        HardRun const run = finished(vacuum_ball(2, 100), order, scheme, cfl);
        std::string const name = text(order, scheme) + (cfl > 0.5 ? " CFL 0.9" : " CFL 0.3");
        EXPECT_EQ(run.density_min, 0);
        if (scheme == Scheme::table) {
          EXPECT_TRUE(evidence::at_most("F25", "disk in true vacuum", name, "rejected pairs",
                                        static_cast<Real>(run.clock.retry.rejected()), order > 1 && cfl > 0.5 ? 1 : 0));
        }
        EXPECT_TRUE(evidence::at_most("F25", "disk in true vacuum", name, "largest defect of mass, momentum, energy",
                                      run.conservation, 1e-13));
      }
}

}  // namespace
}  // namespace brisance::testing
