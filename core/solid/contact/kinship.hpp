// Which particles hang together so closely that they are no candidates for contact.
#pragma once
#include <span>
#include <vector>

#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Particles within as many unbroken links as there are dimensions are kin: cells that share a corner are, and their
/// links keep them apart. A pair whose own link broke is not, whatever way round a crack tip still joins it.
/// Broken links are known on every rank, so that all ranks decide alike.  Source: theory/solid.md section 15.
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

  Solid const& solid_;
  parallel::Comm& comm_;
  std::vector<bool> broken_;     ///< by link of the mesh
  std::vector<bool> in_pieces_;  ///< by body
  GlobalId walked_from_ = -1;
  std::vector<std::uint32_t> walk_of_;  ///< by particle: the last walk that met it
  std::uint32_t walk_ = 0;
  std::vector<GlobalId> met_;
};

}  // namespace brisance::solid
