#include "parallel/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "parallel/sum_batch.hpp"

namespace brisance::parallel {
namespace {

using Limits = std::numeric_limits<double>;

double sum_of(std::vector<double> const& values) {
  ExactSum sum;
  for (double const x : values) sum.add(x);
  return sum.value();
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

TEST(ExactSum, KeepsWhatPlainAdditionLoses) {
  EXPECT_EQ(sum_of({1e300, 1.0, -1e300}), 1.0);
  EXPECT_EQ(sum_of({1e16, 1.0, 1.0, -1e16}), 2.0);
  EXPECT_EQ(sum_of({Limits::max(), Limits::denorm_min(), -Limits::max()}), Limits::denorm_min());
  EXPECT_EQ(sum_of({0.1, 0.2, -0.3}), std::ldexp(1.0, -55));  // the exact sum of the three doubles
}

TEST(ExactSum, ASingleDoubleComesBackWithItsBits) {
  std::mt19937_64 random(1);
  int tried = 0;
  while (tried != 20000) {
    auto const x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    ++tried;
    ASSERT_EQ(bits(sum_of({x})), bits(x));
  }
  for (double const x : {Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min(), -Limits::denorm_min(),
                         std::nextafter(Limits::min(), 0.0), 1.0, -1.0})
    EXPECT_EQ(bits(sum_of({x})), bits(x));
}

TEST(ExactSum, TwoDoublesAddAsTheProcessorAddsThem) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> exponent(-1074, 1022);
  for (int k = 0; k != 50000; ++k) {
    double const x =
        std::ldexp(static_cast<double>(static_cast<std::int64_t>(random() >> 10)) / 0x1p54, exponent(random));
    int const near = std::ilogb(x == 0 ? 1.0 : x) + static_cast<int>(random() % 120) - 60;
    double const y = std::ldexp((random() % 2 ? 1 : -1) * (0.5 + static_cast<double>(random() >> 11) * 0x1p-54),
                                std::min(near, 1022));
    ASSERT_EQ(sum_of({x, y}), x + y) << x << " " << y;
  }
}

TEST(ExactSum, RoundsTiesToEvenAndOnlyOnce) {
  double const ulp = 0x1p-52;
  EXPECT_EQ(sum_of({1.0, ulp / 2}), 1.0);
  EXPECT_EQ(sum_of({1.0 + ulp, ulp / 2}), 1.0 + 2 * ulp);
  EXPECT_EQ(sum_of({1.0, ulp / 2, Limits::denorm_min()}), 1.0 + ulp);
  EXPECT_EQ(sum_of({1.0, ulp / 2, -Limits::denorm_min()}), 1.0);
  EXPECT_EQ(sum_of({2.0 - ulp, ulp / 2}), 2.0);
}

TEST(ExactSum, OrderAndGroupingDoNotChangeTheBits) {
  std::mt19937_64 random(3);
  std::vector<double> values;
  for (int k = 0; k != 5000; ++k) {
    double const x = std::ldexp(static_cast<double>(random() >> 11) * 0x1p-53, static_cast<int>(random() % 600) - 300);
    values.push_back(x);
    if (k % 2) values.push_back(-x * (1 + 0x1p-40));
  }
  double const expected = sum_of(values);
  for (int k = 0; k != 5; ++k) {
    std::shuffle(values.begin(), values.end(), random);
    EXPECT_EQ(bits(sum_of(values)), bits(expected));
    std::size_t const cut = random() % values.size();
    ExactSum left, right;
    for (std::size_t i = 0; i != values.size(); ++i) (i < cut ? left : right).add(values[i]);
    left.add(right);
    EXPECT_EQ(bits(left.value()), bits(expected));
  }
}

TEST(ExactSum, ManyAdditionsDoNotOverflowALimb) {
  // Doubling by adding sums to themselves reaches 2^40 additions, beyond what unpropagated limbs hold.
  ExactSum sum;
  double const x = 1.0 + 0x1p-52;
  sum.add(x);
  for (int k = 0; k != 40; ++k) sum.add(ExactSum(sum));
  EXPECT_EQ(sum.value(), std::ldexp(x, 40));
  for (int k = 0; k != 40; ++k) {
    ExactSum minus;
    minus.add(-std::ldexp(x, k));
    sum.add(minus);
  }
  EXPECT_EQ(sum.value(), x);
}

TEST(ExactSum, SpillsOverTheRangeToInfinityAndBack) {
  ExactSum sum;
  for (int k = 0; k != 100; ++k) sum.add(Limits::max());
  EXPECT_EQ(sum.value(), Limits::infinity());
  for (int k = 0; k != 99; ++k) sum.add(-Limits::max());
  EXPECT_EQ(sum.value(), Limits::max());
}

TEST(ExactSum, AZeroIsPositive) {
  EXPECT_EQ(bits(sum_of({})), bits(0.0));
  EXPECT_EQ(bits(sum_of({-0.0})), bits(0.0));
  EXPECT_EQ(bits(sum_of({3.0, -3.0})), bits(0.0));
}

TEST(ExactSum, NaNAndInfinityPoison) {
  for (double const bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    EXPECT_TRUE(std::isnan(sum_of({1.0, bad, 2.0})));
    ExactSum sum, other;
    other.add(bad);
    sum.add(other);
    EXPECT_TRUE(std::isnan(sum.value()));
    ExactSum restarted;
    restarted.raw() = sum.raw();
    EXPECT_TRUE(std::isnan(restarted.value()));
  }
}

TEST(SumBatch, HasTheBitsOfTheSumOneByOne) {
  std::mt19937_64 random(11);
  for (int const span : {0, 10, 60, 200, 900, 1070}) {  // powers of two between the largest and the smallest
    for (std::size_t const count : {1u, 7u, 255u, 256u, 257u, 5000u}) {
      ExactSum one_by_one, batched;
      {
        SumBatch batch(batched);
        for (std::size_t n = 0; n < count; ++n) {
          double const mantissa = std::uniform_real_distribution<double>(-1, 1)(random);
          int const exponent = span == 0 ? 0 : std::uniform_int_distribution<int>(-span, 0)(random);
          double const value = std::ldexp(mantissa, exponent);
          one_by_one.add(value);
          batch.add(value);
        }
      }
      EXPECT_EQ(bits(one_by_one.value()), bits(batched.value())) << "span " << span << ", " << count << " numbers";
    }
  }
  ExactSum cancels;
  {
    SumBatch batch(cancels);
    for (double x : {1e300, 1.0, -1e300, 1e-300}) batch.add(x);
    for (double x : {1.0, -1.0}) batch.add(x);
  }
  EXPECT_EQ(cancels.value(), sum_of({1.0, 1e-300}));
  for (double const bad : {Limits::quiet_NaN(), Limits::infinity()}) {
    ExactSum sum;
    {
      SumBatch batch(sum);
      batch.add(1);
      batch.add(bad);
    }
    EXPECT_TRUE(std::isnan(sum.value()));
  }
}

}  // namespace
}  // namespace brisance::parallel
