// Hardening laws: yield stress over plastic strain, rate and temperature. To add one, write it here and name it in
// PlasticityConfig.  Source: theory/solid.md section 16.
#pragma once
#include <algorithm>
#include <cmath>
#include <variant>

#include "core/base/real.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Where a law is asked: cumulated plastic strain p, its rate (1/s), temperature (K).
struct PlasticPoint {
  Real p = 0, rate = 0, temperature = 0;
};

/// sigma_0
struct PerfectHardening {
  Real factor(PlasticPoint const&) const { return 1; }
  Real excess(Real) const { return 0; }
  Real stored(Real) const { return 0; }
};

/// sigma_0 + H p
struct LinearHardening {
  static constexpr char const* name = "linear";
  Real modulus = 0;  // Pa
  static void keys(Keys<LinearHardening>& k);
  Real factor(PlasticPoint const&) const { return 1; }
  Real excess(Real p) const { return modulus * p; }
  Real stored(Real p) const { return 0.5 * modulus * p * p; }
};

/// sigma_0 + Q (1 - exp(-b p))
struct VoceHardening {
  static constexpr char const* name = "voce";
  Real saturation = 0;  // Q, Pa
  Real exponent = 0;    // b, 1
  static void keys(Keys<VoceHardening>& k);
  Real factor(PlasticPoint const&) const { return 1; }
  Real excess(Real p) const { return -saturation * std::expm1(-exponent * p); }
  Real stored(Real p) const { return saturation * (p + std::expm1(-exponent * p) / exponent); }
};

/// A + B p^n
struct LudwikHardening {
  static constexpr char const* name = "ludwik";
  Real modulus = 0;   // B, Pa
  Real exponent = 1;  // n, 1
  static void keys(Keys<LudwikHardening>& k);
  Real factor(PlasticPoint const&) const { return 1; }
  Real excess(Real p) const { return modulus * std::pow(p, exponent); }
  Real stored(Real p) const { return modulus * std::pow(p, exponent + 1) / (exponent + 1); }
};

/// (A + B p^n) (1 + C ln(rate / rate_0)) (1 - T*^m), T* = (T - T_0) / (T_melt - T_0): a lower rate or temperature than
/// the reference changes nothing.
struct JohnsonCookHardening {
  static constexpr char const* name = "johnson_cook";
  Real modulus = 0;                                               // B, Pa
  Real exponent = 1;                                              // n, 1
  Real rate_coefficient = 0;                                      // C, 1
  Real reference_rate = 1;                                        // 1/s
  Real thermal_exponent = 1;                                      // m, 1
  Real reference_temperature = 293, melting_temperature = 1e300;  // K
  static void keys(Keys<JohnsonCookHardening>& k);
  /// T*
  Real homologous(Real temperature) const {
    return std::clamp((temperature - reference_temperature) / (melting_temperature - reference_temperature), 0.0, 1.0);
  }
  /// ln of the rate over the reference, not below 0.
  Real log_rate(Real rate) const { return std::log(std::max(rate / reference_rate, 1.0)); }
  Real factor(PlasticPoint const& at) const {
    Real const hot = homologous(at.temperature);
    return (1 + rate_coefficient * log_rate(at.rate)) * (hot > 0 ? 1 - std::pow(hot, thermal_exponent) : 1);
  }
  Real excess(Real p) const { return modulus * std::pow(p, exponent); }
  Real stored(Real p) const { return modulus * std::pow(p, exponent + 1) / (exponent + 1); }
};

using Hardening = std::variant<PerfectHardening, LinearHardening, VoceHardening, LudwikHardening, JohnsonCookHardening>;

}  // namespace brisance::solid
