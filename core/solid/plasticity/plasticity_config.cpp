#include "core/solid/plasticity/plasticity_config.hpp"

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"

namespace brisance::solid {

void LinearHardening::keys(Keys<LinearHardening>& k) {
  k("modulus", &LinearHardening::modulus, "Pa", "rise of the yield stress per plastic strain").required().at_least(0);
}

void VoceHardening::keys(Keys<VoceHardening>& k) {
  k("saturation", &VoceHardening::saturation, "Pa", "rise of the yield stress at large plastic strain")
      .required()
      .at_least(0);
  k("exponent", &VoceHardening::exponent, "1", "b in saturation (1 - exp(-b p))").required().above(0);
}

void LudwikHardening::keys(Keys<LudwikHardening>& k) {
  k("modulus", &LudwikHardening::modulus, "Pa", "B in B p^n").required().at_least(0);
  k("exponent", &LudwikHardening::exponent, "1", "n in B p^n").required().above(0);
}

void JohnsonCookHardening::keys(Keys<JohnsonCookHardening>& k) {
  k("modulus", &JohnsonCookHardening::modulus, "Pa", "B in B p^n").required().at_least(0);
  k("exponent", &JohnsonCookHardening::exponent, "1", "n in B p^n").required().above(0);
  k("rate_coefficient", &JohnsonCookHardening::rate_coefficient, "1", "C in 1 + C ln(rate / reference_rate)")
      .at_least(0);
  k("reference_rate", &JohnsonCookHardening::reference_rate, "1/s", "plastic strain rate below which C has no effect")
      .above(0);
  k("thermal_exponent", &JohnsonCookHardening::thermal_exponent, "1", "m in 1 - T*^m").above(0);
  k("reference_temperature", &JohnsonCookHardening::reference_temperature, "K", "below it heat has no effect")
      .at_least(0);
  k("melting_temperature", &JohnsonCookHardening::melting_temperature, "K", "no strength is left at it").above(0);
}

void HeatingConfig::keys(Keys<HeatingConfig>& k) {
  k("specific_heat", &HeatingConfig::specific_heat, "J/(kg K)", "heat capacity").required().above(0);
  k("share", &HeatingConfig::share, "1", "of the plastic work that becomes heat (Taylor and Quinney)")
      .at_least(0)
      .at_most(1);
  k("initial_temperature", &HeatingConfig::initial_temperature, "K", "before any plastic work").at_least(0);
}

void DuctileFailureConfig::keys(Keys<DuctileFailureConfig>& k) {
  k("criterion", &DuctileFailureConfig::criterion, "",
    "damage: the sum of dp / p_f reaches 1; strain: p reaches p_f at the present triaxiality")
      .one_of({"damage", "strain"});
  k("d1", &DuctileFailureConfig::d1, "1",
    "failure strain p_f = (d1 + d2 exp(d3 triaxiality)) (1 + d4 ln rate*) (1 + d5 T*)")
      .required()
      .at_least(0);
  k("d2", &DuctileFailureConfig::d2, "1", "see d1").at_least(0);
  k("d3", &DuctileFailureConfig::d3, "1", "see d1; negative in metals");
  k("d4", &DuctileFailureConfig::d4, "1", "see d1; rate* as in johnson_cook");
  k("d5", &DuctileFailureConfig::d5, "1", "see d1; T* as in johnson_cook");
  k("cutoff_triaxiality", &DuctileFailureConfig::cutoff_triaxiality, "1", "nothing is damaged below it");
}

void PlasticityConfig::keys(Keys<PlasticityConfig>& k) {
  k("yield_stress", &PlasticityConfig::yield_stress, "Pa", "in tension, before any hardening").required().above(0);
  k("linear", &PlasticityConfig::linear, "", "linear isotropic hardening");
  k("voce", &PlasticityConfig::voce, "", "saturating isotropic hardening");
  k("ludwik", &PlasticityConfig::ludwik, "", "isotropic hardening by a power of the plastic strain");
  k("johnson_cook", &PlasticityConfig::johnson_cook, "", "hardening by strain and rate, softening by heat");
  k("kinematic_modulus", &PlasticityConfig::kinematic_modulus, "Pa",
    "linear kinematic hardening of Prager: back stress per plastic strain")
      .at_least(0);
  k("heating", &PlasticityConfig::heating, "", "adiabatic heating by plastic work");
  k("failure", &PlasticityConfig::failure, "", "links of particles at the end of their ductility break");
}

Hardening PlasticityConfig::hardening() const {
  int const given = linear.has_value() + voce.has_value() + ludwik.has_value() + johnson_cook.has_value();
  require(given <= 1, at,
          "plasticity has " + std::to_string(given) +
              " hardening laws: keep one of linear, voce, ludwik, johnson_cook (kinematic_modulus "
              "goes with any of them).");
  if (johnson_cook) {
    require(johnson_cook->melting_temperature > johnson_cook->reference_temperature, at,
            "plasticity.johnson_cook: melting_temperature must lie above reference_temperature.");
    return *johnson_cook;
  }
  if (linear) return *linear;
  if (voce) return *voce;
  if (ludwik) return *ludwik;
  return PerfectHardening{};
}

}  // namespace brisance::solid
