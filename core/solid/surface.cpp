#include "core/solid/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/solid/solid.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }
std::size_t at(GlobalId i) { return static_cast<std::size_t>(i); }

/// Groups of corners: sets joined pairwise; the root is the smallest member.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Joins the corners of two linked faces that lie at the same reference point.
void join_corners(Mesh const& mesh, Link const& link, std::vector<std::size_t> const& first, Groups& groups) {
  if (link.j == Link::wall || link.far >= 0) return;
  Polyhedron const &a = mesh.shape(link.i).polyhedron, &b = mesh.shape(link.j).polyhedron;
  Vec3 const shift = mesh.particle(link.j).centre - mesh.particle(link.i).centre;
  Real const near = 1e-12 * mesh.face(link.i, link.face_i).area;  // square of a millionth of the face
  for (int va : a.faces[at(link.face_i)])
    for (int vb : b.faces[at(link.face_j)])
      if (norm2(b.vertices[at(vb)] + shift - a.vertices[at(va)]) <= near)
        groups.join(first[at(link.i)] + at(va), first[at(link.j)] + at(vb));
}

/// Offsets of the corners of each particle in arrays over all corners.
std::vector<std::size_t> first_corners(Mesh const& mesh) {
  std::vector<std::size_t> first{0};
  for (GlobalId p = 0; p < mesh.size(); ++p) first.push_back(first.back() + mesh.shape(p).polyhedron.vertices.size());
  return first;
}

/// Faces without a whole link, by particle.
std::vector<FreeFace> open_faces(Mesh const& mesh, std::vector<bool> const& broken) {
  std::vector<FreeFace> faces = mesh.free_faces;
  for (std::size_t l = 0; l < broken.size(); ++l) {
    Link const& link = mesh.links[l];
    if (!broken[l] || link.j == Link::wall) continue;  // a clamped face is boundary already
    faces.push_back({link.i, link.face_i, link.weight * link.rest_length});
    faces.push_back({link.j, link.face_j, (1 - link.weight) * link.rest_length});
  }
  std::stable_sort(faces.begin(), faces.end(), [](auto const& a, auto const& b) { return a.particle < b.particle; });
  return faces;
}

}  // namespace

Surface::Surface(Mesh const& mesh, std::vector<bool> const& broken, Surface const* before)
    : dimension_(mesh.dimension), broken_(broken) {
  std::vector<std::size_t> const first = first_corners(mesh);
  Groups groups(first.back());
  for (std::size_t l = 0; l < mesh.links.size(); ++l)
    if (broken.empty() || !broken[l]) join_corners(mesh, mesh.links[l], first, groups);
  for (std::size_t c = 0; c < first.back(); ++c) root_of_corner_.push_back(groups.root(c));

  // Vertices: the groups that a boundary face uses, then the centres of faces, in the order of the faces.
  std::vector<std::pair<std::size_t, Corner>> centres;  // face centres, by vertex
  Index next = 0;
  auto shared = [&](GlobalId p, int v) {
    auto const [it, fresh] = vertex_of_root_.try_emplace(root_of_corner_[first[at(p)] + at(v)], next);
    if (fresh) ++next;
    return it->second;
  };
  auto own = [&](GlobalId p, int face, Vec3 const& arm) {
    centres.push_back({at(next), {p, arm}});
    vertex_of_face_[{p, face}] = next;
    return next++;
  };
  auto add = [&](GlobalId p, std::array<Index, 3> const& v, int side) {
    elements_.push_back({static_cast<GlobalId>(elements_.size()), mesh.particle(p).body, p, v, side});
  };
  for (FreeFace const& free : open_faces(mesh, broken)) {
    GlobalId const p = free.particle;
    Polyhedron const& shape = mesh.shape(p).polyhedron;
    FaceGeometry const& face = mesh.face(p, free.face);
    auto const& loop = shape.faces[at(free.face)];
    if (dimension_ == 1) {
      add(p, {own(p, free.face, {face.centroid.x, 0, 0}), -1, -1}, face.normal.x > 0 ? 1 : -1);
      continue;
    }
    if (dimension_ == 2) {
      // The edge in the lower plane: counter-clockwise seen from outside, it runs with the body on its left.
      for (std::size_t k = 0; k < loop.size(); ++k) {
        int const a = loop[k], b = loop[(k + 1) % loop.size()];
        if (shape.vertices[at(a)].z < 0 && shape.vertices[at(b)].z < 0) {
          Index const va = shared(p, a), vb = shared(p, b);
          add(p, {va, vb, -1}, 0);
        }
      }
      continue;
    }
    std::vector<Index> corners;
    for (int v : loop) {
      Index const c = shared(p, v);
      if (corners.empty() || (corners.back() != c && corners.front() != c)) corners.push_back(c);
    }
    if (corners.size() < 3) continue;  // a sliver whose corners coincide
    if (corners.size() == 3) {
      add(p, {corners[0], corners[1], corners[2]}, 0);
      continue;
    }
    Index const middle = own(p, free.face, face.centroid);
    for (std::size_t k = 0; k < corners.size(); ++k) add(p, {corners[k], corners[(k + 1) % corners.size()], middle}, 0);
  }

  std::vector<std::vector<Corner>> corners(at(static_cast<GlobalId>(next)));
  for (auto const& [vertex, corner] : centres) corners[vertex].push_back(corner);
  auto const arm_of = [&](Vec3 arm) {
    if (dimension_ == 2) arm.z = 0;
    return arm;
  };
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    auto const& vertices = mesh.shape(p).polyhedron.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (auto const found = vertex_of_root_.find(root_of_corner_[first[at(p)] + v]); found != vertex_of_root_.end())
        corners[at(found->second)].push_back({p, arm_of(vertices[v])});
  }
  for (auto const& of_vertex : corners) {
    corners_.insert(corners_.end(), of_vertex.begin(), of_vertex.end());
    first_.push_back(corners_.size());
  }
  if (!mesh.has(FarSide::Kind::shifted)) check_closed();  // a periodic body is open where it goes on
  if (!before) return;

  origins_.resize(at(next));
  std::map<std::size_t, std::vector<Corner>> inner;  // groups before that were not on the boundary
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    auto const& vertices = mesh.shape(p).polyhedron.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      std::size_t const corner = first[at(p)] + v;
      auto const found = vertex_of_root_.find(root_of_corner_[corner]);
      if (found == vertex_of_root_.end()) continue;
      auto const old = before->vertex_of_root_.find(before->root_of_corner_[corner]);
      if (old != before->vertex_of_root_.end())
        origins_[at(found->second)].vertices = {old->second};
      else
        inner[before->root_of_corner_[corner]];
    }
  }
  if (!inner.empty())
    for (GlobalId p = 0; p < mesh.size(); ++p) {
      auto const& vertices = mesh.shape(p).polyhedron.vertices;
      for (std::size_t v = 0; v < vertices.size(); ++v)
        if (auto const group = inner.find(before->root_of_corner_[first[at(p)] + v]); group != inner.end())
          group->second.push_back({p, arm_of(vertices[v])});
    }
  for (auto const& [root, vertex] : vertex_of_root_)
    if (auto const group = inner.find(before->root_of_corner_[root]); group != inner.end())
      origins_[at(vertex)].corners = group->second;
  for (auto const& [face, vertex] : vertex_of_face_) {
    auto const old = before->vertex_of_face_.find(face);
    if (old != before->vertex_of_face_.end()) {
      origins_[at(vertex)].vertices = {old->second};
      continue;
    }
    // A face of the boundary that had no centre, because some of its corners were one: within the triangle it was.
    auto& was = origins_[at(vertex)].vertices;
    for (int const v : mesh.shape(face.first).polyhedron.faces[at(face.second)])
      if (auto const corner = before->vertex_of_root_.find(before->root_of_corner_[first[at(face.first)] + at(v)]);
          corner != before->vertex_of_root_.end() && std::find(was.begin(), was.end(), corner->second) == was.end())
        was.push_back(corner->second);
    // The centre of a face that was inside: the mean under both particles that it joined.
    for (std::size_t const l : mesh.links_of(face.first)) {
      Link const& link = mesh.links[l];
      if ((link.i == face.first ? link.face_i : link.face_j) != face.second) continue;
      Vec3 const arm = mesh.face(link.i, link.face_i).centroid;
      if (link.j == Link::wall || (!before->broken_.empty() && before->broken_[l])) continue;
      Vec3 const there = mesh.particle(link.i).centre + arm - mesh.particle(link.j).centre;
      was.clear();
      origins_[at(vertex)].corners = {{link.i, arm_of(arm)}, {link.j, arm_of(there)}};
    }
  }
}

std::vector<std::vector<GlobalId>> Surface::neighbours(Mesh const& mesh) {
  std::vector<std::size_t> const first = first_corners(mesh);
  Groups groups(first.back());
  for (Link const& link : mesh.links) join_corners(mesh, link, first, groups);
  std::map<std::size_t, std::vector<GlobalId>> members;
  for (GlobalId p = 0; p < mesh.size(); ++p)
    for (std::size_t c = first[at(p)]; c < first[at(p) + 1]; ++c) {
      auto& of = members[groups.root(c)];
      if (of.empty() || of.back() != p) of.push_back(p);
    }
  std::vector<std::vector<GlobalId>> out(at(mesh.size()));
  for (auto const& [root, of] : members)
    for (GlobalId const p : of)
      for (GlobalId const q : of)
        if (p != q) out[at(p)].push_back(q);
  for (auto& of : out) {
    std::sort(of.begin(), of.end());
    of.erase(std::unique(of.begin(), of.end()), of.end());
  }
  return out;
}

void Surface::check_closed() const {
  std::map<std::pair<Index, Index>, int> edges;
  int sides = 0;
  for (Element const& e : elements_) {
    if (dimension_ == 1) sides += e.side;
    if (dimension_ == 2) {
      ++edges[{e.vertex[0], -1}];
      --edges[{e.vertex[1], -1}];
    }
    if (dimension_ == 3)
      for (std::size_t k = 0; k < 3; ++k) {
        Index const a = e.vertex[k], b = e.vertex[(k + 1) % 3];
        edges[std::minmax(a, b)] += a < b ? 1 : -1;
      }
  }
  bool closed = sides == 0;
  for (auto const& [edge, balance] : edges) closed = closed && balance == 0;
  require(closed, Failure::internal, "the boundary of the solid is not closed: cells of a body do not match.");
}

bool Surface::known(Index vertex, Solid const& solid) const {
  for (Corner const& c : corners(vertex))
    if (solid.local(c.particle) < 0) return false;
  return true;
}

Vec3 Surface::position(Index vertex, Solid const& solid) const {
  Vec3 sum{};
  auto const group = corners(vertex);
  for (Corner const& c : group) {
    Pose const& pose = solid.pose()[at(solid.local(c.particle))];
    sum += pose.x + rotate(pose.q, c.arm);
  }
  return sum / static_cast<Real>(group.size());
}

void Surface::arms(Index vertex, Solid const& solid, std::span<Vec3> arms) const {
  auto const group = corners(vertex);
  for (std::size_t k = 0; k < group.size(); ++k)
    arms[k] = rotate(solid.pose()[at(solid.local(group[k].particle))].q, group[k].arm);
}

Vec3 Surface::velocity(Index vertex, Solid const& solid, std::span<Vec3 const> arms) const {
  Vec3 sum{};
  auto const group = corners(vertex);
  for (std::size_t k = 0; k < group.size(); ++k) {
    HalfVelocity const& h = solid.half_velocity()[at(solid.local(group[k].particle))];
    sum += h.v + cross(h.omega, arms[k]);
  }
  return sum / static_cast<Real>(group.size());
}

Vec3 Surface::reference(Index vertex, Mesh const& mesh) const {
  Corner const& c = corners(vertex)[0];
  return mesh.particle(c.particle).centre + c.arm;
}

}  // namespace brisance::solid
