#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/errors.hpp"
#include "core/base/place.hpp"
#include "core/solid/mesh.hpp"
#include "core/solid/mesh_build/draft.hpp"
#include "core/solid/mesh_build/links.hpp"
#include "core/solid/mesh_build/supports.hpp"
#include "core/solid/overlap.hpp"
#include "core/solid/space_curve.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

void add_initial_velocity(BodyConfig const& body, int dimension, Particle& p) {
  constexpr Real far = std::numeric_limits<Real>::infinity();
  for (InitialVelocityConfig const& field : body.initial_velocity) {
    if (!in_box(p.centre, field.low.value_or(Vec3{-far, -far, -far}), field.high.value_or(Vec3{far, far, far}),
                dimension))
      continue;
    p.velocity += field.velocity;
    if (field.gradient.empty()) continue;
    auto const& g = field.gradient;
    p.velocity +=
        Mat3{{Vec3{g[0], g[1], g[2]}, Vec3{g[3], g[4], g[5]}, Vec3{g[6], g[7], g[8]}}} * (p.centre - field.centre);
    p.spin += 0.5 * Vec3{g[7] - g[5], g[2] - g[6], g[3] - g[1]};  // half the curl
  }
}

/// 2^-50 of the extent of all bodies: 51 bits hold every place, so that a difference of two is exact.
void snap_centres(Mesh& mesh) {
  Real extent = 0;
  for (Particle const& p : mesh.particles) {
    Real reach = 0;
    for (Vec3 const& v : mesh.shapes[static_cast<std::size_t>(p.shape)].polyhedron.vertices)
      reach = max(reach, norm(v));
    for (int d = 0; d < 3; ++d) extent = max(extent, std::abs(p.centre[d]) + reach);
  }
  mesh.grain = std::ldexp(1.0, std::ilogb(extent) + 1 - 50);
  for (Particle& p : mesh.particles) p.centre = on_grain(mesh, p.centre);
}

}  // namespace

Mesh build_mesh(SolidConfig const& config, int dimension) {
  Mesh mesh;
  mesh.dimension = dimension;
  if (config.links) mesh.torsion_ratio = config.links->torsion_ratio;
  std::map<std::string, Index> material_of;
  for (auto const& [name, m] : config.material) {
    material_of[name] = static_cast<Index>(mesh.materials.size());
    mesh.materials.push_back({name, m.density, m.young_modulus, m.poisson_ratio});
  }
  for (BodyConfig const& body : config.body)
    require(material_of.contains(body.material) || (body.mesh && body.material.empty()), Failure::scene,
            body.at.text() + ": solid.body \"" + body.name + "\": material \"" + body.material +
                "\" is not one of solid.material. Add it there or correct the name.");
  for (BodyConfig const& body : config.body) check_supports(body, dimension);
  Draft const draft = tessellate_all(config, dimension);

  std::vector<std::size_t> const order = curve_order(draft.centre);
  std::vector<GlobalId> number(order.size());
  for (std::size_t g = 0; g < order.size(); ++g) number[order[g]] = static_cast<GlobalId>(g);
  std::vector<Index> first_shape;
  for (Cells const& cells : draft.cells) {
    first_shape.push_back(static_cast<Index>(mesh.shapes.size()));
    mesh.shapes.insert(mesh.shapes.end(), cells.shapes.begin(), cells.shapes.end());
  }

  Supports supports(mesh, config);
  mesh.particles.resize(order.size());
  for (std::size_t a = 0; a < order.size(); ++a) {
    auto const b = static_cast<std::size_t>(draft.body_of[a]);
    BodyConfig const& body = config.body[b];
    Particle& p = mesh.particles[static_cast<std::size_t>(number[a])];
    p.body = draft.body_of[a];
    p.material = cell_material(body, draft.cells[b], draft.cell_of[a], material_of);
    p.shape = first_shape[b] + draft.cells[b].shape[draft.cell_of[a]];
    p.centre = draft.centre[a];
    Shape const& s = mesh.shapes[static_cast<std::size_t>(p.shape)];
    p.mass = mesh.materials[static_cast<std::size_t>(p.material)].density * s.volume;
    p.velocity = body.velocity;
    for (std::size_t n = 0; n < body.prescribed.size(); ++n) {
      DrivenConfig const& box = body.prescribed[n];
      if (!in_box(p.centre, box.low, box.high, dimension)) continue;
      p.freedom = Freedom::prescribed;
      p.motion = supports.motion_of(b, n);
      p.velocity = box.velocity;
    }
    for (HoldConfig const& box : body.hold)
      if (in_box(p.centre, box.low, box.high, dimension)) p.freedom = Freedom::fixed, p.velocity = {}, p.motion = -1;
  }
  name_faces(mesh, draft, number);
  for (BodyConfig const& body : config.body)
    for (auto const* groups : {&body.clamp_groups, &body.symmetry_groups})
      for (std::string const& name : *groups)
        require_face_group(mesh, name, body.at, "solid.body \"" + body.name + "\"");
  connect(mesh, draft, config, number, supports);
  snap_centres(mesh);

  for (std::size_t b = 0; b < config.body.size(); ++b)
    mesh.bodies.push_back({config.body[b].name, 0, 0, {}, draft.cells[b].whole_volume});
  for (Particle& p : mesh.particles) {
    Body& body = mesh.bodies[static_cast<std::size_t>(p.body)];
    ++body.particles;
    body.mass += p.mass;
    body.centre += p.mass * p.centre;
  }
  for (Body& body : mesh.bodies) body.centre = body.centre / body.mass;
  for (GlobalId id = 0; id < mesh.size(); ++id) {
    Particle& p = mesh.particles[static_cast<std::size_t>(id)];
    Real free_volume = 0;
    for (FreeFace const& f : mesh.free_faces_of(id))
      if (!f.clamped) free_volume += mesh.face(id, f.face).area * f.distance;
    p.effective_volume = mesh.shape(id).volume + mesh.material(id).free_ratio() * free_volume;
    auto const b = static_cast<std::size_t>(p.body);
    if (p.freedom == Freedom::free) {
      p.spin = config.body[b].spin;
      p.velocity += cross(p.spin, p.centre - mesh.bodies[b].centre);
      add_initial_velocity(config.body[b], dimension, p);
    }
    if (p.motion >= 0) {
      RigidMotion const& motion = mesh.motions[static_cast<std::size_t>(p.motion)];
      RigidMotion::State const now = motion.at(0);
      p.velocity = now.velocity(p.centre - motion.centre());
      p.spin = now.omega;
    }
    for (int d = dimension; d < 3; ++d) p.velocity[d] = 0;
    if (dimension < 3) p.spin = {0, 0, dimension == 2 ? p.spin.z : 0};
  }

  if (auto const meeting = find_overlap(mesh)) {
    auto const &a = config.body[static_cast<std::size_t>(meeting->body_a)],
               &b = config.body[static_cast<std::size_t>(meeting->body_b)];
    throw Error(Failure::scene, b.at.text() + ": solid.body \"" + a.name + "\" and \"" + b.name + "\" overlap by " +
                                    std::to_string(meeting->depth) + " m at " + place_text(meeting->place) +
                                    ". Bodies may touch: move one of them or change its dimensions.");
  }
  return mesh;
}

}  // namespace brisance::solid
