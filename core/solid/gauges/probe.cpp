#include "core/solid/gauges/probe.hpp"

#include <algorithm>
#include <limits>

#include "core/base/errors.hpp"
#include "core/solid/gauges/stress.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
Vec3 vector(Triple<double> const& t) { return {t.x, t.y, t.z}; }

}  // namespace

Probe::Probe(SolidGaugeConfig const& gauge, Solid const& solid)
    : gauge_(gauge), about_(gauge.position.value_or(Vec3{})) {
  Mesh const& mesh = solid.mesh();
  for (int d = mesh.dimension; d < 3; ++d) about_[d] = 0.5;  // the middle of the slab
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    if (gauge.body && mesh.bodies[b].name == *gauge.body) body_ = static_cast<Index>(b);
  if (gauge.watch == "particle") choose_particle(mesh);
  if (gauge.watch == "surface") choose_face(mesh);
  if (gauge.watch == "support") choose_supports(mesh);
  if (gauge.watch == "section") choose_section(mesh);
  require(
      particle_ >= 0 || !held_.empty() || !cuts_.empty(), gauge.at,
      "output.solid_gauge \"" + gauge.name + "\": " +
          (gauge.watch == "support"   ? "no support lies in its box: enlarge `low` and `high`, or hold the body there"
           : gauge.watch == "section" ? "its plane cuts no link: move `position` into the body, between two particles"
                                      : "there is nothing to watch"));
  for (GlobalId const p : held_) ranks_.push_back(solid.owner(p));
  for (Cut const& cut : cuts_) ranks_.push_back(solid.owner(mesh.links[cut.link].i));
  if (particle_ >= 0) ranks_.push_back(solid.owner(particle_));
  std::sort(ranks_.begin(), ranks_.end());
  ranks_.erase(std::unique(ranks_.begin(), ranks_.end()), ranks_.end());
}

bool Probe::counts(Mesh const& mesh, GlobalId particle, Vec3 const& place) const {
  if (body_ >= 0 && mesh.particle(particle).body != body_) return false;
  for (int d = 0; d < mesh.dimension; ++d)
    if ((gauge_.low && place[d] < (*gauge_.low)[d]) || (gauge_.high && place[d] > (*gauge_.high)[d])) return false;
  return true;
}

void Probe::choose_particle(Mesh const& mesh) {
  Real best = std::numeric_limits<Real>::infinity();
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    Vec3 const x = mesh.particle(p).centre;
    Real const distance = norm2(x - about_);
    if (!counts(mesh, p, x) || !(distance < best)) continue;
    best = distance, particle_ = p, place_ = x;
  }
}

void Probe::choose_face(Mesh const& mesh) {
  Real best = std::numeric_limits<Real>::infinity();
  for (FreeFace const& face : mesh.free_faces) {
    Vec3 const x = mesh.particle(face.particle).centre + mesh.face(face.particle, face.face).centroid;
    Real const distance = norm2(x - about_);
    if (!counts(mesh, face.particle, x) || !(distance < best)) continue;
    best = distance, particle_ = face.particle, face_ = face.face, place_ = x;
  }
}

void Probe::choose_supports(Mesh const& mesh) {
  Vec3 sum{};
  for (GlobalId p = 0; p < mesh.size(); ++p)
    if (mesh.particle(p).freedom != Freedom::free && counts(mesh, p, mesh.particle(p).centre)) {
      held_.push_back(p);
      sum += mesh.particle(p).centre;
    }
  for (std::size_t l = 0; l < mesh.links.size(); ++l) {
    Link const& link = mesh.links[l];
    if (link.j != Link::wall) continue;
    Vec3 const x = mesh.particle(link.i).centre + mesh.face(link.i, link.face_i).centroid;
    if (!counts(mesh, link.i, x)) continue;
    cuts_.push_back({l, true});
    sum += x;
  }
  std::size_t const n = held_.size() + cuts_.size();
  if (n > 0) place_ = sum / static_cast<Real>(n);
}

void Probe::choose_section(Mesh const& mesh) {
  Vec3 const normal = normalized(*gauge_.normal);
  Vec3 sum{};
  for (std::size_t l = 0; l < mesh.links.size(); ++l) {
    Link const& link = mesh.links[l];
    if (link.far >= 0 || link.j == Link::wall) continue;
    bool const i_ahead = dot(mesh.particle(link.i).centre - about_, normal) > 0;
    bool const j_ahead = dot(mesh.particle(link.j).centre - about_, normal) > 0;
    Vec3 const x = mesh.particle(link.i).centre + mesh.face(link.i, link.face_i).centroid;
    if (i_ahead == j_ahead || !counts(mesh, link.i, x)) continue;
    cuts_.push_back({l, j_ahead});
    sum += x;
  }
  if (!cuts_.empty()) place_ = sum / static_cast<Real>(cuts_.size());
}

std::vector<Real> Probe::values(Solid const& solid) const {
  Mesh const& mesh = solid.mesh();
  Index const l = solid.local(particle_);
  Pose const& pose = solid.pose()[at(l)];
  Motion const& motion = solid.motion()[at(l)];
  Material const& material = mesh.material(particle_);
  int const dimension = mesh.dimension;
  std::vector<Real> out;
  auto place = [&](Vec3 const& v) {
    for (int d = 0; d < dimension; ++d) out.push_back(v[d]);
  };
  auto turn = [&](Vec3 const& v) {
    if (dimension == 3) out.insert(out.end(), {v.x, v.y});
    if (dimension > 1) out.push_back(v.z);
  };
  auto tensor = [&](Mat3 const& m) {
    out.insert(out.end(), {m[0].x, m[1].y, m[2].z});
    if (dimension > 1) out.push_back(m[0].y);
    if (dimension > 2) out.insert(out.end(), {m[0].z, m[1].z});
  };
  Vec3 const omega = solid.omega_of(l, motion.spin);
  if (face_ >= 0) {
    // The point of the surface is not on the rigid particle (theory/solid.md section 7).
    FaceGeometry const& face = mesh.face(particle_, face_);
    Real opening = 0, traction = 0;
    for (FaceTractions::Face const& loaded : solid.face_tractions().faces())
      if (loaded.particle == l && loaded.face == face_) traction += loaded.normal_traction();
    for (FreeFace const& f : mesh.free_faces_of(particle_))
      if (f.face == face_ && !f.clamped)
        opening = f.distance / (2 * material.shear()) * (traction - solid.pressure()[at(l)]);
    Vec3 const arm = rotate(pose.q, face.centroid);
    place(pose.x + arm - place_ + opening * rotate(pose.q, face.normal));
    place(motion.v + cross(omega, arm));
    return out;
  }
  auto wants = [&](char const* quantity) {
    auto const& all = gauge_.quantities;
    return all.empty() || std::find(all.begin(), all.end(), quantity) != all.end();
  };
  bool const with_stress = wants("stress") || wants("strain");
  Mat3 const stress = with_stress ? mean_stress(solid, l) : Mat3{};
  std::vector<std::string> order = gauge_.quantities;
  if (order.empty()) order = {"displacement", "velocity", "rotation", "spin", "stress", "strain"};
  for (std::string const& q : order) {
    if (q == "displacement") place(pose.x - place_);
    if (q == "velocity") place(motion.v);
    if (q == "rotation") turn(rotation_vector(pose.q));
    if (q == "spin") turn(omega);
    if (q == "stress") tensor(stress);
    if (q == "strain") tensor(elastic_strain(material, stress));
  }
  return out;
}

void Probe::add(Solid const& solid, std::span<parallel::ExactSum, 6> sums) const {
  Mesh const& mesh = solid.mesh();
  auto put = [&](Vec3 const& force, Vec3 const& moment) {
    for (int d = 0; d < 3; ++d) {
      sums[static_cast<std::size_t>(d)].add(force[d]);
      sums[static_cast<std::size_t>(3 + d)].add(moment[d]);
    }
  };
  for (GlobalId const p : held_) {
    Index const l = solid.local(p);
    if (l < 0 || l >= solid.owned()) continue;
    Wrench const &internal = solid.internal()[at(l)], &load = solid.load()[at(l)];
    Vec3 const force = -(internal.force + load.force);
    put(force, cross(solid.pose()[at(l)].x - about_, force) - (internal.torque + load.torque));
  }
  for (Cut const& cut : cuts_) {
    Index const l = solid.local(mesh.links[cut.link].i);
    auto const k = solid.local_link(cut.link);
    if (l < 0 || l >= solid.owned() || !k) continue;
    LinkWrench<double> const w = solid.wrench_of(*k);
    Real const sign = cut.forward ? 1 : -1;
    Vec3 const force = vector(w.force);
    put(sign * force, sign * (cross(solid.pose()[at(l)].x - about_, force) + vector(w.torque_i)));
  }
}

std::vector<Real> Probe::columns(std::span<parallel::ExactSum const, 6> sums, int dimension) const {
  std::vector<Real> out;
  for (int d = 0; d < dimension; ++d) out.push_back(sums[static_cast<std::size_t>(d)].value());
  for (int d = 0; d < 3; ++d)
    if (dimension == 3 || (dimension == 2 && d == 2)) out.push_back(sums[static_cast<std::size_t>(3 + d)].value());
  return out;
}

}  // namespace brisance::solid
