// Energy criterion, brittle.  Source: theory/solid.md section 14, criterion 3.
#pragma once
#include <optional>

#include "core/solid/fracture/link_state.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Y / S >= beta_G G_c: the link at the tip of a crack stores only the share beta_G of the energy that the crack
/// releases per area; the rest leaves the tip as waves.
struct EnergyRelease {
  static constexpr char const* name = "energy";
  static constexpr bool softens = false;
  Real toughness = 0;                   // G_I, J/m2
  std::optional<Real> shear_toughness;  // G_II, J/m2; as G_I when absent
  Real mixing_exponent = 2;             // eta of Benzeggagh and Kenane
  Real tip_share = 0.29;                // beta_G
  static void keys(Keys<EnergyRelease>& k);

  Wants wants() const { return {true, false, false, false}; }
  /// Y / S is at most t^2 / 2 k + e.
  Real safe_traction(Real scatter, Real stiffness) const {
    return scatter * std::sqrt(2 * tip_share * min(toughness, shear_toughness.value_or(toughness)) * stiffness);
  }
  /// Strength goes with the root of the toughness.
  bool fails(LinkState const& s, Real scatter) const {
    Release const g = driving_release(s);
    MixedToughness const critical{toughness, shear_toughness.value_or(toughness), mixing_exponent};
    return g.total() >= scatter * scatter * tip_share * critical(g);
  }
};

}  // namespace brisance::solid
