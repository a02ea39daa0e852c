// Sums of doubles whose bits do not depend on the order of addition, hence not on ranks or partition.
#pragma once
#include <array>
#include <cstdint>

namespace brisance::parallel {

/// Fixed-point accumulator wide enough for every finite double: exact, so any order gives the same bits.
/// A NaN or an infinity among the summands makes the value NaN, also after a reduction or a restart of the limbs.
/// Units: those of the summands.  Cost: about 8 ns per add; for fields, sum each block in a fixed order first.
class ExactSum {
 public:
  void add(double value);
  void add(ExactSum const& other);
  void subtract(ExactSum const& other);
  /// The sum, rounded once to nearest, ties to even; infinite when it leaves the range of a double; never -0.
  double value() const;

  /// The last limb counts the summands that were not finite; the others hold 32 bits of value each.
  static constexpr int limbs = 70;
  /// For reductions and checkpoints: limbs add as integers. Propagates the carries first.
  std::array<std::int64_t, limbs>& raw();
  std::array<std::int64_t, limbs> const& raw() const { return limb_; }

 private:
  void propagate();

  std::array<std::int64_t, limbs> limb_{};
  std::int64_t pending_ = 0;  // additions since the carries were last propagated
};

}  // namespace brisance::parallel
