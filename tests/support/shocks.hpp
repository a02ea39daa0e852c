// The Riemann problems of theory/fluid.md 8.2 and 8.3: one table for errors and for the stability matrix.
#pragma once
#include <ostream>
#include <vector>

#include "tests/support/gases.hpp"
#include "tests/support/riemann.hpp"

namespace brisance::testing {

struct Shock {
  char const *id, *name;
  Primitive left, right;
  double x0, end_time;
  fluid::Gas gas;
  double length;
  double table[6];  ///< L1 error of density, 200 cells, orders 1, 3, ... 11; zeros: not given
};
inline void PrintTo(Shock const& s, std::ostream* out) { *out << s.id; }

/// Those whose errors the theory gives.
std::vector<Shock> const& shocks();
/// Further ones of the stability matrix.
std::vector<Shock> const& hard_shocks();

}  // namespace brisance::testing
