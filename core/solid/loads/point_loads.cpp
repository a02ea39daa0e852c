#include "core/solid/loads/point_loads.hpp"

#include <cmath>
#include <cstdio>

#include "core/base/errors.hpp"
#include "core/solid/loads/face_selection.hpp"
#include "core/solid/loads/free_step.hpp"

namespace brisance::solid {
namespace {

/// How far a point lies outside of a particle along its worst face, m: negative inside.
Real outside(Mesh const& mesh, GlobalId p, Vec3 const& point) {
  Real most = -1e300;
  for (FaceGeometry const& face : mesh.shape(p).faces)
    if (!is_side_of_slab(face, mesh.dimension))
      most = max(most, dot(point - mesh.particle(p).centre - face.centroid, face.normal));
  return most;
}

/// The particle that holds a point or is nearest to it; of several that are as near, the first.
/// Errors: scene error when the nearest is further away than its own size.
GlobalId particle_at(Mesh const& mesh, Vec3 const& point, std::optional<std::string> const& body,
                     std::string const& name, Location const& at) {
  std::optional<Index> only;
  if (body) only = find_body(mesh, *body, name, at);
  GlobalId best = -1;
  Real least = 0;
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    if (only && mesh.particle(p).body != *only) continue;
    // Points on a common face belong to the first of its particles, whatever the rounding.
    Real const size = std::cbrt(mesh.shape(p).volume), away = max(outside(mesh, p, point), 0);
    if (best >= 0 && away >= least - 1e-9 * size) continue;
    best = p;
    least = away;
  }
  if (best < 0 || least > std::cbrt(mesh.shape(best).volume)) {
    char text[200];
    std::snprintf(text, sizeof text,
                  ": no particle is near (%.6g, %.6g, %.6g) m: the nearest surface is %.3g m away. Move the position "
                  "onto a body",
                  point.x, point.y, point.z, least);
    scene_error(at, name + text);
  }
  return best;
}

Vec3 in_plane(Vec3 v, int dimension) {
  for (int d = dimension; d < 3; ++d) v[d] = 0;
  return v;
}

}  // namespace

PointLoads::PointLoads(SolidConfig const& config, Solid& solid) : config_(config), solid_(solid) {
  for (std::size_t i = 0; i < config_.point_force.size(); ++i)
    add_force(config_.point_force[i], "solid.point_force[" + std::to_string(i) + "]");
  for (std::size_t i = 0; i < config_.moment_tensor.size(); ++i)
    add_source(config_.moment_tensor[i], "solid.moment_tensor[" + std::to_string(i) + "]");
}

void PointLoads::add_part(GlobalId particle, Index frame, Vec3 const& force, Vec3 const& arm) {
  Index const l = solid_.local(particle);
  if (l < 0 || l >= solid_.owned()) return;
  parts_.push_back({histories_.size() - 1, l, frame, force, arm, {}, {}, {}});
}

void PointLoads::add_force(PointForceConfig const& config, std::string const& name) {
  Mesh const& mesh = solid_.mesh();
  require(config.force == in_plane(config.force, mesh.dimension), config.at,
          name + ".force leaves the plane of the solid; make that component 0");
  GlobalId const p = particle_at(mesh, config.position, config.body, name, config.at);
  histories_.emplace_back(config, name, config.at);
  longest_step_ = min(longest_step_, free_step(mesh, p));
  add_part(p, config.follow ? solid_.local(p) : -1, config.force,
           in_plane(config.position - mesh.particle(p).centre, mesh.dimension));
}

void PointLoads::add_source(MomentTensorConfig const& config, std::string const& name) {
  Mesh const& mesh = solid_.mesh();
  require(config.moment.size() == 6, config.at, name + ".moment needs six numbers: xx, yy, zz, xy, xz, yz");
  auto const& m = config.moment;
  Mat3 const tensor{{Vec3{m[0], m[3], m[4]}, Vec3{m[3], m[1], m[5]}, Vec3{m[4], m[5], m[2]}}};
  GlobalId const p = particle_at(mesh, config.position, config.body, name, config.at);
  // A missing link would take its share of the moment with it.
  require(mesh.free_faces_of(p).empty() && !mesh.links_of(p).empty(), config.at,
          name +
              " acts in a particle with a boundary face, where a part of it would be lost. Move it at least one "
              "particle inside, into a body with links");
  for (std::size_t const l : mesh.links_of(p))
    require(mesh.links[l].far < 0, config.at,
            name +
                " acts in a particle beside a periodic side, beyond which its forces would act on an image. Move it at "
                "least one particle away from that side");
  histories_.emplace_back(config, name, config.at);
  for (std::size_t const l : mesh.links_of(p)) {
    Link const& link = mesh.links[l];
    GlobalId const other = link.i == p ? link.j : link.i;
    FaceGeometry const& face = mesh.face(link.i, link.face_i);
    Real const weight = link.i == p ? link.weight : 1 - link.weight;
    Vec3 const outward = link.i == p ? face.normal : -face.normal;
    Vec3 const force = (weight * face.area / mesh.shape(p).volume) * (tensor * outward);
    Vec3 const place = mesh.particle(link.i).centre + face.centroid;
    Index const frame = solid_.local(p);  // a neighbour of every particle that gets a part of it
    add_part(other, frame, in_plane(force, mesh.dimension), place - mesh.particle(other).centre);
    add_part(p, frame, -in_plane(force, mesh.dimension), place - mesh.particle(p).centre);
  }
}

void PointLoads::measure_wrenches(Real time) {
  time_ = time;
  for (Part& part : parts_) {
    Vec3 force = histories_[part.history].at(time) * part.force;
    if (part.frame >= 0) force = rotate(solid_.pose()[static_cast<std::size_t>(part.frame)].q, force);
    Vec3 const arm = rotate(solid_.pose()[static_cast<std::size_t>(part.particle)].q, part.arm);
    part.second.force = force;
    part.second.torque = cross(arm, force);
  }
}

void PointLoads::add_to_forces() const {
  for (Part const& part : parts_) {
    Wrench& w = solid_.internal()[static_cast<std::size_t>(part.particle)];
    w.force += part.second.force;
    w.torque += part.second.torque;
  }
}

void PointLoads::join(Plan& plan) {
  auto const nothing = [] { return std::size_t{0}; };
  if (!config_.point_force.empty()) plan.effect("solid.point_force", nothing);
  if (!config_.moment_tensor.empty()) plan.effect("solid.moment_tensor", nothing);
  plan.effects().back().bytes = [this] { return parts_.size() * sizeof(Part); };
  plan.at(Stage::set_off, [this](Clock const&) {
    for (Part& part : parts_) {
      part.first = part.second;
      part.velocity.begin(solid_, part.particle);
    }
  });
  plan.at(Stage::kick, [this](Clock const&) {
    for (Part& part : parts_) part.velocity.take(solid_, part.particle, part.first);
  });
  plan.at(Stage::forces, [this](Clock const& c) {
    measure_wrenches(c.time + c.dt);
    add_to_forces();
  });
  plan.at(Stage::kick_again, [this](Clock const& c) {
    for (Part& part : parts_) {
      part.velocity.take(solid_, part.particle, part.second);
      account_.add(c.dt, part.first, part.second);
    }
  });
  if (longest_step_ < 1e300) plan.limit("solid.loads", [this](Clock const&) { return longest_step_; });
  plan.account([this](Ledger& ledger) { account_.book(ledger); });
  Plan::Keep keep;
  keep.save = [this] { saved_time_ = time_; };
  keep.restore = [this] {
    measure_wrenches(saved_time_);
    account_.clear();
  };
  keep.write = [](parallel::ArchiveWriter&) {};
  keep.read = [this](parallel::ArchiveReader& file) {
    time_ = file.real("time");
    resumed_ = true;
  };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void PointLoads::start() {
  measure_wrenches(time_);
  if (!resumed_) add_to_forces();
}

}  // namespace brisance::solid
