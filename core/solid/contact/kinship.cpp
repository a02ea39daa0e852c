#include "core/solid/contact/kinship.hpp"

#include <algorithm>

namespace brisance::solid {

Kinship::Kinship(Solid const& solid, parallel::Comm& comm)
    : solid_(solid),
      comm_(comm),
      broken_(solid.mesh().links.size(), false),
      walk_of_(static_cast<std::size_t>(solid.mesh().size()), 0) {}

void Kinship::update() {
  walked_from_ = -1;
  Mesh const& mesh = solid_.mesh();
  in_pieces_.assign(mesh.bodies.size(), mesh.links.empty());
  if (!solid_.damageable()) return;
  parallel::Bytes mine;
  for (std::size_t k = 0; k < solid_.links(); ++k)
    if (solid_.intact(k) == 0 && solid_.link_store().end_i(k) < solid_.owned())
      parallel::put(mine, static_cast<std::int64_t>(solid_.mesh_link(k)));
  broken_.assign(mesh.links.size(), false);
  for (parallel::Bytes const& part : comm_.all_gather(mine)) {
    std::span<std::byte const> in = part;
    while (!in.empty()) {
      auto const link = static_cast<std::size_t>(parallel::take<std::int64_t>(in));
      broken_[link] = true;
      in_pieces_[static_cast<std::size_t>(mesh.particle(mesh.links[link].i).body)] = true;
    }
  }
}

bool Kinship::opened(GlobalId particle) const {
  auto const links = solid_.mesh().links_of(particle);
  return std::any_of(links.begin(), links.end(), [&](std::size_t l) { return broken_[l]; });
}

void Kinship::walk(GlobalId from) {
  Mesh const& mesh = solid_.mesh();
  if (++walk_ == 0) std::fill(walk_of_.begin(), walk_of_.end(), 0), walk_ = 1;
  walked_from_ = from;
  met_.assign(1, from);
  walk_of_[static_cast<std::size_t>(from)] = walk_;
  std::size_t next = 0;
  for (int hop = 0; hop < mesh.dimension; ++hop)
    for (std::size_t const end = met_.size(); next < end; ++next)
      for (std::size_t const l : mesh.links_of(met_[next])) {
        Link const& link = mesh.links[l];
        if (link.j == Link::wall || broken_[l]) continue;
        GlobalId const other = link.i == met_[next] ? link.j : link.i;
        std::uint32_t& mark = walk_of_[static_cast<std::size_t>(other)];
        if (mark == walk_) continue;
        mark = walk_;
        met_.push_back(other);
      }
}

bool Kinship::excluded(GlobalId a, GlobalId b) {
  if (walked_from_ != a) walk(a);
  bool const near = walk_of_[static_cast<std::size_t>(b)] == walk_;
  return (near || share_a_corner(a, b)) && !parted(a, b);
}

/// In the mesh as it was built.
bool Kinship::has_corner(GlobalId particle, Vec3 const& point, Real tolerance) const {
  Mesh const& mesh = solid_.mesh();
  Vec3 const at = point - mesh.particle(particle).centre;
  auto const& corners = mesh.shape(particle).polyhedron.vertices;
  return std::any_of(corners.begin(), corners.end(),
                     [&](Vec3 const& corner) { return norm2(corner - at) < square(tolerance); });
}

/// Do unbroken links lead from one to the other through particles that have this corner?
bool Kinship::joined_round(GlobalId a, GlobalId b, Vec3 const& corner, Real tolerance) {
  Mesh const& mesh = solid_.mesh();
  round_.assign(1, a);
  for (std::size_t next = 0; next < round_.size(); ++next)
    for (std::size_t const l : mesh.links_of(round_[next])) {
      Link const& link = mesh.links[l];
      if (link.j == Link::wall || broken_[l]) continue;
      GlobalId const other = link.i == round_[next] ? link.j : link.i;
      if (other == b) return true;
      if (std::find(round_.begin(), round_.end(), other) != round_.end()) continue;
      if (has_corner(other, corner, tolerance)) round_.push_back(other);
    }
  return false;
}

bool Kinship::share_a_corner(GlobalId a, GlobalId b) {
  Mesh const& mesh = solid_.mesh();
  Real reach = 0;
  for (Vec3 const& corner : mesh.shape(a).polyhedron.vertices) reach = max(reach, norm(corner));
  Real const tolerance = 1e-6 * reach;
  for (Vec3 const& corner : mesh.shape(a).polyhedron.vertices) {
    Vec3 const place = mesh.particle(a).centre + corner;
    if (has_corner(b, place, tolerance) && joined_round(a, b, place, tolerance)) return true;
  }
  return false;
}

/// Did all links between the two break?
bool Kinship::parted(GlobalId a, GlobalId b) const {
  Mesh const& mesh = solid_.mesh();
  bool broke = false;
  for (std::size_t const l : mesh.links_of(a)) {
    Link const& link = mesh.links[l];
    if ((link.i == a ? link.j : link.i) != b) continue;
    if (!broken_[l]) return false;
    broke = true;
  }
  return broke;
}

}  // namespace brisance::solid
