// What the writer and the reader of archives share: one verdict on all ranks, even shares of rows, hashes of content.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "parallel/archive.hpp"
#include "parallel/error.hpp"
#include "parallel/hdf5_file.hpp"

namespace brisance::parallel {

constexpr char const* checksum_name = "checksum";
constexpr char const* format_name = "format";
constexpr char const* format_text = "brisance archive 1";

/// What went wrong on this rank; empty when nothing did.
struct Problem {
  Failure kind = Failure::system;
  std::string text;
};

template <class Work>
Problem attempt(Work const& work) {
  try {
    work();
    return {};
  } catch (Error const& e) {
    return {e.kind(), e.what()};
  } catch (std::exception const& e) {
    return {Failure::system, e.what()};
  }
}

/// Collective. Throws on all ranks when one has a problem: the one of the lowest rank, after `subject`.
void agree(Comm& comm, std::string const& subject, Problem const& mine);

/// Rows in contiguous shares, one per rank, none so small that a write is not worth it: the last ranks may have none.
class Shares {
 public:
  Shares(std::int64_t total, std::int64_t row_bytes, int ranks);
  Range of(int rank) const;
  int owner(std::int64_t row) const { return static_cast<int>(row / rows_); }

 private:
  std::int64_t total_, rows_;
};

/// Values per row: one for [n] and [nz][ny][nx], the last dimension for [n][c] and [nz][ny][nx][c].
std::int64_t columns_of(Hdf5File::Dataset const& dataset);

/// Adds the hashes of rows, of a dataset's name and shape, of a value: name, place and bits.
template <class T>
void add_rows(Digest& digest, std::string const& name, std::int64_t first_row, std::size_t columns,
              std::span<T const> data);
void add_dataset(Digest& digest, std::string const& name, Hdf5File::Dataset const& dataset);
void add_value(Digest& digest, std::string const& name, Hdf5File::Value const& value);

}  // namespace brisance::parallel
