#include "core/solid/plasticity/return_mapping.hpp"

#include "core/base/errors.hpp"

namespace brisance::solid {

PlasticLaw::PlasticLaw(PlasticityConfig const& config, Real density, Real shear)
    : config_(config),
      hardening_(config.hardening()),
      density_(density),
      stiffness_(3 * shear + 1.5 * config.kinematic_modulus) {
  require(
      !config.failure || (config.failure->d4 == 0 && config.failure->d5 == 0) || config.johnson_cook, config.at,
      "plasticity.failure: d4 and d5 need the reference rate and temperatures of johnson_cook: add that section, or "
      "set both to 0.");
}

Real PlasticLaw::yield_stress(PlasticPoint const& at) const {
  return std::visit([&](auto const& law) { return (config_.yield_stress + law.excess(at.p)) * law.factor(at); },
                    hardening_);
}

PlasticFlow PlasticLaw::flow(Symmetric const& stress, PlasticState const& state, Real dt) const {
  Symmetric const driving = relative(stress, state);
  Real const size = equivalent(driving);
  auto const over = [&](Real dp) {
    return size - stiffness_ * dp - yield_stress({state.p + dp, dp / dt, state.temperature});
  };
  if (over(0) <= 0) return {};
  // Falls from a positive value at 0 to a negative one at size / stiffness: secant steps (Illinois) inside the bracket.
  Real low = 0, high = size / stiffness_, at_low = over(low), at_high = over(high), dp = high;
  int stuck = 0;
  for (int n = 0; n < 60 && high - low > 1e-15 * high; ++n) {
    dp = std::clamp((low * at_high - high * at_low) / (at_high - at_low), low, high);
    Real const value = over(dp);
    if (std::abs(value) <= 1e-14 * size) break;
    bool const above = value > 0;
    (above ? low : high) = dp;
    (above ? at_low : at_high) = value;
    stuck = above ? std::max(stuck, 0) + 1 : std::min(stuck, 0) - 1;
    if (stuck > 1) at_high *= 0.5;
    if (stuck < -1) at_low *= 0.5;
  }
  return {dp, (1.5 * dp / size) * driving};
}

Real PlasticLaw::stored(Symmetric const& strain, Real p) const {
  Real const isotropic = std::visit([&](auto const& law) { return law.stored(p); }, hardening_);
  return 0.5 * config_.kinematic_modulus * contract(strain, strain) + isotropic;
}

Real PlasticLaw::settle(PlasticState& state, PlasticFlow const& flow, Real work) const {
  Symmetric const before = state.strain - flow.strain;
  Real kept = stored(state.strain, state.p) - stored(before, state.p - flow.dp);
  if (config_.heating) {
    // What the back stress keeps comes back; of the rest the share of Taylor and Quinney is heat.
    Real const back =
        0.5 * config_.kinematic_modulus * (contract(state.strain, state.strain) - contract(before, before));
    Real const heat = config_.heating->share * (work - back);
    state.temperature += heat / (density_ * config_.heating->specific_heat);
    kept = work - heat;
  }
  state.stored += kept;
  return work - kept;
}

Real PlasticLaw::failure_strain(Real triaxiality, PlasticPoint const& at) const {
  DuctileFailureConfig const& f = *config_.failure;
  Real strain = f.d1 + f.d2 * std::exp(f.d3 * triaxiality);
  if (auto const* law = std::get_if<JohnsonCookHardening>(&hardening_))
    strain *= (1 + f.d4 * law->log_rate(at.rate)) * (1 + f.d5 * law->homologous(at.temperature));
  return std::max(strain, 1e-12);
}

void PlasticLaw::damage(PlasticState& state, Real dp, Real triaxiality, Real dt) const {
  if (triaxiality < config_.failure->cutoff_triaxiality) return;
  Real const strain = failure_strain(triaxiality, {state.p, dp / dt, state.temperature});
  if (config_.failure->criterion == "damage")
    state.damage += dp / strain;
  else
    state.damage = std::max(state.damage, state.p / strain);
}

}  // namespace brisance::solid
