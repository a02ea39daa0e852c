#include "core/solid/meshes/mesh_faults.hpp"
#include "core/base/place.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/solid/meshes/elements.hpp"
#include "core/solid/meshes/node_buckets.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

[[noreturn]] void fail(ElementMesh const& mesh, std::string const& what) { mesh_error(mesh.path, 0, what); }

Real size_of(Polyhedron const& p) {
  Vec3 low = p.vertices[0], high = low;
  for (Vec3 const& v : p.vertices)
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], v[d]), high[d] = max(high[d], v[d]);
  return 0.5 * norm(high - low);
}

Real size_of(ElementMesh const& mesh) {
  Polyhedron all;
  all.vertices = mesh.nodes;
  return 2 * size_of(all);
}

std::string node_text(ElementMesh const& mesh, Index n) { return "node " + std::to_string(mesh.node_tag[at(n)]); }

}  // namespace

std::string element_text(MeshElement const& e) {
  return "element " + std::to_string(e.tag) + " (" + name(e.kind) + ")";
}

Vec3 middle_of(ElementMesh const& mesh, std::span<Index const> nodes) {
  Vec3 sum{};
  for (Index n : nodes) sum += mesh.nodes[at(n)];
  return sum / static_cast<Real>(nodes.size());
}

Real warp(Polyhedron const& p, std::size_t face) {
  if (p.faces[face].size() < 4) return 0;
  FaceGeometry const g = face_geometry(p, face);
  if (!(g.area > 0)) return 0;
  Real off = 0;
  for (int v : p.faces[face])
    off = max(off, std::abs(dot(p.vertices[static_cast<std::size_t>(v)] - g.centroid, g.normal)));
  return off / size_of(p);
}

void require_plane(ElementMesh const& mesh, int dimension) {
  if (dimension > 2) return;
  Real const slack = 1e-9 * size_of(mesh);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(mesh.nodes[n].z - mesh.nodes[0].z) > slack)
      fail(mesh, node_text(mesh, static_cast<Index>(n)) + " lies at " + place_text(mesh.nodes[n]) +
                     ", off the plane of the others: in two dimensions all nodes have one z.");
}

void merge_nodes(ElementMesh& mesh) {
  Real const near = 1e-8 * size_of(mesh);
  NodeBuckets buckets(mesh.nodes, 4 * near);
  std::vector<Index> first(mesh.nodes.size());
  for (std::size_t n = 0; n < first.size(); ++n) {
    first[n] = static_cast<Index>(n);
    buckets.each_near(mesh.nodes[n], near, [&](Index other) {
      if (at(other) < n && norm(mesh.nodes[at(other)] - mesh.nodes[n]) <= near)
        first[n] = std::min(first[n], first[at(other)]);
    });
    buckets.add(static_cast<Index>(n));
  }
  for (MeshElement& e : mesh.elements)
    for (Index& n : e.node) n = first[at(n)];
}

void check_nodes(ElementMesh const& mesh, MeshElement const& e) {
  std::set<Index> seen;
  for (Index n : e.nodes())
    if (!seen.insert(n).second)
      fail(mesh, element_text(e) + " has " + node_text(mesh, n) + " twice, at " + place_text(mesh.nodes[at(n)]) +
                     ". Write it as an element with fewer nodes.");
}

void check_element(ElementMesh const& mesh, MeshElement const& e) {
  Polyhedron const p = polyhedron_of(mesh, e);
  Real const size = size_of(p);
  Vec3 const middle = middle_of(mesh, e.nodes());
  std::string const part = dimension(e.kind) == 3 ? "volume" : "area";
  Moments const m = moments(p);
  if (std::abs(m.volume) <= 1e-9 * size * size * size)
    fail(mesh, element_text(e) + " has no " + part + ": its nodes lie in a " +
                   (dimension(e.kind) == 3 ? "plane" : "line") + ", at " + place_text(middle) +
                   ". Remesh there, or remove it.");
  if (m.volume < 0)
    fail(mesh, element_text(e) + " has a negative " + part + " at " + place_text(middle) +
                   ": its nodes are numbered inside out, or it is folded. Reorient or remesh it.");
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    Real const off = warp(p, f);
    if (off <= plane_tolerance) continue;
    std::vector<Index> nodes;
    for (int k : p.faces[f]) nodes.push_back(e.node[static_cast<std::size_t>(k)]);
    fail(mesh, element_text(e) + " has a face that is not plane, by " + std::to_string(off * size) + " m at " +
                   place_text(middle_of(mesh, nodes)) +
                   ". Particles have plane faces: set mesh.warped = \"split\" to cut such elements into pyramids and "
                   "tetrahedra, or mesh with tetrahedra.");
  }
  if (auto const f = fault(p, 2 * plane_tolerance))
    fail(mesh, element_text(e) + " is " + f->what + " at " + place_text(f->place) +
                   ". Particles are convex: move its nodes, or mesh with tetrahedra.");
}

void check_sides(ElementMesh const& mesh, MeshElement const& a, MeshElement const& b, std::span<Index const> nodes) {
  // The vector area of the common face seen from one element (2D: of the strip over the edge).
  auto outward = [&](MeshElement const& e) {
    Polyhedron const p = polyhedron_of(mesh, e);
    auto const& loops = faces_of(e.kind);
    for (std::size_t f = 0; f < loops.size(); ++f) {
      bool const here =
          loops[f].size() == nodes.size() && std::all_of(loops[f].begin(), loops[f].end(), [&](int k) {
            return std::find(nodes.begin(), nodes.end(), e.node[static_cast<std::size_t>(k)]) != nodes.end();
          });
      if (here) return face_geometry(p, f).normal;
    }
    return Vec3{};
  };
  if (dot(outward(a), outward(b)) >= 0)
    fail(mesh, "elements " + std::to_string(a.tag) + " and " + std::to_string(b.tag) +
                   " lie on the same side of their common face at " + place_text(middle_of(mesh, nodes)) +
                   ": they overlap. Remesh there.");
}

namespace {

/// The loop of a boundary face in its order; 2D: the edge.
std::vector<Index> loop_of(MeshElement const& e, BoundaryFace const& f) {
  std::vector<Index> nodes;
  for (int k : faces_of(e.kind)[static_cast<std::size_t>(f.face)]) nodes.push_back(e.node[static_cast<std::size_t>(k)]);
  return nodes;
}

/// Does x lie in a plane face or on its rim (2D: on the edge), away from its corners?
bool lies_in(std::span<Vec3 const> corner, Vec3 const& normal, Real slack, Vec3 const& x) {
  if (std::abs(dot(x - corner[0], normal)) > slack) return false;
  if (corner.size() == 2) {
    Vec3 const along = corner[1] - corner[0];
    Real const s = dot(x - corner[0], along) / norm2(along);
    return s > 0 && s < 1 && norm(x - corner[0] - s * along) <= slack;
  }
  for (std::size_t k = 0; k < corner.size(); ++k) {
    Vec3 const edge = corner[(k + 1) % corner.size()] - corner[k];
    if (dot(cross(normal, normalized(edge)), x - corner[k]) < -slack) return false;
  }
  return true;
}

}  // namespace

void check_boundary(ElementMesh const& mesh, std::span<MeshElement const> elements, Cells const& cells,
                    std::span<BoundaryFace const> boundary, bool coincident) {
  std::set<Index> used;
  std::map<std::vector<Index>, Index> triangles;
  Real longest = 0;
  std::size_t edges = 0;
  for (BoundaryFace const& f : boundary) {
    used.insert(f.nodes.begin(), f.nodes.end());
    if (f.nodes.size() == 3) triangles[f.nodes] = f.cell;
    longest += norm(mesh.nodes[at(f.nodes[1])] - mesh.nodes[at(f.nodes[0])]), ++edges;
  }
  for (BoundaryFace const& f : boundary)
    for (std::size_t out = 0; f.nodes.size() == 4 && out < 4; ++out) {
      std::vector<Index> three = f.nodes;
      three.erase(three.begin() + static_cast<std::ptrdiff_t>(out));
      auto const found = triangles.find(three);
      if (found == triangles.end()) continue;
      fail(mesh, element_text(elements[at(f.cell)]) + " has a quadrangle where " +
                     element_text(elements[at(found->second)]) + " has a triangle, at " +
                     place_text(middle_of(mesh, f.nodes)) +
                     ": the faces do not match. Put a pyramid between them, or mesh both sides alike.");
    }
  if (edges == 0) return;
  Real const near = 1e-8 * size_of(mesh);
  NodeBuckets buckets(mesh.nodes, max(longest / static_cast<Real>(edges), 4 * near));
  for (Index n : used) buckets.add(n);
  for (BoundaryFace const& f : boundary) {
    MeshElement const& e = elements[at(f.cell)];
    std::vector<Vec3> corner;
    std::vector<Index> const loop = loop_of(e, f);
    for (Index n : loop) corner.push_back(mesh.nodes[at(n)]);
    if (corner.size() == 2)
      for (Vec3& x : corner) x.z = 0;
    FaceGeometry const& g = cells.shapes[at(cells.shape[at(f.cell)])].faces[static_cast<std::size_t>(f.face)];
    Vec3 low = corner[0], high = corner[0];
    for (Vec3 const& x : corner)
      for (int d = 0; d < 3; ++d) low[d] = min(low[d], x[d]), high[d] = max(high[d], x[d]);
    Real const slack = max(plane_tolerance * norm(high - low), near);
    buckets.each_in(low, high, slack, [&](Index n) {
      if (std::binary_search(f.nodes.begin(), f.nodes.end(), n)) return;
      Vec3 x = mesh.nodes[at(n)];
      if (corner.size() == 2) x.z = 0;
      for (std::size_t k = 0; k < corner.size(); ++k)
        if (norm(x - corner[k]) <= near) {
          if (coincident)
            fail(mesh, node_text(mesh, n) + " and " + node_text(mesh, loop[k]) + " of " + element_text(e) +
                           " lie at one place, " + place_text(x) +
                           ": the faces there are not joined. Set mesh.coincident_nodes = \"merge\" to join them, or "
                           "\"keep\" if this is a crack.");
          return;
        }
      if (lies_in(corner, g.normal, slack, x))
        fail(mesh, node_text(mesh, n) + " hangs on a face of " + element_text(e) + " at " + place_text(x) +
                       ": the faces do not match. Mesh both sides alike, or give them as two bodies by mesh.group.");
    });
  }
}

}  // namespace brisance::solid
