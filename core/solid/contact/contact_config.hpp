// What a scene says about contact between bodies and between fragments.
#pragma once
#include "core/base/location.hpp"
#include "core/base/real.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Repulsion and friction of particles that overlap.  Source: theory/solid.md section 15.
struct ContactConfig {
  Real stiffness = 1;    ///< K_c over the smaller Young's modulus of the two
  Real restitution = 1;  ///< separating over closing speed of a flat impact; 1: no damping
  Real friction = 0;     ///< Coulomb's coefficient
  Real cfl = 0.1;        ///< fraction of the stable step of the contacts
  bool self = true;      ///< do unbroken bodies touch themselves?
  Location at;
  static void keys(Keys<ContactConfig>& k);
};

}  // namespace brisance::solid
