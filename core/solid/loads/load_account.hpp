// What a load does to the solid: impulse and work for the account.
#pragma once
#include "core/model/ledger.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// A load on one particle in one of the two kicks of a step: its wrench, and the mean velocities of the kick.
struct KickLoad {
  Vec3 force{}, torque{}, v{}, omega{};
};

/// Impulse and work of the loads of this rank since the last account. A load works with the mean velocity of its kick,
/// which is what it adds to the kinetic energy; so the account keeps the bounded oscillation of Verlet and nothing
/// else.
class LoadAccount {
 public:
  /// Books the step of one particle: half a kick at its start, half a kick at its end.
  void add(Real dt, KickLoad const& first, KickLoad const& second) {
    Vec3 const impulse = (0.5 * dt) * (first.force + second.force);
    for (int d = 0; d < 3; ++d) impulse_[static_cast<std::size_t>(d)].add(impulse[d]);
    Real const work = 0.5 * dt *
                      (dot(first.force, first.v) + dot(first.torque, first.omega) + dot(second.force, second.v) +
                       dot(second.torque, second.omega));
    work_.add(work);
    size_.add(std::abs(work));
    push_.add(norm(impulse));
  }
  /// Work that changes the energy at fixed positions, J.
  void add_work(Real work) { work_.add(work); }
  void add_work(parallel::ExactSum const& work) { work_.add(work); }

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

/// Watches the velocities of a particle through the two kicks of a step.
class KickVelocity {
 public:
  /// Before the first kick.
  void begin(Solid const& solid, Index particle) { last_ = solid.motion()[static_cast<std::size_t>(particle)]; }
  /// After each kick, at the pose of that kick: its mean velocities.
  void take(Solid const& solid, Index particle, KickLoad& load) {
    Motion const& now = solid.motion()[static_cast<std::size_t>(particle)];
    load.v = 0.5 * (last_.v + now.v);
    load.omega = solid.omega_of(particle, 0.5 * (last_.spin + now.spin));
    last_ = now;
  }

 private:
  Motion last_;
};

}  // namespace brisance::solid
