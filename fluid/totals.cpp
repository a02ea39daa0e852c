#include "fluid/totals.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace brisance::fluid {
namespace {

using Sums = std::array<Real, 6>;  // the state, and the size of the momentum

void add(Sums& to, Sums const& part) {
  for (std::size_t q = 0; q < 6; ++q) to[q] += part[q];
}

/// Of a block that walls cut. Row by row and plane by plane: short sums lose fewer digits than one long one.
Sums sums_of_cut(Block const& block, FluidVolume const& volume) {
  auto const [nx, ny, nz] = block.size();
  CellIndex const first = block.first();
  Sums sums{};
  for (Index k = 0; k < nz; ++k) {
    Sums plane{};
    for (Index j = 0; j < ny; ++j) {
      Sums row{};
      for (Index i = 0; i < nx; ++i) {
        Real const v = volume({first[0] + i, first[1] + j, first[2] + k});
        State const u = block.load(i, j, k);
        for (std::size_t q = 0; q < 5; ++q) row[q] += v * u[q];
        row[5] += v * std::sqrt(u[1] * u[1] + u[2] * u[2] + u[3] * u[3]);
      }
      add(plane, row);
    }
    add(sums, plane);
  }
  return sums;
}

Sums sums_of_whole(Survey const& seen, Real cell_volume) {
  Sums sums{};
  for (std::size_t q = 0; q < 5; ++q) sums[q] = seen.sum[q] * cell_volume;
  sums[5] = seen.momentum_size * cell_volume;
  return sums;
}

/// Calls visit(cell, state, fluid volume) for the cells of a block that hold fluid.
template <class Visit>
void for_cells(Block const& block, Grid const& grid, FluidVolume const& volume, Visit&& visit) {
  auto const [nx, ny, nz] = block.size();
  CellIndex const first = block.first();
  bool const cut = volume.cuts(block.id());
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        CellIndex const c{first[0] + i, first[1] + j, first[2] + k};
        Real const v = cut ? volume(c) : grid.cell_volume();
        if (v > 0) visit(c, block.load(i, j, k), v);
      }
}

}  // namespace

LocalTotals local_totals(Flow const& flow, FluidVolume const& volume) {
  LocalTotals sums;
  for (std::size_t b = 0; b < flow.blocks().size(); ++b) {
    Block const& block = flow.blocks()[b];
    Sums const part =
        volume.cuts(block.id()) ? sums_of_cut(block, volume) : sums_of_whole(flow.survey(b), flow.grid().cell_volume());
    sums.mass.add(part[0]);
    for (std::size_t d = 0; d < 3; ++d) sums.momentum[d].add(part[1 + d]);
    sums.energy.add(part[4]);
    sums.momentum_size.add(part[5]);
    if (flow.mixture()) sums.products.add(flow.survey(b).products * flow.grid().cell_volume());
  }
  return sums;
}

Totals totals(Flow const& flow, FluidVolume const& volume) {
  LocalTotals const local = local_totals(flow, volume);
  std::array<parallel::ExactSum, 7> sums{local.mass,   local.momentum[0],   local.momentum[1], local.momentum[2],
                                         local.energy, local.momentum_size, local.products};
  flow.comm().sum(std::span(sums));
  return {sums[0].value(),
          {sums[1].value(), sums[2].value(), sums[3].value()},
          sums[4].value(),
          sums[5].value(),
          sums[6].value()};
}

Extremes extremes(Flow const& flow, FluidVolume const& volume) {
  Gas const& gas = flow.gas();
  constexpr Real infinite = std::numeric_limits<Real>::infinity();
  Extremes e{infinite, infinite, 0};
  for (std::size_t b = 0; b < flow.blocks().size(); ++b) {
    Block const& block = flow.blocks()[b];
    if (!volume.cuts(block.id())) {
      Survey const& seen = flow.survey(b);
      e.density_min = min(e.density_min, seen.density_min);
      e.pressure_min = min(e.pressure_min, seen.pressure_min);
      e.mach_max = max(e.mach_max, seen.mach_max);
      continue;
    }
    for_cells(block, flow.grid(), volume, [&](CellIndex, State const& u, Real) {
      if (gas.vacuum(u)) return;
      e.density_min = min(e.density_min, u[0]);
      e.pressure_min = min(e.pressure_min, gas.pressure(u));
      Real const speed = std::sqrt(u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / u[0];
      e.mach_max = max(e.mach_max, speed / gas.sound_speed(u));
    });
  }
  return e;
}

void add_cells(parallel::Digest& digest, Flow const& flow, FluidVolume const& volume) {
  Grid const& grid = flow.grid();
  for (Block const& block : flow.blocks())
    for_cells(block, grid, volume, [&](CellIndex c, State const& u, Real v) {
      if (flow.mixture()) {
        std::ptrdiff_t const at = block.at(c[0] - block.first()[0], c[1] - block.first()[1], c[2] - block.first()[2]);
        Real const bits[8] = {u[0], u[1], u[2], u[3], u[4], block.component(5)[at], block.component(6)[at], v};
        digest.add(cell_kind, grid.cell_id(c), bits);
      } else {
        Real const bits[6] = {u[0], u[1], u[2], u[3], u[4], v};
        digest.add(cell_kind, grid.cell_id(c), bits);
      }
    });
}

}  // namespace brisance::fluid
