#include "parallel/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace brisance::parallel {
namespace {

// Bit 0 of limb 0 has the weight 2^-1088: a multiple of 32 below the smallest subnormal, 2^-1074.
constexpr int lowest_exponent = -1088;
constexpr int smallest_bit = -1074 - lowest_exponent;
constexpr int mantissa_bits = 53;
constexpr int value_limbs = ExactSum::limbs - 1;
constexpr int invalid_limb = ExactSum::limbs - 1;
constexpr std::uint64_t low_32 = 0xffffffffu;
// One addition changes a limb by less than 2^33, so limbs stay below 2^61 and three of them may still be added.
constexpr std::int64_t most_pending = std::int64_t{1} << 28;

using Limbs = std::array<std::int64_t, ExactSum::limbs>;

/// Brings every limb but the top one into [0, 2^32); the top one carries the sign.
void carry(Limbs& limb) {
  std::int64_t carried = 0;
  for (int k = 0; k != value_limbs - 1; ++k) {
    std::int64_t const total = limb[k] + carried;
    limb[k] = static_cast<std::int64_t>(static_cast<std::uint64_t>(total) & low_32);
    carried = total >> 32;
  }
  limb[value_limbs - 1] += carried;
}

bool bit(Limbs const& limb, int position) {
  return (static_cast<std::uint64_t>(limb[position / 32]) >> (position % 32)) & 1u;
}

bool any_bit_below(Limbs const& limb, int position) {
  for (int k = 0; k != position / 32; ++k)
    if (limb[k] != 0) return true;
  std::uint64_t const mask = (std::uint64_t{1} << (position % 32)) - 1;
  return (static_cast<std::uint64_t>(limb[position / 32]) & mask) != 0;
}

}  // namespace

void ExactSum::add(double value) {
  auto const bits = std::bit_cast<std::uint64_t>(value);
  int const biased = static_cast<int>((bits >> 52) & 0x7ff);
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  if (biased == 0x7ff) {
    ++limb_[invalid_limb];
    return;
  }
  if (biased != 0) mantissa |= std::uint64_t{1} << 52;
  int const position = (biased == 0 ? 1 : biased) - 1 + smallest_bit;
  int const k = position / 32, shift = position % 32;
  std::uint64_t const low = (mantissa & low_32) << shift, high = (mantissa >> 32) << shift;
  // (x ^ sign) - sign is -x for sign = -1: no branch on a sign that may alternate.
  std::int64_t const sign = static_cast<std::int64_t>(bits) >> 63;
  limb_[k] += (static_cast<std::int64_t>(low & low_32) ^ sign) - sign;
  limb_[k + 1] += (static_cast<std::int64_t>((low >> 32) + (high & low_32)) ^ sign) - sign;
  limb_[k + 2] += (static_cast<std::int64_t>(high >> 32) ^ sign) - sign;
  if (++pending_ >= most_pending) propagate();
}

void ExactSum::add(ExactSum const& other) {
  for (int k = 0; k != limbs; ++k) limb_[k] += other.limb_[k];
  pending_ += other.pending_ + 1;
  if (pending_ >= most_pending) propagate();
}

void ExactSum::subtract(ExactSum const& other) {
  for (int k = 0; k != value_limbs; ++k) limb_[k] -= other.limb_[k];
  limb_[invalid_limb] += other.limb_[invalid_limb];
  pending_ += other.pending_ + 1;
  if (pending_ >= most_pending) propagate();
}

void ExactSum::propagate() {
  carry(limb_);
  pending_ = 0;
}

std::array<std::int64_t, ExactSum::limbs>& ExactSum::raw() {
  propagate();
  return limb_;
}

double ExactSum::value() const {
  if (limb_[invalid_limb] != 0) return std::numeric_limits<double>::quiet_NaN();
  Limbs limb = limb_;
  carry(limb);
  bool const negative = limb[value_limbs - 1] < 0;
  if (negative) {
    for (int k = 0; k != value_limbs; ++k) limb[k] = -limb[k];
    carry(limb);
  }
  int top = value_limbs - 1;
  while (top >= 0 && limb[top] == 0) --top;
  if (top < 0) return 0.0;
  int const highest = 32 * top + static_cast<int>(std::bit_width(static_cast<std::uint64_t>(limb[top]))) - 1;
  int const lowest = std::max(highest - (mantissa_bits - 1), smallest_bit);
  std::uint64_t mantissa = 0;
  for (int position = highest; position >= lowest; --position)
    mantissa = 2 * mantissa + (bit(limb, position) ? 1u : 0u);
  bool const half = bit(limb, lowest - 1);
  if (half && ((mantissa & 1u) != 0 || any_bit_below(limb, lowest - 1))) ++mantissa;
  double const size = std::ldexp(static_cast<double>(mantissa), lowest + lowest_exponent);
  return negative ? -size : size;
}

}  // namespace brisance::parallel
