// What two pieces of one triangle have in common: the pieces of the boundary at both ends of a step, refined to parts
// that lie in one cell before and in one cell after (theory/coupling.md 1.8, `explicit`).
#pragma once
#include <array>
#include <span>

#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// A part of a triangle (2D: of a segment).
struct TrianglePart {
  Real share = 0;              ///< of its area; shares of parts that tile it sum to 1 to round-off
  std::array<Real, 3> bary{};  ///< barycentric coordinates of the centroid
};

/// The part that two pieces share, by barycentric coordinates alone: where the triangle is does not matter. Convex
/// polygons counter-clockwise in the triangle, as build() makes them; in 2D segments.
TrianglePart overlap(std::span<Corner const> a, std::span<Corner const> b);

}  // namespace brisance::coupling
