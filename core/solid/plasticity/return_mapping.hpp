// The plastic law of a material and the radial return of one particle.  Source: theory/solid.md section 16.
#pragma once
#include "core/solid/plasticity/plasticity_config.hpp"
#include "core/solid/plasticity/symmetric.hpp"

namespace brisance::solid {

/// Plastic state of a particle; strain in the reference frame.
struct PlasticState {
  Symmetric strain;      ///< traceless
  Real p = 0;            ///< cumulated plastic strain
  Real damage = 0;       ///< 1: its links break
  Real temperature = 0;  ///< K; 0 in materials without heating
  Real stored = 0;       ///< energy kept by hardening, J/m3
  static constexpr std::size_t columns = 10;
  bool operator==(PlasticState const&) const = default;
};

/// A step of plastic flow.
struct PlasticFlow {
  Real dp = 0;
  Symmetric strain;  ///< added to the plastic strain
};

class PlasticLaw {
 public:
  /// Errors: scene error when more than one hardening law is given, or heat asked for that nothing makes.
  PlasticLaw(PlasticityConfig const& config, Real density, Real shear);

  /// sigma_y, Pa.
  Real yield_stress(PlasticPoint const& at) const;
  /// Yield stress at rest: below it nothing flows, Pa.
  Real threshold(PlasticState const& state) const { return yield_stress({state.p, 0, state.temperature}); }
  /// s - X, Pa.
  Symmetric relative(Symmetric const& stress, PlasticState const& state) const {
    return stress - config_.kinematic_modulus * state.strain;
  }
  /// Flow that brings the driving stress `stress` (a deviator, Pa) back to the yield surface within `dt`: solves
  /// sigma_eq - sigma_y(p + dp) - (3 G + 3/2 H) dp = 0.
  PlasticFlow flow(Symmetric const& stress, PlasticState const& state, Real dt) const;
  /// Hardening, heat and stored energy after a flow that took `work`, J/m3. Returns what is dissipated, J/m3.
  Real settle(PlasticState& state, PlasticFlow const& flow, Real work) const;
  /// Damage after a flow at the given mean stress over equivalent stress; the state has the new p.
  void damage(PlasticState& state, Real dp, Real triaxiality, Real dt) const;
  Real failure_strain(Real triaxiality, PlasticPoint const& at) const;
  bool fails() const { return config_.failure.has_value(); }
  bool damaged_at_rest() const { return fails() && config_.failure->criterion == "strain"; }
  Real initial_temperature() const { return config_.heating ? config_.heating->initial_temperature : 0; }

 private:
  Real stored(Symmetric const& strain, Real p) const;
  PlasticityConfig config_;
  Hardening hardening_;
  Real density_, stiffness_;
};

}  // namespace brisance::solid
