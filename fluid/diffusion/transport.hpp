// Viscosity and heat conductivity of an ideal gas.
#pragma once
#include <cmath>

#include "fluid/diffusion/diffusion_config.hpp"
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// Sutherland's law: mu_0 (T / T_0)^{3/2} (T_0 + S) / (T + S), Pa s.  Source: theory/fluid.md 5.1.
struct Sutherland {
  Real viscosity, reference, constant;  ///< mu_0, Pa s; T_0, K; S, K
  Real operator()(Real temperature) const {
    Real const ratio = temperature / reference;
    return viscosity * (ratio * std::sqrt(ratio)) * ((reference + constant) / (temperature + constant));
  }
};

/// The same at all temperatures, Pa s.
struct ConstantViscosity {
  Real viscosity;
  Real operator()(Real) const { return viscosity; }
};

/// Everything the viscous terms know of the gas.
struct Transport {
  Transport(ViscosityConfig const& config, Gas const& gas)
      : sutherland(config.law == "sutherland"),
        law_sutherland{config.dynamic_viscosity, config.reference_temperature, config.sutherland_temperature},
        law_constant{config.dynamic_viscosity},
        gas(gas),
        conductivity_ratio(gas.gamma * gas.gas_constant / gas.kappa() / config.prandtl),
        diffusivity_ratio(max(4.0 / 3, gas.gamma / config.prandtl)) {}

  bool sutherland;
  Sutherland law_sutherland;
  ConstantViscosity law_constant;
  Gas gas;
  Real conductivity_ratio;  ///< kappa / mu = c_p / Pr, J/(kg K)
  Real diffusivity_ratio;   ///< largest diffusivity (of longitudinal momentum, of heat) over mu / rho

  Real viscosity(Real temperature) const {
    return sutherland ? law_sutherland(temperature) : law_constant(temperature);
  }
};

}  // namespace brisance::fluid
