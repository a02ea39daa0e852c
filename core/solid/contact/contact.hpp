// The effect solid.contact: forces of overlapping particles, their memory and their account.
#pragma once
#include <map>
#include <memory>
#include <optional>

#include "core/model/plan.hpp"
#include "core/solid/contact/contact_account.hpp"
#include "core/solid/contact/contact_law.hpp"
#include "core/solid/contact/contact_list.hpp"

namespace brisance::solid {

/// Registers solid.contact.  Every rank computes the pairs of its particles, each from the same poses and in the
/// direction of ids, and adds them in global order: the bits do not depend on the ranks.
/// Source: theory/solid.md section 15.
class Contact : public Effect {
 public:
  Contact(SolidConfig const& config, Solid& solid, parallel::Comm& comm);
  void join(Plan& plan) override;
  /// Collective. Lists the pairs and measures the overlaps of a state whose forces are known.
  void start() override;

  /// Adds the forces at the end of a step to those of the links. Collective.
  void apply(Clock const& clock);
  /// Largest step (s) of this rank's particles: stable and well resolved while they overlap, and so short that none
  /// passes through another. Collective.
  Real time_step();
  /// The same for the sub-steps of a coupled step. Time (s) over which nobody comes near who is not near now; and the
  /// largest sub-step when limits are chosen anew after `horizon` s, within that time: whoever may meet until then is
  /// regarded as if in contact. Collective both.
  Real sight();
  Real sub_step(Real horizon);
  void account(Ledger& ledger);
  void digest(parallel::Digest& to) const;

  std::int64_t overlapping_pairs() const;  ///< of this rank, each at the owner of its lower id
  std::int64_t list_builds() const { return list_.builds(); }

 private:
  /// State of a listed pair.
  struct Overlap {
    PairLaw law;
    Intersection common;
    PairMemory memory, before;
    Barrier barrier;
    Real energy = 0, first_energy = 0;  ///< now; when the forces of this step were first computed
    int separating_plane = 0;
    bool active = false, was_active = false;  ///< overlaps now; did at the start of the step
  };
  using PairId = std::pair<GlobalId, GlobalId>;

  PairId id_of(std::size_t pair) const;
  bool mine(std::size_t pair) const;  ///< does its account belong to this rank?
  PairLaw law_of(ContactPair const& pair) const;
  bool refresh();
  void measure();
  void begin_step();
  void book(Overlap& overlap, PairEnd const& a, PairEnd const& b, Real dt, bool again);
  void carry_over();
  void charge_stages(Plan& plan);
  parallel::ExactSum held_energy() const;  ///< of the overlaps of this rank, J
  enum class Axes { keep, choose };        ///< of the barriers: those of the memory, or those of a new step
  void find_overlap(std::size_t pair, Axes axes);
  void find_overlaps(Axes axes);
  Real step_within(std::optional<Real> horizon);
  Vec3 acceleration_of(Index local) const;
  std::array<double, 8> motion_row(Index local);
  void gather_accelerations();
  PairEnd end_of(Index actor, Vec3 const& area, Vec3 const& moment) const;
  Vec3 turned_by(ContactActor const& actor, Quaternion const& q, Vec3 const& torque) const;
  void write(parallel::ArchiveWriter& file) const;
  void read(parallel::ArchiveReader& file);

  ContactConfig config_;
  Real damping_ = 0, link_cfl_ = 0;
  std::optional<Vec3> gravity_;
  Solid& solid_;
  ContactList list_;
  Clipper clipper_;
  std::vector<Overlap> overlaps_;      ///< beside the pairs of the list
  std::vector<std::size_t> live_;      ///< places of those that overlap, or did at the start of the step
  std::vector<PairId> listed_;         ///< ids of the pairs that `overlaps_` belongs to
  std::map<PairId, PairMemory> kept_;  ///< of a checkpoint or of the start of a pair of steps, until the list is built
  std::pair<std::int64_t, int> step_{-1, 0};  ///< the (sub-)step whose forces were computed last
  parallel::ExactSum dissipated_;             ///< since the last account
  std::vector<double> rows_;                  ///< accelerations of the actors
  std::unique_ptr<ContactAccount> charged_;   ///< null: defects are not charged to stages
};

}  // namespace brisance::solid
