// Numbering along a space-filling curve: neighbours in space are near in memory, and a range of numbers is a compact
// patch.
#pragma once
#include <span>
#include <vector>

#include "core/base/vec3.hpp"

namespace brisance::solid {

/// Place of a point of the unit cube along a Hilbert curve of 2^20 steps a side.
std::uint64_t hilbert_key(Vec3 const& unit);

/// Permutation that sorts points along the curve through their bounding cube; equal keys keep their order.
std::vector<std::size_t> curve_order(std::span<Vec3 const> points);

}  // namespace brisance::solid
