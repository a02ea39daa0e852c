// Cohesive links: strength and toughness both hold, whatever the size of the particles.
// Source: theory/solid.md section 14, criterion 4.
#pragma once
#include <optional>

#include "core/solid/fracture/link_state.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// What a softening link remembers, m. All zero until its strength is reached.
struct CohesiveHistory {
  Real largest = 0;  ///< largest effective opening so far
  Real onset = 0;    ///< delta_0
  Real end = 0;      ///< delta_f
  bool operator==(CohesiveHistory const&) const = default;
};

/// Linear softening of the traction from f_t at delta_0 to zero at delta_f over the effective opening
/// delta = sqrt([du_n]+^2 + |du_t|^2 / beta^2), unloading towards the origin. delta_f is set at the onset so that the
/// link dissipates G_c S in the mode it then has, exactly for proportional loading: delta_f = delta_0 G_c / (Y_0 / S).
struct Cohesive {
  static constexpr char const* name = "cohesive";
  static constexpr bool softens = true;
  Real tensile_strength = 0;            // f_t, Pa
  Real toughness = 0;                   // G_I, J/m2
  std::optional<Real> shear_toughness;  // G_II, J/m2; as G_I when absent
  Real mixing_exponent = 2;             // eta of Benzeggagh and Kenane
  Real beta = 1;                        // shear strength over tensile strength
  static void keys(Keys<Cohesive>& k);

  Wants wants() const { return {true, false, false, false}; }

  Real safe_traction(Real scatter, Real) const { return scatter * tensile_strength * min(1, beta); }
  /// 1 - d of the link after this state; updates the history.
  Real intact(LinkState const& s, Real scatter, CohesiveHistory& history) const {
    Real const open = std::max(s.opening, 0.0), slip = s.slip / beta;
    Real const opening = std::sqrt(open * open + slip * slip);
    if (history.end == 0) {
      Real const normal = std::max(s.normal, 0.0), shear = s.shear / beta;
      Real const over = std::sqrt(normal * normal + shear * shear) / (scatter * tensile_strength);
      if (over < 1 || opening == 0) return 1;
      // The step has passed the onset by the factor `over`: scale back along the ray.
      Release g = driving_release(s);
      g.opening -= s.flexure;
      MixedToughness const critical{toughness, shear_toughness.value_or(toughness), mixing_exponent};
      history.onset = opening / over;
      history.end = history.onset * (critical(g) / (g.total() / (over * over)));
    }
    history.largest = std::max(history.largest, opening);
    if (history.largest >= history.end) return 0;  // at once when one link holds more than G_c at its onset
    return history.onset / history.largest * (history.end - history.largest) / (history.end - history.onset);
  }

  /// Longest link that can soften: beyond it the energy stored at the strength exceeds the toughness, m.
  Real longest(Real young_modulus) const {
    return 2 * young_modulus * toughness / (tensile_strength * tensile_strength);
  }
  /// Largest strength over the mean that a link of this length can soften from.
  Real largest_scatter(Real young_modulus, Real length) const { return std::sqrt(longest(young_modulus) / length); }
};

}  // namespace brisance::solid
