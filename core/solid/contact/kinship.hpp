// Which particles hang together so closely that they are no candidates for contact.
#pragma once
#include <span>
#include <vector>

#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Particles within as many unbroken links as there are dimensions are kin: cells that share a corner are, and their
/// links keep them apart. So are cells that share a corner which unbroken links go round, however many: the wedges
/// about the axis of a rod, cells at a vertex of tetrahedra. A pair whose own link broke is not, whatever way round a
/// crack tip still joins it. Broken links are known on every rank, so that all ranks decide alike.  Source:
/// theory/solid.md section 15.
class Kinship {
 public:
  Kinship(Solid const& solid, parallel::Comm& comm);

  /// Collective. Learns which links are broken.
  void update();
  /// Has a link of the particle broken?
  bool opened(GlobalId particle) const;
  /// Can parts of a body touch each other although it is not folded: has a link of it broken, or has it none?
  bool in_pieces(Index body) const { return in_pieces_[static_cast<std::size_t>(body)]; }
  /// Are two particles of one body no candidates? Cost: a walk over the surroundings of `a` unless it was asked about
  /// last.
  bool excluded(GlobalId a, GlobalId b);

 private:
  void walk(GlobalId from);
  bool parted(GlobalId a, GlobalId b) const;
  bool has_corner(GlobalId particle, Vec3 const& point, Real tolerance) const;
  bool joined_round(GlobalId a, GlobalId b, Vec3 const& corner, Real tolerance);
  bool share_a_corner(GlobalId a, GlobalId b);

  Solid const& solid_;
  parallel::Comm& comm_;
  std::vector<bool> broken_;     ///< by link of the mesh
  std::vector<bool> in_pieces_;  ///< by body
  GlobalId walked_from_ = -1;
  std::vector<std::uint32_t> walk_of_;  ///< by particle: the last walk that met it
  std::uint32_t walk_ = 0;
  std::vector<GlobalId> met_, round_;
};

}  // namespace brisance::solid
