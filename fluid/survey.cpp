#include "fluid/survey.hpp"

#include <cmath>

#include "fluid/flux/face.hpp"

namespace brisance::fluid {
namespace {

/// One cell a lane.
template <class V>
struct Seen {
  Mask<V> gas;  // not vacuum
  V speed[3], pressure, mach_squared;
};

template <class V>
Seen<V> see(V const& density, V const& mx, V const& my, V const& mz, V const& energy, Gas const& gas) {
  V const zero(0.0), one(1.0);
  Mask<V> const some = density > V(gas.vacuum_density);
  V const r = one / select(some, density, one);
  V const u = mx * r, v = my * r, w = mz * r, twice_kinetic = mx * u + my * v + mz * w;
  V internal = energy - V(0.5) * twice_kinetic, curve_pressure(0.0), curve_slope(0.0);
  if (!gas.curve.zero()) {
    CurvePoint<V> const ref = curve_at(density, gas.curve, V(gas.vacuum_density));
    internal = internal - ref.energy;
    curve_pressure = ref.pressure, curve_slope = ref.slope;
  }
  Seen<V> seen;
  seen.gas = some && internal > V(gas.vacuum_energy);
  V square = V(gas.gamma * gas.kappa()) * internal * r;
  if (gas.curve.exponential()) square = square + curve_slope;
  V const c = sqrt(select(seen.gas, square, zero));
  V const velocity[3] = {u, v, w};
  for (int d = 0; d < 3; ++d) seen.speed[d] = select(seen.gas, abs(velocity[d]) + c, zero);
  seen.pressure = V(gas.kappa()) * internal + curve_pressure;
  seen.mach_squared = select(seen.gas, twice_kinetic * r / select(seen.gas, square, one), zero);
  return seen;
}

template <class Fold>
Real over_lanes(Pack const& pack, Real start, Fold fold) {
  alignas(Pack) std::array<Real, Pack::size> lanes;
  store(lanes.data(), pack);
  for (Real const lane : lanes) start = fold(start, lane);
  return start;
}

using Sums = std::array<Pack, 6>;
void add(Sums& to, Sums const& part) {
  for (std::size_t q = 0; q < 6; ++q) to[q] = to[q] + part[q];
}

}  // namespace

Survey survey(Block const& block, Gas const& gas) {
  constexpr Index width = static_cast<Index>(Pack::size);
  static_assert(width <= Block::row_pad, "the last vector of a row must not leave it");
  Pack const zero(0.0), infinite(std::numeric_limits<Real>::infinity());
  alignas(Pack) std::array<Real, Pack::size> count;
  for (std::size_t lane = 0; lane < Pack::size; ++lane) count[lane] = static_cast<Real>(lane);
  Pack const lane_number = load<Pack>(count.data());
  auto const [nx, ny, nz] = block.size();
  std::array<Pack, 3> speed{zero, zero, zero};
  Pack density_min = infinite, pressure_min = infinite, mach_squared = zero;
  Sums sums;
  sums.fill(zero);
  for (Index k = 0; k < nz; ++k) {
    Sums plane;
    plane.fill(zero);
    for (Index j = 0; j < ny; ++j) {
      Sums row;
      row.fill(zero);
      std::ptrdiff_t const at = block.at(0, j, k);
      for (Index i = 0; i < nx; i += width) {
        std::array<Pack, 5> u;
        for (std::size_t q = 0; q < 5; ++q) u[q] = load<Pack>(block.component(static_cast<int>(q)) + at + i);
        if (i + width > nx) {  // what stands beyond the row is no cell
          PackMask const inside = lane_number < Pack(static_cast<Real>(nx - i));
          for (Pack& x : u) x = select(inside, x, zero);
        }
        Seen<Pack> const seen = see(u[0], u[1], u[2], u[3], u[4], gas);
        for (std::size_t d = 0; d < 3; ++d) speed[d] = max(speed[d], seen.speed[d]);
        density_min = min(density_min, select(seen.gas, u[0], infinite));
        pressure_min = min(pressure_min, select(seen.gas, seen.pressure, infinite));
        mach_squared = max(mach_squared, seen.mach_squared);
        for (std::size_t q = 0; q < 5; ++q) row[q] = row[q] + u[q];
        row[5] = row[5] + sqrt(fma(u[1], u[1], fma(u[2], u[2], u[3] * u[3])));
      }
      add(plane, row);
    }
    add(sums, plane);
  }
  auto const largest = [](Real a, Real b) { return max(a, b); };
  auto const smallest = [](Real a, Real b) { return min(a, b); };
  auto const sum = [](Real a, Real b) { return a + b; };
  Survey result;
  for (std::size_t d = 0; d < 3; ++d) result.speed[d] = over_lanes(speed[d], 0, largest);
  result.density_min = over_lanes(density_min, result.density_min, smallest);
  result.pressure_min = over_lanes(pressure_min, result.pressure_min, smallest);
  result.mach_max = std::sqrt(over_lanes(mach_squared, 0, largest));
  for (std::size_t q = 0; q < 5; ++q) result.sum[q] = over_lanes(sums[q], 0, sum);
  result.momentum_size = over_lanes(sums[5], 0, sum);
  return result;
}

std::array<Real, 3> signal_speeds(State const& u, Gas const& gas) {
  Seen<Real> const seen = see(u[0], u[1], u[2], u[3], u[4], gas);
  return {seen.speed[0], seen.speed[1], seen.speed[2]};
}

}  // namespace brisance::fluid
