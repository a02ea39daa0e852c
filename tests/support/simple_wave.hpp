// Right-going simple waves of gas with gamma = 1.4 in units of density and pressure 1, and cell means of them.
#pragma once
#include <cmath>

#include "fluid/flow.hpp"

namespace brisance::testing {

constexpr Real wave_gamma = 1.4, wave_k = 2 / (wave_gamma - 1);
inline Real const rest_sound = std::sqrt(wave_gamma);  ///< of density 1 and pressure 1

/// The gas that has speed `u` in a wave running into the unit state at speed `u0`: u - k c is the same in both.
inline fluid::GasState on_wave(Real u, Real u0) {
  Real const c = rest_sound + (u - u0) / wave_k, density = std::pow(c / rest_sound, wave_k);
  return {density, density * c * c / wave_gamma, {u, 0, 0}};
}

/// Speed at (x, t) of the wave that a source at x = path(t) sends with speed(t), both from early on: every value runs
/// at its own u + c.
template <class Speed, class Path>
Real speed_of_wave(Real x, Real t, Speed const& speed, Path const& path) {
  Real early = -10, late = t;
  for (int halvings = 0; halvings < 60; ++halvings) {
    Real const sent = 0.5 * (early + late), u = speed(sent);
    (path(sent) + (t - sent) * (u + rest_sound + u / wave_k) > x ? early : late) = sent;
  }
  return speed(early);
}

/// Mean over cell i of a 1D grid by four Gauss points.
template <class Point>
fluid::State line_mean(fluid::Grid const& grid, Index i, Point const& point) {
  constexpr Real node[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr Real weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  fluid::State sum{};
  for (int g = 0; g < 4; ++g) {
    fluid::State const u = point(grid.centre({i, 0, 0}).x + 0.5 * node[g] * grid.spacing.x);
    for (std::size_t q = 0; q < 5; ++q) sum[q] += 0.5 * weight[g] * u[q];
  }
  return sum;
}

/// Calls visit(global cell, state) for the cells of this rank.
template <class Visit>
void for_cells(fluid::Flow const& flow, Visit const& visit) {
  for (fluid::Block const& block : flow.blocks()) {
    auto const [nx, ny, nz] = block.size();
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i)
          visit(fluid::CellIndex{block.first()[0] + i, block.first()[1] + j, block.first()[2] + k},
                block.load(i, j, k));
  }
}

}  // namespace brisance::testing
