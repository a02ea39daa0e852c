// The effect output.solid_gauges: what is watched of the solid after every step, and the files. Changes nothing of it.
#pragma once
#include <string>
#include <vector>

#include "core/model/plan.hpp"
#include "core/model/row_sampler.hpp"
#include "core/solid/gauges/probe.hpp"

namespace brisance::solid {

/// Every rank notes what it owns, without a message; from time to time rank 0 collects the notes and appends rows.
/// Forces over sections and supports are exact sums, so that files have the same bytes on any number of ranks.
class SolidGauges : public Effect {
 public:
  SolidGauges(std::vector<SolidGaugeConfig> gauges, Solid& solid, parallel::Comm& comm);
  void join(Plan& plan) override;

  /// Collective. Call when the state of the start or of a checkpoint is in place. Files of gauges that the checkpoint
  /// knows lose the rows after it; the others begin here. Returns what a user ought to know (rank 0).
  /// Errors: Failure::system when a file cannot be written.
  std::vector<std::string> open(std::string const& directory, Clock const& clock);
  /// Collective. The pair that ended at clock.time is accepted.
  void accept(Clock const& clock);
  /// Collective. All accepted steps are in the files.
  void flush();

  std::vector<SolidGaugeConfig> const& configs() const { return configs_; }
  Probe const& probe(std::size_t gauge) const { return probes_[gauge]; }
  RowSampler const& rows(std::size_t gauge) const { return samplers_[gauge]; }  ///< on rank 0

 private:
  void note(Real time);
  /// Collective. On rank 0: the columns of all gauges, [note][gauge].
  std::vector<std::vector<std::vector<Real>>> collect(std::size_t notes);
  std::string path(std::size_t gauge) const;

  std::vector<SolidGaugeConfig> configs_;
  Solid& solid_;
  parallel::Comm& comm_;
  std::vector<Probe> probes_;
  std::vector<RowSampler> samplers_;
  std::size_t most_notes_ = 0;  ///< before the files are written
  std::vector<Real> times_;     ///< of the notes
  parallel::Bytes notes_;       ///< of this rank
  std::size_t note_size_ = 0;   ///< bytes of one
  std::size_t accepted_ = 0;    ///< notes of accepted pairs
  std::string directory_;
};

}  // namespace brisance::solid
