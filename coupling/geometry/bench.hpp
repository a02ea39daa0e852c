// The cut-cell geometry alone: what `brisance bench` reports of it.
#pragma once
#include <ctime>
#include <vector>

#include "coupling/geometry/surface.hpp"

namespace brisance::coupling {

/// Items done and the processor time they took, the best of several runs.
struct GeometryRate {
  Real items = 0;
  Real seconds = 0;
};

/// Best of several runs of `work`, which returns its number of items.
template <class Work>
GeometryRate best_rate(Work&& work) {
  constexpr int runs = 5;
  GeometryRate rate;
  for (int run = 0; run < runs; ++run) {
    std::clock_t const start = std::clock();
    auto const items = static_cast<Real>(work());
    Real const seconds = static_cast<Real>(std::clock() - start) / CLOCKS_PER_SEC;
    if (run == 0 || seconds * rate.items < rate.seconds * items) rate = {items, seconds};
  }
  return rate;
}

/// The wall of the rows: a sphere of 5120 triangles about as wide as a cell, within `bench_cells`^3 unit cells.
constexpr Index bench_cells = 48;
std::vector<SurfaceTriangle> bench_sphere();

/// Row `coupling.cut_cells`: clipping, fractions and swept volumes of a sphere of 5120 triangles in 48^3 cells that
/// moves by 0.3 cell per step. Items: cut-cell-steps.
GeometryRate bench_cut_cells();

/// Row `coupling.closest_points`: the centre of every cut cell against each piece of the cell and of the cells before
/// and after it in their order. Items: pairs of point and piece.
GeometryRate bench_closest_points();

}  // namespace brisance::coupling
