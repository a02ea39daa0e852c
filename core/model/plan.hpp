// What the effects of a scene registered: tasks per stage, limits of the step, and what has to be kept, counted and
// shown.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/model/clock.hpp"
#include "core/model/ledger.hpp"
#include "core/model/stage.hpp"
#include "core/model/stage_ledger.hpp"
#include "parallel/archive.hpp"

namespace brisance {

/// A rank's judgement of its part of the state after a step.
struct Verdict {
  bool good = true;
  std::string message;  ///< what, where (cell, particle, rank), why
};

class Plan {
 public:
  struct Task {
    std::size_t effect;
    std::function<void(Clock const&)> run;
    std::function<Part(Clock const&)> part;  ///< what its changes are charged to; null: to the part of its stage
  };
  struct Limit {
    std::string name;
    std::function<Real(Clock const&)> seconds;  ///< local; the minimum over ranks counts
    /// Of an effect that can sub-cycle: its limit and the smallest of the others, both over all ranks, -> the step it
    /// really asks for. Null: the limit itself.
    std::function<Real(Real own, Real others)> relax;
    /// Of an effect of the solid that looks ahead, where the solid takes sub-steps. They stand for `seconds` then:
    /// the time over which it can look ahead at all, and the sub-step that it asks for when it looks again after
    /// `horizon` s. Local both.
    std::function<Real()> sight;
    std::function<Real(Real horizon)> sub_step;
    /// Does it bind the sub-steps of the solid instead of the whole step? So do those of its effects.
    bool of_solid() const { return name.starts_with("solid.") && !sight; }
  };
  /// What an effect keeps of physics. `write` and `read` are collective; `save` and `restore` serve rejected pairs.
  struct Keep {
    std::function<void(parallel::ArchiveWriter&)> write;
    std::function<void(parallel::ArchiveReader&)> read;
    std::function<void()> save, restore;
    std::function<void(parallel::Digest&)> digest;
  };
  /// A table of the output directory that grows by rows at every output time.
  struct Table {
    std::string file, header;  ///< "fragments.csv"; the header ends in a newline, its first column is `step`
    /// Collective. Whole rows on rank 0, nothing elsewhere.
    std::function<std::string(Clock const&)> rows;
  };
  /// A figure per particle in the output of the solid.
  struct ParticleField {
    std::string name;
    std::function<void(std::span<double>)> fill;  ///< owned particles, in their order
  };
  struct EffectCost {
    std::string name;
    Real wall_s = 0;
    std::function<std::size_t()> bytes;
  };

  /// Starts the registrations of one effect (scene section, e.g. "fluid.euler"); `bytes` tells what it holds on this
  /// rank.
  void effect(std::string name, std::function<std::size_t()> bytes);
  void at(Stage stage, std::function<void(Clock const&)> run, std::function<Part(Clock const&)> part = nullptr);
  void limit(std::string name, std::function<Real(Clock const&)> seconds,
             std::function<Real(Real own, Real others)> relax = nullptr) {
    limits_.push_back({std::move(name), std::move(seconds), std::move(relax), nullptr, nullptr});
  }
  /// The limit of an effect of the solid that looks ahead.
  void limit_ahead(std::string name, std::function<Real(Clock const&)> seconds, std::function<Real()> sight,
                   std::function<Real(Real horizon)> sub_step) {
    limits_.push_back({std::move(name), std::move(seconds), nullptr, std::move(sight), std::move(sub_step)});
  }
  void health(std::function<Verdict(Clock const&)> judge) { health_.push_back(std::move(judge)); }
  void keep(Keep k) { kept_.push_back(std::move(k)); }
  void account(std::function<void(Ledger&)> add);
  void table(Table t) { tables_.push_back(std::move(t)); }
  void particle_field(std::string name, std::function<void(std::span<double>)> fill) {
    particle_fields_.push_back({std::move(name), std::move(fill)});
  }
  /// What a user should know of the effect before the run: a line each, the same on every rank.
  void remark(std::string text) { remarks_.push_back(std::move(text)); }
  /// What a user should know of the effect after the run. Collective: a line on rank 0, or nothing.
  void finding(std::function<std::string()> tell) { findings_.push_back(std::move(tell)); }
  /// From now on accounts are taken stage by stage; to be called before any effect joins.
  void charge_stages() { stages_.emplace(); }
  StageLedger* stages() { return stages_ ? &*stages_ : nullptr; }  ///< null: not asked for
  StageLedger const* stages() const { return stages_ ? &*stages_ : nullptr; }
  /// During Stage::fracture, on all ranks alike: the law of force has changed, so Stage::forces and Stage::contact run
  /// once more before the next step.
  void ask_for_forces() { forces_asked_ = true; }
  bool take_asked_forces() { return std::exchange(forces_asked_, false); }
  /// During Stage::load_solid, on all ranks alike: boundary and loads do not agree yet, so both are due once more.
  void ask_for_boundary() { boundary_asked_ = true; }
  bool take_asked_boundary() { return std::exchange(boundary_asked_, false); }

  std::vector<Task> const& tasks(Stage s) const { return tasks_[static_cast<std::size_t>(s)]; }
  std::vector<Limit> const& limits() const { return limits_; }
  std::vector<std::function<Verdict(Clock const&)>> const& judges() const { return health_; }
  std::vector<Keep> const& kept() const { return kept_; }
  std::vector<std::function<void(Ledger&)>> const& accounts() const { return accounts_; }
  std::vector<Table> const& tables() const { return tables_; }
  std::vector<ParticleField> const& particle_fields() const { return particle_fields_; }
  std::vector<std::string> const& remarks() const { return remarks_; }
  std::vector<std::function<std::string()>> const& findings() const { return findings_; }
  std::vector<EffectCost>& effects() { return effects_; }
  std::vector<EffectCost> const& effects() const { return effects_; }

 private:
  std::array<std::vector<Task>, static_cast<std::size_t>(Stage::count)> tasks_;
  std::vector<EffectCost> effects_;
  std::vector<Limit> limits_;
  std::vector<std::function<Verdict(Clock const&)>> health_;
  std::vector<Keep> kept_;
  std::vector<std::function<void(Ledger&)>> accounts_;
  std::optional<StageLedger> stages_;
  std::vector<Table> tables_;
  std::vector<ParticleField> particle_fields_;
  std::vector<std::string> remarks_;
  std::vector<std::function<std::string()>> findings_;
  bool forces_asked_ = false, boundary_asked_ = false;
};

/// One physical effect. Exists only if the scene lists it.
class Effect {
 public:
  virtual ~Effect() = default;
  /// Registers state, tasks, limits, accounts. Called once, in catalogue order.
  virtual void join(Plan& plan) = 0;
  /// Collective. Once, when the initial state is complete or a checkpoint has been read; adds to no state that a
  /// checkpoint holds.
  virtual void start() {}
};

}  // namespace brisance
