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

/// Row by row and plane by plane: short sums lose fewer digits than one long one.
template <class Weight>
Sums block_sums(Block const& block, Weight const& weight) {
  auto const [nx, ny, nz] = block.size();
  CellIndex const first = block.first();
  Sums sums{};
  for (Index k = 0; k < nz; ++k) {
    Sums plane{};
    for (Index j = 0; j < ny; ++j) {
      Sums row{};
      for (Index i = 0; i < nx; ++i) {
        Real const w = weight(CellIndex{first[0] + i, first[1] + j, first[2] + k});
        State const u = block.load(i, j, k);
        for (std::size_t q = 0; q < 5; ++q) row[q] += w * u[q];
        row[5] += w * std::sqrt(u[1] * u[1] + u[2] * u[2] + u[3] * u[3]);
      }
      add(plane, row);
    }
    add(sums, plane);
  }
  return sums;
}

/// Calls visit(cell, state, fluid volume) for the cells of this rank that hold fluid.
template <class Visit>
void for_cells(Flow const& flow, FluidVolume const& volume, Visit&& visit) {
  Real const whole = flow.grid().cell_volume();
  for (Block const& block : flow.blocks()) {
    auto const [nx, ny, nz] = block.size();
    CellIndex const first = block.first();
    bool const cut = volume.cuts(block.id());
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) {
          CellIndex const c{first[0] + i, first[1] + j, first[2] + k};
          Real const v = cut ? volume(c) : whole;
          if (v > 0) visit(c, block.load(i, j, k), v);
        }
  }
}

}  // namespace

LocalTotals local_totals(Flow const& flow, FluidVolume const& volume) {
  LocalTotals sums;
  for (Block const& block : flow.blocks()) {
    Sums part;
    if (volume.cuts(block.id())) {
      part = block_sums(block, volume);
    } else {
      part = block_sums(block, [](CellIndex) { return 1.0; });
      for (Real& x : part) x *= flow.grid().cell_volume();
    }
    sums.mass.add(part[0]);
    for (std::size_t d = 0; d < 3; ++d) sums.momentum[d].add(part[1 + d]);
    sums.energy.add(part[4]);
    sums.momentum_size.add(part[5]);
  }
  return sums;
}

Totals totals(Flow const& flow, FluidVolume const& volume) {
  LocalTotals const local = local_totals(flow, volume);
  std::array<parallel::ExactSum, 6> sums{local.mass,        local.momentum[0], local.momentum[1],
                                         local.momentum[2], local.energy,      local.momentum_size};
  flow.comm().sum(std::span(sums));
  return {sums[0].value(), {sums[1].value(), sums[2].value(), sums[3].value()}, sums[4].value(), sums[5].value()};
}

Extremes extremes(Flow const& flow, FluidVolume const& volume) {
  Gas const& gas = flow.gas();
  constexpr Real infinite = std::numeric_limits<Real>::infinity();
  Extremes e{infinite, infinite, 0};
  for_cells(flow, volume, [&](CellIndex, State const& u, Real) {
    if (gas.vacuum(u)) return;
    e.density_min = min(e.density_min, u[0]);
    e.pressure_min = min(e.pressure_min, gas.pressure(u));
    Real const speed = std::sqrt(u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / u[0];
    e.mach_max = max(e.mach_max, speed / gas.sound_speed(u));
  });
  return e;
}

void add_cells(parallel::Digest& digest, Flow const& flow, FluidVolume const& volume) {
  Grid const& grid = flow.grid();
  for_cells(flow, volume, [&](CellIndex c, State const& u, Real v) {
    Real const bits[6] = {u[0], u[1], u[2], u[3], u[4], v};
    digest.add(cell_kind, grid.cell_id(c), bits);
  });
}

}  // namespace brisance::fluid
