// The effect fluid.gravity: a constant acceleration of the gas.
#pragma once
#include <array>

#include "core/model/plan.hpp"
#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"
#include "fluid/source/gravity_config.hpp"

namespace brisance::fluid {

/// Half a step before and half a step after the others, with the exact work of a constant acceleration g over tau:
/// rho u += tau rho g, E += tau rho u . g + tau^2 rho g^2 / 2.  Source: theory/fluid.md 3, "Sources".
class Gravity : public Effect {
 public:
  /// `flow` must outlive this.
  Gravity(GravityConfig const& config, Flow& flow) : g_(config.acceleration), flow_(flow) { flow.keep_awake(); }
  void join(Plan& plan) override;

  /// Fluid volume of a cell where walls cut cells.
  void set_fluid_volume(FluidVolume volume) { volume_ = std::move(volume); }

  /// Local. Acts on all cells for `tau` s and enters what it gave in the account.
  void advance(Real tau);

 private:
  void account(Ledger& ledger);
  void forget();  ///< what it gave

  Vec3 g_;  // m/s2
  Flow& flow_;
  FluidVolume volume_;
  /// Since the last account, block by block: a product with a sum of this rank would round as the partition has it.
  std::array<parallel::ExactSum, 3> impulse_;
  parallel::ExactSum impulse_size_, work_, work_size_;
};

}  // namespace brisance::fluid
