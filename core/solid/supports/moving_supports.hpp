// The effect of supports that move by histories: prescribed particles and the walls behind clamped faces.
#pragma once
#include "core/model/plan.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// At the start of a step prescribed particles get the velocities that lead them to their exact pose at its end; there
/// they take the velocities of that time. Poses are functions of time alone, whatever the steps.
/// Reactions bear the changes of momentum and energy (Solid::drive).
class MovingSupports : public Effect {
 public:
  explicit MovingSupports(Solid& solid) : solid_(solid) {}
  void join(Plan& plan) override;

  /// Before the first kick of the step from `time` to `time` + `dt`, s.
  void set_off(Real time, Real dt);
  /// After its last kick.
  void arrive(Real time);
  /// Poses of the walls at `time`, for a state read from a checkpoint.
  void place_walls(Real time);

 private:
  Solid& solid_;
};

}  // namespace brisance::solid
