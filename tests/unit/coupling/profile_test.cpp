// Profiles in cut cells: quadratics are found, sound has none, entropy does (coupling/README.md, "Density profiles").
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/cut_cells/wall_slopes.hpp"

namespace brisance::coupling {
namespace {

using fluid::Gas;
using fluid::State;

constexpr Real h = 0.1;

fluid::ReferenceCurve stiffened() { return {.stiffness = 3}; }
fluid::ReferenceCurve jwl() { return {.a = 20, .b = 1, .r1 = 4.5, .r2 = 1.5, .solid_density = 4}; }

/// Full cells of a plane grid about the origin, of states given by their centres.
template <class StateAt>
std::vector<PlacedState> around(StateAt const& at) {
  std::vector<PlacedState> cells;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i)
      if (i != 0 || j != 0) {
        Vec3 const x{i * h, j * h, 0};
        cells.push_back({at(x), moved(moments_of_box({h, h, 0}), x), std::abs(i) < 2 && std::abs(j) < 2});
      }
  return cells;
}

template <class StateAt>
Profile fitted(Gas const& gas, StateAt const& at) {
  Profile profile{};
  EXPECT_TRUE(fit_profile(ProfileKind::density, gas, {h, h, h}, 2, {at(Vec3{}), moments_of_box({h, h, 0}), true},
                          around(at), profile));
  return profile;
}

/// Change of the density across the cell.
Real steepness(Profile const& p) { return h * (std::abs(p.slope[0][0]) + std::abs(p.slope[1][0])); }

TEST(Profile, DensityAtOnePressureIsFoundToItsCurvature) {
  for (auto const& curve : {fluid::ReferenceCurve{}, stiffened(), jwl()}) {
    Gas gas;
    gas.curve = curve;
    Vec3 const velocity{0.3, -0.2, 0};
    auto const at = [&](Vec3 const& x) {  // the mean over the cell
      Real const mean_x2 = x.x * x.x + h * h / 12;
      return gas.conserved(1.4 + 0.7 * x.x - 0.4 * x.y + 0.9 * mean_x2 - 0.3 * x.x * x.y, velocity, 1);
    };
    Profile const p = fitted(gas, at);
    EXPECT_NEAR(p.slope[0][0], 0.7, 1e-12);
    EXPECT_NEAR(p.slope[1][0], -0.4, 1e-12);
    EXPECT_NEAR(p.curve[0][0], 0.9, 1e-11);
    EXPECT_NEAR(p.curve[1][0], 0, 1e-11);
    EXPECT_NEAR(p.curve[3][0], -0.3, 1e-11);
    EXPECT_NEAR(p.slope[0][1], 0.7 * velocity.x, 1e-12);
  }
}

TEST(Profile, SoundHasNone) {
  for (Real const stiffness : {0.0, 3.0}) {
    Gas gas;
    gas.curve.stiffness = stiffness;
    auto const at = [&](Vec3 const& x) {
      Real const density = 1.4 + 1.1 * x.x + 0.5 * x.y;
      return gas.conserved(density, {x.x, 0, 0}, (1 + stiffness) * std::pow(density / 1.4, gas.gamma) - stiffness);
    };
    EXPECT_LT(steepness(fitted(gas, at)), 1e-14);
  }
}

TEST(Profile, WeakSoundHasNoneInDetonationProducts) {
  // There the sound of the cell stands for that of its neighbours: what is left falls as the square of the wave.
  Gas gas;
  gas.curve = jwl();
  Real const c2 = std::pow(gas.sound_speed(gas.conserved(1.4, {}, 1)), 2);
  std::array<Real, 2> left{};
  for (std::size_t n = 0; n < 2; ++n) {
    Real const size = n == 0 ? 0.2 : 0.1;
    left[n] =
        steepness(fitted(gas, [&](Vec3 const& x) { return gas.conserved(1.4 + size * x.x, {}, 1 + c2 * size * x.x); }));
    EXPECT_LT(left[n], 1e-3 * size * h);
  }
}

}  // namespace
}  // namespace brisance::coupling
