#include "core/model/row_sampler.hpp"

#include <fmt/format.h>

namespace brisance {

std::string RowSampler::header() const {
  std::string text = "time";
  for (std::string const& column : columns_) text += "," + column;
  return text + "\n";
}

void RowSampler::row(Real time, std::span<Real const> values, std::string& rows) const {
  rows += fmt::format("{:.12g}", time);
  for (Real const v : values) rows += fmt::format(",{:.10g}", v);
  rows += '\n';
}

void RowSampler::start(Real time, std::span<Real const> values, std::string& rows) {
  started_ = true;
  time_ = time;
  last_.assign(values.begin(), values.end());
  lowest_ = highest_ = last_;
  samples_.start(time);
  if (auto const t = samples_.take(time)) row(*t, values, rows);
}

void RowSampler::add(Real time, std::span<Real const> values, std::string& rows) {
  std::vector<Real> here(values.size());
  while (auto const t = samples_.take(time)) {
    Real const w = clamp((*t - time_) / (time - time_), 0, 1);
    for (std::size_t c = 0; c < here.size(); ++c) here[c] = (1 - w) * last_[c] + w * values[c];
    row(*t, here, rows);
  }
  time_ = time;
  last_.assign(values.begin(), values.end());
  for (std::size_t c = 0; c < last_.size(); ++c) {
    lowest_[c] = min(lowest_[c], last_[c]);
    highest_[c] = max(highest_[c], last_[c]);
  }
}

std::vector<Real> RowSampler::store() const {
  std::vector<Real> all{samples_.interval(), time_, static_cast<Real>(samples_.next())};
  for (auto const* part : {&last_, &lowest_, &highest_}) all.insert(all.end(), part->begin(), part->end());
  all.resize(stored_size(), 0);
  return all;
}

bool RowSampler::restore(std::span<Real const> stored) {
  if (stored.size() != stored_size() || stored[0] != samples_.interval()) return false;
  std::size_t const n = columns_.size();
  auto part = [&](std::size_t k) {
    auto const from = stored.subspan(3 + k * n, n);
    return std::vector<Real>(from.begin(), from.end());
  };
  started_ = true;
  time_ = stored[1];
  samples_.go_on_at(static_cast<std::int64_t>(stored[2]));
  last_ = part(0), lowest_ = part(1), highest_ = part(2);
  return true;
}

}  // namespace brisance
