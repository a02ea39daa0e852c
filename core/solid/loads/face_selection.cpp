#include "core/solid/loads/face_selection.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/place.hpp"

namespace brisance::solid {
namespace {

/// Do all corners of a face lie in the box, to rounding?
bool in_box(FaceSelection const& selection, Mesh const& mesh, FreeFace const& face) {
  Shape const& shape = mesh.shape(face.particle);
  Vec3 const centre = mesh.particle(face.particle).centre;
  Real const slack = 1e-9 * std::abs(face.distance);
  for (int const v : shape.polyhedron.faces[static_cast<std::size_t>(face.face)]) {
    Vec3 const corner = centre + shape.polyhedron.vertices[static_cast<std::size_t>(v)];
    for (int d = 0; d < mesh.dimension; ++d) {
      if (selection.low && corner[d] < (*selection.low)[d] - slack) return false;
      if (selection.high && corner[d] > (*selection.high)[d] + slack) return false;
    }
  }
  return true;
}

}  // namespace

Index find_body(Mesh const& mesh, std::string const& name, std::string const& load, Location const& at) {
  std::vector<std::string> names;
  for (Body const& body : mesh.bodies) names.push_back(body.name);
  auto const found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    scene_error(at,
                load + ": there is no solid.body \"" + name + "\"; the nearest is \"" + nearest(name, names) + "\"");
  return static_cast<Index>(found - names.begin());
}

std::vector<FaceRef> select_faces(FaceSelection const& selection, Mesh const& mesh, std::string const& load,
                                  Location const& at) {
  std::optional<Index> body;
  if (selection.body) body = find_body(mesh, *selection.body, load, at);
  std::span<FaceId const> group;
  if (selection.group) {
    require_face_group(mesh, *selection.group, at, load + ".group");
    group = mesh.face_group(*selection.group);
  }
  std::optional<Vec3> normal = selection.normal;
  if (normal) {
    for (int d = mesh.dimension; d < 3; ++d) (*normal)[d] = 0;
    require(norm(*normal) > 0, at, load + ".normal has no direction; give one such as [0, 0, 1]");
    normal = normalized(*normal);
  }
  Real const least = std::cos(selection.within);
  std::vector<FaceRef> chosen;
  std::size_t candidates = 0;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (FreeFace const& face : mesh.free_faces) {
    if (face.clamped || (body && mesh.particle(face.particle).body != *body)) continue;
    if (selection.group && !std::binary_search(group.begin(), group.end(), FaceId{face.particle, face.face})) continue;
    FaceGeometry const& geometry = mesh.face(face.particle, face.face);
    ++candidates;
    Vec3 const place = mesh.particle(face.particle).centre + geometry.centroid;
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], place[d]), high[d] = max(high[d], place[d]);
    if (normal && dot(*normal, geometry.normal) < least - 1e-12) continue;
    if (selection.facing) {
      Vec3 way = *selection.facing - place;
      for (int d = mesh.dimension; d < 3; ++d) way[d] = 0;
      if (dot(way, geometry.normal) <= 1e-9 * norm(way)) continue;
    }
    if (in_box(selection, mesh, face)) chosen.push_back({face.particle, face.face});
  }
  if (chosen.empty())
    scene_error(at,
                load + " selects no face: none of the " + std::to_string(candidates) + " free boundary faces of " +
                    (selection.group  ? "the physical surface \"" + *selection.group + "\""
                     : selection.body ? "solid.body \"" + *selection.body + "\""
                                      : "the solid") +
                    (candidates > 0 ? ", with centres from " + place_text(low) + " to " + place_text(high) + "," : "") +
                    " lies with all its corners between low and high, has the normal asked for (within " +
                    std::to_string(selection.within * 180 / std::acos(-1.0)) +
                    " deg) and looks at the point `facing`. Make the box larger or drop a condition");
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace brisance::solid
