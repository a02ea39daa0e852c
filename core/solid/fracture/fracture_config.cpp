#include "core/solid/fracture/fracture_config.hpp"

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"

namespace brisance::solid {

namespace {

constexpr char const* beta_meaning = "shear strength over tensile strength";
constexpr char const* bending_meaning =
    "add the tensile stress of the outer fibre in bending to the normal stress: for bodies one particle thick";
constexpr char const* exponent_meaning = "exponent of Benzeggagh and Kenane's mixed mode";

}  // namespace

void Elongation::keys(Keys<Elongation>& k) {
  k("at_break", &Elongation::at_break, "1", "elongation of the line between the poles of two particles at their break")
      .required()
      .above(0);
}

void RateHardening::keys(Keys<RateHardening>& k) {
  k("coefficient", &RateHardening::coefficient, "1", "C in 1 + C ln(rate / reference)").required().at_least(0);
  k("reference", &RateHardening::reference, "1/s", "strain rate up to which the strength is the static one").above(0);
}

void MixedStress::keys(Keys<MixedStress>& k) {
  k("tensile_strength", &MixedStress::tensile_strength, "Pa", "normal traction at the break").required().above(0);
  k("beta", &MixedStress::beta, "1", beta_meaning).above(0);
  k("bending", &MixedStress::bending, "", bending_meaning);
  k("rate", &MixedStress::rate, "", "growth of the strength with the rate of strain");
}

void MohrCoulomb::keys(Keys<MohrCoulomb>& k) {
  k("cohesion", &MohrCoulomb::cohesion, "Pa", "shear strength without normal stress").required().above(0);
  k("friction_angle", &MohrCoulomb::friction_angle, "rad", "angle of internal friction").at_least(0).below(1.57);
  k("tensile_strength", &MohrCoulomb::tensile_strength, "Pa",
    "tension cut-off; not given: where the straight line ends, cohesion over tan(friction_angle)")
      .above(0);
  k("bending", &MohrCoulomb::bending, "", bending_meaning);
  k("rate", &MohrCoulomb::rate, "", "growth of the strength with the rate of strain");
}

void EnergyRelease::keys(Keys<EnergyRelease>& k) {
  k("toughness", &EnergyRelease::toughness, "J/m2", "critical energy release rate in opening").required().above(0);
  k("shear_toughness", &EnergyRelease::shear_toughness, "J/m2",
    "critical energy release rate in shear; not given: as in opening")
      .above(0);
  k("mixing_exponent", &EnergyRelease::mixing_exponent, "1", exponent_meaning).above(0);
  k("tip_share", &EnergyRelease::tip_share, "1",
    "share of a crack's release rate that the link at its tip stores: 0.29 gives the toughness of the material, 1 a "
    "body 3.5 times too tough")
      .above(0)
      .at_most(1);
}

void Cohesive::keys(Keys<Cohesive>& k) {
  k("tensile_strength", &Cohesive::tensile_strength, "Pa", "normal traction at which softening begins")
      .required()
      .above(0);
  k("toughness", &Cohesive::toughness, "J/m2", "energy dissipated per area in opening").required().above(0);
  k("shear_toughness", &Cohesive::shear_toughness, "J/m2",
    "energy dissipated per area in shear; not given: as in opening")
      .above(0);
  k("mixing_exponent", &Cohesive::mixing_exponent, "1", exponent_meaning).above(0);
  k("beta", &Cohesive::beta, "1", beta_meaning).above(0);
}

void Weibull::keys(Keys<Weibull>& k) {
  k("modulus", &Weibull::modulus, "1", "Weibull modulus: 5 for scattered, 30 for uniform strengths")
      .required()
      .above(0);
  k("volume", &Weibull::volume, "m3", "volume for which the strength of the law is the characteristic one")
      .required()
      .above(0);
  k("seed", &Weibull::seed, "", "another seed is another specimen");
}

void LawConfig::keys(Keys<LawConfig>& k) {
  k("body", &LawConfig::body, "", "for links between particles of this body; not given: of all");
  k("material", &LawConfig::material, "", "for links between particles of this material; not given: of all");
  k("between", &LawConfig::between, "", "two materials: for the links of their interface");
  k("elongation", &LawConfig::elongation, "", "brittle, by the elongation of the link; blind to shear");
  k("stress", &LawConfig::stress, "", "brittle, by normal and shear traction in mixed mode");
  k("mohr_coulomb", &LawConfig::mohr_coulomb, "", "brittle, by shear against cohesion and friction");
  k("energy", &LawConfig::energy, "", "brittle, by the energy the break releases: for cracks of known toughness");
  k("cohesive", &LawConfig::cohesive, "", "softening: strength and toughness both hold");
  k("weibull", &LawConfig::weibull, "", "scatter of the strength from link to link");
  k("clamps", &LawConfig::clamps, "", "clamped faces break off their wall too");
}

void FractureConfig::keys(Keys<FractureConfig>& k) {
  k("law", &FractureConfig::law, "",
    "criteria; a link follows the last one that fits it, and never breaks when none does");
}

Criterion LawConfig::criterion() const {
  int const given = elongation.has_value() + stress.has_value() + mohr_coulomb.has_value() + energy.has_value() +
                    cohesive.has_value();
  require(given == 1, at,
          "solid.fracture.law has " + std::string(given == 0 ? "no" : "more than one") +
              " criterion. Give exactly one of elongation, stress, mohr_coulomb, energy, cohesive.");
  if (elongation) return *elongation;
  if (stress) return *stress;
  if (mohr_coulomb) return *mohr_coulomb;
  if (energy) return *energy;
  return *cohesive;
}

}  // namespace brisance::solid
