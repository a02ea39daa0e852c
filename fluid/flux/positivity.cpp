#include "fluid/flux/positivity.hpp"

#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {

Real limited_share(Real const (&left)[5], Real const (&right)[5], Real const (&difference)[5], Real twice_sigma) {
  Real share = 1;
  for (int side = 0; side < 2; ++side) {
    Real const(&low)[5] = side == 0 ? left : right;
    Real const step = side == 0 ? -twice_sigma : twice_sigma;
    auto energy = [&](Real t) {
      Real z[5];
      for (int k = 0; k < 5; ++k) z[k] = low[k] + step * t * difference[k];
      if (!(z[0] > 0)) return -std::numeric_limits<Real>::infinity();
      return z[4] - 0.5 * (z[1] * z[1] + z[2] * z[2] + z[3] * z[3]) / z[0];
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
