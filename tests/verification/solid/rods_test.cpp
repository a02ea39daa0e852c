// S8 to S10 of theory/solid.md section 19: frequencies of a clamped-free rod 20 x 1 x 1.
#include <gtest/gtest.h>

// Scalar Eigen: GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>
#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

enum class Family { stretch, twist, bend };
struct Mode {
  Real omega;
  Family family;
};

/// Modes of the linearised rod, slowest first: stiffness by central differences of the forces, masses of the particles.
std::vector<Mode> modes(Index cells, Real torsion_ratio) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.links->torsion_ratio = torsion_ratio;
  config.body.push_back(testing::box({0, 0, 0}, {20, 1, 1}, {cells, 1, 1}));
  config.body[0].clamp.push_back({{0, 0, 0}, {0, 1, 1}});
  testing::Lone rod(config);
  Solid::Saved rest;
  rod.solid.save(rest);
  auto const n = static_cast<Eigen::Index>(rod.solid.owned());
  Eigen::MatrixXd k(6 * n, 6 * n), m = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  Real const h = 1e-5;
  auto forces = [&](Eigen::Index p, int freedom, Real s) {
    rod.solid.restore(rest);
    Pose& pose = rod.solid.pose()[static_cast<std::size_t>(p)];
    Vec3 unit{};
    unit[freedom % 3] = s;
    if (freedom < 3)
      pose.x += unit;
    else
      pose.q = testing::rotation(unit);
    rod.solid.compute_forces();
    Eigen::VectorXd f(6 * n);
    for (Eigen::Index q = 0; q < n; ++q) {
      Wrench const& w = rod.solid.internal()[static_cast<std::size_t>(q)];
      f.segment<6>(6 * q) << w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z;
    }
    return f;
  };
  for (Eigen::Index p = 0; p < n; ++p) {
    GlobalId const id = rod.solid.id(static_cast<Index>(p));
    for (int c = 0; c < 6; ++c) {
      k.col(6 * p + c) = (forces(p, c, -h) - forces(p, c, h)) / (2 * h);
      m(6 * p + c, 6 * p + c) = c < 3 ? rod.mesh.particle(id).mass : rod.mesh.inertia(id)[c - 3][c - 3];
    }
  }
  Eigen::MatrixXd const symmetric = 0.5 * (k + k.transpose());
  Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> const solver(symmetric, m);
  std::vector<Mode> found;
  for (Eigen::Index e = 0; e < 40; ++e) {
    Eigen::VectorXd const v = solver.eigenvectors().col(e);
    Real along = 0, about = 0;
    for (Eigen::Index p = 0; p < n; ++p) {
      along += m(6 * p, 6 * p) * square(v(6 * p));
      about += m(6 * p + 3, 6 * p + 3) * square(v(6 * p + 3));
    }
    Family const family = along > 0.5 ? Family::stretch : about > 0.5 ? Family::twist : Family::bend;
    found.push_back({std::sqrt(solver.eigenvalues()(e)), family});
  }
  return found;
}

std::vector<Real> of(std::vector<Mode> const& modes, Family family) {
  std::vector<Real> omega;
  for (Mode const& m : modes)
    if (m.family == family) omega.push_back(m.omega);
  return omega;
}

TEST(Rod, FrequenciesOfStretchTwistAndBend) {
  Real const pi = std::numbers::pi;
  auto const coarse = modes(20, 1), fine = modes(80, 1), square_section = modes(80, 0.843462);
  auto const stretch20 = of(coarse, Family::stretch), stretch80 = of(fine, Family::stretch);
  EXPECT_TRUE(evidence::near("S8", "clamped-free rod", "20 cells", "omega", stretch20.at(0), pi / 40, 1e-3 * pi / 40));
  EXPECT_TRUE(evidence::near("S8", "clamped-free rod", "80 cells", "omega", stretch80.at(0), pi / 40, 1e-3 * pi / 40));
  // The last digits of the table: second order, so the method itself is meant and not a neighbour of it.
  EXPECT_NEAR(stretch20.at(0), 0.078505, 2e-6);
  EXPECT_NEAR(stretch80.at(0), 0.078538, 1e-6);

  Real const twist = of(fine, Family::twist).at(0), twist_square = of(square_section, Family::twist).at(0);
  EXPECT_TRUE(evidence::near("S9", "clamped-free rod", "kappa 1", "omega", twist, 0.048708, 5e-4 * 0.048708));
  EXPECT_TRUE(
      evidence::near("S9", "clamped-free rod", "kappa 0.843462", "omega", twist_square, 0.044734, 5e-4 * 0.044734));

  auto const bend = of(fine, Family::bend);  // every mode twice, in y and in z
  Real const expected[] = {0.00253465, 0.0157801, 0.0437280};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_NEAR(bend.at(2 * b), bend.at(2 * b + 1), 1e-5 * bend.at(2 * b));
    EXPECT_TRUE(evidence::near("S10", "clamped-free rod", "80 cells, mode " + std::to_string(b + 1), "omega",
                               bend.at(2 * b), expected[b], 5e-4 * expected[b]));
  }
}

}  // namespace
}  // namespace brisance::solid
