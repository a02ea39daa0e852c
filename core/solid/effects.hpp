// The effects of the solid: motion (kicks and drifts) and elastic links.
#pragma once
#include "core/model/plan.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Registers solid.motion, and solid.links and solid.gravity when the scene lists them.
class Dynamics : public Effect {
 public:
  Dynamics(SolidConfig const& config, Solid& solid) : config_(config), solid_(solid) {}
  void join(Plan& plan) override;
  /// Collective. Ghost poses and internal forces of the initial state.
  void start() override;
  std::int64_t link_updates() const { return link_updates_; }
  std::int64_t links_asleep() const { return links_asleep_; }  ///< those that sleep saved, on this rank

 private:
  void account(Ledger& ledger);
  Verdict judge() const;
  SolidConfig config_;
  Solid& solid_;
  std::int64_t link_updates_ = 0, links_asleep_ = 0;
  StableStep limit_;
  Real elapsed_ = 0;  ///< s since the last account
};

/// Errors: Failure::scene when the plan has an effect of the solid, or a coupling, that cannot act within multi-rate
/// steps. Call it when all effects have joined.
void require_multirate_support(SolidConfig const& config, Plan const& plan);

/// The other effects a scene lists, in the order of their tasks: one line each.
std::vector<std::unique_ptr<Effect>> make_effects(SolidConfig const& config, Solid& solid, parallel::Comm& comm);

}  // namespace brisance::solid
