// Step one of build(): the triangles cut into pieces.
#pragma once
#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling::detail {

/// Fills `out.corners` and `out.clipped` with the pieces of all triangles, in their order, each in its cell.
/// A piece in a grid plane belongs to the cell towards which it points, the fluid; where two bodies meet in a plane,
/// see clip.cpp.
void clip(Lattice const& lattice, std::span<SurfaceTriangle const> triangles, Geometry& out);

/// Largest cell index in absolute value: three of them make one key.
inline constexpr Index far_away = (1 << 19) - 2;

/// Order of cells by (c[slow], c[middle], c[fast]).
inline std::uint64_t cell_key(CellIndex const& c, std::size_t slow, std::size_t middle, std::size_t fast) {
  auto const part = [&](std::size_t d) { return static_cast<std::uint64_t>(c[d] + (1 << 19)); };
  return (part(slow) << 40) | (part(middle) << 20) | part(fast);
}

}  // namespace brisance::coupling::detail
