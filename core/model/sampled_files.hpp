// The files and the bookkeeping of gauges: notes of every step, kept until rank 0 writes their rows.
#pragma once
#include <string>
#include <vector>

#include "core/model/plan.hpp"
#include "core/model/sampled_series.hpp"

namespace brisance {

/// Base of the effects output.gauges and output.solid_gauges. A rank notes what it owns after every step, without a
/// message; from time to time rank 0 collects the notes of accepted steps and appends rows. So the files depend on the
/// states and the times of the steps alone, not on ranks or on when they were written.
class SampledFiles : public Effect {
 public:
  void join(Plan& plan) override;

  /// Collective. Call when the state of the start or of a checkpoint is in place. Files of gauges that the checkpoint
  /// knows lose the rows after it; the others begin here. Returns what a user ought to know (rank 0).
  /// Errors: Failure::system when a file cannot be written.
  std::vector<std::string> open(std::string const& directory, Clock const& clock);
  /// Collective. The pair that ended at clock.time is accepted.
  void accept(Clock const& clock);
  /// Collective. All accepted steps are in the files and in the figures of rank 0.
  void flush();

 protected:
  /// `name`: of the effect; `group`: of the checkpoint.
  SampledFiles(std::string name, std::string group, parallel::Comm& comm)
      : name_(std::move(name)), group_(std::move(group)), comm_(comm) {}
  /// Notes kept before the files are written.
  void keep_notes(std::size_t most) { most_notes_ = most; }

 private:
  virtual std::size_t count() const = 0;  ///< of gauges
  virtual std::string const& name_of(std::size_t gauge) const = 0;
  /// Is the state at the end of this step one to be noted?
  virtual bool is_state(Clock const&) const { return true; }
  /// Notes the present state of what this rank owns.
  virtual void note() = 0;
  virtual void keep_first(std::size_t notes) = 0;  ///< forgets the notes behind
  virtual void drop_first(std::size_t notes) = 0;
  virtual std::size_t note_bytes() const = 0;  ///< held in memory
  /// Collective. Makes the values of the first `notes` notes ready on rank 0.
  virtual void collect(std::size_t notes) = 0;

  // On rank 0:
  virtual SampledSeries& series(std::size_t gauge) = 0;
  /// The first collected value begins the series.
  virtual void start(std::size_t gauge, Real time, std::string& rows) = 0;
  /// The value of a collected note, one step after the last.
  virtual void add(std::size_t gauge, Real time, std::size_t note, std::string& rows) = 0;

  std::string path(std::size_t gauge) const { return directory_ + "/gauges/" + name_of(gauge) + ".csv"; }
  void write(parallel::ArchiveWriter& file);
  void read(parallel::ArchiveReader& file);

  std::string name_, group_;
  parallel::Comm& comm_;
  std::size_t most_notes_ = 256;  // a collection of values costs a message per rank
  std::vector<Real> times_;       ///< of the notes
  std::size_t accepted_ = 0;      ///< notes of accepted pairs
  std::string directory_;         ///< empty until opened
};

}  // namespace brisance
