#include "core/solid/gauges/gauges.hpp"

#include <algorithm>

namespace brisance::solid {
namespace {

constexpr std::size_t bytes_kept = std::size_t{1} << 20, notes_kept = 256;

using Limbs = std::array<std::int64_t, parallel::ExactSum::limbs>;

bool has(std::vector<int> const& ranks, int rank) { return std::binary_search(ranks.begin(), ranks.end(), rank); }

}  // namespace

SolidGauges::SolidGauges(std::vector<SolidGaugeConfig> gauges, Solid& solid, parallel::Comm& comm)
    : SampledFiles("output.solid_gauges", "solid_gauges", comm),
      configs_(std::move(gauges)),
      solid_(solid),
      comm_(comm) {
  std::size_t largest = 1;
  for (SolidGaugeConfig const& gauge : configs_) {
    Probe const& probe = probes_.emplace_back(gauge, solid);
    RowSampler const& sampler =
        samplers_.emplace_back(columns(gauge, solid.mesh().dimension), static_cast<Real>(gauge.interval));
    std::size_t const size = probe.is_sum() ? 6 * sizeof(Limbs) : sampler.columns().size() * sizeof(Real);
    largest += size;
    if (has(probe.ranks(), comm.rank())) note_size_ += size;
  }
  keep_notes(std::clamp<std::size_t>(bytes_kept / largest, 1, notes_kept));
}

void SolidGauges::note() {
  for (Probe const& probe : probes_) {
    if (!has(probe.ranks(), comm_.rank())) continue;
    if (!probe.is_sum()) {
      for (Real const v : probe.values(solid_)) parallel::put(notes_, v);
      continue;
    }
    std::array<parallel::ExactSum, 6> sums;
    probe.add(solid_, sums);
    for (parallel::ExactSum& sum : sums) parallel::put(notes_, sum.raw());
  }
}

void SolidGauges::collect(std::size_t notes) {
  parallel::Bytes const mine(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(notes * note_size_));
  std::vector<parallel::Bytes> const all = comm_.gather(mine, 0);
  if (comm_.rank() != 0) return;
  std::vector<std::span<std::byte const>> in(all.begin(), all.end());
  values_.assign(notes, {});
  for (auto& of_note : values_)
    for (std::size_t g = 0; g < probes_.size(); ++g) {
      Probe const& probe = probes_[g];
      std::vector<Real>& row = of_note.emplace_back();
      std::array<parallel::ExactSum, 6> sums;
      for (int const rank : probe.ranks()) {
        auto& from = in[static_cast<std::size_t>(rank)];
        if (!probe.is_sum()) {
          for (std::size_t c = 0; c < samplers_[g].columns().size(); ++c) row.push_back(parallel::take<Real>(from));
          continue;
        }
        for (parallel::ExactSum& sum : sums) {
          parallel::ExactSum part;
          part.raw() = parallel::take<Limbs>(from);
          sum.add(part);
        }
      }
      if (probe.is_sum()) row = probe.columns(sums, solid_.mesh().dimension);
    }
}

void SolidGauges::drop_first(std::size_t notes) {
  notes_.erase(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(notes * note_size_));
}

void SolidGauges::start(std::size_t gauge, Real time, std::string& rows) {
  samplers_[gauge].start(time, values_.front()[gauge], rows);
}

void SolidGauges::add(std::size_t gauge, Real time, std::size_t note, std::string& rows) {
  samplers_[gauge].add(time, values_[note][gauge], rows);
}

}  // namespace brisance::solid
