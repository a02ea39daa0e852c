// The value at a point from cell means: linear between centres in open gas, the mean of the cell itself beside a wall.
#pragma once
#include <span>
#include <vector>

#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// What a gauge keeps of one cell, or of one point.  Units: kg/m3, Pa, m/s; share of the cell that is fluid, 0:
/// covered.
struct GaugeValue {
  Real density = 0, pressure = 0;
  Vec3 velocity{};
  Real fluid_share = 1;
};

/// The value of a cell with mean state u.
GaugeValue gauge_value(Gas const& gas, State const& u, Real fluid_share);

/// (1 - w) a + w b; exactly a or b at the ends.
GaugeValue between(GaugeValue const& a, GaugeValue const& b, Real w);

/// The cells around a position and their weights, linear along each direction. Beyond the outermost centres the value
/// is that of the outermost cell; periodic directions wrap.
class GaugeStencil {
 public:
  GaugeStencil(Grid const& grid, Vec3 const& position);
  /// Distinct cells of positive weight: the nearest first, those as near in the order of their ids.
  std::vector<CellIndex> const& cells() const { return cells_; }
  /// `values`: of cells(), in that order. When all are whole, the interpolant. Where a wall cuts or covers any, nothing
  /// is read across it: the mean of the nearest cell that holds gas; covered (share 0) when the nearest do not.
  GaugeValue value(std::span<GaugeValue const> values) const;

 private:
  std::vector<CellIndex> cells_;
  std::vector<Real> weights_;
};

}  // namespace brisance::fluid
