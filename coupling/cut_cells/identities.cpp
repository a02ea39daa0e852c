#include "coupling/cut_cells/identities.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/geometry/prism.hpp"
#include "coupling/geometry/swept.hpp"

namespace brisance::coupling {

namespace {

constexpr Real tolerance = 1e-11;  // measured: 1e-14; rounding grows with the distance from the corner of the grid

struct Finding {
  Real defect = tolerance;
  CellIndex cell{};
  char const* what = nullptr;
  void take(Real size, CellIndex const& where, char const* name) {
    if (!(std::abs(size) > defect)) return;
    defect = std::abs(size), cell = where, what = name;
  }
};

}  // namespace

std::string broken_identity(WallRecord const& before, WallRecord const& after, std::span<CellBox const> own) {
  Lattice const& lattice = after.lattice();
  fluid::Grid const& grid = after.grid();
  Real const cell_volume = lattice.cell_volume();
  auto const within = [&](CellIndex const& c, Index halo) {
    for (CellBox const& b : own)
      if (grown(grid, b, halo).holds(c)) return true;
    return false;
  };
  Finding worst;
  std::map<CellIndex, Real> filled;  // by the prisms, in cells
  std::vector<Swept> parts;
  for (CutCell const& cut : after.geometry.cells) {
    if (within(cut.cell, 0))
      for (int d = 0; d < lattice.dimension; ++d) {
        auto const& open = cut.aperture[static_cast<std::size_t>(d)];
        worst.take((open[1] - open[0] - cut.area[d]) / lattice.face_area(d), cut.cell, "closure (G1)");
      }
    if (!within(cut.cell, 2)) continue;
    for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
      Piece const& piece = after.geometry.pieces[static_cast<std::size_t>(f)];
      SurfaceTriangle const& t = after.triangles[static_cast<std::size_t>(piece.triangle)];
      if (!t.moved(lattice.dimension)) continue;
      parts.clear();
      swept(lattice, after.geometry, piece, t, parts);
      Real sum = 0;
      for (Swept const& s : parts) {
        sum += s.volume;
        filled[s.cell] += s.volume / cell_volume;
      }
      if (within(cut.cell, 0))
        worst.take((sum - prism_volume(lattice, after.geometry, piece, t)) / cell_volume, cut.cell, "prism (G3)");
    }
  }
  for (WallRecord const* r : {&before, &after})
    for (CutCell const& cut : r->geometry.cells) filled.try_emplace(cut.cell, 0.0);
  for (auto const& [c, w] : filled) {
    if (!within(c, 0)) continue;
    Real defect = (after.volume(c) - before.volume(c)) / cell_volume + w;
    // Where bodies overlap by more than a cell, or a surface is folded by as much, uncut cells hold a whole number.
    if (before.cut_index(c) < 0 || after.cut_index(c) < 0) {
      bool const piled =
          before.geometry.overlapped + before.geometry.inverted + after.geometry.overlapped + after.geometry.inverted >
          0;
      if (piled) defect -= std::nearbyint(defect);
    }
    worst.take(defect, c, "volume law (G2)");
  }
  if (!worst.what) return {};
  Vec3 const x =
      lattice.position({worst.cell[0] + 0.5, worst.cell[1] + 0.5, grid.dimension == 3 ? worst.cell[2] + 0.5 : 0});
  char text[240];
  std::snprintf(text, sizeof text, "%s of cell (%d, %d, %d) at (%.6g, %.6g, %.6g) m fails by %.3g of a cell",
                worst.what, worst.cell[0], worst.cell[1], worst.cell[2], x.x, x.y, x.z, worst.defect);
  return text;
}

}  // namespace brisance::coupling
