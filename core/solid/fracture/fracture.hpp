// The effect solid.fracture: links over their criterion weaken and break; what they release goes to the account.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/model/plan.hpp"
#include "core/solid/fracture/census.hpp"
#include "core/solid/fracture/link_laws.hpp"

namespace brisance::solid {

/// All criteria are judged on one evaluation of the forces, all links that fail break at once, and the forces are
/// computed once more: links that fail then break in the next step. The outcome depends on no order and no rank.
/// Source: theory/solid.md section 14.
class Fracture : public Effect {
 public:
  /// Errors: scene errors of assign_laws; links are missing.
  Fracture(FractureConfig const& config, Solid& solid, parallel::Comm& comm);
  void join(Plan& plan) override;
  void start() override;

  /// Judges all links at the present poses and forces and weakens those that fail; the forces are then those of before.
  /// Collective. Returns whether any link of any rank changed.  `time` is that of the state, s.
  bool judge(Real time);
  /// Books the energy released by the last judge, once the forces have been computed anew at the same poses.
  void book();

  Fragments const& fragments() const { return *fragments_; }
  /// J and number since the last account, of this rank.
  parallel::ExactSum const& dissipated() const { return dissipated_; }
  std::int64_t links_broken() const { return links_broken_; }

 private:
  struct Change {
    std::size_t link;
    Real intact;
  };
  template <class Law>
  void judge_group(LawGroup& group, Law const& law);
  LinkState state_of(std::size_t link, Wants const& wants) const;
  void add_energy(parallel::ExactSum& to, Real sign) const;
  /// Share of the linked faces of each owned particle that is free now, 0 to 1.
  void damage_of_particles(std::span<double> to) const;
  void keep(Plan& plan);
  std::vector<double> pack_history() const;
  void unpack_history(std::span<double const> rows);

  Solid& solid_;
  parallel::Comm& comm_;
  std::vector<std::string> remarks_;
  std::vector<LawGroup> groups_;
  std::vector<Section> sections_;  // of the links of the rank
  bool ghost_pressure_ = false;    // some law reads pressures, and some are not zero
  std::shared_ptr<Fragments const> fragments_ = std::make_shared<Fragments>();  // replaced when links break
  std::size_t broken_seen_ = 0;

  // Of the judgement under way.
  std::vector<double> pressure_;
  std::vector<Change> changes_;
  std::vector<Index> touched_;             // owned particles whose links changed
  std::vector<std::size_t> touched_link_;  // links that changed and whose first end is owned
  bool to_book_ = false;
  bool history_changed_ = true;  // since the last save

  parallel::ExactSum dissipated_;
  std::int64_t links_broken_ = 0;
};

}  // namespace brisance::solid
