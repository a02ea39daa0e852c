// Sums of doubles whose bits do not depend on the order of addition, hence not on ranks or partition.
#pragma once
#include <array>
#include <cstdint>

namespace brisance::parallel {

/// Fixed-point accumulator wide enough for every finite double: exact, so any order gives the same bits.
/// Units: those of the summands.  Cost: about 5 ns per add; for fields, sum each block in a fixed order first.
class ExactSum {
 public:
  void add(double value);
  void add(ExactSum const& other);
  /// The sum, rounded once to nearest.
  double value() const;
  static constexpr int limbs = 70;
  std::array<std::int64_t, limbs>& raw() { return limb_; }              ///< for reductions: limbs add as integers
  std::array<std::int64_t, limbs> const& raw() const { return limb_; }

 private:
  std::array<std::int64_t, limbs> limb_{};  // 32 bits of value each, carries deferred
  std::int64_t pending_ = 0;                // additions since the carries were last propagated
  bool invalid_ = false;                    // a NaN or infinity was added
};

}  // namespace brisance::parallel
