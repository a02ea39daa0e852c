// Parallel HDF5 files written under a temporary name, checksummed, fsynced and renamed: complete or absent, never half.
// Rows are addressed by global row numbers, so a file does not know how many ranks wrote it.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "parallel/comm.hpp"

namespace brisance::parallel {

/// A run of consecutive global rows.
struct Range {
  std::int64_t first = 0, count = 0;
};

class ArchiveWriter {
 public:
  /// Collective. Opens `path` + a temporary suffix in the same folder. Throws Error(system) with the path and the
  /// cause.
  ArchiveWriter(Comm& comm, std::string const& path);
  ~ArchiveWriter();  ///< not closed: the temporary file is removed
  ArchiveWriter(ArchiveWriter const&) = delete;
  ArchiveWriter& operator=(ArchiveWriter const&) = delete;
  /// Collective. Dataset `name` of total_rows x columns doubles; this rank gives the rows of `ranges`, in that order.
  void rows(std::string const& name, std::int64_t total_rows, int columns, std::span<Range const> ranges,
            std::span<double const> data);
  /// Collective. Rows with explicit ids, any number per rank (datasets name/id and name/data). Order in the file is
  /// free.
  void sparse(std::string const& name, int columns, std::span<std::int64_t const> ids, std::span<double const> data);
  /// Collective. A dense array [nz][ny][nx] (or [..][columns] when columns > 1); this rank gives boxes of it, x
  /// fastest.
  struct Box {
    std::array<std::int64_t, 3> first, size;
  };  ///< x, y, z
  void grid(std::string const& name, std::array<std::int64_t, 3> cells, int columns, std::span<Box const> boxes,
            std::span<double const> data, bool single_precision);
  /// Collective; identical on all ranks. Integer rows for connectivities and the like go through `rows_int`.
  void rows_int(std::string const& name, std::int64_t total_rows, int columns, std::span<Range const> ranges,
                std::span<std::int64_t const> data);
  void attribute(std::string const& name, double value);
  void attribute(std::string const& name, std::int64_t value);
  void attribute(std::string const& name, std::string const& value);
  /// Collective. Writes the checksum of all content, flushes, fsyncs, renames. Throws Error(system) on any rank's
  /// failure.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class ArchiveReader {
 public:
  /// Collective. Throws Error(system) if the file is missing, truncated or its checksum differs; names file and cause.
  ArchiveReader(Comm& comm, std::string const& path);
  ~ArchiveReader();
  bool has(std::string const& name) const;
  std::vector<double> rows(std::string const& name, int columns, std::span<Range const> ranges);
  std::vector<std::int64_t> rows_int(std::string const& name, int columns, std::span<Range const> ranges);
  struct Sparse {
    std::vector<std::int64_t> ids;
    std::vector<double> data;
  };
  Sparse sparse(std::string const& name, int columns);  ///< all rows, on every rank
  double real(std::string const& name) const;
  std::int64_t integer(std::string const& name) const;
  std::string text(std::string const& name) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes a small text file atomically on rank 0 (temporary name, fsync, rename); throws Error(system) on all ranks.
void write_text_atomically(Comm& comm, std::string const& path, std::string const& content);

}  // namespace brisance::parallel
