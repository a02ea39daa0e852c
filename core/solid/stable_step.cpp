// The guaranteed stable step.  Source: theory/solid.md section 11.
// Scalar Eigen: done once, and GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>
#include <algorithm>
#include <map>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Eigen::Vector3d eigen(Vec3 const& v) { return {v.x, v.y, v.z}; }
Eigen::Matrix3d eigen(Mat3 const& m) {
  Eigen::Matrix3d e;
  for (int r = 0; r < 3; ++r) e.row(r) = eigen(m[r]).transpose();
  return e;
}

/// One link seen from one of its ends: outward normal, arm and the weight of that end.
struct End {
  FaceGeometry const* face;
  Vec3 arm, normal;
  Real weight;
  GlobalId other;  ///< whose strain the link enters: at a mirror the particle itself, Link::wall at a wall
};

End end_of(Mesh const& mesh, Link const& link, GlobalId p) {
  FaceGeometry const& face = mesh.face(link.i, link.face_i);
  if (link.i == p) return {&face, face.centroid, face.normal, link.weight, mesh.is_mirror(link) ? p : link.j};
  return {&face, mesh.particle(link.i).centre + face.centroid - mesh.shift(link) - mesh.particle(p).centre,
          -face.normal, 1 - link.weight, link.i};
}

Vector6 generalized_normal(End const& e) {
  Vector6 g;
  g << eigen(e.normal), eigen(cross(e.arm, e.normal));
  return g;
}

/// B = [1  -[arm]x]: displacement of a point by (u, theta).
Eigen::Matrix<double, 3, 6> moved_by(Vec3 const& arm) {
  Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();
  b.leftCols<3>().setIdentity();
  for (int c = 0; c < 3; ++c) {
    Vec3 axis{};
    axis[c] = 1;
    b.col(3 + c) = eigen(cross(axis, arm));
  }
  return b;
}

/// Of a boundary face from the pole, m.
Real distance(Mesh const& mesh, GlobalId p, FaceGeometry const& face) {
  return dot(face.centroid - mesh.shape(p).pole, face.normal);
}

/// How the strain of a particle depends on the others and on itself: A_J / V~_J and b_J.
struct StrainBound {
  Real ratio = 0;  ///< sum of w^2 S D over the effective volume, 1 (dimensionless)
  Vector6 own = Vector6::Zero();
  bool cancels = true;  ///< does its own displacement drop out of its strain?
  Real volume = 0;      ///< effective volume, m3
};

/// `held`: faces of `p` that count as clamped.
StrainBound strain_bound(Mesh const& mesh, GlobalId p, std::vector<int> const& held) {
  StrainBound bound;
  bound.volume = mesh.particle(p).effective_volume;
  Real scale = 0, size = 0;
  for (std::size_t l : mesh.links_of(p)) {
    Link const& link = mesh.links[l];
    End const e = end_of(mesh, link, p);
    if (e.other != Link::wall) bound.ratio += e.weight * e.weight * e.face->area * link.rest_length;
    bound.own += e.weight * e.face->area * generalized_normal(e);
    scale += e.weight * e.face->area;
    size = max(size, norm(e.arm));
  }
  for (int const f : held) {
    FaceGeometry const& face = mesh.face(p, f);
    bound.own += face.area * generalized_normal({&face, face.centroid, face.normal, 1, Link::wall});
    bound.volume -= mesh.material(p).free_ratio() * face.area * distance(mesh, p, face);
    scale += face.area;
    size = max(size, norm(face.centroid));
  }
  bound.ratio /= bound.volume;
  bound.cancels = bound.own.head<3>().norm() <= 1e-9 * scale && bound.own.tail<3>().norm() <= 1e-9 * scale * size;
  return bound;
}

/// |g| in the metric of the inverse mass of a particle; 0 if it is held.
Real size(Mesh const& mesh, GlobalId p, Vector6 const& g, std::vector<int> const& moving) {
  if (mesh.particle(p).freedom != Freedom::free) return 0;
  Matrix6 m = Matrix6::Zero();
  m.diagonal().head<3>().setConstant(mesh.particle(p).mass);
  m.bottomRightCorner<3, 3>() = eigen(mesh.inertia(p));
  Eigen::MatrixXd const mass = m(moving, moving);
  Eigen::VectorXd const kept = g(moving);
  return std::sqrt(kept.dot(mass.ldlt().solve(kept)));
}

/// The freedoms that move: rows of (u, theta).
std::vector<int> freedoms(int dimension) {
  if (dimension == 1) return {0};
  if (dimension == 2) return {0, 1, 5};
  return {0, 1, 2, 3, 4, 5};
}

using Matrix6s = std::vector<Matrix6>;

Matrix6 mass_of(Mesh const& mesh, GlobalId p) {
  Matrix6 m = Matrix6::Zero();
  m.diagonal().head<3>().setConstant(mesh.particle(p).mass);
  m.bottomRightCorner<3, 3>() = eigen(mesh.inertia(p));
  return m;
}

/// Opened volume of particle J as a linear function of small motions of the particles around it, consistent option.
std::map<GlobalId, Vector6> opening_of(Mesh const& mesh, GlobalId j) {
  std::map<GlobalId, Vector6> g;
  // t . gap of a link, the gap as the small motion of its ends.
  auto const add_gap = [&](Link const& link, Vec3 const& t) {
    Vec3 const place = mesh.particle(link.i).centre + mesh.face(link.i, link.face_i).centroid;
    for (auto const& [end, sign] : {std::pair{link.i, -1.0}, std::pair{link.j, 1.0}}) {
      if (end == Link::wall) continue;
      Vec3 const turn = cross(place - mesh.particle(end).centre, t);
      Vector6& of = g.try_emplace(end, Vector6::Zero()).first->second;
      of.head<3>() += sign * eigen(t);
      of.tail<3>() += sign * eigen(turn);
    }
  };
  for (std::size_t const own : mesh.links_of(j)) {
    Link const& link = mesh.links[own];
    FaceGeometry const& face = mesh.face(link.i, link.face_i);
    add_gap(link, (link.i == j ? link.weight : 1 - link.weight) * face.area * face.normal);
    Vec3 const offset = face_offset(mesh, link).offset;
    if (norm2(offset) == 0) continue;
    Real const sign = link.i == j ? 0.5 : -0.5;
    for (GlobalId const p : {link.i, link.j}) {
      Vec3 const weight = gradient_inverse(mesh, p) * offset;
      for (std::size_t const l : mesh.links_of(p))
        add_gap(mesh.links[l], (sign * face.area * dot(face_offset(mesh, mesh.links[l]).pull, weight)) * face.normal);
    }
  }
  return g;
}

/// Bound of the volumetric stiffness on the diagonal of the owned particles, consistent option. With the sizes
/// s_K = |g_JK| in the metric of the masses, (sum of g_JK u_K)^2 <= sum of s_K sum of (g_JK u_K)^2 / s_K.
Matrix6s consistent_bound(Solid const& solid, std::vector<int> const& moving) {
  Mesh const& mesh = solid.mesh();
  struct Part {
    GlobalId from;
    Matrix6 stiffness;
  };
  std::vector<std::vector<Part>> parts(at(solid.owned()));
  for (Index l = 0; l < solid.count(); ++l) {
    GlobalId const j = solid.id(l);
    Real const lame = max(mesh.material(j).lame(), 0);
    if (lame == 0) continue;
    auto const g = opening_of(mesh, j);
    std::map<GlobalId, Real> size;
    Real sum = 0;
    for (auto const& [k, of] : g) {
      Eigen::MatrixXd const mass = mass_of(mesh, k)(moving, moving);
      Eigen::VectorXd const kept = of(moving);
      sum += size[k] = std::sqrt(kept.dot(mass.ldlt().solve(kept)));
    }
    for (auto const& [k, of] : g) {
      Index const here = solid.local(k);
      if (here < 0 || here >= solid.owned() || size[k] == 0) continue;
      parts[at(here)].push_back({j, (lame / mesh.particle(j).effective_volume * sum / size[k]) * of * of.transpose()});
    }
  }
  Matrix6s bound;
  for (auto& list : parts) {  // in global order: the same bits on any number of ranks
    std::sort(list.begin(), list.end(), [](Part const& a, Part const& b) { return a.from < b.from; });
    Matrix6 total = Matrix6::Zero();
    for (Part const& part : list) total += part.stiffness;
    bound.push_back(total);
  }
  return bound;
}

/// How the volume of a particle depends on itself and on its neighbours, in the order of Mesh::links_of: sizes of the
/// gradients of the opened volume.
struct VolumeGradient {
  std::vector<Real> of;
  Real own = 0, sum = 0;
};

VolumeGradient volume_gradient(Mesh const& mesh, GlobalId p, std::vector<int> const& moving) {
  VolumeGradient gradient;
  Vector6 own = Vector6::Zero();
  for (std::size_t l : mesh.links_of(p)) {
    End const e = end_of(mesh, mesh.links[l], p);
    own += e.weight * e.face->area * generalized_normal(e);
    Real of_other = 0;
    if (e.other != Link::wall) {
      End const back = end_of(mesh, mesh.links[l], e.other);
      of_other = e.weight * e.face->area * size(mesh, e.other, generalized_normal(back), moving);
    }
    gradient.of.push_back(of_other);
    gradient.sum += of_other;
  }
  gradient.own = size(mesh, p, own, moving);
  gradient.sum += gradient.own;
  return gradient;
}

}  // namespace

std::vector<double> Solid::volume_limits() const {
  std::vector<int> const moving = freedoms(dimension_);
  std::vector<double> squares(at(count_), 0);  // omega^2
  // (sum_L g_L x_L)^2 <= (sum_L s_L) sum_K (g_K x_K)^2 / s_K with s = size(g).
  for (Index l = 0; l < count_; ++l) {
    GlobalId const p = id(l);
    Real const lame = std::abs(mesh_.material(p).lame());
    if (lame == 0) continue;
    VolumeGradient const gradient = volume_gradient(mesh_, p, moving);
    Real const scale = lame / mesh_.particle(p).effective_volume * gradient.sum;
    squares[at(l)] += scale * gradient.own;
    std::size_t k = 0;
    for (std::size_t index : mesh_.links_of(p)) {
      Link const& link = mesh_.links[index];
      Real const of = gradient.of[k++];
      if (link.j == Link::wall) continue;
      Index const other = local(link.i == p ? link.j : link.i);
      if (other >= 0) squares[at(other)] += scale * of;
    }
  }
  std::vector<double> limits(at(owned_));
  for (Index l = 0; l < owned_; ++l) limits[at(l)] = squares[at(l)] > 0 ? 2 / std::sqrt(squares[at(l)]) : 1e300;
  return limits;
}

std::vector<double> Solid::link_limits() const {
  std::vector<int> const moving = freedoms(dimension_);
  std::vector<StrainBound> bound(at(count_));
  // Second-layer ghosts are not complete here, but the replicated mesh is.
  auto const held = [&](Index l) {
    std::vector<int> faces;
    for (auto [f, last] = held_faces_.equal_range(l); f != last; ++f) faces.push_back(f->second);
    return faces;
  };
  for (Index l = 0; l < count_; ++l) bound[at(l)] = strain_bound(mesh_, id(l), held(l));
  Matrix6s const consistent = consistent_ ? consistent_bound(*this, moving) : Matrix6s{};
  std::vector<double> limits(at(owned_), 1e300);
  for (Index l = 0; l < owned_; ++l) {
    GlobalId const p = id(l);
    if (motion_[at(l)].turns == 0 || mesh_.links_of(p).empty()) continue;
    Matrix6 k = Matrix6::Zero();
    for (std::size_t index : mesh_.links_of(p)) {
      Link const& link = mesh_.links[index];
      End const e = end_of(mesh_, link, p);
      bool const wall = e.other == Link::wall;
      Eigen::Matrix<double, 3, 6> const b = moved_by(e.arm);
      // |a - b|^2 <= 2 |a|^2 + 2 |b|^2 for two moving ends; a wall does not move.
      Real const shared = wall ? 1 : 2;
      k += shared * link.stiffness * b.transpose() * b;
      k.bottomRightCorner<3, 3>() += 0.5 * shared * eigen(bending_tensor(mesh_, link));
      if (wall || consistent_) continue;
      StrainBound const& of = bound[at(local(e.other))];
      Vector6 const g = generalized_normal(e);
      Real const lame = max(mesh_.material(e.other).lame(), 0);
      k += lame * (of.cancels ? 1 : 2) * of.ratio * (e.face->area / link.rest_length) * g * g.transpose();
    }
    for (int const f : held(l)) {
      FaceGeometry const& face = mesh_.face(p, f);
      Eigen::Matrix<double, 3, 6> const b = moved_by(face.centroid);
      k += 2 * mesh_.material(p).shear() * face.area / distance(mesh_, p, face) * b.transpose() * b;
    }
    StrainBound const& mine = bound[at(l)];
    Real const lame = max(mesh_.material(p).lame(), 0);
    if (consistent_)
      k += consistent[at(l)];
    else if (!mine.cancels)
      k += 2 * lame / mine.volume * mine.own * mine.own.transpose();
    Eigen::MatrixXd const kept = k(moving, moving), mass = mass_of(mesh_, p)(moving, moving);
    Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> const solver(kept, mass,
                                                                           Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
    limits[at(l)] = 2 / std::sqrt(solver.eigenvalues().maxCoeff());
  }
  return limits;
}

std::span<double const> Solid::step_limits() const {
  if (link_limits_.empty()) link_limits_ = link_limits();
  return link_limits_;
}

StableStep Solid::link_limit() const {
  step_limits();
  StableStep best;
  for (Index l = 0; l < owned_; ++l)
    if (link_limits_[at(l)] < best.dt) best = {link_limits_[at(l)], id(l), false};
  return best;
}

StableStep Solid::stable_limit() const {
  StableStep best = link_limit();
  if (sharp_limit_ > 0) best.dt = sharp_limit_;
  best.dt = rates_ ? rates_->levels.step() : cfl_ * best.dt;
  for (Sleep::Particles const& range : awake_particles())
    for (Index l = range.first; l < std::min(range.end, owned_); ++l) {
      Vec3 const spin = rotate(conjugate(pose_[at(l)].q), motion_[at(l)].spin);
      auto const& t = inertia_[at(inertia_of_[at(l)])].inverse;
      Triple<double> const rate = symmetric_times(t.data(), Triple<double>{spin.x, spin.y, spin.z});
      Real const speed = std::sqrt(dot(rate, rate));
      Real const steps = rates_ ? rates_->steps_of(id(l)) : 1;
      if (speed * best.dt > 0.25 * steps) best = {0.25 * steps / speed, id(l), true};
    }
  return best;
}

}  // namespace brisance::solid
