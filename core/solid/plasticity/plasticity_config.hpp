// What a scene says about the plasticity of a material.
#pragma once
#include <optional>
#include <string>

#include "core/base/location.hpp"
#include "core/solid/plasticity/hardening.hpp"

namespace brisance::solid {

/// Adiabatic heating by plastic work.
struct HeatingConfig {
  Real specific_heat = 0;          // J/(kg K)
  Real share = 0.9;                // Taylor and Quinney: of the plastic work that becomes heat
  Real initial_temperature = 293;  // K
  static void keys(Keys<HeatingConfig>& k);
};

/// Failure strain p_f = (d1 + d2 exp(d3 eta)) (1 + d4 ln rate*) (1 + d5 T*) over the triaxiality eta = mean stress over
/// equivalent stress.
struct DuctileFailureConfig {
  std::string criterion = "damage";
  Real d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0;
  Real cutoff_triaxiality = -1.0 / 3;
  static void keys(Keys<DuctileFailureConfig>& k);
};

/// Plasticity of von Mises; without a hardening law it is perfect.
struct PlasticityConfig {
  Real yield_stress = 0;  // Pa
  std::optional<LinearHardening> linear;
  std::optional<VoceHardening> voce;
  std::optional<LudwikHardening> ludwik;
  std::optional<JohnsonCookHardening> johnson_cook;
  Real kinematic_modulus = 0;  // H, Pa
  std::optional<HeatingConfig> heating;
  std::optional<DuctileFailureConfig> failure;
  Location at;
  static void keys(Keys<PlasticityConfig>& k);

  /// Errors: scene error when more than one law is given.
  Hardening hardening() const;
};

}  // namespace brisance::solid
