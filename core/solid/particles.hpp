// Records of a rigid particle, one cache line per access pattern.
#pragma once
#include "core/base/mat3.hpp"

namespace brisance::solid {

/// Mass centre (m) and rotation reference -> current: what links and surfaces read.
struct alignas(64) Pose {
  Vec3 x{};
  Real unused = 0;
  Quaternion q{};
  bool operator==(Pose const&) const = default;
};

/// Velocity (m/s) and angular momentum about the centre in the fixed frame (kg m2/s): what kicks change.
struct alignas(64) Motion {
  Vec3 v{};
  Real inverse_mass = 0;  ///< 1/kg; 0 when fixed or prescribed
  Vec3 spin{};
  Real turns = 0;  ///< 1 when free, 0 when fixed or prescribed
  bool operator==(Motion const&) const = default;
};

/// Force (N) and torque about the centre (N m), fixed frame.
struct alignas(64) Wrench {
  Vec3 force{};
  Real unused_force = 0;
  Vec3 torque{};
  Real unused_torque = 0;
  bool operator==(Wrench const&) const = default;
};

/// Velocity and angular velocity seen by the half kicks of a step: v^{n+1/2} (m/s), Omega^{n+1/2} (rad/s), fixed frame.
struct alignas(64) HalfVelocity {
  Vec3 v{};
  Real unused_v = 0;
  Vec3 omega{};
  Real unused_omega = 0;
  bool operator==(HalfVelocity const&) const = default;
};

/// J and its inverse in the reference frame: xx, yy, zz, xy, xz, yz.  Units: kg m2, 1/(kg m2).
struct alignas(128) Inertia {
  std::array<double, 8> tensor{}, inverse{};  // two entries of padding each
};

}  // namespace brisance::solid
