#include "coupling/geometry/prism.hpp"

namespace brisance::coupling {

Real prism_volume(Lattice const& lattice, Geometry const& g, Piece const& p, SurfaceTriangle const& t) {
  auto const corners = g.corners_of(p);
  Vec3 const base{static_cast<Real>(p.cell[0]), static_cast<Real>(p.cell[1]), static_cast<Real>(p.cell[2])};
  auto const now = [&](std::size_t c) { return corners[c].point - base; };
  auto const before = [&](std::size_t c) {
    Vec3 x{};
    for (std::size_t v = 0; v < static_cast<std::size_t>(lattice.dimension); ++v)
      x += corners[c].bary[v] * (lattice.grid_point(t.x_old[v]) - base);
    return x;
  };
  if (lattice.dimension == 2) return 0.5 * cross(now(0) - before(1), now(1) - before(0)).z * lattice.cell_volume();
  Real sum = 0;
  for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
    Vec3 const a1 = before(0), b1 = before(c), c1 = before(c + 1), a2 = now(0), b2 = now(c), c2 = now(c + 1);
    Vec3 const s =
        2 * cross(b1 - a1, c1 - a1) + 2 * cross(b2 - a2, c2 - a2) + cross(b1 - a1, c2 - a2) + cross(b2 - a2, c1 - a1);
    sum += dot(s, (a2 - a1) + (b2 - b1) + (c2 - c1)) / 36;
  }
  return sum * lattice.cell_volume();
}

}  // namespace brisance::coupling
