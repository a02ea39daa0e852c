// S15 of theory/solid.md section 19: the free oscillations of a ball of fitted Voronoi cells.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/linear_solid.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

struct Oscillations {
  std::array<Real, 4> omega;  ///< omega a / c_s of 0T2, 0S2, 1S1, 0T3: means over their multiplets
  Real size;                  ///< cell size over radius
};

/// The torsional fields of degree 3, x cross the gradient of a harmonic polynomial, at the centres of the particles.
Eigen::MatrixXd torsion_of_degree_three(testing::LinearSolid const& linear) {
  Eigen::MatrixXd field = Eigen::MatrixXd::Zero(linear.row(linear.count()), 7);
  for (std::size_t s = 0; s < linear.count(); ++s) {
    Vec3 const p = linear.pole[s];
    Real const x = p.x, y = p.y, z = p.z;
    Vec3 const gradient[7] = {{y * z, x * z, x * y},
                              {2 * x * z, -2 * y * z, x * x - y * y},
                              {3 * x * x - 3 * y * y, -6 * x * y, 0},
                              {6 * x * y, 3 * x * x - 3 * y * y, 0},
                              {-6 * x * z, -6 * y * z, 6 * z * z - 3 * x * x - 3 * y * y},
                              {4 * z * z - 3 * x * x - y * y, -2 * x * y, 8 * x * z},
                              {-2 * x * y, 4 * z * z - x * x - 3 * y * y, 8 * y * z}};
    for (int c = 0; c < 7; ++c) {
      Vec3 const u = cross(p, gradient[c]);
      field.block<3, 1>(linear.row(s), c) << u.x, u.y, u.z;
    }
  }
  return field;
}

Oscillations oscillations(int particles) {
  SolidConfig config = testing::one_material(1, 1, 0.25);
  BodyConfig ball;
  ball.material = "m";
  ball.shape = "sphere";
  ball.tessellation = "voronoi";
  ball.centre = Vec3{};
  ball.radius = 1;
  ball.particles = particles;
  ball.lloyd = 20;
  config.body.push_back(ball);
  testing::Lone body(config);
  Real volume = 0;
  for (Particle const& p : body.mesh.particles) volume += p.mass;
  Real const radius = std::cbrt(volume * 3 / (4 * std::numbers::pi));
  Real const unit = std::sqrt(body.mesh.materials[0].shear()) / radius;
  auto const linear = testing::linearise(body.solid);
  auto const modes = testing::lowest_modes(linear, 34, square(2.5 * unit));
  auto mean = [&](Eigen::Index first, Eigen::Index count) {
    return std::sqrt(modes.omega2.segment(first, count).mean()) / unit;
  };
  // After six rigid motions: 0T2 (5), 0S2 (5), 1S1 (3), then 0T3 and 0S3 (7 each), which lie so close together that a
  // mesh mixes them: of those the mean omega^2 in the space of the torsional fields.
  Eigen::MatrixXd const part =
      modes.shape.middleCols(19, 14).transpose() * (linear.mass * torsion_of_degree_three(linear));
  Eigen::MatrixXd const energy = part.transpose() * modes.omega2.segment(19, 14).asDiagonal() * part;
  Real const t3 = std::sqrt((part.transpose() * part).ldlt().solve(energy).trace() / 7) / unit;
  return {{mean(6, 5), mean(11, 5), mean(16, 3), t3}, std::cbrt(volume / particles) / radius};
}

TEST(Ball, OscillatesAtTheFrequenciesOfTheElasticSphere) {
  char const* const name[] = {"0T2", "0S2", "1S1", "0T3"};
  Real const exact[] = {2.50113, 2.63987, 3.42453, 3.86470}, allowed[] = {8e-3, 2e-3, 6e-3, 8e-3};
  std::vector<Oscillations> found;
  for (int particles : {100, 300, 800, 1600}) {
    if (particles > 300 && !evidence::full()) break;
    found.push_back(oscillations(particles));
    Real const size = found.back().size, finest = std::cbrt(4 * std::numbers::pi / 3 / 1600);
    for (std::size_t m = 0; m < 4; ++m) {
      // Coarser meshes than that of the table: its allowance grows with the square of the cells.
      Real const slack = allowed[m] * exact[m] * max(1, square(size / finest));
      EXPECT_TRUE(evidence::near("S15", "free sphere", std::to_string(particles) + " Voronoi cells, " + name[m],
                                 "omega a / c_s", found.back().omega[m], exact[m], slack));
    }
  }
  Oscillations const &coarse = found.front(), &fine = found.back();
  for (std::size_t m = 0; m < 4; ++m) {
    // N2: a factor 3.3 for cells half as large.
    Real const wanted = std::pow(fine.size / coarse.size, std::log2(3.3));
    EXPECT_TRUE(evidence::at_most("S15", "free sphere", name[m], "error, finest over coarsest mesh",
                                  (fine.omega[m] - exact[m]) / (coarse.omega[m] - exact[m]), wanted));
  }
}

}  // namespace
}  // namespace brisance::solid
