// Global sums of the solid, exact over ranks, and what its supports did to it.
#pragma once
#include <array>
#include <span>

#include "core/base/vec3.hpp"
#include "parallel/exact_sum.hpp"

namespace brisance::solid {

/// Sums over particles and links. Reduce `sums` with Comm::sum; every rank then reads the same bits.
struct Measures {
  enum Item {
    kinetic,                       ///< J, with rotation
    elastic,                       ///< J, each link once
    mass,                          ///< kg
    momentum,                      ///< 3, kg m/s
    angular = momentum + 3,        ///< 3, about the origin, kg m2/s
    momentum_scale = angular + 3,  ///< sum of |m v|, kg m/s
    first_moment,                  ///< 3, sum of m x of free particles, kg m: gravity has done g . (change of it)
    free_mass = first_moment + 3,  ///< kg
    count
  };
  std::array<parallel::ExactSum, count> sums;

  void add(Item item, Real value) { sums[item].add(value); }
  void add(Item item, Vec3 const& v) {
    for (int d = 0; d < 3; ++d) sums[static_cast<std::size_t>(item + d)].add(v[d]);
  }
  Real value(Item item) const { return sums[item].value(); }
  Vec3 vector(Item item) const {
    auto const at = static_cast<std::size_t>(item);
    return {sums[at].value(), sums[at + 1].value(), sums[at + 2].value()};
  }
};

/// Impulse (kg m/s), angular impulse about the origin (kg m2/s) and work (J) of supports on the solid.
struct Reactions {
  std::array<parallel::ExactSum, 7> sums;
  void add(Real dt, Vec3 const& force, Vec3 const& torque_about_origin, Real power) {
    for (int d = 0; d < 3; ++d) {
      sums[static_cast<std::size_t>(d)].add(dt * force[d]);
      sums[static_cast<std::size_t>(3 + d)].add(dt * torque_about_origin[d]);
    }
    sums[6].add(dt * power);
  }
  Vec3 impulse() const { return {sums[0].value(), sums[1].value(), sums[2].value()}; }
  Vec3 angular_impulse() const { return {sums[3].value(), sums[4].value(), sums[5].value()}; }
  Real work() const { return sums[6].value(); }
};

}  // namespace brisance::solid
