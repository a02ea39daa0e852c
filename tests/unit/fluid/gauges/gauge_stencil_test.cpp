#include "fluid/gauges/gauge_stencil.hpp"

#include <gtest/gtest.h>

#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

Grid grid_of(int dimension, bool periodic = false) {
  FlowConfig config = testing::unit_box(dimension, 10);
  if (periodic) testing::set_boundaries(config, "periodic");
  return make_grid(config);
}

/// Values that are linear in space.
GaugeValue linear(Vec3 const& x) {
  return {1 + 2 * x.x - x.y + 0.5 * x.z, 3 - x.x + 4 * x.y + x.z, {x.x, 2 * x.y, -x.z}, 1};
}

GaugeValue value(GaugeStencil const& stencil, Grid const& grid, auto const& share) {
  std::vector<GaugeValue> values;
  for (CellIndex const c : stencil.cells()) {
    values.push_back(linear(grid.centre(c)));
    values.back().fluid_share = share(c);
  }
  return stencil.value(values);
}
constexpr auto open_gas = [](CellIndex) { return 1.0; };

TEST(GaugeStencil, IsExactForLinearFields) {
  for (int dimension : {1, 2, 3}) {
    Grid const grid = grid_of(dimension);
    for (Real const s : {0.05, 0.25, 0.333, 0.5, 0.871}) {
      Vec3 x{s, s * s + 0.05, 0.9 - 0.6 * s};
      for (int d = dimension; d < 3; ++d) x[d] = grid.centre({0, 0, 0})[d];
      GaugeValue const got = value(GaugeStencil(grid, x), grid, open_gas), wanted = linear(x);
      EXPECT_NEAR(got.density, wanted.density, 1e-14);
      EXPECT_NEAR(got.pressure, wanted.pressure, 1e-14);
      EXPECT_NEAR(norm(got.velocity - wanted.velocity), 0, 1e-14);
    }
  }
}

TEST(GaugeStencil, OnACentreReadsThatCellAlone) {
  GaugeStencil const stencil(grid_of(3), {0.35, 0.05, 0.95});
  ASSERT_EQ(stencil.cells().size(), 1u);
  EXPECT_EQ(stencil.cells().front(), (CellIndex{3, 0, 9}));
}

TEST(GaugeStencil, BeyondTheOutermostCentresIsThatOfTheOutermostCell) {
  Grid const grid = grid_of(2);
  EXPECT_EQ(value(GaugeStencil(grid, {0, 0.05, 0}), grid, open_gas).density, linear(grid.centre({0, 0, 0})).density);
  EXPECT_NEAR(value(GaugeStencil(grid, {1, 1, 0}), grid, open_gas).pressure, linear(grid.centre({9, 9, 0})).pressure,
              1e-15);
}

TEST(GaugeStencil, WrapsAlongPeriodicDirections) {
  GaugeStencil const stencil(grid_of(1, true), {0.02, 0, 0});
  ASSERT_EQ(stencil.cells().size(), 2u);
  EXPECT_EQ(stencil.cells()[0], (CellIndex{0, 0, 0}));
  EXPECT_EQ(stencil.cells()[1], (CellIndex{9, 0, 0}));
}

TEST(GaugeStencil, BesideAWallIsTheMeanOfItsOwnCell) {
  Grid const grid = grid_of(2);
  GaugeStencil const stencil(grid, {0.44, 0.52, 0});  // in cell (4, 5); (3, 5), (4, 4) and (3, 4) are the others
  auto const only = [](CellIndex other, Real share) {
    return [other, share](CellIndex c) { return c == other ? share : 1.0; };
  };
  Real const own = linear(grid.centre({4, 5, 0})).density;
  for (CellIndex const c : stencil.cells())
    if (c != CellIndex{4, 5, 0}) {
      EXPECT_EQ(value(stencil, grid, only(c, 0)).density, own);
    }
  EXPECT_EQ(value(stencil, grid, only({4, 5, 0}, 0.3)).density, own);
  EXPECT_EQ(value(stencil, grid, only({4, 5, 0}, 0)).fluid_share, 0);
}

TEST(GaugeStencil, OnTheSurfaceOfABodyReadsTheSideOfTheGas) {
  Grid const grid = grid_of(2);
  for (Index const gas : {3, 4}) {  // x = 0.4 is the face of cells 3 and 4
    GaugeValue const v =
        value(GaugeStencil(grid, {0.4, 0.45, 0}), grid, [&](CellIndex c) { return c[0] == gas ? 1.0 : 0.0; });
    EXPECT_EQ(v.density, linear(grid.centre({gas, 4, 0})).density);
    EXPECT_GT(v.fluid_share, 0);
  }
}

TEST(GaugeValue, OfVacuumIsAtRest) {
  Gas gas;
  gas.vacuum_density = 1e-10;
  GaugeValue const v = gauge_value(gas, {1e-12, 1, 0, 0, 1}, 1);
  EXPECT_EQ(v.pressure, 0);
  EXPECT_EQ(v.velocity, (Vec3{}));
}

}  // namespace
}  // namespace brisance::fluid
