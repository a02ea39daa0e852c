// The cut-cell geometry alone: what `brisance bench` reports of it.
#pragma once
#include "core/base/real.hpp"

namespace brisance::coupling {

/// Items done and the processor time they took, the best of several runs.
struct GeometryRate {
  Real items = 0;
  Real seconds = 0;
};

/// Row `coupling.cut_cells`: clipping, fractions and swept volumes of a sphere of 5120 triangles in 48^3 cells that
/// moves by 0.3 cell per step. Items: cut-cell-steps.
GeometryRate bench_cut_cells();

/// Row `coupling.closest_points`: the centre of every cut cell against each piece of the cell and of the cells before
/// and after it in their order. Items: pairs of point and piece.
GeometryRate bench_closest_points();

}  // namespace brisance::coupling
