// What all gauges have in common: a file of rows at multiples of an interval that a restart goes on with.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/model/sample_times.hpp"

namespace brisance {

/// One gauge through time. The file depends on the values and times of the steps alone: not on ranks, nor on when it is
/// written.
class SampledSeries {
 public:
  virtual ~SampledSeries() = default;
  virtual std::string header() const = 0;
  bool started() const { return started_; }
  /// The complete lines of `file` below its header that were written before the present state; empty when the header
  /// is another.
  std::string kept_rows(std::string const& file) const { return samples_.kept_rows(file, header()); }

  /// Everything a restart needs. `restore` is false and does nothing when the gauge was another: moved, or sampled
  /// differently.
  virtual std::size_t stored_size() const = 0;
  virtual std::vector<Real> store() const = 0;
  virtual bool restore(std::span<Real const> stored) = 0;

 protected:
  explicit SampledSeries(Real interval) : samples_(interval) {}
  SampledSeries(SampledSeries const&) = default;
  SampledSeries(SampledSeries&&) = default;
  SampledSeries& operator=(SampledSeries const&) = default;
  SampledSeries& operator=(SampledSeries&&) = default;

  bool started_ = false;
  Real time_ = 0;  ///< of the last step, s
  SampleTimes samples_;
};

}  // namespace brisance
