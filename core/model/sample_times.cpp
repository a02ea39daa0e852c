#include "core/model/sample_times.hpp"

#include <cmath>
#include <cstdlib>

namespace brisance {
namespace {

/// Sampling times and steps that end on them agree to rounding.
constexpr Real rounding = 1e-12;

}  // namespace

void SampleTimes::start(Real time) { next_ = static_cast<std::int64_t>(std::ceil(time / interval_ * (1 - rounding))); }

std::optional<Real> SampleTimes::take(Real time) {
  Real const sample = static_cast<Real>(next_) * interval_;
  if (sample > time * (1 + rounding)) return std::nullopt;
  ++next_;
  return sample;
}

std::string SampleTimes::kept_rows(std::string const& file, std::string const& header) const {
  std::string kept;
  if (!file.starts_with(header)) return kept;
  for (std::size_t at = header.size(), end; (end = file.find('\n', at)) != std::string::npos; at = end + 1) {
    Real const time = std::strtod(file.c_str() + at, nullptr);
    if (std::llround(time / interval_) >= next_) break;
    kept.append(file, at, end + 1 - at);
  }
  return kept;
}

}  // namespace brisance
