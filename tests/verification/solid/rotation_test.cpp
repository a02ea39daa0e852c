// S18 and S19 of theory/solid.md section 19: the rotation step of one rigid particle.
#include <gtest/gtest.h>

// Scalar Eigen: GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;

/// Brick of unit mass scale with J = diag(a, b, c): sides from K = (b + c - a, a + c - b, a + b - c) / 2.
SolidConfig brick(Real a, Real b, Real c, Real thinnest) {
  Vec3 const k{0.5 * (b + c - a), 0.5 * (a + c - b), 0.5 * (a + b - c)};
  Vec3 const side{std::sqrt(12 * k.x), std::sqrt(12 * k.y), max(std::sqrt(12 * k.z), thinnest)};
  SolidConfig config = testing::one_material(1 / (side.x * side.y * side.z), 1, 0);
  config.body.push_back(testing::box(-0.5 * side, 0.5 * side, {1, 1, 1}));
  return config;
}

Vec3 body_rate(Lone const& lone, Vec3 const& inertia) {
  Vec3 const spin = rotate(conjugate(lone.solid.pose()[0].q), lone.solid.motion()[0].spin);
  return {spin.x / inertia.x, spin.y / inertia.y, spin.z / inertia.z};
}

TEST(FreeParticle, TumblesAboutItsMiddleAxis) {
  // diag(1, 2, 3) is a flat body: a millionth of a thickness stands for none.
  SolidConfig config = brick(1, 2, 3, 1e-6);
  config.body[0].spin = {1e-3, 1, 1e-3};
  Real const first_zero = 14.905939;
  struct Level {
    Real dt, early;
  };
  for (Level const& level : {Level{0.04, 6.6e-3}, Level{0.02, 1.7e-3}, Level{0.01, 4.1e-4}, Level{0.005, 1.0e-4}}) {
    Lone lone(config);
    Vec3 const spin0 = lone.solid.motion()[0].spin;
    Real const energy0 = lone.energy();
    Real zero = 0, energy_error = 0, spin_error = 0, previous = 1;
    for (int n = 1; n * level.dt < 100; ++n) {
      lone.solid.step(level.dt);
      Real const rate = body_rate(lone, {1, 2, 3}).y;
      if (zero == 0 && rate < 0) zero = (n - rate / (rate - previous)) * level.dt;
      previous = rate;
      energy_error = max(energy_error, std::abs(lone.energy() / energy0 - 1));
      spin_error = max(spin_error, norm(lone.solid.motion()[0].spin - spin0) / norm(spin0));
    }
    std::string const variant = "dt " + std::to_string(level.dt).substr(0, 5);
    // Two digits are known of the delay: 6 % covers their rounding.
    EXPECT_TRUE(evidence::near("S18", "free rigid particle", variant, "first zero of Omega_2 early by",
                               first_zero - zero, level.early, 0.06 * level.early));
    EXPECT_TRUE(evidence::at_most("S18", "free rigid particle", variant, "energy error", energy_error, 1e-13));
    EXPECT_TRUE(evidence::at_most("S18", "free rigid particle", variant, "angular momentum error", spin_error, 1e-13));
  }
}

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

Matrix skew(Vector const& v) {
  Matrix m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The published step: P = dQ/dt D, symmetric multipliers for Q^T Q = 1 and its rate.
class Literal {
 public:
  Literal(Vector const& d, Vector const& rate) : d_(d.asDiagonal()), p_(q_ * skew(rate) * d_) {}
  Matrix const& q() const { return q_; }

  template <class Torque>
  void step(Real dt, Torque torque) {
    Matrix const inverse = d_.diagonal().cwiseInverse().asDiagonal();
    Matrix const kicked = p_ + dt / 4 * skew(torque(q_)) * q_;
    Eigen::Matrix<double, 6, 1> s = Eigen::Matrix<double, 6, 1>::Zero();
    auto symmetric = [](Eigen::Matrix<double, 6, 1> const& v) {
      Matrix m;
      m << v(0), v(3), v(4), v(3), v(1), v(5), v(4), v(5), v(2);
      return m;
    };
    auto half_way = [&](Eigen::Matrix<double, 6, 1> const& v) -> Matrix { return kicked + q_ * symmetric(v); };
    auto turned = [&](Eigen::Matrix<double, 6, 1> const& v) -> Matrix { return q_ + dt * half_way(v) * inverse; };
    auto error = [&](Eigen::Matrix<double, 6, 1> const& v) {
      Matrix const f = turned(v), g = f.transpose() * f - Matrix::Identity();
      Eigen::Matrix<double, 6, 1> e;
      e << g(0, 0), g(1, 1), g(2, 2), g(0, 1), g(0, 2), g(1, 2);
      return e;
    };
    for (int it = 0; it < 8; ++it) {
      Eigen::Matrix<double, 6, 6> jacobian;
      for (int c = 0; c < 6; ++c) {
        Eigen::Matrix<double, 6, 1> const h = 1e-4 * Eigen::Matrix<double, 6, 1>::Unit(c);
        jacobian.col(c) = (error(s + h) - error(s - h)) / 2e-4;  // the error is quadratic: exact
      }
      s -= jacobian.fullPivLu().solve(error(s));
    }
    Matrix const half = half_way(s);
    q_ = turned(s);
    Matrix const a = q_.transpose() * (half + dt / 4 * skew(torque(q_)) * q_);
    Matrix multiplier;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        multiplier(i, j) = -(a(i, j) * inverse(j, j) + a(j, i) * inverse(i, i)) / (inverse(i, i) + inverse(j, j));
    p_ = q_ * (a + multiplier);
  }

 private:
  Matrix q_ = Matrix::Identity(), d_, p_;
};

TEST(ForcedTop, FollowsTheLiteralSchemeWithMatricesAndMultipliers) {
  Vec3 const inertia{1.5, 2.2, 2.9};
  SolidConfig config = brick(inertia.x, inertia.y, inertia.z, 0);
  config.body[0].spin = {0.4, 0.3, 0.8};
  Lone lone(config);
  Vector const d(0.5 * (inertia.y + inertia.z - inertia.x), 0.5 * (inertia.x + inertia.z - inertia.y),
                 0.5 * (inertia.x + inertia.y - inertia.z));
  Literal literal(d, {0.4, 0.3, 0.8});
  // A weight hung off the centre: torque (R a) x g, weak enough for the top not to tumble chaotically, which would
  // amplify the rounding of the literal solver.
  Vector const arm(0.2, 0.1, 0.5), weight(0, 0, -0.2);
  auto torque = [&](Matrix const& q) -> Vector { return (q * arm).cross(weight); };
  auto apply = [&] {
    Vec3 const a = rotate(lone.solid.pose()[0].q, {0.2, 0.1, 0.5});
    lone.solid.load()[0].torque = cross(a, {0, 0, -0.2});
  };
  Real const dt = 0.02;
  Real difference = 0;
  apply();
  for (int n = 0; n < 2000; ++n) {
    lone.solid.half_kick(dt);
    lone.solid.drift(dt);
    apply();
    lone.solid.half_kick(dt);
    literal.step(dt, torque);
    Mat3 const r = matrix(lone.solid.pose()[0].q);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) difference = max(difference, std::abs(r[i][j] - literal.q()(i, j)));
  }
  EXPECT_TRUE(evidence::at_most("S19", "forced top", "2000 steps", "largest difference of Q", difference, 1e-10));
}

}  // namespace
}  // namespace brisance::solid
