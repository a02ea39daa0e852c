#include "core/solid/gauges/gauges.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

constexpr std::size_t bytes_kept = std::size_t{1} << 20, notes_kept = 256;

using Limbs = std::array<std::int64_t, parallel::ExactSum::limbs>;

std::string read_text(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  return text.str();
}

bool has(std::vector<int> const& ranks, int rank) { return std::binary_search(ranks.begin(), ranks.end(), rank); }

}  // namespace

SolidGauges::SolidGauges(std::vector<SolidGaugeConfig> gauges, Solid& solid, parallel::Comm& comm)
    : configs_(std::move(gauges)), solid_(solid), comm_(comm) {
  std::size_t largest = 1;
  for (SolidGaugeConfig const& gauge : configs_) {
    Probe const& probe = probes_.emplace_back(gauge, solid);
    RowSampler const& sampler =
        samplers_.emplace_back(columns(gauge, solid.mesh().dimension), static_cast<Real>(gauge.interval));
    std::size_t const size = probe.is_sum() ? 6 * sizeof(Limbs) : sampler.columns().size() * sizeof(Real);
    largest += size;
    if (has(probe.ranks(), comm.rank())) note_size_ += size;
  }
  most_notes_ = std::clamp<std::size_t>(bytes_kept / largest, 1, notes_kept);
}

void SolidGauges::join(Plan& plan) {
  plan.effect("output.solid_gauges", [this] { return notes_.capacity() + times_.capacity() * sizeof(Real); });
  plan.at(Stage::kick_again, [this](Clock const& clock) { note(clock.time + clock.dt); });
  Plan::Keep keep;
  keep.save = [] {};
  keep.restore = [this] {
    times_.resize(accepted_);
    notes_.resize(accepted_ * note_size_);
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    flush();
    for (std::size_t g = 0; g < configs_.size(); ++g) {
      auto const stored = samplers_[g].store();
      auto const rows = static_cast<std::int64_t>(stored.size());
      parallel::Range const all{0, comm_.rank() == 0 ? rows : 0};
      file.rows("solid_gauges/" + configs_[g].name, rows, 1, std::span(&all, 1),
                std::span(stored).first(static_cast<std::size_t>(all.count)));
    }
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    for (std::size_t g = 0; g < configs_.size(); ++g) {
      std::string const name = "solid_gauges/" + configs_[g].name;
      parallel::Range const all{0, static_cast<std::int64_t>(samplers_[g].stored_size())};
      if (!file.has(name) || file.row_count(name) != all.count) continue;
      samplers_[g].restore(file.rows(name, 1, std::span(&all, 1)));
    }
  };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void SolidGauges::note(Real time) {
  times_.push_back(time);
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

void SolidGauges::accept(Clock const& clock) {
  times_.back() = clock.time;  // output times are hit exactly, sums of steps are not
  accepted_ = times_.size();
  if (accepted_ >= most_notes_) flush();
}

std::vector<std::vector<std::vector<Real>>> SolidGauges::collect(std::size_t notes) {
  parallel::Bytes const mine(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(notes * note_size_));
  std::vector<parallel::Bytes> const all = comm_.gather(mine, 0);
  std::vector<std::vector<std::vector<Real>>> values;
  if (comm_.rank() != 0) return values;
  std::vector<std::span<std::byte const>> in(all.begin(), all.end());
  values.resize(notes);
  for (auto& of_note : values)
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
  return values;
}

std::string SolidGauges::path(std::size_t gauge) const {
  return directory_ + "/gauges/" + configs_[gauge].name + ".csv";
}

std::vector<std::string> SolidGauges::open(std::string const& directory, Clock const& clock) {
  directory_ = directory;
  times_.clear();
  notes_.clear();
  note(clock.time);
  auto const values = collect(1);
  times_.clear();
  notes_.clear();
  accepted_ = 0;
  std::error_code failed;  // then writing the files fails, on all ranks
  if (comm_.rank() == 0) std::filesystem::create_directories(directory + "/gauges", failed);
  std::vector<std::string> remarks;
  for (std::size_t g = 0; g < configs_.size(); ++g) {
    std::string text;
    if (comm_.rank() == 0) {
      RowSampler& sampler = samplers_[g];
      text = sampler.header();
      if (sampler.started()) {
        std::string const kept = sampler.kept_rows(read_text(path(g)));
        if (kept.empty())
          remarks.push_back(path(g) + " held no rows of this gauge before the checkpoint: it begins here");
        text += kept;
      } else {
        if (clock.step > 0)
          remarks.push_back("gauge " + configs_[g].name + " is not in the checkpoint: it begins here");
        sampler.start(clock.time, values.front()[g], text);
      }
    }
    parallel::write_text_atomically(comm_, path(g), text);
  }
  return remarks;
}

void SolidGauges::flush() {
  if (accepted_ == 0) return;
  auto const values = collect(accepted_);
  if (comm_.rank() == 0)
    for (std::size_t g = 0; g < configs_.size(); ++g) {
      std::string rows;
      for (std::size_t n = 0; n < accepted_; ++n) samplers_[g].add(times_[n], values[n][g], rows);
      if (rows.empty()) continue;
      std::ofstream file(path(g), std::ios::app | std::ios::binary);
      file.write(rows.data(), static_cast<std::streamsize>(rows.size())).flush();
      require(file.good(), Failure::system, path(g) + ": cannot be written (is the disk full?)");
    }
  times_.erase(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(accepted_));
  notes_.erase(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(accepted_ * note_size_));
  accepted_ = 0;
}

}  // namespace brisance::solid
