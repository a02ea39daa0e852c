// The plastic laws: hardening, radial return, rate, heat, back stress, damage.
#include <gtest/gtest.h>

#include "core/solid/plasticity/return_mapping.hpp"
#include "parallel/error.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

constexpr Real shear = 1 / 2.6;

Symmetric tension(Real stress) { return deviator({{stress, 0, 0, 0, 0, 0}}); }

TEST(PlasticLaw, ReturnsToTheYieldSurface) {
  PlasticityConfig linear, voce, ludwik, cook;
  linear.linear = {0.1};
  voce.voce = {2e-3, 300};
  ludwik.ludwik = {0.02, 0.31};
  cook.johnson_cook = {0.02, 0.31, 0.05, 1e-3, 1.1, 300, 1300};
  cook.heating = {1, 0.9, 700};
  testing::Random random(4);
  for (PlasticityConfig config : {PlasticityConfig{}, linear, voce, ludwik, cook})
    for (Real const kinematic : {0.0, 0.3}) {
      config.yield_stress = 1e-3;
      config.kinematic_modulus = kinematic;
      PlasticLaw const law(config, 1, shear);
      PlasticState state;
      state.temperature = law.initial_temperature();
      for (int n = 0; n < 40; ++n) {
        Symmetric stress;
        for (double& c : stress.c) c = 4e-3 * random();
        stress = deviator(stress);
        Real const dt = 0.3;
        PlasticFlow const flow = law.flow(stress, state, dt);
        Symmetric const relative = stress - kinematic * state.strain;
        if (equivalent(relative) <= law.yield_stress({state.p, 0, state.temperature})) {
          EXPECT_EQ(flow.dp, 0);
          continue;
        }
        EXPECT_GT(flow.dp, 0);
        EXPECT_NEAR(trace(flow.strain), 0, 1e-17);
        EXPECT_NEAR(std::sqrt(contract(flow.strain, flow.strain) / 1.5), flow.dp, 1e-14 * flow.dp + 1e-18);
        state.strain = state.strain + flow.strain;
        state.p += flow.dp;
        Symmetric const after = stress - (2 * shear) * flow.strain - kinematic * state.strain;
        EXPECT_NEAR(equivalent(after), law.yield_stress({state.p, flow.dp / dt, state.temperature}), 1e-15);
        Real const work = contract(stress - shear * flow.strain, flow.strain), cold = state.temperature;
        Real const before = state.stored, lost = law.settle(state, flow, work);
        EXPECT_NEAR(lost + state.stored - before, work, 1e-18);
        EXPECT_GE(lost, 0);
        if (config.heating) {
          EXPECT_GT(state.temperature, cold);
        }
      }
      EXPECT_GT(state.p, 1e-3);
    }
}

TEST(PlasticLaw, JohnsonCookKnowsRateAndHeat) {
  PlasticityConfig copper;
  copper.yield_stress = 90e6;
  copper.johnson_cook = {292e6, 0.31, 0.025, 1, 1.09, 293, 1356};
  PlasticLaw const law(copper, 8960, 46e9);
  Real const still = 90e6 + 292e6 * std::pow(0.2, 0.31);
  EXPECT_NEAR(law.yield_stress({0.2, 0.5, 293}), still, 1e-6);
  EXPECT_NEAR(law.yield_stress({0.2, 1e4, 293}), still * (1 + 0.025 * std::log(1e4)), 1e-5);
  EXPECT_NEAR(law.yield_stress({0.2, 1e4, 800}),
              still * (1 + 0.025 * std::log(1e4)) * (1 - std::pow(507.0 / 1063, 1.09)), 1e-5);
  EXPECT_EQ(law.yield_stress({0.2, 1e4, 2000}), 0);
}

TEST(PlasticLaw, PlasticWorkHeats) {
  PlasticityConfig config;
  config.yield_stress = 1e8;
  config.heating = {400, 0.9, 293};
  PlasticLaw const law(config, 8000, 5e10);
  PlasticState state;
  state.temperature = law.initial_temperature();
  PlasticFlow const flow{0.1, {{0.1, -0.05, -0.05, 0, 0, 0}}};
  state.strain = flow.strain;
  state.p = flow.dp;
  Real const work = 1e8 * 0.1;
  EXPECT_NEAR(law.settle(state, flow, work), 0.9 * work, 1e-6);
  EXPECT_NEAR(state.stored, 0.1 * work, 1e-6);
  EXPECT_NEAR(state.temperature, 293 + 0.9 * work / (8000 * 400), 1e-10);
}

TEST(PlasticLaw, BackStressLowersTheYieldOfTheWayBack) {
  PlasticityConfig config;
  config.yield_stress = 1e-3;
  config.kinematic_modulus = 0.02;
  PlasticLaw const law(config, 1, shear);
  PlasticState state;
  Real const p = 0.01;
  state.strain = {{p, -0.5 * p, -0.5 * p, 0, 0, 0}};
  state.p = p;
  Real const back = 1.5 * config.kinematic_modulus * p;
  EXPECT_EQ(law.flow(tension(back + 0.999e-3), state, 1).dp, 0);
  EXPECT_GT(law.flow(tension(back + 1.001e-3), state, 1).dp, 0);
  EXPECT_EQ(law.flow(tension(back - 0.999e-3), state, 1).dp, 0);
  EXPECT_GT(law.flow(tension(back - 1.001e-3), state, 1).dp, 0);
}

TEST(PlasticLaw, DamageCountsTheShareOfTheFailureStrain) {
  PlasticityConfig config;
  config.yield_stress = 1e-3;
  config.failure.emplace();
  config.failure->d1 = 0.05, config.failure->d2 = 3.44, config.failure->d3 = -2.12;
  PlasticLaw const sum(config, 1, shear);
  PlasticState state;
  Real const limit = 0.05 + 3.44 * std::exp(-2.12 / 3);
  EXPECT_NEAR(sum.failure_strain(1.0 / 3, {}), limit, 1e-12);
  state.p = 0.1;
  sum.damage(state, 0.1, 1.0 / 3, 1);
  EXPECT_NEAR(state.damage, 0.1 / limit, 1e-12);
  sum.damage(state, 0.1, -0.5, 1);  // under pressure nothing opens
  EXPECT_NEAR(state.damage, 0.1 / limit, 1e-12);
  config.failure->criterion = "strain";
  PlasticLaw const now(config, 1, shear);
  state = {};
  state.p = limit;
  now.damage(state, 0, 1.0 / 3, 1);
  EXPECT_NEAR(state.damage, 1, 1e-12);
}

TEST(PlasticityConfig, RefusesWhatContradictsItself) {
  PlasticityConfig config;
  config.yield_stress = 1;
  config.linear = {1};
  config.voce = {1, 1};
  EXPECT_THROW(config.hardening(), Error);
  config.voce.reset();
  config.failure.emplace();
  config.failure->d4 = 0.1;
  EXPECT_THROW(PlasticLaw(config, 1, 1), Error);
}

}  // namespace
}  // namespace brisance::solid
