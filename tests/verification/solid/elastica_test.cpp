// S12 of theory/solid.md section 19: a cantilever bent far beyond small rotations by a dead load at its end.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/linear_solid.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

/// Sinking and shortening of the loaded end over the length, and its slope.
struct Tip {
  Real sinking, shortening, angle;
};

/// A chain of `cells` bricks of section 1 x 1 whose first and last centres are L = 40 apart; the first one is held.
/// P L^2 / E I = `load`.
Tip bend(Index cells, Real load, Real poisson_ratio) {
  Real const length = 40, h = length / (cells - 1);
  SolidConfig config = testing::one_material(1, 1, poisson_ratio);
  config.body.push_back(testing::box({-h / 2, -0.5, -0.5}, {length + h / 2, 0.5, 0.5}, {cells, 1, 1}));
  config.body[0].hold.push_back({{-h / 2, -0.5, -0.5}, {h / 2, 0.5, 0.5}});
  testing::Lone rod(config);
  Index last = 0;
  for (GlobalId p = 0; p < rod.mesh.size(); ++p)
    if (rod.mesh.particle(p).centre.x > length - h / 2) last = rod.solid.local(p);
  auto const at = static_cast<std::size_t>(last);
  int const steps = static_cast<int>(8 * load);
  for (int s = 1; s <= steps; ++s) {
    Real const force = load * s / steps / (12 * length * length);
    rod.solid.load()[at].force = {0, -force, 0};
    testing::balance(rod.solid, 1e-7 * force);
  }
  Pose const& end = rod.solid.pose()[at];
  Vec3 const axis = rotate(end.q, {1, 0, 0});
  return {-end.x.y / length, 1 - end.x.x / length, -std::atan2(axis.y, axis.x)};
}

TEST(Elastica, FollowsEulersCurve) {
  struct Row {
    Real load, sinking, shortening, angle;
  };
  for (Row const& row :
       {Row{1, 0.30172, 0.05643, 0.46135}, Row{3, 0.60325, 0.25442, 0.98602}, Row{10, 0.81061, 0.55500, 1.43029}}) {
    std::string const variant = "P L^2 / E I = " + std::to_string(static_cast<int>(row.load));
    Tip const tip = bend(41, row.load, 0.3);
    EXPECT_TRUE(evidence::near("S12", "elastica", variant, "w / L", tip.sinking, row.sinking, 1e-3 * row.sinking));
    EXPECT_TRUE(
        evidence::near("S12", "elastica", variant, "u / L", tip.shortening, row.shortening, 1e-3 * row.shortening));
    EXPECT_TRUE(evidence::near("S12", "elastica", variant, "theta", tip.angle, row.angle, 1e-3 * row.angle));
  }
  // Against bricks half as long: the length of the cells is what the chain leaves open.
  Tip const fine = bend(161, 10, 0.3), middle = bend(81, 10, 0.3), coarse = bend(41, 10, 0.3);
  EXPECT_TRUE(evidence::at_most("S12", "elastica", "P L^2 / E I = 10", "change of w at 80 / at 40 cells",
                                std::abs((fine.sinking - middle.sinking) / (middle.sinking - coarse.sinking)),
                                1 / 3.3));
  for (Real nu : {-0.9, 0.49}) {
    Tip const tip = bend(41, 10, nu);
    EXPECT_TRUE(evidence::near("S12", "elastica", "P L^2 / E I = 10, nu " + std::to_string(nu).substr(0, 5), "w / L",
                               tip.sinking, 0.81061, 1e-3 * 0.81061));
  }
}

}  // namespace
}  // namespace brisance::solid
