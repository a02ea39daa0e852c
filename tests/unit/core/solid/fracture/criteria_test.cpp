// Each criterion on loading paths of one link.
#include <gtest/gtest.h>

#include "core/solid/fracture/criteria.hpp"

namespace brisance::solid {
namespace {

Section const cube{1, 1, 0.5, 1};  // E = 1, nu = 0, h = 1

/// A link pulled by `normal` and sheared by `shear` (m), under the pressure of its ends (Pa).
LinkState pulled(Real normal, Real shear, Real pressure = 0) {
  return link_state(cube, normal * cube.area, normal * normal + shear * shear, 0, pressure, pressure);
}

TEST(LinkState, HasTheStressesOfTheTheory) {
  Section const link{0.5, 2, 0.3, 4};
  LinkState const s = link_state(link, 0.01 * 0.5, 0.01 * 0.01 + 0.02 * 0.02, 0.3, 0.1, -0.2);
  EXPECT_NEAR(s.opening, 0.01, 1e-17);
  EXPECT_NEAR(s.slip, 0.02, 1e-16);
  EXPECT_NEAR(s.normal, 4 * 0.01 / 2 + 0.3 * 0.1 - 0.7 * 0.2, 1e-16);
  EXPECT_NEAR(s.shear, 4 * 0.02 / 2, 1e-15);
  // (S D / 4 G) [w_I s_I^2 + w_J s_J^2 + tau^2] + E_flex, over S
  EXPECT_NEAR(release(s).total(), 2 / (2 * 4.0) * (0.3 * 0.12 * 0.12 + 0.7 * 0.18 * 0.18 + 0.04 * 0.04) + 0.3 / 0.5,
              1e-15);
}

TEST(LinkState, CompressionDrivesNoCrack) {
  EXPECT_EQ(driving_release(pulled(-0.1, 0)).total(), 0);
  EXPECT_GT(release(pulled(-0.1, 0)).total(), 0);
  EXPECT_NEAR(driving_release(pulled(-0.1, 0.02)).total(), release(pulled(0, 0.02)).total(), 1e-17);
}

/// Runs every brittle law of the family through what all must do.
template <class Law>
Law typical();
template <>
Elongation typical<Elongation>() {
  return {0.01};
}
template <>
MixedStress typical<MixedStress>() {
  return {0.01, 0.7, false, {}};
}
template <>
MohrCoulomb typical<MohrCoulomb>() {
  return {0.01, 0.5, 0.01, false, {}};
}
template <>
EnergyRelease typical<EnergyRelease>() {
  return {5e-5, {}, 2, 1};
}

template <class Law>
struct Criterion : testing::Test {};
using BrittleLaws = testing::Types<Elongation, MixedStress, MohrCoulomb, EnergyRelease>;
TYPED_TEST_SUITE(Criterion, BrittleLaws);

LinkState stretched(Real normal) {
  LinkState s = pulled(normal, 0);
  s.stretch = normal;
  return s;
}

TYPED_TEST(Criterion, BreaksAtItsStrengthInTension) {
  auto const law = typical<TypeParam>();  // all reach their strength at a stress of 0.01
  EXPECT_FALSE(law.fails(stretched(0.00999), 1));
  EXPECT_TRUE(law.fails(stretched(0.01001), 1));
}

TYPED_TEST(Criterion, StandsAnyCompression) {
  auto const law = typical<TypeParam>();
  for (Real depth : {0.01, 0.1, 0.5}) EXPECT_FALSE(law.fails(stretched(-depth), 1));
}

TYPED_TEST(Criterion, StrengthScales) {
  auto const law = typical<TypeParam>();
  for (Real scatter : {0.5, 1.3}) {
    EXPECT_FALSE(law.fails(stretched(0.00999 * scatter), scatter));
    EXPECT_TRUE(law.fails(stretched(0.01001 * scatter), scatter));
  }
}

TEST(MixedStress, FollowsItsEllipse) {
  auto const law = typical<MixedStress>();
  for (Real angle : {0.0, 0.4, 0.8, 1.2, 1.57}) {
    Real const normal = 0.01 * std::cos(angle), shear = 0.7 * 0.01 * std::sin(angle);
    EXPECT_FALSE(law.fails(pulled(0.999 * normal, 0.999 * shear), 1));
    EXPECT_TRUE(law.fails(pulled(1.001 * normal, 1.001 * shear), 1));
  }
  EXPECT_TRUE(law.fails(pulled(-0.1, 0.00701), 1));  // pressure does not help against shear
}

TEST(MixedStress, AddsTheStressOfTheOuterFibre) {
  auto law = typical<MixedStress>();
  LinkState s = pulled(0.004, 0);
  s.fibre = 0.0061;
  EXPECT_TRUE(law.fails(s, 1));
  s.fibre = 0.0059;
  EXPECT_FALSE(law.fails(s, 1));
}

TEST(MixedStress, GrowsStrongerWithTheRateAboveTheReference) {
  auto law = typical<MixedStress>();
  law.rate = RateHardening{0.1, 2};
  LinkState s = pulled(0.0101, 0);
  s.rate = 1;
  EXPECT_TRUE(law.fails(s, 1));
  s.rate = 2 * std::exp(1.0);  // strength 1.1
  EXPECT_FALSE(law.fails(s, 1));
  s = pulled(0.01101, 0);
  s.rate = 2 * std::exp(1.0);
  EXPECT_TRUE(law.fails(s, 1));
}

TEST(MohrCoulomb, PressureStrengthensAndTensionIsCutOff) {
  MohrCoulomb const law{0.01, 0.5, 0.006, false, {}};
  for (Real normal : {-0.02, -0.005, 0.0, 0.004}) {
    Real const strength = 0.01 - normal * std::tan(0.5);
    EXPECT_FALSE(law.fails(pulled(normal, 0.999 * strength), 1));
    EXPECT_TRUE(law.fails(pulled(normal, 1.001 * strength), 1));
  }
  EXPECT_FALSE(law.fails(pulled(0.00599, 0), 1));
  EXPECT_TRUE(law.fails(pulled(0.00601, 0), 1));
  MohrCoulomb const straight{0.01, 0.5, {}, false, {}};  // no cut-off: at cohesion / tan(phi)
  Real const apex = 0.01 / std::tan(0.5);
  EXPECT_FALSE(straight.fails(pulled(0.999 * apex, 0), 1));
  EXPECT_TRUE(straight.fails(pulled(1.001 * apex, 0), 1));
}

TEST(EnergyRelease, MixesToughnessesByTheShareOfShear) {
  EnergyRelease const law{1e-4, 4e-4, 2, 0.3};
  Real const normal = 0.003, shear = 0.004, share = 0.64;  // of the energy
  Real const stored = 0.5 * (normal * normal + shear * shear);
  Real const critical = 0.3 * (1e-4 + 3e-4 * share * share);
  Real const factor = std::sqrt(critical / stored);
  EXPECT_FALSE(law.fails(pulled(0.999 * factor * normal, 0.999 * factor * shear), 1));
  EXPECT_TRUE(law.fails(pulled(1.001 * factor * normal, 1.001 * factor * shear), 1));
}

TEST(Cohesive, SoftensLinearlyAndUnloadsTowardsTheOrigin) {
  Cohesive const law{0.01, 1.5e-4, {}, 2, 1};  // onset at 0.01 m, end at 0.03 m
  CohesiveHistory history;
  EXPECT_EQ(law.intact(pulled(0.0099, 0), 1, history), 1);
  EXPECT_EQ(history, CohesiveHistory{});
  Real intact = 1;  // the least so far, as the effect keeps it
  auto const traction = [&](Real opening) {
    intact = min(intact, law.intact(pulled(opening, 0), 1, history));
    return intact * opening;
  };
  EXPECT_NEAR(traction(0.015), 0.01 * (0.03 - 0.015) / 0.02, 1e-15);
  EXPECT_NEAR(traction(0.02), 0.005, 1e-15);
  EXPECT_NEAR(history.end, 0.03, 1e-15);
  EXPECT_NEAR(traction(0.01), 0.0025, 1e-15);  // the way back keeps the damage
  EXPECT_NEAR(traction(-0.01), -0.0025, 1e-15);
  EXPECT_NEAR(traction(0.02), 0.005, 1e-15);
  EXPECT_EQ(traction(0.031), 0);
}

TEST(Cohesive, DissipatesItsToughnessInEveryMode) {
  Cohesive const law{0.01, 1.5e-4, 4e-4, 1.7, 0.6};
  for (Real angle : {0.0, 0.5, 1.0, 1.5}) {
    CohesiveHistory history;
    Real dissipated = 0, intact = 1;
    Real const length = 0.2;
    int const steps = 200000;
    for (int n = 1; n <= steps && intact > 0; ++n) {
      LinkState const s = pulled(length * n / steps * std::cos(angle), length * n / steps * std::sin(angle));
      Real const left = law.intact(s, 1, history);
      dissipated += (intact - left) * release(s).total();
      intact = left;
    }
    Real const share = std::sin(angle) * std::sin(angle);
    EXPECT_EQ(intact, 0);
    EXPECT_NEAR(dissipated / (1.5e-4 + 2.5e-4 * std::pow(share, 1.7)), 1, 1e-3) << angle;
  }
}

TEST(Cohesive, StandsAnyCompression) {
  Cohesive const law{0.01, 1.5e-4, {}, 2, 1};
  CohesiveHistory history;
  EXPECT_EQ(law.intact(pulled(-0.5, 0), 1, history), 1);
  EXPECT_EQ(law.intact(pulled(-0.5, 0.0099), 1, history), 1);
  EXPECT_LT(law.intact(pulled(-0.5, 0.011), 1, history), 1);
}

TEST(Cohesive, BreaksAtOnceWhenItHoldsMoreThanItsToughness) {
  Cohesive const law{0.01, 4e-5, {}, 2, 1};  // stores 5e-5 at its strength
  CohesiveHistory history;
  EXPECT_EQ(law.intact(pulled(0.0101, 0), 1, history), 0);
  EXPECT_NEAR(law.longest(1), 0.8, 1e-15);
  EXPECT_NEAR(law.largest_scatter(1, 1), std::sqrt(0.8), 1e-15);
}

}  // namespace
}  // namespace brisance::solid
