// Scalar Eigen, as in stable_step.cpp.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/solid/loads/absorbing_faces.hpp"
#include "core/solid/rows.hpp"

namespace brisance::solid {
namespace {

constexpr std::uint32_t absorbing_kind = 0x41425342;  // "ABSB"
constexpr int row_size = 6;

}  // namespace

AbsorbingFaces::AbsorbingFaces(SolidConfig const& config, Solid& solid) : solid_(solid) {
  Mesh const& mesh = solid_.mesh();
  std::vector<FaceRef> loaded, all;
  for (FaceTractions::Face const& f : solid_.face_tractions().faces())
    loaded.push_back({solid_.id(f.particle), f.face});
  std::sort(loaded.begin(), loaded.end());
  for (std::size_t i = 0; i < config.absorbing.size(); ++i) {
    std::string const name = "solid.absorbing[" + std::to_string(i) + "]";
    auto const faces = select_faces(config.absorbing[i], mesh, name, config.absorbing[i].at);
    for (FaceRef const& f : faces)
      require(
          !std::binary_search(loaded.begin(), loaded.end(), f), config.absorbing[i].at,
          name + " takes a face of solid.body \"" +
              mesh.bodies[static_cast<std::size_t>(mesh.particle(f.particle).body)].name +
              "\" that solid.pressure, solid.traction or solid.blast loads: a face can do one of them. Narrow down one "
              "of the selections by low, high or normal");
    all.insert(all.end(), faces.begin(), faces.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  total_ = static_cast<GlobalId>(all.size());
  std::vector<FaceLoad> loads;
  for (std::size_t f = 0; f < all.size(); ++f) {
    loads.push_back({all[f].particle, all[f].face, {}});
    Index const l = solid_.local(all[f].particle);
    if (l < 0) continue;
    here_.push_back(all[f]);
    number_.push_back(static_cast<GlobalId>(f));
    solid_.hold_face(l, all[f].face);
  }
  offset_ = solid_.add_loaded_faces(loads);
  states_.resize(here_.size());
  account_of_faces_.follow(solid_, offset_, offset_ + here_.size());
  for (std::size_t f = 0; f < here_.size(); ++f) {
    GlobalId const p = here_[f].particle;
    if (f > 0 && here_[f - 1].particle == p) {
      if (!groups_.empty() && groups_.back().last == f) ++groups_.back().last;
      continue;
    }
    Material const& m = mesh.material(p);
    Group group{solid_.local(p),
                f,
                f + 1,
                std::sqrt(m.density * (m.lame() + 2 * m.shear())),
                std::sqrt(m.density * m.shear()),
                {}};
    bool complete = true;
    for (std::size_t const l : mesh.links_of(p)) {
      auto const link = solid_.local_link(l);
      complete = complete && link.has_value();
      if (link) group.links.push_back({*link, mesh.links[l].i == p ? mesh.links[l].weight : 1 - mesh.links[l].weight});
    }
    if (complete) groups_.push_back(std::move(group));
  }
}

Real AbsorbingFaces::update(Group const& g, Real dt) {
  auto const faces = solid_.face_tractions().faces();
  auto const p = static_cast<std::size_t>(g.particle);
  Quaternion const back = conjugate(solid_.pose()[p].q);
  HalfVelocity const& half = solid_.half_velocity()[p];
  Vec3 const v = rotate(back, half.v), omega = rotate(back, half.omega);
  auto const n = static_cast<Eigen::Index>(g.last - g.first);

  // Volume opened by all but these faces: links, and other loaded faces of the particle.
  Real others = solid_.face_opening(g.particle);
  for (std::size_t f = g.first; f < g.last; ++f)
    others -= faces[offset_ + f].compliance * faces[offset_ + f].normal_traction();
  for (auto const& [link, weight] : g.links) others += weight * solid_.gap_volume(link);
  Real const bulk = solid_.bulk(g.particle);

  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    FaceTractions::Face const& face = faces[offset_ + g.first + static_cast<std::size_t>(a)];
    State const& s = states_[g.first + static_cast<std::size_t>(a)];
    Real const soft = face.compliance / face.area, pull = g.resist_normal / dt;
    Real const speed = dot(v + cross(omega, face.arm), face.normal);
    for (Eigen::Index b = 0; b < n; ++b)
      matrix(a, b) -= pull * soft * bulk * faces[offset_ + g.first + static_cast<std::size_t>(b)].compliance;
    matrix(a, a) += 0.5 + pull * soft;
    right(a) = -0.5 * dot(s.traction, face.normal) - g.resist_normal * speed +
               pull * (dot(s.extension, face.normal) + soft * bulk * others);
  }
  Eigen::VectorXd const normal = matrix.partialPivLu().solve(right);
  Real opened = others;
  for (Eigen::Index a = 0; a < n; ++a)
    opened += faces[offset_ + g.first + static_cast<std::size_t>(a)].compliance * normal(a);

  Real dissipated = 0;
  for (std::size_t f = g.first; f < g.last; ++f) {
    FaceTractions::Face const& face = faces[offset_ + f];
    State& s = states_[f];
    Real const soft = face.compliance / face.area, pull = g.resist_shear / dt;
    Vec3 const point = v + cross(omega, face.arm);
    auto const across = [&](Vec3 const& u) { return u - dot(u, face.normal) * face.normal; };
    Real const t = normal(static_cast<Eigen::Index>(f - g.first));
    Vec3 const shear = (1 / (0.5 + pull * soft)) *
                       (-0.5 * across(s.traction) - g.resist_shear * across(point) + pull * across(s.extension));
    State const next{t * face.normal + shear, soft * (t - bulk * opened) * face.normal + soft * shear};
    // Work of the surface points against the dashpots.
    dissipated -= 0.5 * face.area * dot(s.traction + next.traction, dt * point + (next.extension - s.extension));
    s = next;
  }
  return dissipated;
}

void AbsorbingFaces::update(Real dt) {
  for (Group const& g : groups_) {
    Real const dissipated = update(g, dt);
    if (g.particle < solid_.owned()) dissipated_.add(dissipated);
  }
  set_tractions();
}

void AbsorbingFaces::set_tractions() {
  auto const faces = solid_.face_tractions().faces();
  for (std::size_t f = 0; f < states_.size(); ++f) faces[offset_ + f].traction = states_[f].traction;
  solid_.tractions_changed();
}

void AbsorbingFaces::join(Plan& plan) {
  plan.effect("solid.absorbing", [this] {
    std::size_t bytes = states_.size() * (2 * sizeof(State) + sizeof(FaceRef) + sizeof(GlobalId));
    for (Group const& g : groups_) bytes += sizeof(Group) + g.links.size() * sizeof(g.links[0]);
    return bytes + account_of_faces_.bytes();
  });
  plan.at(Stage::set_off, [this](Clock const&) { account_of_faces_.before_first_kick(); });
  plan.at(Stage::kick, [this](Clock const&) { account_of_faces_.after_first_kick(); });
  plan.at(Stage::drift, [this](Clock const& c) {
    account_of_faces_.before_change();
    update(c.dt);
  });
  plan.at(Stage::kick_again, [this](Clock const& c) { account_of_faces_.after_second_kick(c.dt, account_); });
  plan.account([this](Ledger& ledger) {
    account_.add_work(dissipated_);  // the load takes it, the ledger wants it under its own name
    ledger.add(Entry::dissipated, dissipated_);
    account_.book(ledger);
    dissipated_ = {};
  });
  Plan::Keep keep;
  keep.save = [this] { saved_ = states_; };
  keep.restore = [this] {
    states_ = saved_;
    set_tractions();
    account_of_faces_.start();
    account_.clear();
    dissipated_ = {};
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    std::vector<GlobalId> ids;
    std::vector<double> rows;
    for (std::size_t f = 0; f < states_.size(); ++f) {
      if (solid_.local(here_[f].particle) >= solid_.owned()) continue;
      ids.push_back(number_[f]);
      for (Vec3 const& v : {states_[f].traction, states_[f].extension}) rows.insert(rows.end(), {v.x, v.y, v.z});
    }
    file.rows("solid/absorbing", total_, row_size, rows_of(ids), rows);
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    std::vector<double> const rows = file.rows("solid/absorbing", row_size, rows_of(number_));
    for (std::size_t f = 0; f < states_.size(); ++f) {
      double const* r = rows.data() + f * row_size;
      states_[f] = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}};
    }
    set_tractions();
  };
  keep.digest = [this](parallel::Digest& digest) {
    for (std::size_t f = 0; f < states_.size(); ++f) {
      if (solid_.local(here_[f].particle) >= solid_.owned()) continue;
      Vec3 const &t = states_[f].traction, &w = states_[f].extension;
      std::array<double, row_size> const bits{t.x, t.y, t.z, w.x, w.y, w.z};
      digest.add(absorbing_kind, number_[f], bits);
    }
  };
  plan.keep(std::move(keep));
}

void AbsorbingFaces::start() {
  solid_.compute_strains();
  account_of_faces_.start();
}

}  // namespace brisance::solid
