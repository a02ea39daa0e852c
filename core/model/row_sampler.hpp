// Rows of a file at multiples of an interval, from values after every step: linear in between.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/real.hpp"

namespace brisance {

/// The file depends on the values and times of the steps alone: not on ranks, nor on when it is written.
class RowSampler {
 public:
  RowSampler(std::vector<std::string> columns, Real interval)
      : columns_(std::move(columns)), interval_(interval), lowest_(columns_.size()), highest_(columns_.size()) {}

  std::vector<std::string> const& columns() const { return columns_; }
  std::string header() const;
  /// The first values; appends the row of this time if it is a multiple of the interval.
  void start(Real time, std::span<Real const> values, std::string& rows);
  /// The values one step later; appends the rows of all multiples of the interval up to it.
  void add(Real time, std::span<Real const> values, std::string& rows);
  bool started() const { return started_; }
  /// Extremes over the steps, by column.
  std::span<Real const> lowest() const { return lowest_; }
  std::span<Real const> highest() const { return highest_; }
  /// The complete lines of `file` below its header that were written before the present state; empty when the header
  /// is another.
  std::string kept_rows(std::string const& file) const;

  /// Everything a restart needs; `restore` is false and does nothing when the interval or the columns were others.
  std::size_t stored_size() const { return 3 + 3 * columns_.size(); }
  std::vector<Real> store() const;
  bool restore(std::span<Real const> stored);

 private:
  Real sampling_time(std::int64_t k) const { return static_cast<Real>(k) * interval_; }
  void row(Real time, std::span<Real const> values, std::string& rows) const;

  std::vector<std::string> columns_;
  Real interval_;
  bool started_ = false;
  Real time_ = 0;
  std::int64_t next_ = 0;  ///< sampling time of the next row
  std::vector<Real> last_, lowest_, highest_;
};

}  // namespace brisance
