// Two-dimensional cases of theory/fluid.md 8.4: F21 to F25.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/evidence.hpp"
#include "tests/support/hard_cases.hpp"
#include "tests/support/tables.hpp"

namespace brisance::testing {
namespace {

using fluid::CellIndex;
using fluid::State;

HardRun finished(HardCase const& c, int order, Real cfl = 0.9) {
  HardRun run(c, order);
  run.run(cfl);
  EXPECT_EQ(run.failure, "");
  EXPECT_EQ(run.health, 0u);
  EXPECT_LE(run.conservation, 1e-12);
  return run;
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

/// Largest difference of density between a cell and the mean over y.
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

std::vector<int> tried() { return evidence::full() ? std::vector<int>{1, 3, 5, 7, 9, 11} : std::vector<int>{1, 5, 11}; }
std::size_t column(int order) { return static_cast<std::size_t>(order - 1) / 2; }

TEST(SeveralDimensions, TransverseErrors) {
  for (int order : tried()) {
    printf("F21 %d %g\n", order, transverse_error(finished(odd_even(20), order)));
    printf("F22 %d %g\n", order, transverse_error(finished(steady_shock(order), order)));
  }
}
TEST(SeveralDimensions, Sedov) {
  for (int order : tried()) {
    auto run = finished(sedov(2, 60), order);
    Real axis = 0, diag = 0, r = 0, top = 0;
    for_cells(run, [&](CellIndex c, State const& u) {
      if (c[1] == 0) axis = max(axis, u[0]);
      if (c[1] == c[0]) diag = max(diag, u[0]);
      if (c[1] == 0 && u[0] > top) top = u[0], r = run.flow->grid().centre(c).x;
    });
    printf("F23 %d %g %g r %g\n", order, axis, diag, r);
  }
}
TEST(SeveralDimensions, Noh) {
  for (int order : tried()) {
    auto run = finished(noh(2, 100, order), order);
    Real l1 = 0, inner = 0, n = 0;
    for_cells(run, [&](CellIndex c, State const& u) {
      Vec3 const x = run.flow->grid().centre(c);
      Real const r = std::hypot(x.x, x.y);
      Real const e = std::abs(u[0] - (r < 2. / 3 ? 16 : 1 + 2 / r));
      l1 += e * 1e-4;
      if (r < 0.5) inner += e, n += 1;
    });
    printf("F23b %d %g %g centre %g\n", order, l1, inner / n, load(*run.flow, {0, 0, 0})[0]);
  }
}
TEST(SeveralDimensions, DoubleMach) {
  for (int order : tried()) {
    auto run = finished(double_mach(60, order), order);
    printf("F23c %d %g lim %ld\n", order, largest_density(run), (long)run.clock.fallback_faces);
  }
}
TEST(SeveralDimensions, Jet) {
  for (int order : tried()) {
    auto run = finished(jet(2, 100, order, 0.9), order);
    printf("F23d %d max %g min %g %g lim %ld\n", order, largest_density(run), run.density_min, run.pressure_min, (long)run.clock.fallback_faces);
  }
}
TEST(SeveralDimensions, Riemann) {
  for (int order : tried()) {
    auto run = finished(riemann_2d(200), order);
    printf("F24a %d max %g asym %g\n", order, largest_density(run), asymmetry(run));
  }
}
TEST(SeveralDimensions, Implosion) {
  for (int order : tried()) {
    auto run = finished(implosion(100), order);
    printf("F24b %d cons %g asym %g\n", order, run.conservation, asymmetry(run));
  }
}
TEST(SeveralDimensions, Vacuum) {
  for (int order : tried()) {
    auto run = finished(vacuum_ball(2, 100), order);
    printf("F25 %d min %g %g rej %ld\n", order, run.density_min, run.pressure_min, (long)run.clock.retry.rejected());
  }
}

}  // namespace
}  // namespace brisance::testing
