#include "core/model/sampled_files.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "parallel/error.hpp"

namespace brisance {
namespace {

std::string read_text(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  return text.str();
}

void append_text(std::string const& path, std::string const& text) {
  std::ofstream file(path, std::ios::app | std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size())).flush();
  require(file.good(), Failure::system, path + ": cannot be written (is the disk full?)");
}

}  // namespace

void SampledFiles::join(Plan& plan) {
  plan.effect(name_, [this] { return note_bytes() + times_.capacity() * sizeof(Real); });
  plan.at(Stage::kick_again, [this](Clock const& clock) {
    if (!is_state(clock)) return;
    times_.push_back(clock.time + clock.dt);
    note();
  });
  Plan::Keep keep;
  keep.save = [] {};
  keep.restore = [this] {
    times_.resize(accepted_);
    keep_first(accepted_);
  };
  keep.write = [this](parallel::ArchiveWriter& file) { write(file); };
  keep.read = [this](parallel::ArchiveReader& file) { read(file); };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void SampledFiles::write(parallel::ArchiveWriter& file) {
  flush();
  for (std::size_t g = 0; g < count(); ++g) {
    std::vector<Real> const stored = series(g).store();
    auto const rows = static_cast<std::int64_t>(stored.size());
    parallel::Range const all{0, comm_.rank() == 0 ? rows : 0};
    file.rows(group_ + "/" + name_of(g), rows, 1, std::span(&all, 1),
              std::span(stored).first(static_cast<std::size_t>(all.count)));
  }
}

void SampledFiles::read(parallel::ArchiveReader& file) {
  for (std::size_t g = 0; g < count(); ++g) {
    std::string const name = group_ + "/" + name_of(g);
    parallel::Range const all{0, static_cast<std::int64_t>(series(g).stored_size())};
    if (file.has(name) && file.row_count(name) == all.count) series(g).restore(file.rows(name, 1, std::span(&all, 1)));
  }
}

void SampledFiles::accept(Clock const& clock) {
  times_.back() = clock.time;  // output times are hit exactly, sums of steps are not
  accepted_ = times_.size();
  if (accepted_ >= most_notes_) flush();
}

std::vector<std::string> SampledFiles::open(std::string const& directory, Clock const& clock) {
  directory_ = directory;
  times_.clear();
  keep_first(0);
  note();
  collect(1);
  keep_first(0);
  accepted_ = 0;
  std::error_code failed;  // then writing the files fails, on all ranks
  if (comm_.rank() == 0) std::filesystem::create_directories(directory + "/gauges", failed);
  std::vector<std::string> remarks;
  for (std::size_t g = 0; g < count(); ++g) {
    std::string text;
    if (comm_.rank() == 0) {
      text = series(g).header();
      if (series(g).started()) {
        std::string const kept = series(g).kept_rows(read_text(path(g)));
        if (kept.empty())
          remarks.push_back(path(g) + " held no rows of this gauge before the checkpoint: it begins here");
        text += kept;
      } else {
        if (clock.step > 0)
          remarks.push_back("gauge " + name_of(g) + " is not in the checkpoint: it begins here, its integrals at 0");
        start(g, clock.time, text);
      }
    }
    parallel::write_text_atomically(comm_, path(g), text);
  }
  return remarks;
}

void SampledFiles::flush() {
  if (accepted_ == 0) return;
  collect(accepted_);
  if (comm_.rank() == 0)
    for (std::size_t g = 0; g < count(); ++g) {
      std::string rows;
      for (std::size_t n = 0; n < accepted_; ++n) add(g, times_[n], n, rows);
      if (!rows.empty()) append_text(path(g), rows);
    }
  times_.erase(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(accepted_));
  drop_first(accepted_);
  accepted_ = 0;
}

}  // namespace brisance
