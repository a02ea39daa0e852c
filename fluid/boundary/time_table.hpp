// A quantity given at some times.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "core/base/real.hpp"

namespace brisance::fluid {

/// Linear between its entries, constant before the first and after the last.  Source: theory/fluid.md 6.
/// Expects: times strictly increasing, at least one entry.  Units: s.
template <std::size_t N>
struct TimeTable {
  using Values = std::array<Real, N>;
  std::vector<Real> times;
  std::vector<Values> values;

  Values at(Real t) const {
    auto const above = std::upper_bound(times.begin(), times.end(), t);
    if (above == times.begin()) return values.front();
    if (above == times.end()) return values.back();
    auto const i = static_cast<std::size_t>(above - times.begin());
    Real const share = (t - times[i - 1]) / (times[i] - times[i - 1]);
    Values v;
    for (std::size_t n = 0; n < N; ++n) v[n] = (1 - share) * values[i - 1][n] + share * values[i][n];
    return v;
  }
};

}  // namespace brisance::fluid
