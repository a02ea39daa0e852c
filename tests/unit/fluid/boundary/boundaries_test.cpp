#include "fluid/boundary/boundaries.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "parallel/comm.hpp"
#include "tests/support/flow_case.hpp"

namespace brisance::fluid {
namespace {

State tagged(Index i, Index j, Index k) {
  Real const t = 1 + i + 20 * j + 400 * k;
  return {t, t + 0.1, t + 0.2, t + 0.3, 4 * t};
}

template <class Law>
class BoundaryLaw : public ::testing::Test {};
using Laws = ::testing::Types<Reflecting, Outflow, FarField, Inflow, MovingWall>;
TYPED_TEST_SUITE(BoundaryLaw, Laws);

/// What every law promises: it fills all ghosts of its side, from cells of its own pencil, and nothing else.
TYPED_TEST(BoundaryLaw, FillsItsSideFromItsOwnPencilAndNothingElse) {
  FlowConfig const config = testing::unit_box(3, 9);
  Grid const grid = make_grid(config);
  TypeParam law{};
  if constexpr (std::is_same_v<TypeParam, Inflow>) law.given = {7, 1, 2, 3, 9};
  if constexpr (std::is_same_v<TypeParam, FarField>) law.ambient = {2, 0.5, 0, 0, 5};
  if constexpr (std::is_same_v<TypeParam, MovingWall>) law.speed = 0.5;
  State const untouched{-1, -1, -1, -1, -1};
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side) {
      Block block(grid, 0, 3);
      block.fill(untouched);
      for (Index k = 0; k < 9; ++k)
        for (Index j = 0; j < 9; ++j)
          for (Index i = 0; i < 9; ++i) block.store(i, j, k, tagged(i, j, k));
      fill_ghosts(law, block, d, side);
      for (Index k = -3; k < 12; ++k)
        for (Index j = -3; j < 12; ++j)
          for (Index i = -3; i < 12; ++i) {
            CellIndex const c{i, j, k};
            std::size_t const s = static_cast<std::size_t>(d);
            bool across = true, inside = true;
            for (std::size_t e = 0; e < 3; ++e) {
              bool const in = c[e] >= 0 && c[e] < 9;
              inside = inside && in;
              if (e != s) across = across && in;
            }
            Index const ghost = side == 0 ? -1 - c[s] : c[s] - 9;
            State expected = untouched;
            if (inside) {
              expected = tagged(i, j, k);
            } else if (across && ghost >= 0) {
              CellIndex from = c;
              from[s] = side == 0 ? law.source(ghost) : 8 - law.source(ghost);
              expected = law(tagged(from[0], from[1], from[2]), {d, side, c});
            }
            ASSERT_EQ(block.load(i, j, k), expected) << d << " " << side << ": " << i << " " << j << " " << k;
          }
    }
}

TEST(Reflecting, NegatesOnlyTheNormalMomentumOfTheMirroredCell) {
  Reflecting const wall;
  EXPECT_EQ(wall.source(2), 2);
  EXPECT_EQ(wall({1, 2, 3, 4, 5}, {0, 0}), (State{1, -2, 3, 4, 5}));
  EXPECT_EQ(wall({1, 2, 3, 4, 5}, {2, 1}), (State{1, 2, 3, -4, 5}));
}

TEST(Boundaries, TakeTheirLawAndStateFromTheScene) {
  FlowConfig config = testing::unit_box(2, 8);
  config.boundary.x_high = "outflow";
  config.boundary.y_low = "inflow";
  config.inflow.y_low = GasState{2, 3, {0.5, 0.25, 0}};
  Grid const grid = make_grid(config);
  Boundaries const boundaries(config, make_gas(config), grid);
  EXPECT_EQ(boundaries.law(0, 0), "reflecting");
  EXPECT_EQ(boundaries.law(0, 1), "outflow");
  Block block(grid, 0, 3);
  block.fill({1, 0, 0, 0, 2.5});
  boundaries.fill(block, 1, 0, 0);
  State const u = block.load(4, -3, 0);
  EXPECT_EQ(u[0], 2);
  EXPECT_EQ(u[1], 1);
  EXPECT_EQ(u[2], 0.5);
  EXPECT_DOUBLE_EQ(u[4], 3 / 0.4 + 0.5 * 2 * (0.25 + 0.0625));
}

TEST(Boundaries, APatchTakesItsFacesAndLeavesTheRestToTheSide) {
  FlowConfig config = testing::unit_box(3, 8);
  config.boundary.z_high = "outflow";
  PatchConfig nozzle;
  nozzle.side = "z_high";
  nozzle.shape = "ball";
  nozzle.centre = Vec3{0.25, 0.5, 7};
  nozzle.radius = 0.2;
  nozzle.inflow = GasState{3, 2, {0, 0, -4}};
  config.patch = {nozzle};
  Grid const grid = make_grid(config);
  Boundaries const boundaries(config, make_gas(config), grid);
  Block block(grid, 0, 3);
  State const inside{1, 0, 0, 0, 2.5};
  block.fill(inside);
  boundaries.fill(block, 2, 1, 0);
  for (Index k = 8; k < 11; ++k)
    for (Index j = 0; j < 8; ++j)
      for (Index i = 0; i < 8; ++i) {
        bool const covered = square((i + 0.5) / 8 - 0.25) + square((j + 0.5) / 8 - 0.5) < square(0.2);
        EXPECT_EQ(block.load(i, j, k)[0], covered ? 3 : 1) << i << " " << j << " " << k;
      }
  EXPECT_DOUBLE_EQ(boundaries.signal_speed(2, 0, 1), 4 + std::sqrt(1.4 * 2 / 3));
  EXPECT_EQ(boundaries.signal_speed(0, 0, 1), 0);
}

TEST(Boundaries, LaterPatchesOverwriteEarlierOnes) {
  FlowConfig config = testing::unit_box(2, 8);
  for (Real const density : {2.0, 3.0}) {
    PatchConfig patch;
    patch.side = "x_low";
    patch.low = Vec3{0, density == 2 ? 0.0 : 0.5, 0}, patch.high = Vec3{0, 0.75, 0};
    patch.inflow = GasState{density, 1, {}};
    config.patch.push_back(patch);
  }
  Grid const grid = make_grid(config);
  Boundaries const boundaries(config, make_gas(config), grid);
  Block block(grid, 0, 3);
  block.fill({1, 0, 0, 0, 2.5});
  boundaries.fill(block, 0, 0, 0);
  for (Index j = 0; j < 8; ++j) EXPECT_EQ(block.load(-2, j, 0)[0], j < 4 ? 2 : j < 6 ? 3 : 1);
}

}  // namespace
}  // namespace brisance::fluid
