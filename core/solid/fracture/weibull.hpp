// Scatter of strengths that depends on nothing but the seed and the ids of the ends of a link.
#pragma once
#include <cmath>
#include <cstdint>

#include "core/base/real.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Weibull strengths: a volume V under a uniform stress s survives with probability exp(-(V / V_0) (s / f_0)^m).
struct Weibull {
  Real modulus = 0;  // m
  Real volume = 0;   // V_0, m3
  std::int64_t seed = 1;
  static void keys(Keys<Weibull>& k);

  /// Strength over f_0 of the link of `i` and `j` (`face` tells the walls of a particle apart) that stands for the
  /// volume `of_link`, m3.  Source: theory/solid.md section 14, (V_0 / V)^(1/m) (-ln u)^(1/m).
  Real factor(GlobalId i, GlobalId j, int face, Real of_link) const;
};

/// Uniform in (0, 1), by hash.  Source: mixing function of splitmix64 (Steele, Lea and Flood 2014).
inline Real uniform_of(std::int64_t seed, GlobalId i, GlobalId j, int face) {
  auto const mix = [](std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  std::uint64_t hash = mix(static_cast<std::uint64_t>(seed));
  for (std::int64_t const part : {std::int64_t{i}, std::int64_t{j}, std::int64_t{face}})
    hash = mix(hash ^ static_cast<std::uint64_t>(part));
  return (static_cast<Real>(hash >> 12) + 0.5) * 0x1p-52;
}

inline Real Weibull::factor(GlobalId i, GlobalId j, int face, Real of_link) const {
  return std::pow(-std::log(uniform_of(seed, i, j, face)) * volume / of_link, 1 / modulus);
}

}  // namespace brisance::solid
