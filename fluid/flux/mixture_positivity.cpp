#include "fluid/flux/mixture_positivity.hpp"

#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {

Real limited_share(MixtureState const& low, MixtureState const& change, Mixture const& mixture) {
  auto const energy = [&](Real share) {
    MixtureState z;
    for (std::size_t n = 0; n < 7; ++n) z[n] = low[n] + share * change[n];
    return z[0] > 0 ? mixture.thermal_energy(z) : -std::numeric_limits<Real>::infinity();
  };
  Real const whole = energy(0);
  if (!(low[0] > 0) || !(whole > 0)) return 0;  // nothing to spare
  Real share = 1;
  auto const keep = [&](Real value, Real step, Real slack) {
    Real const floor = kept_share * value - slack;
    if (!(value + step >= floor)) share = min(share, value > floor ? (floor - value) / step : 0);
  };
  Real const slack = fraction_slack * low[0];
  keep(low[0], change[0], 0);
  keep(low[5], change[5], slack);
  keep(low[0] - low[5], change[0] - change[5], slack);
  keep(low[6], change[6], fraction_slack);
  keep(1 - low[6], -change[6], fraction_slack);
  // Secants on a concave function never overshoot.
  for (int turn = 0; turn < 3; ++turn)
    if (Real const left_over = energy(share); !(left_over >= kept_share * whole))
      share *= (whole - kept_share * whole) / (whole - left_over);
  return share >= 0 ? share : 0;  // a NaN difference keeps nothing of it
}

std::uint64_t judge(MixtureState const& x, Mixture const& mixture) {
  std::uint64_t bits = 0;
  for (Real const value : x)
    if (!std::isfinite(value)) bits |= static_cast<std::uint64_t>(Health::not_finite);
  Real const reference_density = 1e10 * mixture.ambient.vacuum_density;
  if (x[0] < -1e-13 * reference_density) bits |= static_cast<std::uint64_t>(Health::negative_density);
  if (mixture.thermal_energy(x) < -1e-13 * std::fabs(x[4])) bits |= static_cast<std::uint64_t>(Health::negative_energy);
  return bits;
}

}  // namespace brisance::fluid
