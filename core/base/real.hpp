// Numbers of the whole code: double precision, and min/max/select on values so that kernels vectorise.
#pragma once
#include <array>
#include <cstdint>

namespace brisance {

using Real = double;
using Index = std::int32_t;     ///< local index
using GlobalId = std::int64_t;  ///< index over all ranks

inline Real min(Real a, Real b) { return a < b ? a : b; }
inline Real max(Real a, Real b) { return a > b ? a : b; }
inline Real clamp(Real x, Real low, Real high) { return min(max(x, low), high); }
inline Real square(Real x) { return x * x; }

}  // namespace brisance
