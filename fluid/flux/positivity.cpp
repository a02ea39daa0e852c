#include "fluid/flux/positivity.hpp"

#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {

Real limited_share(State const& left, State const& right, State const& difference, Real twice_sigma, Gas const& gas) {
  Real share = 1;
  for (int side = 0; side < 2; ++side) {
    State const& low = side == 0 ? left : right;
    Real const step = side == 0 ? -twice_sigma : twice_sigma;
    auto energy = [&](Real t) {
      State z;
      for (std::size_t n = 0; n < 5; ++n) z[n] = low[n] + step * t * difference[n];
      return z[0] > 0 ? gas.internal_energy(z) : -std::numeric_limits<Real>::infinity();
    };
    Real const whole = energy(0);
    if (!(low[0] > 0) || !(whole > 0)) return 0;  // nothing to spare
    Real const after = low[0] + step * difference[0];
    if (!(after >= kept_share * low[0])) share = min(share, (1 - kept_share) * low[0] / (low[0] - after));
    for (int turn = 0; turn < 2; ++turn)
      if (Real const left_over = energy(share); !(left_over >= kept_share * whole))
        share *= (whole - kept_share * whole) / (whole - left_over);
  }
  return share >= 0 ? share : 0;  // a NaN difference keeps nothing of it
}

std::uint64_t judge(State const& u, Gas const& gas) {
  std::uint64_t bits = 0;
  for (Real const x : u)
    if (!std::isfinite(x)) bits |= static_cast<std::uint64_t>(Health::not_finite);
  Real const reference_density = 1e10 * gas.vacuum_density;
  if (u[0] < -1e-13 * reference_density) bits |= static_cast<std::uint64_t>(Health::negative_density);
  if (gas.internal_energy(u) < -1e-13 * std::fabs(u[4])) bits |= static_cast<std::uint64_t>(Health::negative_energy);
  return bits;
}

}  // namespace brisance::fluid
