// The coupled step, and the pair of steps that is the unit of everything that chooses or interrupts (theory/coupling.md
// 5).
#pragma once
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/model/plan.hpp"
#include "core/model/time_coupling.hpp"

namespace brisance {

struct TimeControl {
  Real end_time = 0;
  int steps_per_pair = 2;    ///< 1 in 1D and without a fluid
  Real output_interval = 0;  ///< s; steps are shortened to hit its multiples; 0: none
  TimeCoupling coupling = TimeCoupling::lag;
  /// Solid steps in a step of the whole: at most so many, as its limits ask; with `least` equal to `most` always so
  /// many.
  int least_sub_steps = 1, most_sub_steps = 1;
};

struct StepStatistics {
  Real dt_min = 0, dt_max = 0;
  std::map<std::string, std::int64_t> limited_by;  ///< steps per limit
  std::int64_t retries = 0;                        ///< rejected pairs
  std::int64_t solid_steps = 0;                    ///< sub-steps of the solid
  int sub_steps_min = 0, sub_steps_max = 0;        ///< of a step
  std::string last_rejection;                      ///< why and where
};

class Simulation {
 public:
  Simulation(Plan& plan, parallel::Comm& comm, TimeControl control) : plan_(plan), comm_(comm), control_(control) {}

  /// Collective. Advances by one pair; a pair in bad health is redone from its start with half the step.
  /// Errors: Failure::numerical after 10 halvings of one pair, or 20 of pairs in a row, naming the place and the cause.
  void pair();
  bool finished() const { return clock_.time >= control_.end_time; }

  Clock const& clock() const { return clock_; }
  Ledger const& ledger() const { return ledger_; }
  StageLedger const* stages() const { return std::as_const(plan_).stages(); }  ///< null: not asked for
  std::string const& limited_by() const { return limited_by_; }                ///< what limited the last pair
  StepStatistics const& statistics() const { return statistics_; }
  /// True when the last pair ended on a multiple of the output interval.
  bool at_output_time() const { return at_output_; }
  /// Collective. Takes the account of the present state: before the first pair and after each.
  void audit();
  /// Collective.
  parallel::Digest digest();
  void write(parallel::ArchiveWriter& file);
  void read(parallel::ArchiveReader& file);

 private:
  void step();
  void step_lag();
  void step_semi();
  void step_explicit();
  void set_off();
  void move_flow();
  void move_solid();
  void run(Stage stage);
  /// What the domain gained or lost against its account since the last call belongs to this part of the step.
  void charge(Part part, Domain domain);
  void run_flow(Stage stage, Part part);
  Real choose_step(std::string& limited_by, bool& at_output);
  /// Sub-steps of the solid in a step of `dt`.
  int sub_steps(Real dt) const;
  bool healthy(std::string& message);

  Plan& plan_;
  parallel::Comm& comm_;
  TimeControl control_;
  Clock clock_;
  Ledger ledger_;
  StepStatistics statistics_;
  Real retry_factor_ = 1;
  Real solid_limit_ = std::numeric_limits<Real>::max();  ///< s, of its sub-steps, at the start of the pair
  std::int64_t outputs_done_ = 0;                        ///< multiples of the output interval already reached
  bool at_output_ = false;
  std::string limited_by_;
};

}  // namespace brisance
