#include "fluid/gauges/gauges.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fluid/cell_state.hpp"
#include "parallel/error.hpp"

namespace brisance::fluid {
namespace {

/// Notes kept before the files are written: a collection of values costs a message per rank.
constexpr std::size_t notes_kept = 256;

std::string read_text(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  return text.str();
}

}  // namespace

Gauges::Gauges(std::vector<GaugeConfig> gauges, FlowConfig const& flow_config, Flow& flow, FluidVolume volume)
    : configs_(std::move(gauges)), flow_(flow), volume_(std::move(volume)) {
  Grid const& grid = flow.grid();
  for (GaugeConfig const& gauge : configs_) {
    GaugeStencil const& stencil = stencils_.emplace_back(grid, gauge.position);
    histories_.emplace_back(gauge, flow_config, grid.dimension);
    first_slot_.push_back(slot_owner_.size());
    for (CellIndex const c : stencil.cells()) {
      Index const id = grid.block_of(c);
      slot_owner_.push_back(flow.owner(id));
      if (Block const* block = flow.find(id)) {
        CellIndex const first = block->first();
        mine_.push_back({block, c[0] - first[0], c[1] - first[1], c[2] - first[2], c});
      }
    }
  }
}

void Gauges::join(Plan& plan) {
  plan.effect("output.gauges",
              [this] { return notes_.capacity() * sizeof(GaugeValue) + times_.capacity() * sizeof(Real); });
  plan.at(Stage::kick_again, [this](Clock const& clock) {
    // Inside a merged pair the directions stand at different times: only its end is a state.
    bool const merged = flow_.splitting() == Splitting::merged && flow_.grid().dimension > 1;
    if (merged && clock.step % 2 == 0) return;
    note(clock.time + clock.dt);
  });
  Plan::Keep keep;
  keep.save = [] {};
  keep.restore = [this] {
    times_.resize(accepted_);
    notes_.resize(accepted_ * mine_.size());
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    flush();
    auto const rows = static_cast<std::int64_t>(GaugeHistory::stored_size);
    parallel::Range const all{0, flow_.comm().rank() == 0 ? rows : 0};
    for (std::size_t g = 0; g < configs_.size(); ++g) {
      auto const stored = histories_[g].store();
      file.rows("gauges/" + configs_[g].name, rows, 1, std::span(&all, 1),
                std::span(stored).first(static_cast<std::size_t>(all.count)));
    }
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    parallel::Range const all{0, static_cast<std::int64_t>(GaugeHistory::stored_size)};
    for (std::size_t g = 0; g < configs_.size(); ++g) {
      std::string const name = "gauges/" + configs_[g].name;
      if (!file.has(name) || file.row_count(name) != all.count) continue;
      std::vector<double> const rows = file.rows(name, 1, std::span(&all, 1));
      std::array<Real, GaugeHistory::stored_size> stored{};
      std::copy(rows.begin(), rows.end(), stored.begin());
      histories_[g].restore(stored);
    }
  };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void Gauges::note(Real time) {
  times_.push_back(time);
  Real const whole = flow_.grid().cell_volume();
  for (Cell const& c : mine_) {
    Real const share = volume_.cuts(c.block->id()) ? volume_(c.global) / whole : 1;
    if (flow_.mixture()) {
      CellState const cell(flow_, *c.block, c.i, c.j, c.k);
      notes_.push_back({cell.density(), cell.pressure(), cell.velocity(), share});
    } else {
      notes_.push_back(gauge_value(flow_.gas(), c.block->load(c.i, c.j, c.k), share));
    }
  }
}

void Gauges::accept(Clock const& clock) {
  times_.back() = clock.time;  // output times are hit exactly, sums of steps are not
  accepted_ = times_.size();
  if (accepted_ >= notes_kept) flush();
}

std::vector<std::vector<GaugeValue>> Gauges::collect(std::size_t notes) {
  parallel::Bytes bytes(notes * mine_.size() * sizeof(GaugeValue));
  std::memcpy(bytes.data(), notes_.data(), bytes.size());
  std::vector<parallel::Bytes> const all = flow_.comm().gather(bytes, 0);
  std::vector<std::vector<GaugeValue>> values;
  if (flow_.comm().rank() != 0) return values;
  std::vector<std::span<std::byte const>> in(all.begin(), all.end());
  values.resize(notes);
  for (std::vector<GaugeValue>& slots : values)
    for (int const rank : slot_owner_) slots.push_back(parallel::take<GaugeValue>(in[static_cast<std::size_t>(rank)]));
  return values;
}

GaugeValue Gauges::at_gauge(std::size_t gauge, std::vector<GaugeValue> const& slots) const {
  return stencils_[gauge].value(std::span(slots).subspan(first_slot_[gauge], stencils_[gauge].cells().size()));
}

std::string Gauges::path(std::size_t gauge) const { return directory_ + "/gauges/" + configs_[gauge].name + ".csv"; }

std::vector<std::string> Gauges::open(std::string const& directory, Clock const& clock) {
  directory_ = directory;
  times_.clear();
  notes_.clear();
  note(clock.time);
  auto const values = collect(1);
  times_.clear();
  notes_.clear();
  accepted_ = 0;
  parallel::Comm& comm = flow_.comm();
  std::error_code failed;  // then writing the files fails, on all ranks
  if (comm.rank() == 0) std::filesystem::create_directories(directory + "/gauges", failed);
  std::vector<std::string> remarks;
  for (std::size_t g = 0; g < configs_.size(); ++g) {
    std::string text;
    if (comm.rank() == 0) {
      GaugeHistory& history = histories_[g];
      text = history.header();
      if (history.started()) {
        std::string const kept = history.kept_rows(read_text(path(g)));
        if (kept.empty())
          remarks.push_back(path(g) + " held no rows of this gauge before the checkpoint: it begins here");
        text += kept;
      } else {
        if (clock.step > 0)
          remarks.push_back("gauge " + configs_[g].name + " is not in the checkpoint: it begins here, impulses at 0");
        history.start(clock.time, at_gauge(g, values.front()), text);
      }
    }
    parallel::write_text_atomically(comm, path(g), text);
  }
  return remarks;
}

void Gauges::flush() {
  if (accepted_ == 0) return;
  auto const values = collect(accepted_);
  if (flow_.comm().rank() == 0)
    for (std::size_t g = 0; g < configs_.size(); ++g) {
      std::string rows;
      for (std::size_t n = 0; n < accepted_; ++n) histories_[g].add(times_[n], at_gauge(g, values[n]), rows);
      if (rows.empty()) continue;
      std::ofstream file(path(g), std::ios::app | std::ios::binary);
      file.write(rows.data(), static_cast<std::streamsize>(rows.size())).flush();
      require(file.good(), Failure::system, path(g) + ": cannot be written (is the disk full?)");
    }
  times_.erase(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(accepted_));
  notes_.erase(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(accepted_ * mine_.size()));
  accepted_ = 0;
}

}  // namespace brisance::fluid
