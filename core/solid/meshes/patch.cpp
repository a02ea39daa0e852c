#include "core/solid/meshes/patch.hpp"

#include <algorithm>
#include <queue>

// Scalar Eigen: small systems, and GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
std::size_t at(GlobalId i) { return static_cast<std::size_t>(i); }

/// Displacement and small rotation of a particle, or force and torque.
struct Twist {
  Vec3 u{}, turn{};
};
using Field = std::vector<Twist>;

Real dot(Field const& a, Field const& b) {
  Real sum = 0;
  for (std::size_t p = 0; p < a.size(); ++p) sum += brisance::dot(a[p].u, b[p].u) + brisance::dot(a[p].turn, b[p].turn);
  return sum;
}

}  // namespace

Patch::Patch(Mesh const& mesh, Index body, GlobalId most) : dimension_(mesh.dimension) {
  Vec3 const middle = mesh.bodies[at(body)].centre;
  // The nearest first; ties by number, so that the choice is the same everywhere.
  using Candidate = std::pair<Real, GlobalId>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open;
  std::vector<char> seen(at(mesh.size()), 0);
  Candidate first{1e300, 0};
  for (GlobalId p = 0; p < mesh.size(); ++p)
    if (mesh.particle(p).body == body) first = std::min(first, Candidate{norm2(mesh.particle(p).centre - middle), p});
  open.push(first);
  seen[at(first.second)] = 1;
  std::vector<GlobalId> chosen;
  while (!open.empty() && static_cast<GlobalId>(chosen.size()) < most) {
    GlobalId const p = open.top().second;
    open.pop();
    chosen.push_back(p);
    for (std::size_t l : mesh.links_of(p)) {
      Link const& link = mesh.links[l];
      GlobalId const q = link.i == p ? link.j : link.i;
      if (q == Link::wall || seen[at(q)]) continue;
      seen[at(q)] = 1;
      open.push({norm2(mesh.particle(q).centre - middle), q});
    }
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<Index> place(at(mesh.size()), -1);
  for (GlobalId p : chosen) {
    place[at(p)] = static_cast<Index>(cells_.size());
    Vec3 const x = mesh.particle(p).centre;
    cells_.push_back({x, x + mesh.shape(p).pole, mesh.shape(p).volume});
  }
  for (GlobalId p : chosen) {
    Index const here = place[at(p)];
    for (std::size_t l : mesh.links_of(p)) {
      Link const& link = mesh.links[l];
      FaceGeometry const& f = mesh.face(link.i, link.face_i);
      Real const distance = face_distance(mesh, link, p);
      Vec3 const arm = mesh.particle(link.i).centre + f.centroid - mesh.particle(p).centre;
      bool const first_end = link.i == p;
      Index const other = link.j == Link::wall ? -1 : place[at(first_end ? link.j : link.i)];
      if (other < 0) {
        if (link.j == Link::wall) continue;  // among the free faces
        faces_.push_back({here, f.area, distance, first_end ? f.normal : -f.normal, arm});
      } else if (first_end) {
        Vec3 const arm_j = arm + mesh.particle(p).centre - mesh.particle(link.j).centre;
        ties_.push_back(
            {here, other, f.area, link.rest_length, distance / link.rest_length, f.normal, arm, arm_j, f.second});
      }
    }
    for (FreeFace const& free : mesh.free_faces_of(p)) {
      FaceGeometry const& f = mesh.face(p, free.face);
      faces_.push_back({here, f.area, free.distance, f.normal, f.centroid});
    }
  }
}

/// The linearised links of a patch: K x, the load, a diagonal to precondition with.
class PatchSystem {
 public:
  PatchSystem(Patch const& patch, Real poisson_ratio)
      : patch_(patch),
        shear_(1 / (2 * (1 + poisson_ratio))),
        lame_(2 * shear_ * poisson_ratio / (1 - 2 * poisson_ratio)),
        effective_volume_(patch.cells_.size()) {
    for (std::size_t p = 0; p < patch.cells_.size(); ++p) effective_volume_[p] = patch.cells_[p].volume;
    for (auto const& f : patch.faces_) effective_volume_[at(f.cell)] += lame_ / (2 * shear_) * f.area * f.distance;
    for (auto const& t : patch.ties_) {
      Real const polar = trace(t.second);
      Mat3 const nn = outer(t.normal, t.normal);
      bending_.push_back((1 / t.length) * ((shear_ * polar) * nn + polar * (Mat3::identity() - nn) - t.second));
    }
  }

  /// K x; in 2D and 1D only the freedoms that move.
  Field times(Field const& x) const {
    std::vector<Real> opened(x.size(), 0);
    for (auto const& t : patch_.ties_) {
      Real const gap = brisance::dot(gap_of(t, x), t.normal) * t.area;
      opened[at(t.i)] += t.weight * gap;
      opened[at(t.j)] += (1 - t.weight) * gap;
    }
    for (std::size_t p = 0; p < opened.size(); ++p) opened[p] *= lame_ / effective_volume_[p];
    Field y(x.size());
    for (std::size_t k = 0; k < patch_.ties_.size(); ++k) {
      auto const& t = patch_.ties_[k];
      Real const pressure = t.weight * opened[at(t.i)] + (1 - t.weight) * opened[at(t.j)];
      Vec3 const f = (2 * shear_ * t.area / t.length) * gap_of(t, x) + (pressure * t.area) * t.normal;
      Vec3 const m = bending_[k] * (x[at(t.j)].turn - x[at(t.i)].turn);
      y[at(t.i)].u -= f;
      y[at(t.j)].u += f;
      y[at(t.i)].turn -= cross(t.arm_i, f) + m;
      y[at(t.j)].turn += cross(t.arm_j, f) + m;
    }
    hold(y);
    return y;
  }

  Field load(Mat3 const& stress) const {
    Field f(patch_.cells_.size());
    std::vector<Real> opened(f.size(), 0);
    for (auto const& face : patch_.faces_) {
      Vec3 const t = face.area * (stress * face.normal);
      f[at(face.cell)].u += t;
      f[at(face.cell)].turn += cross(face.arm, t);
      opened[at(face.cell)] += face.distance / (2 * shear_) * brisance::dot(t, face.normal);
    }
    for (std::size_t p = 0; p < opened.size(); ++p) opened[p] *= lame_ / effective_volume_[p];
    for (auto const& t : patch_.ties_) {
      Vec3 const force = ((t.weight * opened[at(t.i)] + (1 - t.weight) * opened[at(t.j)]) * t.area) * t.normal;
      f[at(t.i)].u += force;
      f[at(t.j)].u -= force;
      f[at(t.i)].turn += cross(t.arm_i, force);
      f[at(t.j)].turn -= cross(t.arm_j, force);
    }
    hold(f);
    return f;
  }

  /// Stiffness of each particle against its own moves, one number for displacements and one for turns.
  std::vector<std::pair<Real, Real>> diagonal() const {
    std::vector<std::pair<Real, Real>> d(patch_.cells_.size(), {0, 0});
    for (std::size_t k = 0; k < patch_.ties_.size(); ++k) {
      auto const& t = patch_.ties_[k];
      Real const stiffness = (2 * shear_ + max(lame_, 0) / 3) * t.area / t.length;
      for (auto const& [p, arm] : {std::pair(t.i, t.arm_i), std::pair(t.j, t.arm_j)}) {
        d[at(p)].first += stiffness;
        d[at(p)].second += stiffness * 2 * norm2(arm) / 3 + trace(bending_[k]) / 3;
      }
    }
    return d;
  }

 private:
  Vec3 gap_of(Patch::Tie const& t, Field const& x) const {
    Twist const &i = x[at(t.i)], &j = x[at(t.j)];
    return (j.u + cross(j.turn, t.arm_j)) - (i.u + cross(i.turn, t.arm_i));
  }
  void hold(Field& y) const {
    int const d = patch_.dimension_;
    if (d == 3) return;
    for (Twist& t : y) {
      t.u = {t.u.x, d > 1 ? t.u.y : 0, 0};
      t.turn = {0, 0, d > 1 ? t.turn.z : 0};
    }
  }
  Patch const& patch_;
  Real shear_, lame_;
  std::vector<Real> effective_volume_;
  std::vector<Mat3> bending_;  // C / D
};

Patch::Response Patch::respond(Mat3 const& stress, Real poisson_ratio, Real tolerance) const {
  PatchSystem const system(*this, poisson_ratio);
  Field x(cells_.size()), residual = system.load(stress), direction, preconditioned(x.size());
  auto const diagonal = system.diagonal();
  auto precondition = [&] {
    for (std::size_t p = 0; p < x.size(); ++p) {
      auto const [s, m] = diagonal[p];
      preconditioned[p] = {residual[p].u / (s > 0 ? s : 1), residual[p].turn / (m > 0 ? m : 1)};
    }
  };
  precondition();
  direction = preconditioned;
  Real size = dot(residual, preconditioned);
  Real const goal = square(tolerance) * size;
  Response r;
  // A linked patch has no more than six directions without stiffness, and the load has no part in them.
  int const most = 20000;
  for (; r.iterations < most && size > goal; ++r.iterations) {
    Field const k = system.times(direction);
    Real const step = size / dot(direction, k);
    for (std::size_t p = 0; p < x.size(); ++p) {
      x[p].u += step * direction[p].u;
      x[p].turn += step * direction[p].turn;
      residual[p].u -= step * k[p].u;
      residual[p].turn -= step * k[p].turn;
    }
    precondition();
    Real const next = dot(residual, preconditioned), ratio = next / size;
    size = next;
    for (std::size_t p = 0; p < x.size(); ++p) {
      direction[p].u = preconditioned[p].u + ratio * direction[p].u;
      direction[p].turn = preconditioned[p].turn + ratio * direction[p].turn;
    }
  }
  r.converged = size <= goal;

  // Least squares of the displacements of the poles.
  Vec3 mean_x{}, mean_u{};
  std::vector<Vec3> u;
  for (std::size_t p = 0; p < x.size(); ++p) {
    u.push_back(x[p].u + cross(x[p].turn, cells_[p].pole - cells_[p].centre));
    mean_x += cells_[p].pole;
    mean_u += u.back();
  }
  Real const n = static_cast<Real>(x.size());
  mean_x = mean_x / n, mean_u = mean_u / n;
  Eigen::Matrix3d xx = Eigen::Matrix3d::Zero(), ux = Eigen::Matrix3d::Zero();
  for (std::size_t p = 0; p < x.size(); ++p)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        xx(a, b) += (cells_[p].pole[a] - mean_x[a]) * (cells_[p].pole[b] - mean_x[b]);
        ux(a, b) += (u[p][a] - mean_u[a]) * (cells_[p].pole[b] - mean_x[b]);
      }
  // A single layer says nothing about the gradient across it: the smallest such gradient.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const axes(xx);
  for (int a = 0; a < 3; ++a) {
    Real unknown = 0;
    for (int k = 0; k < 3; ++k)
      if (axes.eigenvalues()[k] < 1e-6 * axes.eigenvalues()[2]) unknown += square(axes.eigenvectors()(a, k));
    r.spans[static_cast<std::size_t>(a)] = unknown < 1e-6;
  }
  Eigen::Matrix3d const gradient = ux * xx.completeOrthogonalDecomposition().pseudoInverse();
  for (int a = 0; a < 3; ++a) r.gradient[a] = {gradient(a, 0), gradient(a, 1), gradient(a, 2)};
  Real off = 0, all = 0;
  Mat3 const strain = 0.5 * (r.gradient + transpose(r.gradient));
  for (std::size_t p = 0; p < x.size(); ++p) {
    Vec3 const y = cells_[p].pole - mean_x;
    off += norm2(u[p] - mean_u - r.gradient * y);
    all += norm2(strain * y);
  }
  r.scatter = all > 0 ? std::sqrt(off / all) : 0;
  return r;
}

PatchModuli measure_moduli(Patch const& patch, Real nu, Real tolerance) {
  PatchModuli m;
  auto keep = [](Real& worst, Real value) {
    if (std::abs(value) > std::abs(worst)) worst = value;
  };
  int const d = patch.dimension();
  bool const plane = d == 2;  // plane strain: E e_xx = (1 - nu^2) sigma, e_yy / e_xx = -nu / (1 - nu)
  Real const stretch = plane ? 1 - nu * nu : 1;
  for (int a = 0; a < d; ++a)
    for (int b = a; b < d; ++b) {
      Mat3 stress{};
      stress[a][b] = stress[b][a] = 1;
      auto const r = patch.respond(stress, nu, tolerance);
      m.converged = m.converged && r.converged;
      if (!r.spans[at(a)] || !r.spans[at(b)]) continue;
      m.scatter = max(m.scatter, r.scatter);
      if (a != b) {
        keep(m.shear, 2 * (1 + nu) / (r.gradient[a][b] + r.gradient[b][a]) - 1);
        m.shearing = true;
        continue;
      }
      keep(m.young, stretch / r.gradient[a][a] - 1);
      m.stretch = true;
      for (int c = 0; c < d; ++c) {
        if (c == a || !r.spans[at(c)]) continue;
        Real const ratio = -r.gradient[c][c] / r.gradient[a][a];
        keep(m.poisson, (plane ? ratio / (1 + ratio) : ratio) - nu);
        m.squeeze = true;
      }
    }
  return m;
}

}  // namespace brisance::solid
