// What a scene says about the supports of a body: what holds it, moves it, mirrors it or repeats it.
#pragma once
#include <optional>
#include <vector>

#include "core/base/location.hpp"
#include "core/base/vec3.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// An axis-parallel box in the reference state.  Units: m.
struct HoldConfig {
  Vec3 low{}, high{};
  static void keys(Keys<HoldConfig>& k);
};

/// One entry of the history of a motion.  Units: s, m/s, rad/s.
struct TimedMotion {
  Real time = 0;
  Vec3 velocity{}, spin{};
  Location at{};
  static void keys(Keys<TimedMotion>& k);
};

/// A box whose content moves as one rigid body: particles (`prescribed`) or the wall behind faces (`clamp`).
/// Velocity of the point that starts at `centre`, and turn about it.  Units: m, m/s, rad/s.
struct DrivenConfig {
  Vec3 low{}, high{}, velocity{}, spin{};
  std::optional<Vec3> centre{};
  std::vector<TimedMotion> history{};
  Location at{};
  static void keys(Keys<DrivenConfig>& k);
  bool turns() const;
  bool moves() const;
};

/// Velocity of the particles with their centre in a box, on top of that of their body:
/// `velocity` + `gradient` (X - `centre`), and the spin of that field.  Units: m, m/s, 1/s.
struct InitialVelocityConfig {
  std::optional<Vec3> low{}, high{};
  Vec3 velocity{}, centre{};
  std::vector<double> gradient{};  ///< dv_x/dx, dv_x/dy, dv_x/dz, dv_y/dx, ...
  Location at{};
  static void keys(Keys<InitialVelocityConfig>& k);
};

struct BodyConfig;

/// What keys alone cannot check.  Errors: scene errors naming the body: times that do not ascend, a constant motion
/// beside a history, a turn without a centre, a gradient that has not nine entries, periodic bodies that are no bricks.
void check_supports(BodyConfig const& body, int dimension);

}  // namespace brisance::solid
