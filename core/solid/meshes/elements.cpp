#include "core/solid/meshes/elements.hpp"
#include "core/base/place.hpp"

#include <algorithm>
#include <map>

#include "core/base/errors.hpp"
#include "core/solid/meshes/mesh_faults.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Nodes in ascending order, to compare elements and faces by.
std::vector<Index> sorted(std::span<Index const> nodes) {
  std::vector<Index> s(nodes.begin(), nodes.end());
  std::sort(s.begin(), s.end());
  return s;
}

}  // namespace

std::vector<LocalFace> const& faces_of(ElementKind kind) {
  static std::array<std::vector<LocalFace>, 8> const all{
      {{},
       {},
       {{0, 1}, {1, 2}, {2, 0}},
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
       {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
       {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}};
  return all[static_cast<std::size_t>(kind)];
}

Polyhedron polyhedron_of(ElementMesh const& mesh, MeshElement const& e) {
  Polyhedron p;
  for (Index n : e.nodes()) p.vertices.push_back(mesh.nodes[at(n)]);
  if (dimension(e.kind) == 3) {
    p.faces = faces_of(e.kind);
    return p;
  }
  int const n = node_count(e.kind);
  std::vector<int> bottom, top;
  for (int k = 0; k < n; ++k) {
    p.vertices[static_cast<std::size_t>(k)].z = 0;
    p.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
    bottom.insert(bottom.begin(), k);
    top.push_back(n + k);
  }
  for (int k = 0; k < n; ++k) {
    Vec3 const v = p.vertices[static_cast<std::size_t>(k)];
    p.vertices.push_back({v.x, v.y, 1});
  }
  p.faces.push_back(bottom);
  p.faces.push_back(top);
  return p;
}

Selection select(ElementMesh& mesh, std::optional<std::string> const& group, int run_dimension) {
  Selection kept;
  std::map<std::vector<Index>, std::pair<bool, std::size_t>> place;  // of an element among cells (true) or sides
  for (MeshElement const& e : mesh.elements) {
    int const d = dimension(e.kind);
    if (d != run_dimension && d != run_dimension - 1) continue;
    bool const cell = d == run_dimension;
    auto& list = cell ? kept.cells : kept.sides;
    auto const [it, fresh] = place.try_emplace(sorted(e.nodes()), cell, list.size());
    if (fresh) {
      list.push_back(e);
      continue;
    }
    MeshElement& known = list[it->second.second];
    auto names = mesh.group_sets[at(known.groups)];
    auto const& more = mesh.group_sets[at(e.groups)];
    if (cell && known.tag != e.tag && known.groups == e.groups)
      mesh_error(mesh.path, 0,
                 element_text(e) + " repeats element " + std::to_string(known.tag) +
                     ": both have the same nodes. Remove one of them.");
    names.insert(names.end(), more.begin(), more.end());
    known.groups = mesh.group_set(names);
  }
  std::string const what = run_dimension == 3 ? "volume" : "surface";
  if (group) {
    std::erase_if(kept.cells, [&](MeshElement const& e) { return !mesh.in_group(e, *group); });
    if (kept.cells.empty()) {
      std::vector<std::string> names;
      for (MeshElement const& e : mesh.elements)
        if (dimension(e.kind) == run_dimension)
          for (auto const& n : mesh.group_sets[at(e.groups)]) names.push_back(n);
      std::sort(names.begin(), names.end());
      names.erase(std::unique(names.begin(), names.end()), names.end());
      mesh_error(mesh.path, 0,
                 "no element is in a physical " + what + " \"" + *group + "\"" +
                     (names.empty() ? ": the file has none." : ". Physical " + what + "s: " + joined(names) + "."));
    }
  }
  if (kept.cells.empty())
    mesh_error(mesh.path, 0,
               run_dimension == 3 ? "has no tetrahedra, hexahedra, prisms or pyramids: a body in three dimensions is "
                                    "made of these. Mesh the volume (gmsh -3)."
                                  : "has no triangles or quadrangles: a body in two dimensions is made of these. Mesh "
                                    "the surface (gmsh -2).");
  return kept;
}

int split_warped(ElementMesh& mesh, std::vector<MeshElement>& elements) {
  std::vector<MeshElement> result;
  int count = 0;
  for (MeshElement const& e : elements) {
    Polyhedron const p = polyhedron_of(mesh, e);
    std::vector<bool> warped;
    for (std::size_t f = 0; f < p.faces.size(); ++f) warped.push_back(warp(p, f) > plane_tolerance);
    if (std::find(warped.begin(), warped.end(), true) == warped.end()) {
      result.push_back(e);
      continue;
    }
    ++count;
    Index const middle = static_cast<Index>(mesh.nodes.size());
    Vec3 sum{};
    for (Vec3 const& v : p.vertices) sum += v;
    mesh.nodes.push_back(sum / static_cast<Real>(p.vertices.size()));
    mesh.node_tag.push_back(-1);
    auto add = [&](ElementKind kind, std::initializer_list<Index> nodes) {
      MeshElement part = e;
      part.kind = kind;
      std::copy(nodes.begin(), nodes.end(), part.node.begin());
      result.push_back(part);
    };
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
      std::vector<Index> n;
      for (int k : p.faces[f]) n.push_back(e.node[static_cast<std::size_t>(k)]);
      std::rotate(n.begin(), std::min_element(n.begin(), n.end()), n.end());
      if (n.size() == 4 && !warped[f])
        add(ElementKind::pyramid, {n[0], n[3], n[2], n[1], middle});
      else
        add(ElementKind::tetrahedron, {n[0], n[2], n[1], middle});
      if (n.size() == 4 && warped[f]) add(ElementKind::tetrahedron, {n[0], n[3], n[2], middle});
    }
  }
  elements = std::move(result);
  return count;
}

namespace {

/// A face is known by its nodes; two elements may meet there.
struct Sharing {
  Index cell = -1, other = -1;
  std::size_t slot = 0, other_slot = 0;
};

using Faces = std::map<std::vector<Index>, Sharing>;

/// The faces that a boundary element covers: itself, or the two triangles of a quadrangle that was split.
std::vector<Sharing> faces_behind(Faces const& faces, MeshElement const& side) {
  std::vector<Sharing> found;
  auto look = [&](std::vector<Index> const& nodes) {
    auto const it = faces.find(sorted(nodes));
    if (it != faces.end()) found.push_back(it->second);
  };
  look({side.nodes().begin(), side.nodes().end()});
  if (found.empty() && side.kind == ElementKind::quadrangle) {
    std::vector<Index> n(side.nodes().begin(), side.nodes().end());
    std::rotate(n.begin(), std::min_element(n.begin(), n.end()), n.end());
    look({n[0], n[1], n[2]});
    look({n[0], n[2], n[3]});
  }
  return found;
}

/// Physical surfaces (2D: curves) as groups of faces; a face inside the body belongs with both its sides.
void name_faces(ElementMesh const& mesh, Selection const& kept, Faces const& faces, bool whole_file, Cells& cells) {
  for (MeshElement const& side : kept.sides) {
    if (side.groups == 0) continue;
    auto const& names = mesh.group_sets[at(side.groups)];
    auto const behind = faces_behind(faces, side);
    if (behind.empty() && whole_file)
      mesh_error(mesh.path, 0,
                 element_text(side) + " of the physical group \"" + names[0] + "\" at " +
                     place_text(middle_of(mesh, side.nodes())) +
                     " is no face of any element: the volumes are not saved, or their nodes differ.");
    for (Sharing const& s : behind)
      for (std::string const& name : names) {
        cells.face_groups[name].push_back(s.slot);
        if (s.other >= 0) cells.face_groups[name].push_back(s.other_slot);
      }
  }
}

}  // namespace

Cells cells_of(ElementMesh mesh, MeshFileConfig const& config, int run_dimension) {
  for (Vec3& x : mesh.nodes) x = config.unit * x + config.shift;
  require_plane(mesh, run_dimension);
  if (config.coincident_nodes == "merge") merge_nodes(mesh);
  Selection kept = select(mesh, config.group, run_dimension);
  for (MeshElement const& e : kept.cells) check_nodes(mesh, e);
  if (config.warped == "split" && run_dimension == 3) split_warped(mesh, kept.cells);
  for (MeshElement const& e : kept.cells) check_element(mesh, e);

  Cells cells;
  cells.checked = true;
  Faces faces;
  std::vector<BoundaryFace> boundary;
  for (std::size_t c = 0; c < kept.cells.size(); ++c) {
    MeshElement const& e = kept.cells[c];
    std::size_t const first = cells.neighbour.size();
    cells.add(polyhedron_of(mesh, e), {});
    auto const& loops = faces_of(e.kind);
    for (std::size_t f = 0; f < loops.size(); ++f) {
      std::vector<Index> nodes;
      for (int k : loops[f]) nodes.push_back(e.node[static_cast<std::size_t>(k)]);
      auto const [it, fresh] = faces.try_emplace(sorted(nodes));
      Sharing& s = it->second;
      if (fresh) {
        s = {static_cast<Index>(c), -1, first + f, 0};
        continue;
      }
      if (s.other >= 0)
        mesh_error(mesh.path, 0,
                   "elements " + std::to_string(kept.cells[at(s.cell)].tag) + ", " +
                       std::to_string(kept.cells[at(s.other)].tag) + " and " + std::to_string(e.tag) +
                       " share a face at " + place_text(middle_of(mesh, nodes)) +
                       ": a face has two sides. Remove what is too much.");
      s.other = static_cast<Index>(c), s.other_slot = first + f;
      check_sides(mesh, kept.cells[at(s.cell)], e, nodes);
      cells.neighbour[s.slot] = s.other;
      cells.neighbour[s.other_slot] = s.cell;
    }
  }
  for (auto const& [nodes, s] : faces)
    if (s.other < 0) boundary.push_back({nodes, s.cell, static_cast<int>(s.slot - cells.first[at(s.cell)])});
  check_boundary(mesh, kept.cells, cells, boundary, config.coincident_nodes == "refuse");
  check_overlaps(mesh, kept.cells, boundary);

  for (MeshElement const& e : kept.cells) cells.region.push_back(e.groups);
  cells.region_names = mesh.group_sets;
  name_faces(mesh, kept, faces, !config.group, cells);
  return cells;
}

}  // namespace brisance::solid
