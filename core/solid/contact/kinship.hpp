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
  Kinship(Solid const& solid, parallel::Comm& comm) : solid_(solid), comm_(comm) {}

  /// Collective. Learns which links are broken.
  void update();
  /// Has a link of the particle broken?
  bool opened(GlobalId particle) const;
  /// Particles within `dimension` unbroken links of one, sorted, itself included.
  std::vector<GlobalId> const& around(GlobalId particle);
  /// Did all links between the two break?
  bool parted(GlobalId a, GlobalId b) const;
  bool is_broken(std::size_t mesh_link) const { return !broken_.empty() && broken_[mesh_link]; }

 private:
  Solid const& solid_;
  parallel::Comm& comm_;
  std::vector<bool> broken_;  ///< by link of the mesh; empty: none
  std::vector<GlobalId> around_;
};

}  // namespace brisance::solid
