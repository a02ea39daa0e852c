#include "core/solid/mesh_build/supports.hpp"

#include <algorithm>

namespace brisance::solid {
namespace {

Link half_link(Mesh const& mesh, GlobalId p, int face, Real distance) {
  Real const area = mesh.face(p, face).area;
  return {p, Link::wall, face, -1, distance, 1, 2 * mesh.material(p).shear() * area / distance};
}

}  // namespace

Supports::Supports(Mesh& mesh, SolidConfig const& config) : mesh_(mesh), config_(config) {
  for (BodyConfig const& body : config.body) {
    auto& prescribed = prescribed_.emplace_back();
    for (DrivenConfig const& box : body.prescribed)
      prescribed.push_back(box.turns() || !box.history.empty() ? motion(box) : -1);
    auto& walls = walls_.emplace_back();
    for (DrivenConfig const& box : body.clamp) {
      if (!box.moves()) {
        walls.push_back(-1);
        continue;
      }
      walls.push_back(static_cast<Index>(mesh.far_sides.size()));
      mesh.far_sides.push_back({FarSide::Kind::moving_wall, motion(box), {}, {}});
    }
  }
}

std::optional<Link> Supports::link(std::size_t body, GlobalId p, FreeFace const& face) {
  BodyConfig const& of = config_.body[body];
  if (!config_.links) return std::nullopt;
  std::optional<Link> found;
  for (std::size_t c = 0; c < of.clamp.size(); ++c)
    if (lies_in(p, face, of.clamp[c].low, of.clamp[c].high)) {
      found = half_link(mesh_, p, face.face, face.distance);
      found->far = walls_[body][c];
    }
  if (!found && in_group(of.clamp_groups, p, face)) found = half_link(mesh_, p, face.face, face.distance);
  if (found) return found;
  if (in_group(of.symmetry_groups, p, face)) return mirror_link(p, face);
  for (HoldConfig const& box : of.symmetry)
    if (lies_in(p, face, box.low, box.high)) return mirror_link(p, face);
  return std::nullopt;
}

Index Supports::motion(DrivenConfig const& box) {
  mesh_.motions.emplace_back(box, mesh_.dimension);
  return static_cast<Index>(mesh_.motions.size()) - 1;
}

bool Supports::in_group(std::vector<std::string> const& groups, GlobalId p, FreeFace const& face) const {
  return std::any_of(groups.begin(), groups.end(), [&](std::string const& name) {
    auto const faces = mesh_.face_group(name);
    return std::binary_search(faces.begin(), faces.end(), FaceId{p, face.face});
  });
}

bool Supports::lies_in(GlobalId p, FreeFace const& face, Vec3 const& low, Vec3 const& high) const {
  Polyhedron const& shape = mesh_.shape(p).polyhedron;
  for (int v : shape.faces[static_cast<std::size_t>(face.face)])
    if (!in_box(mesh_.particle(p).centre + shape.vertices[static_cast<std::size_t>(v)], low, high, mesh_.dimension,
                1e-9 * face.distance))
      return false;
  return true;
}

Link Supports::mirror_link(GlobalId p, FreeFace const& face) {
  FaceGeometry const& of = mesh_.face(p, face.face);
  Link link = half_link(mesh_, p, face.face, 2 * face.distance);
  link.weight = 0.5;
  link.far = side({FarSide::Kind::mirror, -1, mesh_.particle(p).centre + of.centroid, of.normal});
  return link;
}

Index Supports::side(FarSide const& wanted) {
  // Planes are told apart by their distance from the origin, not by the point that names them.
  Vec3 const& v = wanted.vector;
  std::array<Real, 4> const key{v.x, v.y, v.z, dot(v, wanted.point)};
  auto const [at, fresh] = sides_.try_emplace({wanted.kind, key}, static_cast<Index>(mesh_.far_sides.size()));
  if (fresh) mesh_.far_sides.push_back(wanted);
  return at->second;
}

}  // namespace brisance::solid
