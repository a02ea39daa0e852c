#include "parallel/digest.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <vector>

namespace brisance::parallel {
namespace {

Digest of(std::uint32_t kind, std::int64_t id, std::vector<double> const& bits) {
  Digest digest;
  digest.add(kind, id, bits);
  return digest;
}

TEST(Digest, KindIdLengthAndEveryBitCount) {
  Digest const d = of(1, 7, {1.0, 2.0});
  EXPECT_EQ(d, of(1, 7, {1.0, 2.0}));
  EXPECT_NE(d, of(2, 7, {1.0, 2.0}));
  EXPECT_NE(d, of(1, 8, {1.0, 2.0}));
  EXPECT_NE(d, of(1, 7, {2.0, 1.0}));
  EXPECT_NE(d, of(1, 7, {1.0, 2.0, 0.0}));
  EXPECT_NE(of(1, 7, {0.0}), of(1, 7, {-0.0}));
  EXPECT_NE(of(1, 7, {}), Digest{});
}

TEST(Digest, OrderOfEntitiesDoesNotMatter) {
  Digest forward, backward, halves[2];
  for (int k = 0; k != 100; ++k) {
    double const x = k * 0.1;
    forward.add(3, k, std::span(&x, 1));
    halves[k % 2].add(3, k, std::span(&x, 1));
  }
  for (int k = 99; k >= 0; --k) {
    double const x = k * 0.1;
    backward.add(3, k, std::span(&x, 1));
  }
  EXPECT_EQ(forward, backward);
  halves[0].add(halves[1]);
  EXPECT_EQ(forward, halves[0]);
}

TEST(Digest, OneFlippedBitChangesHalfTheBits) {
  double changed = 0;
  int cases = 0;
  for (int word = 0; word != 3; ++word)
    for (int bit = 0; bit != 64; ++bit) {
      std::uint64_t words[3] = {1, 2, 3};
      Digest before, after;
      before.add(1, 1, std::span<std::uint64_t const>(words));
      words[word] ^= std::uint64_t{1} << bit;
      after.add(1, 1, std::span<std::uint64_t const>(words));
      int const low = std::popcount(before.low ^ after.low), high = std::popcount(before.high ^ after.high);
      EXPECT_GT(low, 8);
      EXPECT_GT(high, 8);
      changed += low + high;
      ++cases;
    }
  EXPECT_NEAR(changed / cases, 64.0, 2.0);  // mean of 192 sums of 128 fair coins: standard deviation 0.4
}

TEST(Digest, NearbyEntitiesDoNotCollide) {
  std::set<std::uint64_t> low, high;
  int n = 0;
  for (int id = 0; id != 200; ++id)
    for (int value = 0; value != 200; ++value, ++n) {
      Digest const d = of(1, id, {static_cast<double>(value), static_cast<double>(id)});
      low.insert(d.low);
      high.insert(d.high);
    }
  EXPECT_EQ(static_cast<int>(low.size()), n);
  EXPECT_EQ(static_cast<int>(high.size()), n);
}

TEST(Digest, AddsModulo2To128) {
  Digest d{~std::uint64_t{0}, ~std::uint64_t{0}};
  d.add(Digest{1, 0});
  EXPECT_EQ(d, Digest{});
  Digest carry{~std::uint64_t{0}, 4};
  carry.add(Digest{2, 5});
  EXPECT_EQ(carry, (Digest{1, 10}));
  EXPECT_EQ((Digest{0x1fu, 0xau}).hex(), "000000000000000a000000000000001f");
}

}  // namespace
}  // namespace brisance::parallel
