// Rows of a file at multiples of an interval, from values after every step: linear in between.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/model/sampled_series.hpp"

namespace brisance {

/// A fixed set of columns.
class RowSampler : public SampledSeries {
 public:
  RowSampler(std::vector<std::string> columns, Real interval)
      : SampledSeries(interval), columns_(std::move(columns)), lowest_(columns_.size()), highest_(columns_.size()) {}

  std::vector<std::string> const& columns() const { return columns_; }
  std::string header() const override;
  /// The first values; appends the row of this time if it is a multiple of the interval.
  void start(Real time, std::span<Real const> values, std::string& rows);
  /// The values one step later; appends the rows of all multiples of the interval up to it.
  void add(Real time, std::span<Real const> values, std::string& rows);
  /// Extremes over the steps, by column.
  std::span<Real const> lowest() const { return lowest_; }
  std::span<Real const> highest() const { return highest_; }
  std::size_t stored_size() const override { return 3 + 3 * columns_.size(); }
  std::vector<Real> store() const override;
  bool restore(std::span<Real const> stored) override;

 private:
  void row(Real time, std::span<Real const> values, std::string& rows) const;

  std::vector<std::string> columns_;
  std::vector<Real> last_, lowest_, highest_;
};

}  // namespace brisance
