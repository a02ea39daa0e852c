// S4 and S5 of theory/solid.md section 19: uniaxial stress, solved for; bricks are exact, Voronoi cells nearly so.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/uniaxial.hpp"

namespace brisance::solid {
namespace {

std::string name_of(Real nu) { return "nu " + std::to_string(nu).substr(0, 5); }

constexpr Real stress = 1e-2;  // rounding of positions must stay below 1e-11 of the strain; E = 1

TEST(PatchTest, BricksUnderUniaxialStressAreExact) {
  struct Bar {
    std::array<Index, 3> cells;
  };
  Vec3 const h{1, 1.3, 0.8};
  for (Bar const& bar : {Bar{{10, 1, 1}}, Bar{{10, 3, 2}}, Bar{{8, 4, 4}}})
    for (Real nu : {-0.9, -0.5, 0.0, 0.3, 0.45, 0.49}) {
      if (bar.cells[0] == 8 && !evidence::full()) continue;
      Vec3 const half{0.5 * h.x * bar.cells[0], 0.5 * h.y * bar.cells[1], 0.5 * h.z * bar.cells[2]};
      SolidConfig config = testing::one_material(1, 1, nu);
      config.body.push_back(testing::box(-half, half, bar.cells));
      testing::Lone body(config);
      testing::AffineFit const fit = testing::finite_strain(body, -half.x, half.x, stress);
      std::string const variant = std::to_string(bar.cells[0]) + "x" + std::to_string(bar.cells[1]) + "x" +
                                  std::to_string(bar.cells[2]) + " " + name_of(nu) + ", solved";
      EXPECT_TRUE(evidence::at_most("S4", "patch test", variant, "|E e_xx / sigma - 1|",
                                    std::abs(fit.gradient[0][0] / stress - 1), 1e-11));
      for (int d : {1, 2}) {
        if (bar.cells[static_cast<std::size_t>(d)] == 1) continue;  // one particle wide: no lateral displacement
        EXPECT_TRUE(evidence::at_most("S4", "patch test", variant,
                                      std::string("|E e_") + (d == 1 ? "yy" : "zz") + " / sigma + nu|",
                                      std::abs(fit.gradient[d][d] / stress + nu), 1e-11));
      }
      EXPECT_TRUE(evidence::at_most("S4", "patch test", variant, "rms distance from a uniform strain / elongation",
                                    fit.scatter / (2 * half.x * stress), 1e-11));
    }
}

TEST(PatchTest, FittedVoronoiCellsWithTheBasicVolumetricTerm) {
  struct Row {
    Real nu, expected, slack;  // E e_xx / sigma - 1; the table knows 0, 0.3 and 0.45, the others are bounds
  };
  for (Row const& row : {Row{-0.9, 0, 1e-3}, Row{-0.5, 0, 1e-3}, Row{0, 0, 1e-11}, Row{0.3, -1.3e-3, 1.3e-3},
                         Row{0.45, -4.5e-3, 4.5e-3}, Row{0.49, -1e-2, 1e-2}}) {
    SolidConfig config = testing::one_material(1, 1, row.nu);
    BodyConfig bar = testing::box({-2, -0.5, -0.5}, {2, 0.5, 0.5}, {1, 1, 1});
    bar.tessellation = "voronoi";
    bar.particles = 250;
    bar.lloyd = 20;
    config.body.push_back(bar);
    testing::Lone body(config);
    testing::AffineFit const fit = testing::small_strain(body, -2, 2);
    std::string const variant = "250 Voronoi cells " + name_of(row.nu);
    Real const e_xx = fit.gradient[0][0] - 1;
    EXPECT_TRUE(evidence::near("S5", "patch test", variant, "E e_xx / sigma - 1", e_xx, row.expected, row.slack));
    EXPECT_TRUE(evidence::at_most("S5", "patch test", variant, "rms distance from an affine field / elongation",
                                  fit.scatter / 4, row.nu == 0 ? 1e-11 : 3e-3));
    for (int d : {1, 2}) {
      Real const lateral = fit.gradient[d][d] / fit.gradient[0][0] + row.nu;
      EXPECT_TRUE(evidence::at_most("S5", "patch test", variant,
                                    std::string("|e_") + (d == 1 ? "yy" : "zz") + " / e_xx + nu|", std::abs(lateral),
                                    row.nu == 0 ? 1e-11 : 1e-2));
    }
  }
}

}  // namespace
}  // namespace brisance::solid
