// The geometric identities (G1), (G2), (G3) of theory/coupling.md 1.5, measured on one step of a surface.
#pragma once
#include <map>

#include "coupling/geometry/prism.hpp"
#include "coupling/geometry/swept.hpp"
#include "tests/support/shapes.hpp"

namespace brisance::testing {

struct Identities {
  Real residual = 0;  ///< closure before snapping, in faces
  Real closure = 0;   ///< (G1) of the apertures handed out, in faces
  Real mismatch = 0;  ///< x, y, z volumes, in cells
  Real volume = 0;    ///< solid volume against the polyhedron, relative
  Real cell_law = 0;  ///< (G2), in cells
  Real total = 0;     ///< sum of all swept volumes against the change of the polyhedron's volume, likewise
  Real prism = 0;     ///< (G3) per piece: sum over cells against the closed formula, in cells
  Real least_aperture = 1, most_aperture = 0;  ///< in faces
  Real least_volume = 1, most_volume = 0;      ///< in cells
  std::size_t cells = 0, pieces = 0;
  int overlapped = 0;
};

inline constexpr coupling::CellBox everywhere{{-100000, -100000, -100000}, {100000, 100000, 100000}};

using CellVolumes = std::map<coupling::CellIndex, Real>;

/// Fluid volumes of all cells that are not full.
inline CellVolumes volumes_of(coupling::Geometry const& g) {
  CellVolumes v;
  for (auto const& c : g.cells) v[c.cell] = c.volume;
  for (auto const& run : g.solid)
    for (Index i = 0; i < run.count; ++i) v[{run.first[0] + i, run.first[1], run.first[2]}] = 0;
  return v;
}

inline Identities measure(coupling::Lattice const& lattice, Shape const& old, Shape const& now) {
  using namespace coupling;
  Identities r;
  int const dimension = lattice.dimension;
  Geometry g0, g1;
  build(lattice, surface(old, old, dimension), std::span(&everywhere, 1), g0);
  auto const triangles = surface(old, now, dimension);
  build(lattice, triangles, std::span(&everywhere, 1), g1);
  Real const cell = lattice.cell_volume();
  auto const law0 = volumes_of(g0), law1 = volumes_of(g1);
  for (auto const* g : {&g0, &g1}) {
    r.residual = max(r.residual, g->residual);
    r.mismatch = max(r.mismatch, g->volume_mismatch);
    r.overlapped += g->overlapped;
    for (auto const& c : g->cells) {
      r.least_volume = min(r.least_volume, c.volume / cell);
      r.most_volume = max(r.most_volume, c.volume / cell);
      for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
        int const k = static_cast<int>(d);
        Real const face = lattice.face_area(k), low = c.aperture[d][0], high = c.aperture[d][1];
        r.closure = max(r.closure, std::abs(high - low - c.area[k]) / face);
        r.least_aperture = min(r.least_aperture, min(low, high) / face);
        r.most_aperture = max(r.most_aperture, max(low, high) / face);
      }
    }
  }
  auto const solid = [&](CellVolumes const& v) {
    long double sum = 0;
    for (auto const& [c, fluid] : v) sum += cell - fluid;
    return static_cast<Real>(sum);
  };
  Real const exact0 = enclosed(old, dimension, lattice.spacing.z), exact1 = enclosed(now, dimension, lattice.spacing.z);
  // A body much smaller than its cells is known no better than the positions of its corners among the planes.
  Real const scale = max(exact0, cell);
  r.volume = max(std::abs(solid(law0) - exact0), std::abs(solid(law1) - exact1)) / scale;

  std::map<CellIndex, Real> balance;
  std::vector<Swept> parts;
  long double total = 0;
  for (auto const& p : g1.pieces) {
    parts.clear();
    auto const& t = triangles[static_cast<std::size_t>(p.triangle)];
    swept(lattice, g1, p, t, parts);
    Real sum = 0;
    for (auto const& s : parts) {
      sum += s.volume;
      balance[s.cell] += s.volume;
    }
    total += sum;
    r.prism = max(r.prism, std::abs(sum - prism_volume(lattice, g1, p, t)) / cell);
  }
  auto const value = [&](CellVolumes const& v, CellIndex const& c) {
    auto const at = v.find(c);
    return at == v.end() ? cell : at->second;
  };
  for (auto const* v : {&law0, &law1})
    for (auto const& entry : *v) balance.try_emplace(entry.first, 0.0);
  for (auto const& [c, w] : balance) r.cell_law = max(r.cell_law, std::abs(value(law1, c) - value(law0, c) + w) / cell);
  r.total = std::abs(static_cast<Real>(total) - (exact1 - exact0)) / scale;
  r.cells = g1.cells.size();
  r.pieces = g1.pieces.size();
  return r;
}

}  // namespace brisance::testing
