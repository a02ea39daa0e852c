#include "fluid/gauges/gauge_stencil.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::fluid {
namespace {

constexpr Real rounding = 1e-9;  // of a cell: positions meant to lie on a centre or a face do

/// The two cells along one direction and the weight of the second.
struct Line {
  std::array<Index, 2> cell;
  Real second;
};

Line line(Grid const& grid, int d, Real x) {
  Real const s = (x - grid.low[d]) / grid.spacing[d] - 0.5;  // in cells, from the first centre
  Index const n = grid.cells[static_cast<std::size_t>(d)];
  auto const i = static_cast<Index>(std::floor(s + rounding));
  Real second = max(0, s - i);
  if (second < rounding) second = 0;
  if (std::abs(second - 0.5) < rounding) second = 0.5;
  auto const inside = [&](Index c) {
    return grid.periodic[static_cast<std::size_t>(d)] ? (c % n + n) % n : std::clamp<Index>(c, 0, n - 1);
  };
  return {{inside(i), inside(i + 1)}, second};
}

}  // namespace

GaugeValue gauge_value(Gas const& gas, State const& u, Real fluid_share) {
  if (!(fluid_share > 0)) return {0, 0, {}, 0};
  Vec3 const v = gas.vacuum(u) ? Vec3{} : Vec3{u[1], u[2], u[3]} / u[0];
  return {u[0], gas.pressure(u), v, fluid_share};
}

GaugeValue between(GaugeValue const& a, GaugeValue const& b, Real w) {
  auto const mix = [w](Real x, Real y) { return (1 - w) * x + w * y; };
  return {mix(a.density, b.density),
          mix(a.pressure, b.pressure),
          {mix(a.velocity.x, b.velocity.x), mix(a.velocity.y, b.velocity.y), mix(a.velocity.z, b.velocity.z)},
          min(a.fluid_share, b.fluid_share)};
}

GaugeStencil::GaugeStencil(Grid const& grid, Vec3 const& position) {
  std::array<Line, 3> lines{Line{{0, 0}, 0}, Line{{0, 0}, 0}, Line{{0, 0}, 0}};
  for (int d = 0; d < grid.dimension; ++d) lines[static_cast<std::size_t>(d)] = line(grid, d, position[d]);
  struct Part {
    CellIndex cell;
    Real weight;
  };
  std::vector<Part> parts;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Part part{{}, 1};
    for (std::size_t d = 0; d < 3; ++d) {
      bool const second = (corner >> d & 1) != 0;
      part.cell[d] = lines[d].cell[second ? 1 : 0];
      part.weight *= second ? lines[d].second : 1 - lines[d].second;
    }
    if (!(part.weight > 0)) continue;
    auto const same = std::find_if(parts.begin(), parts.end(), [&](Part const& p) { return p.cell == part.cell; });
    if (same == parts.end())
      parts.push_back(part);
    else
      same->weight += part.weight;
  }
  std::stable_sort(parts.begin(), parts.end(), [&](Part const& a, Part const& b) {
    return a.weight != b.weight ? a.weight > b.weight : grid.cell_id(a.cell) < grid.cell_id(b.cell);
  });
  for (Part const& p : parts) cells_.push_back(p.cell), weights_.push_back(p.weight);
}

GaugeValue GaugeStencil::value(std::span<GaugeValue const> values) const {
  bool const open =
      std::all_of(values.begin(), values.end(), [](GaugeValue const& v) { return v.fluid_share > 1 - 1e-12; });
  if (!open) {
    // A position on a face is as near to the cells on both sides of it; one of them may be inside the body.
    for (std::size_t c = 0; c < values.size() && weights_[c] == weights_[0]; ++c)
      if (values[c].fluid_share > 0) return values[c];
    return {0, 0, {}, 0};
  }
  GaugeValue sum{0, 0, {}, 1};
  for (std::size_t c = 0; c < values.size(); ++c) {
    sum.density += weights_[c] * values[c].density;
    sum.pressure += weights_[c] * values[c].pressure;
    sum.velocity += weights_[c] * values[c].velocity;
  }
  return sum;
}

}  // namespace brisance::fluid
