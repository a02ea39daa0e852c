// What crossed the sides of the domain: the fluid's part of the audit of mass, momentum and energy.
#pragma once
#include <array>

#include "fluid/grid/grid.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// Sums of dt * area * flux per side and component, exact in any order, hence the same on any number of ranks.
class BoundaryLedger {
 public:
  /// Adds what `flux` (along +direction, per area and time) carried during `dt` through `area` of a side of the domain.
  void add(int direction, int side, Real dt, Real area, State const& flux);

  struct Totals {
    std::array<State, 6>
        through{};   ///< gained by the domain through x_low, x_high, y_low, ...: kg, kg m/s, J (2D: per metre)
    State gained{};  ///< over all sides
    Vec3 impulse{};  ///< sum of the sizes of the normal impulses on the sides along x, y, z: kg m/s
  };
  /// Collective.
  Totals totals(parallel::Comm& comm) const;

 private:
  std::array<std::array<parallel::ExactSum, 5>, 6> through_;
  std::array<parallel::ExactSum, 3> impulse_;
};

}  // namespace brisance::fluid
