// Multiples of an interval, met one by one as the time goes on.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/real.hpp"

namespace brisance {

/// The times of the rows of a sampled file, s: independent of the steps that pass them.
class SampleTimes {
 public:
  explicit SampleTimes(Real interval) : interval_(interval) {}

  Real interval() const { return interval_; }
  /// Begins at `time`: the first sample is the first multiple that is not before it.
  void start(Real time);
  /// The next sample that is not after `time`, if any; the one behind it is next.
  std::optional<Real> take(Real time);
  /// The complete lines of `file` below its `header` whose times were taken; empty when the header is another.
  std::string kept_rows(std::string const& file, std::string const& header) const;

  std::int64_t next() const { return next_; }  ///< index of the next sample: what a restart needs
  void go_on_at(std::int64_t next) { next_ = next; }

 private:
  Real interval_;
  std::int64_t next_ = 0;
};

}  // namespace brisance
