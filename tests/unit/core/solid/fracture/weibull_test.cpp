// The scatter of strengths has the statistics it claims.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/solid/fracture/weibull.hpp"

namespace brisance::solid {
namespace {

TEST(Weibull, StrengthsHaveTheirDistribution) {
  Weibull const law{5, 2e-6, 42};
  int const n = 200000;
  std::vector<Real> strength;
  Real sum = 0, squares = 0;
  Real const volume = 1e-6;
  for (GlobalId i = 0; i < n; ++i) {
    strength.push_back(law.factor(i / 3, i / 3 + 1 + i % 3 * 40, 0, volume));
    sum += strength.back();
    squares += strength.back() * strength.back();
  }
  Real const scale = std::pow(2e-6 / volume, 1 / 5.0);
  Real const mean = scale * std::tgamma(1 + 1 / 5.0);
  Real const variance = scale * scale * std::tgamma(1 + 2 / 5.0) - mean * mean;
  EXPECT_NEAR(sum / n, mean, 4 * std::sqrt(variance / n));  // four standard errors
  EXPECT_NEAR(squares / n - sum / n * sum / n, variance, 0.02 * variance);
  std::sort(strength.begin(), strength.end());
  Real distance = 0;  // Kolmogorov-Smirnov
  for (int i = 0; i < n; ++i) {
    Real const p = 1 - std::exp(-volume / 2e-6 * std::pow(strength[static_cast<std::size_t>(i)], 5));
    distance = std::max(distance, std::max(std::abs(p - Real(i) / n), std::abs(p - Real(i + 1) / n)));
  }
  EXPECT_LT(distance, 1.63 / std::sqrt(n));  // passes in 99 of 100 samples; this one is always the same
}

TEST(Weibull, ChainIsAsStrongAsItsWeakestLink) {
  // n links of a volume V fail together as one of n V: the mean strength falls as n^(-1/m).
  Weibull const law{4, 1, 7};
  int const chains = 4000, links = 16;
  Real sum = 0;
  for (int c = 0; c < chains; ++c) {
    Real weakest = 1e300;
    for (int l = 0; l < links; ++l) weakest = std::min(weakest, law.factor(c * links + l, c * links + l + 1, 0, 0.25));
    sum += weakest;
  }
  Real const mean = std::pow(0.25 * links, -0.25) * std::tgamma(1.25);
  EXPECT_NEAR(sum / chains / mean, 1, 4 * 0.28 / std::sqrt(chains));
}

TEST(Weibull, AnotherSeedIsAnotherSpecimen) {
  Weibull const a{5, 1, 1}, b{5, 1, 2};
  EXPECT_NE(a.factor(3, 4, 0, 1), b.factor(3, 4, 0, 1));
  EXPECT_NE(a.factor(3, 4, 0, 1), a.factor(4, 3, 0, 1));
  EXPECT_NE(a.factor(3, -1, 0, 1), a.factor(3, -1, 1, 1));
  EXPECT_EQ(a.factor(3, 4, 0, 1), a.factor(3, 4, 0, 1));
}

TEST(Weibull, HashIsUniformAndDoesNotFollowItsNeighbours) {
  int const n = 100000;
  Real correlation = 0, lowest = 1, highest = 0;
  for (GlobalId i = 0; i < n; ++i) {
    Real const u = uniform_of(9, i, i + 1, 0), next = uniform_of(9, i + 1, i + 2, 0);
    correlation += (u - 0.5) * (next - 0.5) * 12 / n;
    lowest = std::min(lowest, u), highest = std::max(highest, u);
  }
  EXPECT_LT(std::abs(correlation), 4 / std::sqrt(n));
  EXPECT_GT(lowest, 0);
  EXPECT_LT(highest, 1);
}

}  // namespace
}  // namespace brisance::solid
