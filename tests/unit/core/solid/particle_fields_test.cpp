#include "core/solid/particle_fields.hpp"

#include <gtest/gtest.h>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

/// A block of 5^3 cells, strained uniformly, then turned as a whole; the particle in its middle.
struct Strained {
  testing::Lone body;
  std::size_t middle = 0;

  Strained(Real nu, Mat3 const& strain, Quaternion const& turn) : body(config(nu)) {
    for (std::size_t p = 0; p < body.solid.pose().size(); ++p) {
      Vec3 const x = body.solid.pose()[p].x;
      if (norm(x) < 0.1) middle = p;
      body.solid.pose()[p].x = rotate(turn, x + strain * x);
      body.solid.pose()[p].q = turn;
    }
    body.solid.compute_forces();
  }
  static SolidConfig config(Real nu) {
    SolidConfig config = testing::one_material(1, 7, nu);
    config.body.push_back(testing::box({-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5}, {5, 5, 5}));
    return config;
  }
  std::vector<double> value(std::string const& name) const {
    auto const columns = static_cast<std::size_t>(particle_field_columns(name));
    std::vector<double> const all = particle_field(body.solid, name);
    EXPECT_EQ(all.size(), columns * static_cast<std::size_t>(body.solid.owned()));
    auto const from = all.begin() + static_cast<std::ptrdiff_t>(columns * middle);
    return {from, from + static_cast<std::ptrdiff_t>(columns)};
  }
};

TEST(ParticleFields, StressOfAStrainedAndTurnedBlockIsHookes) {
  Real const small = 1e-6;
  Quaternion const turn{std::cos(0.4), std::sin(0.4) * normalized(Vec3{1, 2, 2})};
  for (Real const nu : {-0.5, 0.0, 0.3, 0.49}) {
    // Plain tension along x, and a shear in its plane.
    Mat3 const strain{{Vec3{small, 0.5 * small, 0}, Vec3{0.5 * small, -nu * small, 0}, Vec3{0, 0, -nu * small}}};
    Strained const block(nu, strain, turn);
    Real const tension = 7 * small, shear = 7 * small / (2 * (1 + nu));
    Mat3 const body_frame{{Vec3{tension, shear, 0}, Vec3{shear, 0, 0}, Vec3{0, 0, 0}}};
    Mat3 const exact = matrix(turn) * body_frame * transpose(matrix(turn));
    std::vector<double> const stress = block.value("stress");
    std::vector<double> const expected{exact[0].x, exact[0].y, exact[0].z, exact[1].y, exact[1].z, exact[2].z};
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], expected[c], 1e-5 * tension) << "nu " << nu << ", " << c;
    EXPECT_NEAR(block.value("mean_stress")[0], tension / 3, 1e-5 * tension) << "nu " << nu;
    EXPECT_NEAR(block.value("von_mises")[0], std::sqrt(tension * tension + 3 * shear * shear), 1e-5 * tension);
    EXPECT_NEAR(block.value("largest_principal_stress")[0],
                tension / 2 + std::sqrt(tension * tension / 4 + shear * shear), 1e-5 * tension);
  }
}

TEST(ParticleFields, MotionIsThatOfTheCentres) {
  Quaternion const turn{std::cos(0.25), {0, 0, std::sin(0.25)}};
  Strained block(0.3, Mat3{}, turn);
  for (Motion& m : block.body.solid.motion()) m.v = {1, 2, 3};
  block.middle = 0;
  Vec3 const x = block.body.mesh.particle(0).centre, u = rotate(turn, x) - x;
  std::vector<double> const displacement = block.value("displacement"), rotation = block.value("rotation");
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(displacement[static_cast<std::size_t>(d)], u[d], 1e-14);
  EXPECT_NEAR(rotation[2], 0.5, 1e-15);
  EXPECT_EQ(block.value("velocity"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(block.value("spin"), (std::vector<double>{0, 0, 0}));
}

}  // namespace
}  // namespace brisance::solid
