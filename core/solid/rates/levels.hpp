// How often each part of the solid is stepped: levels of particles, links and volumes.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// Level l takes steps of 2^l times the finest. One byte per particle or link of the mesh.
/// Source: theory/solid.md section 12(a).
struct Levels {
  int top = 0;          ///< level of the coarsest step
  Real finest = 0;      ///< no larger than the guaranteed step of any particle of level 0, s
  Real cfl = 1;         ///< share of the guaranteed steps that is taken
  Real plain_step = 0;  ///< what one step for all would be, s
  std::vector<std::uint8_t> link, volume, particle;
  /// Level of the first force that a link carries: its own or that of the volume at one of its ends.
  std::vector<std::uint8_t> first;

  /// Step of the top level, s.
  Real step() const { return cfl * finest * static_cast<Real>(1 << top); }
  /// Links of the whole mesh computed in it.
  std::int64_t link_updates() const;
  /// How many times more links one step for all would compute.
  Real gain() const {
    return static_cast<Real>(link.size()) * step() / (plain_step * static_cast<Real>(link_updates()));
  }
};

/// Guaranteed steps of the particles of the mesh, s; 1e300 where there is none.
struct StepLimits {
  std::vector<Real> all;      ///< under all forces
  std::vector<Real> volumes;  ///< under the volumetric ones alone
  Real cfl = 1;               ///< share of them that may be taken
};

/// At most `most` levels; linked particles differ by one level at most. Of the safe choices, the one with the fewest
/// links computed per time.
Levels assign_levels(Mesh const& mesh, StepLimits const& limits, int most);

}  // namespace brisance::solid
