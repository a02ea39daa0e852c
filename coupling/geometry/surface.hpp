// What the cut-cell geometry takes in: the lattice of grid planes and the moving triangles of the bodies.
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "core/base/real.hpp"
#include "core/base/vec3.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::coupling {

using fluid::CellIndex;

/// The grid planes, without bounds: cell indices may be negative or beyond the box. In 2D the third index is always 0
/// and `spacing.z` is the depth of the slab.
/// Units: m.
struct Lattice {
  int dimension = 3;  ///< 2 or 3
  Vec3 low{};
  Vec3 spacing{1, 1, 1};

  Real cell_volume() const { return spacing.x * spacing.y * spacing.z; }
  Real face_area(int d) const { return cell_volume() / spacing[d]; }
  Vec3 position(Vec3 const& g) const {  ///< from grid units (cells from `low`) to metres
    return {low.x + g.x * spacing.x, low.y + g.y * spacing.y, low.z + g.z * spacing.z};
  }
  Vec3 grid_point(Vec3 const& x) const;  ///< to grid units; on a plane when within 1e-12 of a cell of it
};

/// One triangle of the boundary of a solid at both ends of a step, counter-clockwise seen from the fluid. In 2D a
/// segment: the first two entries, with the fluid on the side of (dy, -dx).
/// Units: m, m/s.
struct SurfaceTriangle {
  GlobalId id = 0;
  GlobalId surface = 0;  ///< the closed surface it belongs to, by its lowest triangle
  std::array<GlobalId, 3> vertex{};
  std::array<Vec3, 3> x_old{}, x_new{}, velocity{};
  // What the fluid gives beside its loads, per area that bears one (WallSurface::apply):
  Real centring = 0;  ///< power, W/m2
  Vec3 turning{};     ///< force, Pa

  bool moved(int dimension) const {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
      if (!(x_old[a] == x_new[a])) return true;
    return false;
  }
};

/// Equal to the sign of zero: what shortcuts must ask before they leave something as it is.
inline bool same_bits(Vec3 const& a, Vec3 const& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}
inline bool same_bits(std::array<Vec3, 3> const& a, std::array<Vec3, 3> const& b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}

/// Cells low <= c < high.
struct CellBox {
  CellIndex low{}, high{};
  bool holds(CellIndex const& c) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (c[d] < low[d] || c[d] >= high[d]) return false;
    return true;
  }
};

inline Vec3 Lattice::grid_point(Vec3 const& x) const {
  // Snapping vertices, not pieces, is the tie rule of coincident planes: every triangle sees the same snapped vertex,
  // so that the surface stays closed, and planes are integers, so that "on the plane" is an exact test.
  constexpr Real tie = 1e-12;
  Vec3 g{(x.x - low.x) / spacing.x, (x.y - low.y) / spacing.y, dimension == 3 ? (x.z - low.z) / spacing.z : 0};
  for (int d = 0; d < 3; ++d) {
    Real const plane = std::nearbyint(g[d]);
    if (std::abs(g[d] - plane) <= tie) g[d] = plane;
  }
  return g;
}

}  // namespace brisance::coupling
