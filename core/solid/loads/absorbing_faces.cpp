// Scalar Eigen, as in stable_step.cpp.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>

#include <algorithm>

#include "core/solid/loads/absorbing_faces.hpp"
#include "core/solid/loads/face_selection.hpp"

namespace brisance::solid {
namespace {

using EigenMatrix = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// Freedoms of (v, Omega) that do not move in the plane or on the line.
bool moves(int freedom, int dimension) {
  return freedom < 3 ? freedom < dimension : dimension == 3 || (dimension == 2 && freedom == 5);
}

Mat3 inverse(Mat3 const& m) {
  Vec3 const a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  return (1 / dot(m[0], a)) * transpose(Mat3{{a, b, c}});
}

template <class M>
Eigen::Map<EigenMatrix> map(M& m) {
  return Eigen::Map<EigenMatrix>(m[0].data());
}

}  // namespace

AbsorbingFaces::AbsorbingFaces(SolidConfig const& config, Solid& solid) : solid_(solid) {
  Mesh const& mesh = solid_.mesh();
  std::vector<FaceRef> all;
  for (std::size_t i = 0; i < config.absorbing.size(); ++i) {
    auto const faces =
        select_faces(config.absorbing[i], mesh, "solid.absorbing[" + std::to_string(i) + "]", config.absorbing[i].at);
    all.insert(all.end(), faces.begin(), faces.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (FaceRef const& f : all) {
    Index const l = solid_.local(f.particle);
    if (l < 0 || l >= solid_.owned() || mesh.particle(f.particle).freedom != Freedom::free) continue;
    if (dashpots_.empty() || dashpots_.back().particle != l) {
      Mat3 const inertia = mesh.inertia(f.particle);
      Dashpot dashpot{l, {}, {}, inverse(inertia), {}};
      for (std::size_t a = 0; a < 3; ++a) {
        dashpot.mass[a][a] = mesh.particle(f.particle).mass;
        for (std::size_t b = 0; b < 3; ++b)
          dashpot.mass[3 + a][3 + b] = inertia[static_cast<int>(a)][static_cast<int>(b)];
      }
      dashpots_.push_back(dashpot);
    }
    add_face(dashpots_.back(), f.particle, mesh.face(f.particle, f.face));
  }
}

void AbsorbingFaces::add_face(Dashpot& to, GlobalId particle, FaceGeometry const& face) const {
  Mesh const& mesh = solid_.mesh();
  Material const& m = mesh.material(particle);
  Real const normal = std::sqrt(m.density * (m.lame() + 2 * m.shear())), shear = std::sqrt(m.density * m.shear());
  Mat3 const resistance = face.area * ((normal - shear) * outer(face.normal, face.normal) + shear * Mat3::identity());
  // Velocity of the centroid by (v, Omega): columns e_d and e_d x arm.
  std::array<Vec3, 6> moved{};
  for (int d = 0; d < 3; ++d) {
    Vec3 axis{};
    axis[d] = 1;
    if (moves(d, mesh.dimension)) moved[static_cast<std::size_t>(d)] = axis;
    if (moves(3 + d, mesh.dimension)) moved[static_cast<std::size_t>(3 + d)] = cross(axis, face.centroid);
  }
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) to.damping[a][b] += dot(moved[a], resistance * moved[b]);
}

void AbsorbingFaces::prepare(Real dt) {
  if (dt == prepared_for_) return;
  prepared_for_ = dt;
  for (Dashpot& d : dashpots_) {
    EigenMatrix const left = map(d.mass) + (dt / 2) * map(d.damping), right = map(d.mass) - (dt / 2) * map(d.damping);
    map(d.step) = left.llt().solve(right);
  }
}

void AbsorbingFaces::damp(Real dt) {
  prepare(dt);
  for (Dashpot const& d : dashpots_) {
    auto const p = static_cast<std::size_t>(d.particle);
    Quaternion const& q = solid_.pose()[p].q;
    Motion& motion = solid_.motion()[p];
    Vec3 const v = rotate(conjugate(q), motion.v), spin = rotate(conjugate(q), motion.spin);
    Vec3 const rate = d.inverse * spin;
    Vector const old{v.x, v.y, v.z, rate.x, rate.y, rate.z};
    Vector fresh{}, mean{};
    for (std::size_t a = 0; a < 6; ++a) {
      for (std::size_t b = 0; b < 6; ++b) fresh[a] += d.step[a][b] * old[b];
      mean[a] = 0.5 * (old[a] + fresh[a]);
    }
    Vector change{};  // of momentum and spin: -dt C mean
    Real power = 0;
    for (std::size_t a = 0; a < 6; ++a) {
      Real resistance = 0;
      for (std::size_t b = 0; b < 6; ++b) resistance += d.damping[a][b] * mean[b];
      change[a] = -dt * resistance;
      power += resistance * mean[a];
    }
    Vec3 const impulse = rotate(q, {change[0], change[1], change[2]});
    motion.v += motion.inverse_mass * impulse;
    motion.spin += rotate(q, {change[3], change[4], change[5]});
    for (int c = 0; c < 3; ++c) impulse_[static_cast<std::size_t>(c)].add(impulse[c]);
    push_.add(norm(impulse));
    dissipated_.add(dt * power);
  }
}

void AbsorbingFaces::join(Plan& plan) {
  plan.effect("solid.absorbing", [this] { return dashpots_.size() * sizeof(Dashpot); });
  plan.at(Stage::kick_again, [this](Clock const& c) { damp(c.dt); });
  plan.account([this](Ledger& ledger) {
    for (std::size_t d = 0; d < 3; ++d)
      ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), impulse_[d]);
    ledger.add(Entry::pressure_impulse, push_);
    ledger.add(Entry::dissipated, dissipated_);
    impulse_ = {};
    dissipated_ = push_ = {};
  });
  Plan::Keep keep;
  keep.save = [] {};
  keep.restore = [this] {
    impulse_ = {};
    dissipated_ = push_ = {};
  };
  keep.write = [](parallel::ArchiveWriter&) {};
  keep.read = [](parallel::ArchiveReader&) {};
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

}  // namespace brisance::solid
