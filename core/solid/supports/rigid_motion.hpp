// The motion of a support that moves as one rigid body: a pure function of time.
#pragma once
#include <vector>

#include "core/base/mat3.hpp"
#include "core/solid/supports/support_config.hpp"

namespace brisance::solid {

/// Translation and turn integrated from histories of velocity and spin that are linear between their entries and
/// constant beyond both ends. Depends on time alone: not on steps, ranks or restarts.
class RigidMotion {
 public:
  /// In 2D only x, y and the turn about z are used, in 1D x alone.
  RigidMotion(DrivenConfig const& config, int dimension);

  /// Where the point that started at `centre` is, the turn since time 0, velocity of the point and angular velocity.
  struct State {
    Vec3 x{};
    Quaternion q{};
    Vec3 v{}, omega{};
    Vec3 place(Vec3 const& arm) const { return x + rotate(q, arm); }
    Vec3 velocity(Vec3 const& arm) const { return v + cross(omega, rotate(q, arm)); }
  };
  /// Exact for translations and for turns about one axis; turns about a changing axis to 1e-10 (steps of 1/50 rad of
  /// the fourth-order Magnus expansion).  Units: s.
  State at(Real time) const;
  Vec3 const& centre() const { return centre_; }

 private:
  struct Knot {
    Real time;
    Vec3 velocity, spin;  ///< here
    Vec3 x{};             ///< place of the point here
    Quaternion q{};       ///< turn since time 0
  };
  Vec3 centre_{};
  std::vector<Knot> knots_;  ///< the first at time 0
};

}  // namespace brisance::solid
