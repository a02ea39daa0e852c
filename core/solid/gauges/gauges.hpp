// The effect output.solid_gauges: what is watched of the solid after every step, and the files. Changes nothing of it.
#pragma once
#include <string>
#include <vector>

#include "core/model/row_sampler.hpp"
#include "core/model/sampled_files.hpp"
#include "core/solid/gauges/probe.hpp"

namespace brisance::solid {

/// Forces over sections and supports are exact sums, so that files have the same bytes on any number of ranks.
class SolidGauges : public SampledFiles {
 public:
  SolidGauges(std::vector<SolidGaugeConfig> gauges, Solid& solid, parallel::Comm& comm);

  std::vector<SolidGaugeConfig> const& configs() const { return configs_; }
  Probe const& probe(std::size_t gauge) const { return probes_[gauge]; }
  RowSampler const& rows(std::size_t gauge) const { return samplers_[gauge]; }  ///< on rank 0

 private:
  std::size_t count() const override { return configs_.size(); }
  std::string const& name_of(std::size_t gauge) const override { return configs_[gauge].name; }
  void note() override;
  void keep_first(std::size_t notes) override { notes_.resize(notes * note_size_); }
  void drop_first(std::size_t notes) override;
  std::size_t note_bytes() const override { return notes_.capacity(); }
  void collect(std::size_t notes) override;
  SampledSeries& series(std::size_t gauge) override { return samplers_[gauge]; }
  void start(std::size_t gauge, Real time, std::string& rows) override;
  void add(std::size_t gauge, Real time, std::size_t note, std::string& rows) override;

  std::vector<SolidGaugeConfig> configs_;
  Solid& solid_;
  parallel::Comm& comm_;
  std::vector<Probe> probes_;
  std::vector<RowSampler> samplers_;
  parallel::Bytes notes_;                               ///< of this rank
  std::size_t note_size_ = 0;                           ///< bytes of one
  std::vector<std::vector<std::vector<Real>>> values_;  ///< collected on rank 0: columns of all gauges, [note][gauge]
};

}  // namespace brisance::solid
