// Cohesive links: strength and toughness both hold, whatever the size of the particles.
// Source: theory/solid.md section 14, criterion 4.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/solid/fracture/link_state.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// What a softening link remembers. All zero until its strength is reached.
struct CohesiveHistory {
  Real largest = 0;  ///< largest effective opening so far, m
  Real onset = 0;    ///< delta_0, m
  Real end = 0;      ///< delta_f, m
  Real peak = 0;     ///< T_0, Pa
  bool operator==(CohesiveHistory const&) const = default;
};

/// Softening begins where sqrt([sigma_n]+^2 + tau^2 / beta^2) = f_t. From there the traction T that does the work of
/// the link, T = (1 - d) ([sigma_n]+ [du_n]+ + tau |du_t|) / delta, falls linearly from T_0 at delta_0 to zero at
/// delta_f = 2 G_c / T_0, over the effective opening delta = sqrt([du_n]+^2 + |du_t|^2 / beta^2): the work is G_c in
/// the mode at the onset. d follows from the stresses at hand and not from the moduli at the onset: those change with d
/// when nu is not zero, and with them the work would miss G_c. Unloading keeps d.
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
  /// Largest 1 - d that a link in this state can have; updates the history.
  Real intact(LinkState const& s, Real scatter, CohesiveHistory& history) const {
    Real const open = std::max(s.opening, 0.0), slip = s.slip / beta;
    Real const opening = std::sqrt(open * open + slip * slip);
    Release const work{0.5 * std::max(s.normal, 0.0) * open, 0.5 * s.shear * s.slip};  // of an intact link
    if (history.end == 0) {
      Real const normal = std::max(s.normal, 0.0), shear = s.shear / beta;
      Real const over = std::sqrt(normal * normal + shear * shear) / (scatter * tensile_strength);
      if (over < 1 || !(work.total() > 0)) return 1;
      MixedToughness const critical{toughness, shear_toughness.value_or(toughness), mixing_exponent};
      history.onset = opening / over;  // the step has passed it: back along the ray
      history.peak = 2 * work.total() / (opening * over);
      history.end = 2 * critical(work) / history.peak;
    }
    if (opening < history.largest) return 1;
    history.largest = opening;
    if (opening >= history.end) return 0;  // at once when a link holds more than G_c at its onset
    Real const traction = history.peak * (history.end - opening) / (history.end - history.onset);
    return std::min(traction * opening / (2 * work.total()), 1.0);
  }

  /// Longest link that can soften: beyond it the energy stored at the strength exceeds the toughness, m.
  Real longest(Real young_modulus) const {
    return 2 * young_modulus * toughness / (tensile_strength * tensile_strength);
  }
  /// Largest strength over the mean that a link of this length can soften from.
  Real largest_scatter(Real young_modulus, Real length) const { return std::sqrt(longest(young_modulus) / length); }
};

}  // namespace brisance::solid
