// Scenes with detonation products: what they ask for, what a charge holds, what the sides do, what stays conserved.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"
#include "fluid/advance.hpp"
#include "fluid/boundary/products.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

FlowConfig air_with_products(int dimension, int cells, Real length) {
  FlowConfig config = testing::unit_box(dimension, cells, length);
  config.ambient.density = 1.2;
  config.ambient.pressure = 101325;
  config.products.emplace();
  return config;
}

ChargeConfig jwl_charge(Real mass, std::string const& tnt, Real factor = 1) {
  ChargeConfig charge;
  charge.model = "jwl";
  charge.tnt = tnt;
  if (factor != 1) charge.tnt_factor = factor;
  charge.mass = mass;
  charge.centre = {0.5137, 0.4713, 0.5};
  return charge;
}

TEST(JwlCharge, HoldsItsMassOrTheEnergyOfTnt) {
  for (int dimension : {1, 2, 3})
    for (std::string const tnt : {"mass", "energy"})
      for (Real const mass : {60.0, 0.4}) {  // the second is smaller than a cell in 3D
        FlowConfig config = air_with_products(dimension, 24, 1);
        Real const factor = tnt == "energy" ? 1.2 : 1, air_energy = 101325 / 0.4;
        config.charge = {jwl_charge(mass, tnt, factor)};
        check(config);
        auto const flow = testing::make_flow(config, testing::comm());
        fill(*flow, config);
        Totals const held = totals(*flow);
        Real const specific = 7.0e9 / 1630, expected = tnt == "mass" ? mass : mass * factor * 4.184e6 / specific;
        EXPECT_NEAR(held.products, expected, 1e-13 * expected) << dimension << tnt;
        // products displace the air: its volume is what their volume fraction leaves
        Real volume = 0;
        for (Block const& block : flow->blocks())
          for (Index k = 0; k < block.size()[2]; ++k)
            for (Index j = 0; j < block.size()[1]; ++j)
              for (Index i = 0; i < block.size()[0]; ++i)
                volume += (1 - block.load_mixture(i, j, k)[6]) * flow->grid().cell_volume();
        parallel::ExactSum sum;
        sum.add(volume);
        testing::comm().sum(std::span(&sum, 1));
        Real const energy = expected * specific;
        EXPECT_NEAR(held.energy, energy + air_energy * sum.value(), 1e-12 * held.energy) << dimension << tnt;
        EXPECT_NEAR(held.mass, expected + 1.2 * sum.value(), 1e-12 * held.mass);
        // as dense as the explosive, to the rounding of the volume's sum
        EXPECT_NEAR(1 - sum.value(), expected / 1630, 1e-12) << dimension << tnt;
      }
}

TEST(JwlCharge, LargerThanTheDomainIsRefused) {
  FlowConfig config = air_with_products(1, 24, 1);
  config.charge = {jwl_charge(2000, "mass")};
  auto const flow = testing::make_flow(config, testing::comm());
  EXPECT_THROW(fill(*flow, config), Error);
}

TEST(JwlCharge, LeavesAirWithoutProductsAlone) {
  FlowConfig config = air_with_products(2, 24, 1);
  ChargeConfig balloon;
  balloon.centre = {0.5, 0.5, 0};
  balloon.radius = 0.2;
  balloon.mass = 3;
  config.charge = {balloon};
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, config);
  EXPECT_EQ(totals(*flow).products, 0);
}

TEST(Products, SceneErrorsSayWhatToDo) {
  auto const error = [](FlowConfig const& config) {
    try {
      check(config);
    } catch (Error const& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  FlowConfig config = air_with_products(2, 24, 1);
  config.charge = {jwl_charge(1, "mass")};
  EXPECT_EQ(error(config), "");
  config.products.reset();
  EXPECT_NE(error(config).find("add products"), std::string::npos);
  config.products.emplace();
  config.charge[0].radius = 0.1;
  EXPECT_NE(error(config).find("leave its extent"), std::string::npos);
  config.charge[0] = jwl_charge(1, "mass", 1.3);
  EXPECT_NE(error(config).find("tnt = \"energy\""), std::string::npos);
  config.charge[0] = jwl_charge(1, "energy", 1.3);
  EXPECT_EQ(error(config), "");
  config.charge[0].model = "balloon";
  EXPECT_NE(error(config).find("a balloon has"), std::string::npos);
  config.charge.clear();
  config.gas.law = "stiffened";
  EXPECT_NE(error(config).find("must be ideal"), std::string::npos);
  config.gas.law = "ideal";
  config.products->jwl.energy = 1e9;
  EXPECT_NE(error(config).find("below the reference curve"), std::string::npos);
}

TEST(Products, SidesMirrorCopyOrBringGas) {
  FlowConfig config = air_with_products(2, 8, 1);
  auto const alone = parallel::serial();
  auto const flow = testing::make_flow(config, *alone);
  Block& block = flow->blocks()[0];
  for (Index j = 0; j < 8; ++j)
    for (Index i = 0; i < 8; ++i)
      for (int q = 5; q < 7; ++q) block.component(q)[block.at(i, j, 0)] = q + 10 * i + 100 * j;
  auto const ghost = [&](int q, Index i, Index j) { return block.component(q)[block.at(i, j, 0)]; };
  fill_products(block, 0, 0, "reflecting");
  EXPECT_EQ(ghost(5, -1, 3), 305);
  EXPECT_EQ(ghost(6, -3, 3), 326);
  fill_products(block, 1, 1, "outflow");
  EXPECT_EQ(ghost(6, 2, 10), 726);
  fill_products(block, 0, 1, "inflow");
  EXPECT_EQ(ghost(5, 8, 3), 0);
}

TEST(Products, MassOfProductsIsConservedAcrossSidesAndBlocks) {
  for (int const dimension : {1, 2, 3}) {
    FlowConfig config = air_with_products(dimension, dimension == 1 ? 60 : 24, 1);
    config.block = 12;
    config.boundary.x_high = "outflow";
    config.boundary.y_low = config.boundary.y_high = "periodic";
    config.ambient.velocity = {50, dimension > 1 ? -70.0 : 0, 0};
    // several cells wide, close enough to the open side to reach it
    config.charge = {jwl_charge(dimension == 1 ? 400 : dimension == 2 ? 60 : 15, "mass")};
    config.charge[0].centre.x = 0.8;
    auto const flow = testing::make_flow(config, testing::comm());
    fill(*flow, config);
    Totals const before = totals(*flow);
    FlowClock clock;
    advance(*flow, clock, {.end = 1, .cfl = 0.8, .steps = 60});
    Totals const after = totals(*flow);
    auto const crossed = flow->ledger().totals(testing::comm());
    EXPECT_LT(crossed.products, -1e-3 * before.products) << "the products reached the open side";
    EXPECT_NEAR(after.products - crossed.products, before.products, 1e-13 * before.products) << dimension;
    EXPECT_NEAR(after.mass - crossed.gained[0], before.mass, 1e-13 * before.mass) << dimension;
    EXPECT_NEAR(after.energy - crossed.gained[4], before.energy, 1e-13 * before.energy) << dimension;
  }
}

}  // namespace
}  // namespace brisance::fluid
