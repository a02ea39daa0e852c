// The effect solid.damping: takes motion away until the bodies rest.  Source: theory/solid.md section 10.
#pragma once
#include "core/model/plan.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Viscous: velocities and spins decay by exp(-rate t), half a step on either side of the kicks. Kinetic: all of them
/// become zero whenever the kinetic energy has passed a maximum. Against the ground, or against the rigid motion of
/// each body that no support holds, which then keeps its momentum and angular momentum.
/// What is taken away goes to the account: energy to `dissipated`, momentum across the boundary.
/// Bits: the same on any number of ranks; all sums are exact.
class Damping : public Effect {
 public:
  Damping(DampingConfig const& config, SolidConfig const& solid_config, Solid& solid, parallel::Comm& comm);
  void join(Plan& plan) override;

  /// Collective when the damping is kinetic or relative to bodies. Half a step of viscous decay.
  void half_decay(Real dt);
  /// Collective. Takes all motion away when the kinetic energy falls: it has just passed a maximum.
  void stop_at_maximum();
  /// Collective. Has the net force on free particles fallen below the residual?
  void watch_residual();
  bool over(Real time) const { return state_.done || (config_.until && time >= *config_.until * (1 - 1e-12)); }
  Real dissipated() const { return dissipated_.value(); }  ///< J, of this rank since the last account

 private:
  /// The rigid motion of a body: velocity of its mass centre, angular velocity.
  struct BodyMotion {
    Vec3 centre{}, v{}, omega{};
  };
  std::vector<BodyMotion> body_motions() const;
  void keep_share(Real share);
  Vec3 net_force(Index particle) const;
  /// What raises the kinetic energy relative to the frame, W; of all ranks.
  Real power() const;

  struct State {
    Real largest_force = 0;   ///< N, root of the sum of squares over free particles, so far
    bool stop_again = false;  ///< kinetic: all motion stopped in the last step
    bool done = false;
  };
  DampingConfig config_;
  Vec3 gravity_;
  Solid& solid_;
  parallel::Comm& comm_;
  std::vector<char> floats_;  ///< bodies without supports, relative to which damping is
  State state_;
  parallel::ExactSum dissipated_;
  std::array<parallel::ExactSum, 3> impulse_;
};

}  // namespace brisance::solid
