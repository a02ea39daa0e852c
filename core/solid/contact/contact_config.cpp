#include "core/solid/contact/contact_config.hpp"

#include "core/base/keys.hpp"

namespace brisance::solid {

void ContactConfig::keys(Keys<ContactConfig>& k) {
  k("stiffness", &ContactConfig::stiffness, "1", "stiffness of an overlap over the smaller Young's modulus of the two")
      .above(0)
      .at_most(1);
  k("restitution", &ContactConfig::restitution, "1",
    "separating over closing speed of a flat impact of rigid particles; 1: elastic")
      .at_least(0.1)
      .at_most(1);
  k("friction", &ContactConfig::friction, "1", "Coulomb's coefficient of friction; 0: bodies slide freely").at_least(0);
  k("cfl", &ContactConfig::cfl, "1", "fraction of the stable step of the contacts: how finely an impact is resolved")
      .above(0)
      .at_most(0.5);
  k("self", &ContactConfig::self, "",
    "unbroken bodies touch themselves too: shells that fold, tubes that collapse; without it a body that is whole and "
    "far from others costs nothing. Fragments of a body always touch");
}

}  // namespace brisance::solid
