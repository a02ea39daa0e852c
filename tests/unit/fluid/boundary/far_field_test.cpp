#include "fluid/boundary/far_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

Gas air() { return {1.4, 1e-10, 1e-12}; }
Gas water() { return {4.4, 1e-7, 1e-3, {6e8}}; }
Gas products() { return {1.3, 1e-7, 1e-3, {0, 371.2e9, 3.231e9, 4.15, 0.95, 1630}}; }

/// A state at ambient pressure of each gas, moving at `mach` along x.
State moving(Gas const& gas, Real mach, Vec3 const& across = {}) {
  Real const density = gas.curve.exponential() ? 1630 : gas.curve.zero() ? 1 : 1000;
  Real const pressure = gas.curve.exponential() ? 8.4e9 : gas.curve.zero() ? 1 : 1e5;
  Vec3 velocity = across;
  velocity.x = mach * gas.sound_speed(gas.conserved(density, {}, pressure));
  return gas.conserved(density, velocity, pressure);
}

State mirrored(State u) {
  u[1] = -u[1];
  return u;
}

GhostCell const low{0, 0}, high{0, 1};

TEST(FarField, GivesTheAmbientStateBitForBitWhereTheCellHoldsIt) {
  for (Gas const& gas : {air(), water(), products()})
    for (Real const mach : {0.0, 0.3, -0.3, 0.999, -0.999, 1.0, -1.0, 2.5, -2.5}) {
      State const u = moving(gas, mach, {0, 1.7, -0.3});
      FarField const law{gas, u};
      EXPECT_EQ(law(u, low), u) << mach;
      EXPECT_EQ(law(u, high), u) << mach;
    }
}

TEST(FarField, BothSidesMirrorEachOther) {
  for (Gas const& gas : {air(), water(), products()})
    for (Real const in : {-1.4, -0.2, 0.1, 0.7, 1.8})
      for (Real const out : {-1.2, -0.4, 0.0, 0.6, 1.3}) {
        FarField const law{gas, moving(gas, out)}, other{gas, mirrored(moving(gas, out))};
        State const at_high = law(moving(gas, in), high), at_low = other(mirrored(moving(gas, in)), low);
        EXPECT_EQ(at_low, mirrored(at_high)) << in << " " << out;
      }
}

TEST(FarField, KeepsTheInvariantsOfASubsonicExitAndEntry) {
  for (Gas const& gas : {air(), water()}) {
    Real const k = 2 / gas.kappa();
    State const ambient = moving(gas, 0.1);
    State inside = moving(gas, 0.4, {0, 0.5, 0});
    inside[4] *= 1.01;
    FarField const law{gas, ambient};
    auto const full = [&](State const& u) { return gas.pressure(u) + gas.curve.stiffness; };
    auto const entropy = [&](State const& u) { return full(u) / std::pow(u[0], gas.gamma); };
    auto const sound_at = [&](State const& u, State const& on) {  // of the isentrope of `on` at the pressure of u
      return gas.sound_speed(on) * std::pow(full(u) / full(on), 0.5 * gas.kappa() / gas.gamma);
    };
    for (int sign : {1, -1}) {  // exit through the high side, entry through the low side
      State const ghost = law(inside, sign > 0 ? high : low);
      auto const speed = [&](State const& u) { return sign * u[1] / u[0]; };
      Real const scale = gas.sound_speed(inside);
      EXPECT_NEAR(speed(ghost) + k * sound_at(ghost, inside), speed(inside) + k * gas.sound_speed(inside),
                  1e-8 * scale);
      State const& from = sign > 0 ? inside : ambient;
      EXPECT_NEAR(speed(ghost) - k * sound_at(ghost, from), speed(ambient) - k * sound_at(ambient, from), 1e-8 * scale);
      EXPECT_NEAR(entropy(ghost) / entropy(from), 1, 1e-10);
      EXPECT_NEAR(ghost[2] / ghost[0], from[2] / from[0], 1e-12);
    }
  }
}

TEST(FarField, HotGasAtAmbientPressureLeavesAsItIs) {
  Gas const gas = air();
  State const hot = gas.conserved(0.1, {0.2, 0.3, 0}, 1);
  State const ghost = FarField{gas, gas.conserved(1, {0.2, 0, 0}, 1)}(hot, high);
  for (std::size_t q = 0; q < 5; ++q) EXPECT_NEAR(ghost[q], hot[q], 1e-14);
}

/// Exit and entry agree where the gas stands: no jump of pressure when it turns.
TEST(FarField, PressureIsContinuousWhereTheFlowTurns) {
  for (Gas const& gas : {air(), water(), products()}) {
    State const rest = moving(gas, 0);
    FarField const law{gas, rest};
    Real const p0 = gas.pressure(rest), density = gas.curve.exponential() ? 1500 : 0.5 * rest[0];
    Real const slow = 1e-9 * gas.sound_speed(rest);
    for (Real const u : {slow, -slow}) {
      State const ghost = law(gas.conserved(density, {u, 0, 0}, p0), high);
      EXPECT_NEAR(gas.pressure(ghost), p0, 1e-7 * (p0 + gas.curve.stiffness));
      EXPECT_EQ(ghost[1] > 0, u > 0);
    }
  }
}

TEST(FarField, LinearWavesKeepWhatLeaves) {
  Gas const gas = products();
  State const ambient = moving(gas, 0);
  State const inside = gas.conserved(1640, {20, 3, 0}, 8.6e9);
  State const ghost = FarField{gas, ambient}(inside, high);
  Real const impedance = inside[0] * gas.sound_speed(inside);
  EXPECT_NEAR(gas.pressure(ghost) + impedance * ghost[1] / ghost[0], 8.6e9 + impedance * 20, 1e-9 * 8.6e9);
  EXPECT_NEAR(gas.pressure(ghost) - impedance * ghost[1] / ghost[0], gas.pressure(ambient), 1e-9 * 8.6e9);
  EXPECT_NEAR(ghost[2] / ghost[0], 3, 1e-12);
}

TEST(FarField, SupersonicExitCopiesTheCellAndSupersonicEntryTheAmbientState) {
  for (Gas const& gas : {air(), water(), products()}) {
    State const fast = moving(gas, 1.5), slow = moving(gas, 0.2);
    FarField const law{gas, slow};
    EXPECT_EQ(law(fast, high), fast);
    EXPECT_EQ((FarField{gas, fast}(slow, low)), fast);
  }
}

TEST(FarField, AFanAcrossTheSideHoldsTheSonicState) {
  Gas const gas = air();
  State const inside = gas.conserved(1, {}, 1), thin = gas.conserved(1e-6, {}, 1e-6);
  State const ghost = FarField{gas, thin}(inside, high);
  EXPECT_NEAR(ghost[1] / ghost[0], gas.sound_speed(ghost), 1e-12);
  EXPECT_NEAR(ghost[1] / ghost[0], std::sqrt(1.4) / 1.2, 1e-12);
  EXPECT_EQ((FarField{gas, State{}}(inside, high)), ghost);  // true vacuum outside
  State const back = FarField{gas, inside}(thin, high);      // the ambient gas rushes in
  EXPECT_NEAR(back[1] / back[0], -gas.sound_speed(back), 1e-12);
  EXPECT_EQ((FarField{gas, inside}(State{}, high)), inside);  // into an empty cell
  State const apart = FarField{gas, gas.conserved(1, {9, 0, 0}, 1)}(gas.conserved(1, {-9, 0, 0}, 1), high);
  EXPECT_EQ(apart, State{});
}

/// A uniform stream through far_field sides on all six sides keeps its bits.
TEST(FarField, UniformStreamsStayUniformInAllDimensions) {
  for (int dimension : {1, 2, 3})
    for (Real const mach : {0.0, 0.4, -1.7}) {
      FlowConfig config = testing::unit_box(dimension, dimension == 3 ? 12 : 24);
      config.block = 8;
      config.ambient.velocity = {mach, 0.3 * mach, -0.2 * mach};
      testing::set_boundaries(config, "far_field");
      auto const flow = testing::make_flow(config, testing::comm());
      fill(*flow, config);
      State const initial = flow->gas().conserved(1, config.ambient.velocity, 1);
      FlowClock clock;
      advance(*flow, clock, {.end = 10, .cfl = 0.8, .steps = 8});
      for (Block const& block : flow->blocks())
        for (Index k = 0; k < block.size()[2]; ++k)
          for (Index j = 0; j < block.size()[1]; ++j)
            for (Index i = 0; i < block.size()[0]; ++i) ASSERT_EQ(block.load(i, j, k), initial) << dimension << mach;
    }
}

}  // namespace
}  // namespace brisance::fluid
