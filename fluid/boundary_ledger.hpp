// What crossed the sides of the domain: the fluid's part of the audit of mass, momentum and energy.
#pragma once
#include <array>
#include <utility>

#include "fluid/grid/grid.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// Sums of dt * area * flux per side and component, exact in any order, hence the same on any number of ranks.
class BoundaryLedger {
 public:
  /// Adds what `flux` (along +direction, per area and time) carried during `dt` through `area` of a side of the domain.
  void add(int direction, int side, Real dt, Real area, State const& flux);

  /// Adds the products that `flux` carried through a side.
  void add_products(int side, Real dt, Real area, Real flux) {
    products_.add((side == 0 ? dt * area : -(dt * area)) * flux);
  }

  /// Over the whole run, on all ranks.
  struct Totals {
    std::array<State, 6>
        through{};      ///< gained by the domain through x_low, x_high, y_low, ...: kg, kg m/s, J (2D: per metre)
    State gained{};     ///< over all sides
    Real products = 0;  ///< gained mass of detonation products: kg
    Real impulse = 0;   ///< sum of the sizes of the impulses normal to the sides: kg m/s
  };
  /// Collective.
  Totals totals(parallel::Comm& comm) const;

  /// What this rank recorded since the last take().
  struct Crossed {
    std::array<parallel::ExactSum, 5> gained;
    parallel::ExactSum impulse;      ///< sizes of the impulses normal to the sides: kg m/s
    parallel::ExactSum energy_size;  ///< sizes of the amounts of energy: J
  };
  Crossed take() { return std::exchange(recent_, {}); }

 private:
  std::array<std::array<parallel::ExactSum, 5>, 6> through_;
  parallel::ExactSum impulse_, products_;
  Crossed recent_;
};

}  // namespace brisance::fluid
