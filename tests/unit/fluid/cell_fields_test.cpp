#include "fluid/cell_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/initial_state.hpp"
#include "fluid/rows.hpp"
#include "fluid/totals.hpp"
#include "parallel/error.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

std::unique_ptr<Flow> flow_of(FlowConfig const& config, std::function<State(Vec3)> const& state) {
  auto flow = testing::make_flow(config, testing::comm());
  Grid const& grid = flow->grid();
  fill(*flow, [&](CellIndex c) { return state(grid.centre(c)); });
  return flow;
}

/// Calls visit(global cell, n-th value of this rank).
void for_values(Flow const& flow, std::function<void(CellIndex, std::size_t)> const& visit) {
  std::size_t n = 0;
  for (auto const& box : cell_boxes(flow))
    for (Index k = 0; k < box.size[2]; ++k)
      for (Index j = 0; j < box.size[1]; ++j)
        for (Index i = 0; i < box.size[0]; ++i)
          visit({static_cast<Index>(box.first[0]) + i, static_cast<Index>(box.first[1]) + j,
                 static_cast<Index>(box.first[2]) + k},
                n++);
}

FlowConfig blocks_of_seven(int dimension, int cells) {
  FlowConfig config = testing::unit_box(dimension, cells);
  config.block = 7;
  return config;
}

std::string digest(Flow const& flow) {
  parallel::Digest sum;
  add_cells(sum, flow);
  testing::comm().sum(sum);
  return sum.hex();
}

TEST(CellField, GivesPrimitiveValuesOverTheBoxes) {
  FlowConfig config = testing::unit_box(2, 30);
  config.block = 11;
  config.ambient = {2, 3, {0.5, -0.25, 0}};
  auto const flow = testing::make_flow(config, testing::comm());
  std::size_t cells = 0;
  for (auto const& box : cell_boxes(*flow)) cells += static_cast<std::size_t>(box.size[0] * box.size[1] * box.size[2]);
  config.ambient.pressure = 2.5;
  Real const sound = std::sqrt(1.4 * 1.5);
  struct Expected {
    char const* name;
    Real value;
  };
  for (Expected const& e : {Expected{"density", 2},
                            {"pressure", 3},
                            {"overpressure", 0.5},
                            {"sound_speed", sound},
                            {"mach", std::sqrt(0.3125) / sound},
                            {"temperature", 1.5 / 287.05},
                            {"energy", 7.8125},
                            {"density_gradient", 0},
                            {"schlieren", 1},
                            {"vorticity", 0}}) {
    CellField const field = cell_field(*flow, config, {}, e.name);
    EXPECT_EQ(field.columns, 1);
    ASSERT_EQ(field.data.size(), cells) << e.name;
    for (double const x : field.data) ASSERT_NEAR(x, e.value, 1e-14) << e.name;
  }
  CellField const velocity = cell_field(*flow, config, {}, "velocity");
  EXPECT_EQ(velocity.columns, 3);
  ASSERT_EQ(velocity.data.size(), 3 * cells);
  for (std::size_t c = 0; c < cells; ++c) EXPECT_EQ(velocity.data[3 * c + 1], -0.25);
  EXPECT_THROW(cell_field(*flow, config, {}, "presure"), Error);
}

TEST(CellField, DensityGradientOfALinearFieldIsExactUpToTheSides) {
  for (int dimension : {1, 2, 3}) {
    FlowConfig const config = blocks_of_seven(dimension, 15);
    Vec3 slope{3, dimension > 1 ? -2.0 : 0.0, dimension > 2 ? 1.5 : 0.0};
    auto const flow = flow_of(config, [&](Vec3 x) { return State{9 + dot(slope, x), 0, 0, 0, 2.5}; });
    std::string const before = digest(*flow);
    CellField const field = cell_field(*flow, config, {}, "density_gradient");
    for_values(*flow, [&](CellIndex, std::size_t n) { ASSERT_NEAR(field.data[n], norm(slope), 1e-12); });
    for (double const x : cell_field(*flow, config, {}, "schlieren").data) ASSERT_NEAR(x, std::exp(-10), 1e-15);
    EXPECT_EQ(digest(*flow), before);
  }
}

TEST(CellField, VorticityOfASpinningGasIsTwiceItsSpin) {
  Vec3 const spin{0.3, -0.7, 1.1};
  for (int dimension : {2, 3}) {
    FlowConfig const config = blocks_of_seven(dimension, 15);
    auto const flow = flow_of(config, [&](Vec3 x) {
      Vec3 const v = cross(dimension == 3 ? spin : Vec3{0, 0, spin.z}, x);
      return State{2, 2 * v.x, 2 * v.y, 2 * v.z, 9 + norm2(v)};
    });
    CellField const field = cell_field(*flow, config, {}, "vorticity");
    ASSERT_EQ(field.columns, dimension == 3 ? 3 : 1);
    ASSERT_EQ(cell_field_columns("vorticity", dimension), field.columns);
    for_values(*flow, [&](CellIndex, std::size_t n) {
      if (dimension == 2) {
        ASSERT_NEAR(field.data[n], 2 * spin.z, 1e-12);
      }
      for (std::size_t d = 0; dimension == 3 && d < 3; ++d)
        ASSERT_NEAR(field.data[3 * n + d], 2 * spin[static_cast<int>(d)], 1e-12);
    });
  }
}

TEST(CellField, NothingIsReadOfSolidCells) {
  FlowConfig const config = blocks_of_seven(2, 21);
  auto const solid = [](CellIndex c) { return c[0] >= 6 && c[0] < 9 && c[1] >= 13 && c[1] < 16; };
  FluidVolume const volume{[&](CellIndex c) { return solid(c) ? 0.0 : 1.0 / 441; }};
  auto const flow = testing::make_flow(config, testing::comm());
  Grid const& grid = flow->grid();
  fill(*flow, [&](CellIndex c) {
    return solid(c) ? State{1e9, 1e9, 1e9, 0, 1e12} : State{9 + 3 * grid.centre(c).x, 0, 0, 0, 5};
  });
  CellField const gradient = cell_field(*flow, config, volume, "density_gradient");
  CellField const curl = cell_field(*flow, config, volume, "vorticity");
  for_values(*flow, [&](CellIndex c, std::size_t n) {
    ASSERT_NEAR(gradient.data[n], solid(c) ? 0 : 3, 1e-11) << c[0] << " " << c[1];
    ASSERT_EQ(curl.data[n], 0);
  });
}

TEST(CellField, PeriodicSidesAreNeighbours) {
  FlowConfig config = blocks_of_seven(1, 20);
  testing::set_boundaries(config, "periodic");
  auto const density = [](CellIndex c) { return 2 + std::sin(2 * M_PI * (c[0] + 0.5) / 20); };
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, [&](CellIndex c) { return State{density(c), 0, 0, 0, 5}; });
  CellField const field = cell_field(*flow, config, {}, "density_gradient");
  for_values(*flow, [&](CellIndex c, std::size_t n) {
    Real const exact = std::abs(density({c[0] + 1, 0, 0}) - density({c[0] - 1, 0, 0})) * 10;
    ASSERT_NEAR(field.data[n], exact, 1e-12);
  });
}

TEST(CellField, FaultsOfTheListAreNamed) {
  FlowConfig config = testing::unit_box(2, 10);
  std::vector<std::string> names = cell_field_names();
  std::erase(names, "products");
  std::erase(names, "volume_fraction_products");
  EXPECT_NO_THROW(check_cell_fields(names, config, 2, {}));
  EXPECT_THROW(check_cell_fields({"products"}, config, 2, {}), Error);
  EXPECT_THROW(check_cell_fields({"density", "pressure", "density"}, config, 2, {}), Error);
  EXPECT_THROW(check_cell_fields({"vorticity"}, config, 1, {}), Error);
  config.products.emplace();
  EXPECT_NO_THROW(check_cell_fields({"products", "volume_fraction_products"}, config, 2, {}));
  EXPECT_THROW(check_cell_fields({"temperature"}, config, 2, {}), Error);
  config.products.reset();
  config.gas.law = "stiffened";
  EXPECT_THROW(check_cell_fields({"temperature"}, config, 2, {}), Error);
}

}  // namespace
}  // namespace brisance::fluid
