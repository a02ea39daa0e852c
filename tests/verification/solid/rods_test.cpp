// S8 to S11 of theory/solid.md section 19: frequencies of rods and beams.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/linear_solid.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

constexpr Real pi = std::numbers::pi;

enum class Family { stretch, twist, bend };

/// A clamped-free rod 20 x 1 x 1, cut into cells (1 x n x n layers of it), nu = 0.3.
SolidConfig clamped_rod(std::array<Index, 3> const& cells, Real torsion_ratio) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.links->torsion_ratio = torsion_ratio;
  config.body.push_back(testing::box({0, -0.5, -0.5}, {20, 0.5, 0.5}, cells));
  config.body[0].clamp.push_back({{0, -0.5, -0.5}, {0, 0.5, 0.5}});
  return config;
}

/// Along the axis, about it, or across?
Family family_of(testing::LinearSolid const& linear, Eigen::VectorXd const& shape) {
  Real along = 0, about = 0, total = 0;
  for (std::size_t s = 0; s < linear.count(); ++s) {
    Vec3 const u = linear.pole_shift(shape, s);
    Vec3 const arm{0, linear.centre[s].y, linear.centre[s].z};
    along += u.x * u.x;
    // A section that twists turns its particles with it, also where it is one particle wide.
    Real const turn = shape(linear.row(s) + 3);
    about += turn * turn * (1.0 / 6 + norm2(arm));
    total += norm2(u) + turn * turn / 6;
  }
  return along > 0.5 * total ? Family::stretch : about > 0.5 * total ? Family::twist : Family::bend;
}

class Rod {
 public:
  Rod(SolidConfig const& config, int modes, Real shift = 0) : rod_(config) {
    linear_ = testing::linearise(rod_.solid);
    found_ = testing::lowest_modes(linear_, modes, shift);
    for (int m = 0; m < modes; ++m) family_.push_back(family_of(linear_, found_.shape.col(m)));
  }
  /// Frequency of the mode `place` (from 0) of a family, rad/s.
  Real omega(Family family, int place) const { return found_.omega(mode(family, place)); }

  /// Sets the rod in motion in one of its modes and steps it in time: the frequency by the recurrence
  /// q(t + dt) + q(t - dt) = 2 cos(omega dt) q(t) of the modal amplitude.
  Real omega_in_time(Family family, Real dt, int steps) {
    Eigen::VectorXd const shape = found_.shape.col(mode(family, 0)), test = linear_.mass * shape;
    Real const speed = 1e-3 * omega(family, 0) / shape.cwiseAbs().maxCoeff();
    Solid& solid = rod_.solid;
    for (std::size_t s = 0; s < linear_.count(); ++s) {
      auto const at = static_cast<std::size_t>(solid.local(linear_.particles[s]));
      Eigen::Index const r = linear_.row(s);
      solid.motion()[at].v = speed * Vec3{shape(r), shape(r + 1), shape(r + 2)};
      solid.motion()[at].spin =
          rod_.mesh.inertia(linear_.particles[s]) * (speed * Vec3{shape(r + 3), shape(r + 4), shape(r + 5)});
    }
    std::vector<Real> q{0};
    for (int n = 0; n < steps; ++n) {
      solid.step(dt);
      Real amplitude = 0;
      for (std::size_t s = 0; s < linear_.count(); ++s) {
        Pose const& pose = solid.pose()[static_cast<std::size_t>(solid.local(linear_.particles[s]))];
        Vec3 const shift = pose.x - linear_.centre[s], turn = 2 * pose.q.v;
        for (int d = 0; d < 3; ++d)
          amplitude += test(linear_.row(s) + d) * shift[d] + test(linear_.row(s) + 3 + d) * turn[d];
      }
      q.push_back(amplitude);
    }
    Real bend = 0, square_sum = 0;  // 2 - 2 cos(omega dt) = (2 sin(omega dt / 2))^2
    for (std::size_t n = 1; n + 1 < q.size(); ++n) {
      bend -= q[n] * ((q[n + 1] - q[n]) - (q[n] - q[n - 1]));
      square_sum += q[n] * q[n];
    }
    return 2 / dt * std::asin(0.5 * std::sqrt(bend / square_sum));
  }
  Real stable_step() const { return rod_.solid.link_limit().dt; }

 private:
  Eigen::Index mode(Family family, int place) const {
    for (std::size_t m = 0; m < family_.size(); ++m)
      if (family_[m] == family && place-- == 0) return static_cast<Eigen::Index>(m);
    throw std::runtime_error("fewer modes of a family than asked for");
  }
  testing::Lone rod_;
  testing::LinearSolid linear_;
  testing::Modes found_;
  std::vector<Family> family_;
};

TEST(Rod, FrequenciesOfStretchTwistAndBend) {
  Rod const coarse(clamped_rod({20, 1, 1}, 1), 10), fine(clamped_rod({80, 1, 1}, 1), 10),
      square_section(clamped_rod({80, 1, 1}, 0.843462), 10);
  Real const stretch20 = coarse.omega(Family::stretch, 0), stretch80 = fine.omega(Family::stretch, 0);
  EXPECT_TRUE(evidence::near("S8", "clamped-free rod", "20 cells", "omega", stretch20, pi / 40, 1e-3 * pi / 40));
  EXPECT_TRUE(evidence::near("S8", "clamped-free rod", "80 cells", "omega", stretch80, pi / 40, 1e-3 * pi / 40));
  // The last digits of the table: second order, so the method itself is meant and not a neighbour of it.
  EXPECT_NEAR(stretch20, 0.078505, 2e-6);
  EXPECT_NEAR(stretch80, 0.078538, 1e-6);

  Real const twist = fine.omega(Family::twist, 0), twist_square = square_section.omega(Family::twist, 0);
  EXPECT_TRUE(evidence::near("S9", "clamped-free rod", "kappa 1", "omega", twist, 0.048708, 5e-4 * 0.048708));
  EXPECT_TRUE(
      evidence::near("S9", "clamped-free rod", "kappa 0.843462", "omega", twist_square, 0.044734, 5e-4 * 0.044734));

  Real const expected[] = {0.00253465, 0.0157801, 0.0437280};
  for (int b = 0; b < 3; ++b) {  // every mode twice, in y and in z
    Real const first = fine.omega(Family::bend, 2 * b), second = fine.omega(Family::bend, 2 * b + 1);
    EXPECT_NEAR(first, second, 1e-8 * first);
    EXPECT_TRUE(evidence::near("S10", "clamped-free rod", "80 cells, mode " + std::to_string(b + 1), "omega", first,
                               expected[b], 5e-4 * expected[b]));
  }
}

TEST(Rod, VibratesInTimeAsItsModesAndTheStepSay) {
  struct Row {
    char const* id;
    Family family;
  };
  for (Row const& row : {Row{"S8", Family::stretch}, Row{"S9", Family::twist}, Row{"S10", Family::bend}}) {
    Rod rod(clamped_rod({20, 1, 1}, 1), 10);
    Real const omega = rod.omega(row.family, 0), dt = 0.9 * rod.stable_step();
    Real const expected = 2 / dt * std::asin(0.5 * omega * dt);  // Verlet, theory section 10
    Real const got = rod.omega_in_time(row.family, dt, 3000);
    EXPECT_TRUE(evidence::at_most(row.id, "clamped-free rod", "20 cells, in time",
                                  "|omega / (that of the mode with the error of the step) - 1|",
                                  std::abs(got / expected - 1), 1e-6));
  }
}

TEST(Rod, TorsionOfManyLayersClamped) {
  for (Index layers : {4, 6}) {
    if (layers == 6 && !evidence::full()) break;
    Rod const rod(clamped_rod({20 * layers, layers, layers}, 1), 8);
    EXPECT_TRUE(evidence::near("S9", "clamped-free rod",
                               std::to_string(layers) + "x" + std::to_string(layers) + " layers", "omega",
                               rod.omega(Family::twist, 0), 0.04494, 0.005 * 0.04494));
  }
}

/// First bending of a free-free beam 20 x 1 x 1 of n x n layers of cubes.
Real free_beam(Index layers, Real poisson_ratio) {
  SolidConfig config = testing::one_material(1, 1, poisson_ratio);
  config.body.push_back(testing::box({-10, -0.5, -0.5}, {10, 0.5, 0.5}, {20 * layers, layers, layers}));
  testing::Lone beam(config);
  auto const linear = testing::linearise(beam.solid);
  return testing::lowest_modes(linear, 8, 2e-4).omega(6);
}

TEST(Beam, BendsByTheModulusWithAnyNumberOfLayers) {
  struct Row {
    Real nu;
    Index layers;
    Real omega;
  };
  for (Row const& row : {Row{0.3, 1, 0.016038}, Row{0.3, 2, 0.016314}, Row{0.3, 4, 0.016118}, Row{0.3, 6, 0.016060},
                         Row{0, 1, 0.016044}, Row{0, 2, 0.016021}, Row{0, 4, 0.016017}}) {
    if (row.layers > 4 && !evidence::full()) continue;
    EXPECT_TRUE(
        evidence::near("S11", "free-free beam",
                       "nu " + std::to_string(row.nu).substr(0, 4) + " " + std::to_string(row.layers) + " layers",
                       "first bending omega", free_beam(row.layers, row.nu), row.omega, 2e-5));
  }
}

/// Stiffnesses of an infinite beam of n x n layers of cubes, over those of beam theory: long waves along it.
struct Section {
  Real bending, torsion, stretch;
};
Section long_waves(Index layers, Real poisson_ratio) {
  Real const h = 1.0 / layers, k = 0.02;
  SolidConfig config = testing::one_material(1, 1, poisson_ratio);
  config.body.push_back(testing::box({-2.5 * h, -0.5, -0.5}, {2.5 * h, 0.5, 0.5}, {5, layers, layers}));
  testing::Lone piece(config);
  auto const linear = testing::linearise(piece.solid);
  auto twin = [&](std::size_t s) {
    Vec3 const& x = linear.centre[s];
    return static_cast<int>((x.y + 0.5) / h) + layers * static_cast<int>((x.z + 0.5) / h);
  };
  std::vector<std::size_t> cell(static_cast<std::size_t>(layers * layers));
  for (std::size_t s = 0; s < linear.count(); ++s)
    if (std::abs(linear.centre[s].x) < 0.1 * h) cell[static_cast<std::size_t>(twin(s))] = s;
  auto const omega2 = testing::bloch_waves(linear, cell, twin, {k, 0, 0});
  Real const shear = Material{"m", 1, 1, poisson_ratio}.shear(), square_torsion = square(0.918402);
  // Two bending waves are slowest by far; the twist is slower than the stretch unless nu is near -1.
  bool const twist_first = square_torsion * shear < 1;
  Real const twist = omega2(twist_first ? 2 : 3), stretch = omega2(twist_first ? 3 : 2);
  return {12 * omega2(0) / square(k * k), twist / (k * k * shear * square_torsion), stretch / (k * k)};
}

TEST(Beam, StiffnessOfLayersConvergesForEveryPoissonRatio) {
  struct Row {
    Real nu;
    Index layers;
    Real bending;  // EI over E a^4 / 12, theory section 13.4
  };
  for (Row const& row :
       {Row{0.3, 2, 1.038}, Row{0.3, 4, 1.013}, Row{0.3, 6, 1.006}, Row{0, 2, 1}, Row{-0.9, 1, 1}, Row{0.49, 1, 1}}) {
    std::string const variant =
        "nu " + std::to_string(row.nu).substr(0, 4) + " " + std::to_string(row.layers) + " layers";
    Section const section = long_waves(row.layers, row.nu);
    // The theory has three decimals, read off beams of finite length, whose waves are 0.1 % slower.
    EXPECT_TRUE(
        evidence::near("S11", "infinite beam", variant, "EI / (E a^4 / 12)", section.bending, row.bending, 1.5e-3));
    EXPECT_TRUE(evidence::near("S8", "infinite beam", variant, "EA / (E a^2)", section.stretch, 1, 0.001));
    if (row.layers > 1) {
      EXPECT_TRUE(
          evidence::near("S9", "infinite beam", variant, "torsion / that of the square", section.torsion, 1, 0.01));
    }
  }
  // Extreme ratios: no locking towards 1/2, slow but sure towards -1.
  Index const most = evidence::full() ? 12 : 8;
  for (Real nu : {-0.9, -0.5, 0.45, 0.49, 0.499}) {
    Real const coarse = long_waves(most / 2, nu).bending - 1, fine = long_waves(most, nu).bending - 1;
    std::string const variant = "nu " + std::to_string(nu).substr(0, 5) + " " + std::to_string(most) + " layers";
    EXPECT_TRUE(
        evidence::at_most("S11", "infinite beam", variant, "EI / (E a^4 / 12) - 1", fine, nu < -0.6 ? 0.35 : 0.025));
    EXPECT_TRUE(
        evidence::at_most("S11", "infinite beam", variant, "that over half as many layers", fine / coarse, 0.35));
  }
}

}  // namespace
}  // namespace brisance::solid
