// Force of one overlap: energy of the volume, damping, friction.  Source: theory/solid.md section 15.
#pragma once
#include <array>

#include "core/solid/contact/barrier.hpp"

namespace brisance::solid {

/// Constants of a pair.
struct PairLaw {
  Real stiffness = 0;    ///< kappa_c = K_c / min V, Pa/m3
  Real knee = 0;         ///< 0.2 min V or less: beyond it the pressure grows with the square of the volume, m3
  Real damping = 0;      ///< Hunt and Crossley's factor: pressure (1 + damping u / u_impact)
  Real friction = 0;     ///< Coulomb's coefficient
  Real shear_ratio = 0;  ///< k_t / k_n = 2 (1 - nu) / (2 - nu)
  BarrierLaw barrier;

  Real pressure(Real volume) const { return stiffness * volume * max(1, volume / knee); }  ///< Pa
  /// dp/dV, Pa/m3
  Real slope(Real volume) const { return volume > knee ? 2 * stiffness * volume / knee : stiffness; }
  Real energy(Real volume) const;  ///< J
};

/// The damping factor with which a flat impact of rigid bodies gives this restitution (0 < e <= 1).
/// With f = k x (1 + c v / v0), the loop closes where c (1 + e) = ln((1 + c) / (1 - c e)).
Real damping_for(Real restitution);

/// What an overlap remembers from step to step, for friction, damping and the account.
struct PairMemory {
  Vec3 shear{};                          ///< friction on A in the frame of A, N
  Real shear_stiffness = 0;              ///< N/m
  Real twist = 0;                        ///< friction couple on A about the normal, N m
  Real twist_stiffness = 0;              ///< N m
  Real impact_speed = 0;                 ///< closing speed that damping is measured by, m/s
  Real phase = 0;                        ///< 0: first compression and rebound; 1: rebounds; 2: compressed again
  Vec3 force{}, torque_a{}, torque_b{};  ///< the part of the forces that no energy gives, on A; N, N m
  Real volume = 0;                       ///< of the overlap, m3
  DepthAxis axis;

  static constexpr int size = 24;
  std::array<double, size> pack() const;
  static PairMemory unpack(double const* row);
  /// Energy held by the spring of friction, J.
  Real stored() const;
};

/// One end of a pair during the step that led here.
struct PairEnd {
  Quaternion q{};
  Vec3 v{}, omega{};  ///< half-step velocities
  /// Accelerations without the contacts, and those that the plain pressures of all its contacts give; 0: held.
  Vec3 free_a{}, free_turn{}, contact_a{}, contact_turn{};
  /// g M^-1 g of this end with the gradient g of the overlap: V'' = -(sum over the ends) p when nothing else pushes.
  Real compliance = 0;
};

struct PairForce {
  Vec3 force{}, torque_a{}, torque_b{};  ///< force on A; torques about the centres
  Real energy = 0;                       ///< of the volume and of the spring of friction, J
  PairMemory memory;
};

/// Forces of an overlap at the end of a step of `dt`. `before`: the memory at its start, null when the pair overlaps
/// for the first time.  Momentum and angular momentum are kept by construction: B gets the opposite force and the
/// torque that closes the sum. The pressure of the first and the last steps of a contact is weighted so that the step
/// does not see the kink of the pressure: with f_k = k x_k x_{k+1} / (x_{k+1} - x_{k-1}), x_{k-1} < 0 where the pair
/// was still apart, the energy of Verlet's scheme after the impact is exactly that before it.
PairForce contact_force(PairLaw const& law, Intersection const& overlap, Vec3 const& shift, PairEnd const& a,
                        PairEnd const& b, Real dt, PairMemory const* before);

}  // namespace brisance::solid
