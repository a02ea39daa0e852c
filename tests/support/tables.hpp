// What the tables of theory/fluid.md 8 have in common.
#pragma once
#include <string>

namespace brisance::testing {

inline constexpr int orders[] = {1, 3, 5, 7, 9, 11};
/// What a correct program may add to a table value: rounding of the table and of another order of operations.
inline constexpr double allowance = 1.10;

inline std::string variant(int order) { return "order " + std::to_string(order); }

}  // namespace brisance::testing
