#include "parallel/sum_batch.hpp"

#include <cmath>

namespace brisance::parallel {
namespace {

constexpr std::size_t width = 8;  // independent sums, for the vector units

/// Takes the multiples of ulp(grid) out of all values and returns their sum, which is exact.
template <std::size_t size>
double take(std::array<double, size>& values, double grid) {
  std::array<double, width> sum{};
  for (std::size_t i = 0; i < size; i += width)
    for (std::size_t l = 0; l < width; ++l) {
      double const piece = (values[i + l] + grid) - grid;
      values[i + l] -= piece;
      sum[l] += piece;
    }
  double total = 0;
  for (double s : sum) total += s;
  return total;
}

}  // namespace

void SumBatch::flush() {
  for (std::size_t i = used_; i < size; ++i) values_[i] = 0;
  std::array<double, width> largest{};
  double check = 0;  // 0, or not a number if a value is not finite
  for (std::size_t i = 0; i < size; i += width)
    for (std::size_t l = 0; l < width; ++l) {
      double const a = std::abs(values_[i + l]);
      largest[l] = a > largest[l] ? a : largest[l];
    }
  for (double v : values_) check += 0 * v;
  double most = 0;
  for (double a : largest) most = a > most ? a : most;
  bool const plain = check != 0 || !(check == check) || most > 0x1p900 || most < 0x1p-800;
  if (!plain) {
    // |v| < 2^e; 256 pieces that are multiples of 2^(e + 8 - 52) sum to less than 2^53 of them.
    int e = 0;
    std::frexp(most, &e);
    for (int round = 0; round < 3; ++round, e -= 44) to_.add(take(values_, std::ldexp(1.5, e + 8)));
  }
  for (std::size_t i = 0; i < used_; ++i)
    if (values_[i] != 0) to_.add(values_[i]);
  used_ = 0;
}

}  // namespace brisance::parallel
