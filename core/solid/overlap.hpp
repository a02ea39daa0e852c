// Do bodies overlap in the reference state?
#pragma once
#include <optional>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// A pair of particles of different bodies that share volume.
struct Overlap {
  Index body_a = 0, body_b = 0;
  Vec3 place{};    ///< between the two centres, m
  Real depth = 0;  ///< m
};

/// The first pair, by numbers, that overlaps by more than 1e-6 of the smaller particle. Touching is allowed.
/// Cost: one sweep along x over the particles that lie in the box of another body.
std::optional<Overlap> find_overlap(Mesh const& mesh);

}  // namespace brisance::solid
