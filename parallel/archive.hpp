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

/// Every call but `attribute` is collective, and its failure on one rank is an Error on all: Error(system) with the
/// path and the cause, the temporary file removed. The bytes of the file depend on its content alone, not on the ranks.
class ArchiveWriter {
 public:
  /// Creates the file under its temporary name in the same folder.
  ArchiveWriter(Comm& comm, std::string const& path);
  ~ArchiveWriter();  ///< not closed: the temporary file is removed. Not collective.
  ArchiveWriter(ArchiveWriter const&) = delete;
  ArchiveWriter& operator=(ArchiveWriter const&) = delete;

  /// Dataset `name` of [total_rows][columns] doubles, [total_rows] for one column; this rank gives the rows of
  /// `ranges`, in that order. The ranks together give every row exactly once; folders in the name ("solid/particles")
  /// are made.
  void rows(std::string const& name, std::int64_t total_rows, int columns, std::span<Range const> ranges,
            std::span<double const> data);
  /// The same for integers: connectivities and the like.
  void rows_int(std::string const& name, std::int64_t total_rows, int columns, std::span<Range const> ranges,
                std::span<std::int64_t const> data);
  /// Rows with explicit ids, any number per rank: datasets name/id and name/data, sorted by id.
  /// Cost: every rank sees all ids; for sets that are small beside the fields.
  void sparse(std::string const& name, int columns, std::span<std::int64_t const> ids, std::span<double const> data);
  /// A dense array [nz][ny][nx], or [nz][ny][nx][columns] when columns > 1; this rank gives boxes of it, x fastest.
  struct Box {
    std::array<std::int64_t, 3> first, size;
  };  ///< x, y, z
  void grid(std::string const& name, std::array<std::int64_t, 3> cells, int columns, std::span<Box const> boxes,
            std::span<double const> data, bool single_precision);
  /// A single value; rank 0's is written.
  void attribute(std::string const& name, double value);
  void attribute(std::string const& name, std::int64_t value);
  void attribute(std::string const& name, std::string const& value);

  /// Writes the checksum of all content, flushes to the disk, renames.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opening and reading rows are collective: a failure on one rank is an Error(system) on all. The rest is local.
class ArchiveReader {
 public:
  /// Opens the file and checks its content against its checksum, each rank a part. Throws Error(system) that names the
  /// file if it is missing, truncated, damaged or not ours.
  ArchiveReader(Comm& comm, std::string const& path);
  ~ArchiveReader();
  bool has(std::string const& name) const;                ///< a dataset, a sparse set or a value
  std::int64_t row_count(std::string const& name) const;  ///< rows of a dataset; cells of a grid
  std::vector<std::string> values() const;                ///< names of the single values, sorted
  /// Rows in the order of `ranges`; of a grid, cells numbered with x fastest.
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
