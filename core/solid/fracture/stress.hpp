// Stress criteria, brittle: mixed mode, and Mohr-Coulomb with a tension cut-off.
// Source: theory/solid.md section 14, criterion 2.
#pragma once
#include <optional>

#include "core/solid/fracture/link_state.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Strength grows with the rate of strain above a reference: f (1 + C ln(rate / reference)).
struct RateHardening {
  Real coefficient = 0;  // C
  Real reference = 1;    // 1/s
  static void keys(Keys<RateHardening>& k);
  Real factor(Real rate) const { return rate > reference ? 1 + coefficient * std::log(rate / reference) : 1; }
};

/// sqrt([sigma_n]+^2 + (tau / beta)^2) >= f_t.
struct MixedStress {
  static constexpr char const* name = "stress";
  static constexpr bool softens = false;
  Real tensile_strength = 0;  // f_t, Pa
  Real beta = 1;              // shear strength over tensile strength
  bool bending = false;       // add the outer-fibre stress of bending to sigma_n
  std::optional<RateHardening> rate;
  static void keys(Keys<MixedStress>& k);

  Wants wants() const { return {true, rate.has_value(), bending, false}; }
  Real safe_traction(Real scatter, Real) const { return bending ? 0 : scatter * tensile_strength * min(1, beta); }
  bool fails(LinkState const& s, Real scatter) const {
    Real const strength = scatter * tensile_strength * (rate ? rate->factor(s.rate) : 1);
    Real const normal = std::max(s.normal + s.fibre, 0.0), shear = s.shear / beta;
    return normal * normal + shear * shear >= strength * strength;
  }
};

/// tau >= c - sigma_n tan(phi), or sigma_n >= f_t: pressure strengthens.
struct MohrCoulomb {
  static constexpr char const* name = "mohr_coulomb";
  static constexpr bool softens = false;
  Real cohesion = 0;                     // c, Pa
  Real friction_angle = 0;               // phi, rad
  std::optional<Real> tensile_strength;  // f_t, Pa
  bool bending = false;                  // add the outer-fibre stress of bending to sigma_n
  std::optional<RateHardening> rate;
  static void keys(Keys<MohrCoulomb>& k);

  Wants wants() const { return {true, rate.has_value(), bending, false}; }
  Real safe_traction(Real scatter, Real) const {
    Real const sheared = cohesion * std::cos(friction_angle);  // its distance from the origin
    return bending ? 0 : scatter * min(sheared, tensile_strength.value_or(sheared));
  }
  bool fails(LinkState const& s, Real scatter) const {
    Real const strength = scatter * (rate ? rate->factor(s.rate) : 1);
    Real const normal = s.normal + s.fibre;
    return s.shear >= strength * cohesion - normal * std::tan(friction_angle) ||
           (tensile_strength && normal >= strength * *tensile_strength);
  }
};

}  // namespace brisance::solid
