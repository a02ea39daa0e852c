// What a cell is like, whatever the flow is made of: one gas, or products and gas. For output and audits, not for
// sweeps.
#pragma once
#include <algorithm>

#include "fluid/flow.hpp"

namespace brisance::fluid {

/// One cell of an owned block; reads it when made.
class CellState {
 public:
  CellState(Flow const& flow, Block const& block, Index i, Index j, Index k)
      : gas_(flow.gas()), mixture_(flow.mixture()) {
    if (mixture_)
      state_ = block.load_mixture(i, j, k);
    else
      std::ranges::copy(block.load(i, j, k), state_.begin());
  }
  bool vacuum() const { return mixture_ ? mixture_->vacuum(state_) : gas_.vacuum(five()); }
  Real density() const { return state_[0]; }
  Real energy() const { return state_[4]; }  ///< total, J/m3
  Vec3 velocity() const { return vacuum() ? Vec3{} : Vec3{state_[1], state_[2], state_[3]} / state_[0]; }
  Real pressure() const { return mixture_ ? mixture_->pressure(state_) : gas_.pressure(five()); }           ///< Pa
  Real sound_speed() const { return mixture_ ? mixture_->sound_speed(state_) : gas_.sound_speed(five()); }  ///< m/s
  Real products() const { return state_[5]; }  ///< mass of products per volume, kg/m3
  Real products_fraction() const { return state_[6]; }

 private:
  State five() const { return {state_[0], state_[1], state_[2], state_[3], state_[4]}; }
  Gas const& gas_;
  Mixture const* mixture_;
  MixtureState state_{};
};

}  // namespace brisance::fluid
