#include "fluid/shapes.hpp"

#include <cmath>
#include <numbers>

namespace brisance::fluid {
namespace {

/// Share of sample points of the cell for which `inside` holds; points at the centres of equal parts.
template <class Inside>
Real sampled(Grid const& grid, CellIndex c, int samples, Inside const& inside) {
  Vec3 const centre = grid.centre(c);
  int const ny = grid.dimension > 1 ? samples : 1, nz = grid.dimension > 2 ? samples : 1;
  auto const offset = [](int s, int n) { return (s + 0.5) / n - 0.5; };
  int count = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < samples; ++i)
        count += inside(Vec3{centre.x + offset(i, samples) * grid.spacing.x, centre.y + offset(j, ny) * grid.spacing.y,
                             centre.z + offset(k, nz) * grid.spacing.z});
  return static_cast<Real>(count) / (samples * ny * nz);
}

/// The vector without its components in absent directions.
Vec3 present(Grid const& grid, Vec3 v) {
  for (int d = grid.dimension; d < 3; ++d) v[d] = 0;
  return v;
}

bool in_box(Grid const& grid, Vec3 const& x, Vec3 const& low, Vec3 const& high) {
  for (int d = 0; d < grid.dimension; ++d)
    if (x[d] < low[d] || x[d] >= high[d]) return false;
  return true;
}

}  // namespace

Real covered_by_box(Grid const& grid, CellIndex c, Vec3 const& low, Vec3 const& high) {
  Vec3 const centre = grid.centre(c);
  Real share = 1;
  for (int d = 0; d < grid.dimension; ++d) {
    Real const from = (low[d] - centre[d]) / grid.spacing[d] + 0.5, to = (high[d] - centre[d]) / grid.spacing[d] + 0.5;
    // Planes meant to lie on a face of the grid do, whatever the rounding of their coordinates.
    auto const snapped = [](Real x) { return std::abs(x) < 1e-9 ? 0 : std::abs(x - 1) < 1e-9 ? 1 : clamp(x, 0, 1); };
    share *= max(0, snapped(to) - snapped(from));
  }
  return share;
}

Real covered_by_ball(Grid const& grid, CellIndex c, Vec3 const& centre, Real radius, int samples) {
  Real const reach = 0.5 * norm(present(grid, grid.spacing));
  Real const distance = norm(present(grid, grid.centre(c) - centre));
  if (distance + reach < radius) return 1;
  if (distance - reach > radius) return 0;
  return sampled(grid, c, samples, [&](Vec3 const& x) { return norm2(present(grid, x - centre)) < square(radius); });
}

Real covered_by_cylinder(Grid const& grid, CellIndex c, Vec3 const& centre, Real radius, Real length, int axis,
                         int samples) {
  constexpr Real far = 1e300;
  Vec3 low{-far, -far, -far}, high{far, far, far};
  low[axis] = centre[axis] - length / 2;
  high[axis] = centre[axis] + length / 2;
  Real const along = covered_by_box(grid, c, low, high);
  auto const across = [&](Vec3 v) {
    v[axis] = 0;
    return present(grid, v);
  };
  Real const reach = 0.5 * norm(across(grid.spacing)), distance = norm(across(grid.centre(c) - centre));
  if (along == 0 || distance - reach > radius) return 0;
  if (distance + reach < radius) return along;
  return along * sampled(grid, c, samples, [&](Vec3 const& x) { return norm2(across(x - centre)) < square(radius); });
}

Real covered_by_half_space(Grid const& grid, CellIndex c, Vec3 const& point, Vec3 const& normal, int samples) {
  Vec3 const n = normalized(present(grid, normal));
  for (int d = 0; d < grid.dimension; ++d)
    if (std::abs(n[d]) == 1) {
      constexpr Real far = 1e300;
      Vec3 low{-far, -far, -far}, high{far, far, far};
      (n[d] > 0 ? low : high)[d] = point[d];
      return covered_by_box(grid, c, low, high);
    }
  return sampled(grid, c, samples, [&](Vec3 const& x) { return dot(x - point, n) > 0; });
}

Real covered(RegionConfig const& region, Grid const& grid, CellIndex c) {
  bool const whole = region.cells == "whole";
  Vec3 const x = grid.centre(c);
  if (region.shape == "box")
    return whole ? in_box(grid, x, *region.low, *region.high) : covered_by_box(grid, c, *region.low, *region.high);
  int const samples = whole ? 1 : 4;
  if (region.shape == "half_space") {
    if (whole) return dot(present(grid, x - *region.point), *region.normal) > 0;
    return covered_by_half_space(grid, c, *region.point, *region.normal, samples);
  }
  return covered_by_ball(grid, c, *region.centre, *region.radius, samples);
}

Real ball_volume(int dimension, Real radius) {
  constexpr Real pi = std::numbers::pi;
  return dimension == 1 ? 2 * radius : dimension == 2 ? pi * square(radius) : 4 * pi / 3 * radius * square(radius);
}

Real ball_radius(int dimension, Real volume) {
  constexpr Real pi = std::numbers::pi;
  return dimension == 1 ? volume / 2 : dimension == 2 ? std::sqrt(volume / pi) : std::cbrt(3 * volume / (4 * pi));
}

}  // namespace brisance::fluid
