// The effect fluid.euler: Strang pairs of OSMP sweeps over all blocks.
#pragma once
#include "core/model/plan.hpp"
#include "fluid/flow.hpp"
#include "fluid/time_step.hpp"
#include "fluid/totals.hpp"

namespace brisance::fluid {

class Euler : public Effect {
 public:
  Euler(EulerConfig const& config, Flow& flow) : config_(config), flow_(flow) {}
  void join(Plan& plan) override;

  /// Fluid volume of a cell where walls cut cells; 0 marks a solid cell, which holds no state. Without it all cells are
  /// full.
  void set_fluid_volume(FluidVolume volume) { volume_ = std::move(volume); }
  std::int64_t fallback_faces() const { return fallback_faces_; }
  std::int64_t cell_updates() const { return cell_updates_; }

 private:
  Real acoustic_limit(Clock const& clock);
  void account(Ledger& ledger);
  Verdict judge() const;

  EulerConfig config_;
  Flow& flow_;
  FluidVolume volume_;
  SweepReport report_;  ///< of the pair under way
  std::int64_t fallback_faces_ = 0, saved_fallback_faces_ = 0, cell_updates_ = 0;
};

}  // namespace brisance::fluid
