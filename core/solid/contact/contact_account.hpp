// The part of the ledger by stages that only the contacts know: what their forces do to the particles.
#pragma once
#include <vector>

#include "core/model/stage_ledger.hpp"
#include "core/solid/loads/load_account.hpp"
#include "parallel/archive.hpp"

namespace brisance::solid {

/// Follows the particles under forces of contacts through the two kicks of a (sub-)step. Kinetic energy that these
/// forces gave, and what the overlaps gained and lost to friction and damping, are one defect: that of Part::contact.
class ContactAccount {
 public:
  ContactAccount(StageLedger& stages, Solid& solid) : stages_(stages), solid_(solid) {}

  /// Forces of contacts anew: those of the last time are done with.
  void begin_forces() { pushed_.clear(); }
  /// An owned particle was pushed.
  void add(Index particle, Vec3 const& force, Vec3 const& torque) { pushed_.push_back({particle, force, torque, {}}); }
  /// Before a kick.
  void before_kick();
  /// After it: half a step of `dt` under these forces.
  void after_kick(Real dt);
  /// Overlaps of this rank hold `energy` at the start of a (sub-)step.
  void begin_step(parallel::ExactSum const& energy) { energy_ = energy; }
  /// At its end: what they hold now, and dissipated in it.
  void end_step(parallel::ExactSum const& energy, parallel::ExactSum const& dissipated);

  void save() { saved_ = pushed_; }
  void restore() { pushed_ = saved_, given_ = {}; }
  /// The forces that the next kick will find, for a restart on any number of ranks.
  void write(parallel::ArchiveWriter& file) const;
  void read(parallel::ArchiveReader& file);

 private:
  struct Pushed {
    Index particle;
    Vec3 force, torque;
    KickVelocity velocity;
  };
  StageLedger& stages_;
  Solid& solid_;
  std::vector<Pushed> pushed_, saved_;
  Amounts given_{};  ///< by the kicks of this (sub-)step
  parallel::ExactSum energy_;
};

}  // namespace brisance::solid
