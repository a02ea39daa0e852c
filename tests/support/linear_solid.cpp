#include "tests/support/linear_solid.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tests/support/solids.hpp"

namespace brisance::testing {
namespace {

using solid::Freedom;
using solid::Mesh;
using solid::Pose;
using solid::Solid;
using solid::Wrench;

std::size_t at(GlobalId id) { return static_cast<std::size_t>(id); }

Real component(Wrench const& w, std::size_t freedom) {
  int const d = static_cast<int>(freedom % 3);
  return freedom < 3 ? w.force[d] : w.torque[d];
}

void displace(Pose& pose, std::size_t freedom, Real by) {
  Vec3 v{};
  v[static_cast<int>(freedom % 3)] = by;
  if (freedom < 3)
    pose.x += v;
  else
    pose.q = rotation(v) * pose.q;
}

/// Particles within some links of one another.
class Neighbourhood {
 public:
  explicit Neighbourhood(Mesh const& mesh) : mesh_(mesh), seen_(at(mesh.size()), -1) {}
  /// Those within `hops` links of p, p first.
  std::vector<GlobalId> around(GlobalId p, int hops) {
    ++stamp_;
    std::vector<GlobalId> found{p};
    seen_[at(p)] = stamp_;
    std::size_t first = 0;
    for (int hop = 0; hop < hops; ++hop) {
      std::size_t const last = found.size();
      for (; first < last; ++first)
        for (std::size_t l : mesh_.links_of(found[first])) {
          solid::Link const& link = mesh_.links[l];
          if (link.j == solid::Link::wall) continue;
          GlobalId const other = link.i == found[first] ? link.j : link.i;
          if (seen_[at(other)] == stamp_) continue;
          seen_[at(other)] = stamp_;
          found.push_back(other);
        }
    }
    return found;
  }

 private:
  Mesh const& mesh_;
  std::vector<int> seen_;
  int stamp_ = 0;
};

/// Groups of particles that no particle feels together: a force reaches two links far, through the strain.
std::vector<std::vector<GlobalId>> groups(Mesh const& mesh, std::vector<GlobalId> const& particles) {
  Neighbourhood near(mesh);
  std::vector<int> colour(at(mesh.size()), -1);
  std::vector<std::vector<GlobalId>> groups;
  for (GlobalId p : particles) {
    std::vector<char> taken(groups.size() + 1, 0);
    for (GlobalId q : near.around(p, 4))
      if (colour[at(q)] >= 0) taken[static_cast<std::size_t>(colour[at(q)])] = 1;
    auto const c = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (c == groups.size()) groups.emplace_back();
    groups[c].push_back(p);
    colour[at(p)] = static_cast<int>(c);
  }
  return groups;
}

/// Internal forces and loads of the particles that move, at the present poses.
Eigen::VectorXd unbalanced(Solid& solid, LinearSolid const& linear) {
  solid.compute_forces();
  Eigen::VectorXd f(linear.row(linear.count()));
  for (std::size_t s = 0; s < linear.count(); ++s)
    for (std::size_t g = 0; g < linear.freedom.size(); ++g)
      f(linear.row(s, g)) = component(solid.internal()[at(linear.particles[s])], linear.freedom[g]) +
                            component(solid.load()[at(linear.particles[s])], linear.freedom[g]);
  return f;
}

Sparse symmetric(Sparse const& k) {
  Sparse const transposed = k.transpose();
  return 0.5 * (k + transposed);
}

}  // namespace

LinearSolid linearise(Solid& solid) {
  Mesh const& mesh = solid.mesh();
  LinearSolid out;
  if (mesh.dimension == 3) out.freedom = {0, 1, 2, 3, 4, 5};
  if (mesh.dimension == 2) out.freedom = {0, 1, 5};
  if (mesh.dimension == 1) out.freedom = {0};
  std::vector<std::size_t> slot(at(mesh.size()));
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    if (mesh.particle(p).freedom != Freedom::free) continue;
    slot[at(p)] = out.count();
    out.particles.push_back(p);
    out.centre.push_back(mesh.particle(p).centre);
    out.pole.push_back(mesh.particle(p).centre + mesh.shape(p).pole);
  }
  Neighbourhood near(mesh);
  Solid::Saved state;
  solid.save(state);
  auto const poses = solid.pose();
  auto const forces = solid.internal();
  std::vector<Eigen::Triplet<double>> k, m;

  for (auto const& group : groups(mesh, out.particles)) {
    std::vector<std::vector<GlobalId>> felt;
    for (GlobalId p : group) felt.push_back(near.around(p, 2));
    for (std::size_t f = 0; f < out.freedom.size(); ++f) {
      // Forces are linear in a shift and torques at most quadratic: one wide central difference is exact. In a turn
      // they are sines and cosines: sixth order.
      bool const turn = out.freedom[f] >= 3;
      std::vector<Real> const weights = turn ? std::vector<Real>{0.75, -0.15, 1.0 / 60} : std::vector<Real>{0.5};
      auto step = [&](GlobalId p) { return turn ? 0.01 : 0.05 * std::cbrt(mesh.shape(p).volume); };
      std::vector<std::vector<Real>> column;
      for (auto const& rows : felt) column.emplace_back(rows.size() * out.freedom.size(), 0.0);
      for (std::size_t w = 0; w < weights.size(); ++w)
        for (Real side : {-1.0, 1.0}) {
          for (GlobalId p : group) displace(poses[at(p)], out.freedom[f], side * static_cast<Real>(w + 1) * step(p));
          solid.compute_forces();
          for (std::size_t c = 0; c < group.size(); ++c) {
            for (std::size_t r = 0; r < felt[c].size(); ++r)
              for (std::size_t g = 0; g < out.freedom.size(); ++g)
                column[c][r * out.freedom.size() + g] -=
                    side * weights[w] * component(forces[at(felt[c][r])], out.freedom[g]) / step(group[c]);
            poses[at(group[c])] = state.pose[at(group[c])];
          }
        }
      for (std::size_t c = 0; c < group.size(); ++c)
        for (std::size_t r = 0; r < felt[c].size(); ++r) {
          if (mesh.particle(felt[c][r]).freedom != Freedom::free) continue;
          for (std::size_t g = 0; g < out.freedom.size(); ++g)
            k.emplace_back(out.row(slot[at(felt[c][r])], g), out.row(slot[at(group[c])], f),
                           column[c][r * out.freedom.size() + g]);
        }
    }
  }
  solid.restore(state);

  for (std::size_t s = 0; s < out.count(); ++s) {
    Mat3 const r = matrix(poses[at(out.particles[s])].q);
    Mat3 const inertia = r * mesh.inertia(out.particles[s]) * transpose(r);
    for (std::size_t f = 0; f < out.freedom.size(); ++f)
      for (std::size_t g = 0; g < out.freedom.size(); ++g) {
        std::size_t const a = out.freedom[f], b = out.freedom[g];
        if (a < 3 && a == b) m.emplace_back(out.row(s, f), out.row(s, g), mesh.particle(out.particles[s]).mass);
        if (a >= 3 && b >= 3)
          m.emplace_back(out.row(s, f), out.row(s, g), inertia[static_cast<int>(a - 3)][static_cast<int>(b - 3)]);
      }
  }
  Eigen::Index const n = out.row(out.count());
  Real largest = 0;
  for (auto const& t : k) largest = max(largest, std::abs(t.value()));
  out.stiffness.resize(n, n);
  out.stiffness.setFromTriplets(k.begin(), k.end());
  out.stiffness.prune(largest, 1e-14);  // what rounding left of entries that are zero
  out.mass.resize(n, n);
  out.mass.setFromTriplets(m.begin(), m.end());
  return out;
}

Modes lowest_modes(LinearSolid const& solid, int count, Real shift) {
  Sparse const k = symmetric(solid.stiffness);
  Sparse const shifted = k + shift * solid.mass;
  Eigen::SimplicialLDLT<Sparse> const solver(shifted);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the shifted stiffness has no factors");
  // Block Krylov space of the shifted inverse with Rayleigh-Ritz: blocks, because modes of squares and balls come in
  // multiplets, which a single vector would see once.
  Eigen::Index const n = k.rows(), block = std::min<Eigen::Index>(n, 8), most = std::min<Eigen::Index>(n, 60 * block);
  Eigen::MatrixXd basis(n, most);
  Eigen::Index size = 0;
  Random random(11);
  Eigen::MatrixXd next(n, block);
  for (Eigen::Index c = 0; c < block; ++c)
    for (Eigen::Index r = 0; r < n; ++r) next(r, c) = random();
  Eigen::VectorXd previous = Eigen::VectorXd::Zero(count);
  while (true) {
    Eigen::Index const first = size;
    for (Eigen::Index c = 0; c < next.cols() && size < most; ++c) {
      Eigen::VectorXd v = next.col(c);
      Real const before = std::sqrt(v.dot(solid.mass * v));
      for (int pass = 0; pass < 2; ++pass)
        v -= basis.leftCols(size) * (basis.leftCols(size).transpose() * (solid.mass * v)).eval();
      Real const after = std::sqrt(v.dot(solid.mass * v));
      if (after > 1e-9 * before) basis.col(size++) = v / after;
    }
    auto const q = basis.leftCols(size);
    Eigen::MatrixXd const small = q.transpose() * (k * q);
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const ritz(small);
    if (size >= count) {
      Eigen::VectorXd const now = ritz.eigenvalues().head(count);
      bool const still = (now - previous).cwiseAbs().maxCoeff() <= 1e-9 * (now(count - 1) + shift);
      if (still || size == n) return {now, q * ritz.eigenvectors().leftCols(count)};
      previous = now;
    }
    if (size == most || size == first) throw std::runtime_error("the modes do not converge");
    next = solver.solve((solid.mass * basis.middleCols(first, size - first)).eval());
  }
}

Eigen::VectorXd response(Solid& solid, LinearSolid const& linear, Real anchor) {
  Eigen::SimplicialLDLT<Sparse> const solver(symmetric(linear.stiffness) + anchor * linear.mass);
  Eigen::VectorXd const f = unbalanced(solid, linear);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(f.size()), left = f;
  while (true) {  // takes back what the anchor did, down to rounding
    Eigen::VectorXd const better = u + solver.solve(left), rest = f - linear.stiffness * better;
    if (rest.norm() > 0.5 * left.norm()) break;
    u = better, left = rest;
  }
  if (left.norm() <= 1e-9 * f.norm()) return u;
  throw std::runtime_error("the loads do not balance");
}

Eigen::VectorXd bloch_waves(LinearSolid const& solid, std::vector<std::size_t> const& cell,
                            std::function<int(std::size_t)> const& twin, Vec3 const& wave_vector) {
  std::size_t const f = solid.freedom.size();
  auto const n = static_cast<Eigen::Index>(cell.size() * f);
  Eigen::MatrixXcd k = Eigen::MatrixXcd::Zero(n, n), m = Eigen::MatrixXcd::Zero(n, n);
  std::vector<int> place(solid.count(), -1);
  for (std::size_t c = 0; c < cell.size(); ++c) place[cell[c]] = static_cast<int>(c);
  for (Eigen::Index column = 0; column < solid.stiffness.outerSize(); ++column) {
    std::size_t const q = static_cast<std::size_t>(column) / f;
    int const repeats = twin(q);
    if (repeats < 0) continue;
    Vec3 const apart = solid.centre[q] - solid.centre[cell[static_cast<std::size_t>(repeats)]];
    std::complex<double> const phase = std::polar(1.0, dot(wave_vector, apart));
    Eigen::Index const to = repeats * static_cast<Eigen::Index>(f) + column % static_cast<Eigen::Index>(f);
    auto add = [&](Sparse const& from, Eigen::MatrixXcd& into, std::complex<double> factor) {
      for (Sparse::InnerIterator it(from, column); it; ++it) {
        int const row = place[static_cast<std::size_t>(it.row()) / f];
        if (row < 0) continue;
        into(row * static_cast<Eigen::Index>(f) + it.row() % static_cast<Eigen::Index>(f), to) += factor * it.value();
      }
    };
    add(solid.stiffness, k, phase);
    add(solid.mass, m, 1.0);
  }
  k = (0.5 * (k + k.adjoint())).eval();
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd>(k, m, Eigen::EigenvaluesOnly | Eigen::Ax_lBx)
      .eigenvalues();
}

Real balance(Solid& solid, Real tolerance, Real anchor) {
  Real left = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    LinearSolid const linear = linearise(solid);
    Eigen::VectorXd const f = unbalanced(solid, linear);
    left = f.cwiseAbs().maxCoeff();
    if (left <= tolerance) return left;
    Eigen::SparseLU<Sparse> solver;
    solver.compute(linear.stiffness + anchor * linear.mass);
    if (solver.info() != Eigen::Success) throw std::runtime_error("the stiffness is singular: anchor the body");
    Eigen::VectorXd step = solver.solve(f);
    // The forces of a slender body first rise along the way to its equilibrium: only the turns of a step are bounded.
    Real largest_turn = 0;
    for (std::size_t s = 0; s < linear.count(); ++s)
      for (std::size_t g = 0; g < linear.freedom.size(); ++g)
        if (linear.freedom[g] >= 3) largest_turn = max(largest_turn, std::abs(step(linear.row(s, g))));
    if (largest_turn > 0.2) step *= 0.2 / largest_turn;
    for (std::size_t s = 0; s < linear.count(); ++s)
      for (std::size_t g = 0; g < linear.freedom.size(); ++g)
        displace(solid.pose()[at(linear.particles[s])], linear.freedom[g], step(linear.row(s, g)));
  }
  char text[64];
  std::snprintf(text, sizeof text, "no equilibrium found: %.3g N are left", left);
  throw std::runtime_error(text);
}

}  // namespace brisance::testing
