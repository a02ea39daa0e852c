// The largest frequency of the whole solid by Lanczos iteration.  Source: theory/solid.md section 11, "sharp value".
#define EIGEN_DONT_VECTORIZE  // as in stable_step.cpp
#include <Eigen/Eigenvalues>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

constexpr std::size_t width = 6;  // u, turn
using Rows = std::vector<double>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Triple<double> triple(double const* v) { return {v[0], v[1], v[2]}; }
void add(double* to, Triple<double> const& v, double sign) {
  to[0] += sign * v.x, to[1] += sign * v.y, to[2] += sign * v.z;
}

/// In [-1, 1], the same for a particle and component wherever it lives.
double random_number(GlobalId id, std::size_t component) {
  std::uint64_t z = static_cast<std::uint64_t>(id) * width + component + 1;
  z *= 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

Real exact_dot(parallel::Comm& comm, Rows const& a, Rows const& b, Index owned) {
  parallel::ExactSum sum;
  for (std::size_t n = 0; n < width * at(owned); ++n) sum.add(a[n] * b[n]);
  comm.sum(std::span(&sum, 1));
  return sum.value();
}

}  // namespace

Real Solid::estimated_limit(int products) {
  std::size_t const n = at(count_) + 1;  // the wall stays at rest
  std::array<bool, width> const moves{true,           dimension_ > 1, dimension_ > 2,
                                      dimension_ > 2, dimension_ > 2, dimension_ > 1};
  auto ends = [&](Rows const& x, std::size_t i, std::size_t j) {
    double const *a = &x[width * i], *b = &x[width * j];
    return SmallEnds<double>{triple(a), triple(a + 3), triple(b), triple(b + 3)};
  };
  Rows opened(n), pressure(n);
  /// K x of owned particles, restricted to what moves.
  auto stiffness = [&](Rows const& x, Rows& kx) {
    std::fill(opened.begin(), opened.end(), 0.0);
    std::fill(kx.begin(), kx.end(), 0.0);
    for (std::size_t k = 0; k < links_.count(); ++k) {
      std::size_t const i = at(links_.end_i(k)), j = at(links_.end_j(k));
      LinkRest<double> const rest = links_.rest(k);
      Real const volume = small_opened_volume(rest, ends(x, i, j));
      opened[i] += rest.weight * volume;
      opened[j] += (1 - rest.weight) * volume;
    }
    for (std::size_t p = 0; p + 1 < n; ++p) pressure[p] = bulk_[p] * opened[p];
    for (std::size_t k = 0; k < links_.count(); ++k) {
      std::size_t const i = at(links_.end_i(k)), j = at(links_.end_j(k));
      LinkWrench<double> const w = small_wrench(links_.rest(k), ends(x, i, j), pressure[i], pressure[j]);
      add(&kx[width * i], w.force, -1), add(&kx[width * i + 3], w.torque_i, -1);
      add(&kx[width * j], w.force, 1), add(&kx[width * j + 3], w.torque_j, 1);
    }
    for (Index l = 0; l < owned_; ++l)
      for (std::size_t c = 0; c < width; ++c)
        if (!moves[c] || motion_[at(l)].turns == 0) kx[width * at(l) + c] = 0;
  };
  /// M x, or M^-1 x, of owned free particles.
  auto mass = [&](Rows const& x, Rows& mx, bool inverted) {
    for (Index l = 0; l < owned_; ++l) {
      Real const inverse = motion_[at(l)].inverse_mass;
      if (inverse == 0) continue;
      Inertia const& inertia = inertia_[at(inertia_of_[at(l)])];
      double const* in = &x[width * at(l)];
      double* out = &mx[width * at(l)];
      Triple<double> const turned =
          symmetric_times(inverted ? inertia.inverse.data() : inertia.tensor.data(), triple(in + 3));
      for (std::size_t c = 0; c < 3; ++c) out[c] = inverted ? inverse * in[c] : in[c] / inverse;
      out[3] = turned.x, out[4] = turned.y, out[5] = turned.z;
    }
  };

  // Three-term recurrence in the product of M: q_k orthonormal, T = q^T K q tridiagonal.
  Rows q(width * n, 0.0), last(width * n, 0.0), kq(width * n), mq(width * n, 0.0), next(width * n, 0.0);
  for (Index l = 0; l < owned_; ++l)
    for (std::size_t c = 0; c < width; ++c)
      if (moves[c] && motion_[at(l)].turns != 0)
        q[width * at(l) + c] = random_number(id(l), c) / (c < 3 ? 1 : std::cbrt(mesh_.shape(id(l)).volume));
  mass(q, mq, false);
  Real norm = std::sqrt(exact_dot(comm_, q, mq, owned_));
  std::vector<double> diagonal, beside;
  for (int step = 0; step < products && norm > 0; ++step) {
    for (double& value : q) value /= norm;
    halo_.exchange_rows(comm_, std::span(q).first(width * at(count_)), width);
    stiffness(q, kq);
    Real const alpha = exact_dot(comm_, q, kq, owned_);
    if (step > 0) beside.push_back(norm);
    diagonal.push_back(alpha);
    mass(kq, next, true);
    for (std::size_t k = 0; k < width * at(owned_); ++k) next[k] -= alpha * q[k] + (step > 0 ? norm * last[k] : 0);
    std::swap(last, q);
    std::swap(q, next);
    mass(q, mq, false);
    norm = std::sqrt(exact_dot(comm_, q, mq, owned_));
    if (norm <= 1e-10 * alpha) break;  // all modes that the start contains have been found
  }
  if (diagonal.empty()) return 1e300;
  Eigen::Map<Eigen::VectorXd const> const d(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
  Eigen::VectorXd const e = Eigen::Map<Eigen::VectorXd const>(beside.data(), d.size() - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(d, e, Eigen::EigenvaluesOnly);
  Real const largest = solver.eigenvalues().maxCoeff();
  return largest > 0 ? 2 / std::sqrt(largest) : 1e300;
}

}  // namespace brisance::solid
