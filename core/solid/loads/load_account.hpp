// What a load does to the solid: impulse and work for the account.
#pragma once
#include "core/model/ledger.hpp"
#include "core/solid/particles.hpp"

namespace brisance::solid {

/// A force with its point of action, as a wrench on one particle, at the two ends of a step.
struct StepWrench {
  Vec3 force{}, torque{};
};

/// Impulse and work of the loads of this rank since the last account. Between the kicks of a step the particle moves
/// with its half-step velocities, so the mean of the wrenches at both ends times these is the work to the accuracy with
/// which Verlet keeps the energy.
class LoadAccount {
 public:
  /// Books the step of one particle.
  void add(Real dt, StepWrench const& before, StepWrench const& after, HalfVelocity const& half) {
    Vec3 const impulse = (0.5 * dt) * (before.force + after.force);
    Vec3 const turn = (0.5 * dt) * (before.torque + after.torque);
    for (int d = 0; d < 3; ++d) impulse_[static_cast<std::size_t>(d)].add(impulse[d]);
    Real const work = dot(impulse, half.v) + dot(turn, half.omega);
    work_.add(work);
    size_.add(std::abs(work));
    push_.add(norm(impulse));
  }
  /// Work that changes the energy at fixed positions, J.
  void add_work(Real work) { work_.add(work); }

  /// Adds all to the ledger and starts anew.
  void book(Ledger& ledger) {
    for (std::size_t d = 0; d < 3; ++d)
      ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), impulse_[d]);
    ledger.add(Entry::in_energy, work_);
    ledger.add(Entry::exchanged_energy, size_);
    ledger.add(Entry::pressure_impulse, push_);
    clear();
  }
  void clear() { *this = {}; }

 private:
  std::array<parallel::ExactSum, 3> impulse_{};
  parallel::ExactSum work_, size_, push_;  // J, sum of sizes, sum of sizes of impulses
};

}  // namespace brisance::solid
