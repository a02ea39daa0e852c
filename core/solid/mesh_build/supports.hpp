// Which faces of the bodies meet a support, and the links that hold them there.
#pragma once
#include <map>
#include <optional>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// Supports of the bodies: which face meets what.
class Supports {
 public:
  Supports(Mesh& mesh, SolidConfig const& config);
  /// Of particles in a prescribed box: of Mesh::motions, -1 if its velocity is constant.
  Index motion_of(std::size_t body, std::size_t box) const { return prescribed_[body][box]; }

  /// The link of a boundary face that a support holds.
  std::optional<Link> link(std::size_t body, GlobalId p, FreeFace const& face);

  /// The index in Mesh::far_sides of a shift.
  Index shifted(Vec3 const& shift) { return side({FarSide::Kind::shifted, -1, {}, shift}); }

 private:
  Index motion(DrivenConfig const& box);
  bool in_group(std::vector<std::string> const& groups, GlobalId p, FreeFace const& face) const;
  bool lies_in(GlobalId p, FreeFace const& face, Vec3 const& low, Vec3 const& high) const;
  /// The whole link to the mirror image: its length is twice the distance of the plane, and particle I takes half of
  /// what it opens.
  Link mirror_link(GlobalId p, FreeFace const& face);
  Index side(FarSide const& wanted);

  Mesh& mesh_;
  SolidConfig const& config_;
  std::vector<std::vector<Index>> prescribed_, walls_;  // of every box of every body
  std::map<std::pair<FarSide::Kind, std::array<Real, 4>>, Index> sides_;
};

}  // namespace brisance::solid
