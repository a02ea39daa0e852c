#include "parallel/archive_parts.hpp"

namespace brisance::parallel {
namespace {

constexpr std::int64_t smallest_share = std::int64_t{1} << 20;  // bytes

/// Kinds of the digest: rows of a dataset have an even one, the dataset itself and values an odd one.
std::uint32_t kind_of(std::string const& name) {
  std::uint32_t hash = 2166136261u;
  for (char const c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash & ~1u;
}

std::vector<std::uint64_t> words_of(std::string const& text) {
  std::vector<std::uint64_t> words{text.size()};
  for (std::size_t k = 0; k != text.size(); ++k) {
    if (k % 8 == 0) words.push_back(0);
    words.back() |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[k])) << (8 * (k % 8));
  }
  return words;
}

std::uint64_t word(double x) { return std::bit_cast<std::uint64_t>(x); }
std::uint64_t word(float x) { return std::bit_cast<std::uint32_t>(x); }
std::uint64_t word(std::int64_t x) { return static_cast<std::uint64_t>(x); }

}  // namespace

void agree(Comm& comm, std::string const& subject, Problem const& mine) {
  std::int64_t failed = mine.text.empty() ? 0 : 1;
  comm.sum(std::span(&failed, 1));
  if (failed == 0) return;
  Bytes report;
  put(report, mine.kind);
  for (char const c : mine.text) put(report, c);
  for (Bytes const& bytes : comm.all_gather(report)) {
    std::span<std::byte const> in = bytes;
    auto const kind = take<Failure>(in);
    if (in.empty()) continue;
    std::string text;
    while (!in.empty()) text += take<char>(in);
    throw Error(kind, subject + ": " + text);
  }
}

Shares::Shares(std::int64_t total, std::int64_t row_bytes, int ranks) : total_(total) {
  rows_ = std::max({(total + ranks - 1) / ranks, (smallest_share + row_bytes - 1) / row_bytes, std::int64_t{1}});
}

Range Shares::of(int rank) const {
  std::int64_t const first = std::min(total_, rank * rows_);
  return {first, std::min(rows_, total_ - first)};
}

std::int64_t columns_of(Hdf5File::Dataset const& dataset) {
  return dataset.shape.size() % 2 == 0 && !dataset.shape.empty() ? dataset.shape.back() : 1;
}

template <class T>
void add_rows(Digest& digest, std::string const& name, std::int64_t first_row, std::size_t columns,
              std::span<T const> data) {
  std::uint32_t const kind = kind_of(name);
  std::vector<std::uint64_t> row(columns);
  for (std::size_t at = 0; at + columns <= data.size(); at += columns, ++first_row) {
    for (std::size_t c = 0; c != columns; ++c) row[c] = word(data[at + c]);
    digest.add(kind, first_row, std::span<std::uint64_t const>(row));
  }
}
template void add_rows(Digest&, std::string const&, std::int64_t, std::size_t, std::span<double const>);
template void add_rows(Digest&, std::string const&, std::int64_t, std::size_t, std::span<float const>);
template void add_rows(Digest&, std::string const&, std::int64_t, std::size_t, std::span<std::int64_t const>);

void add_dataset(Digest& digest, std::string const& name, Hdf5File::Dataset const& dataset) {
  std::vector<std::uint64_t> words = words_of(name);
  words.push_back(static_cast<std::uint64_t>(dataset.type));
  for (std::int64_t const size : dataset.shape) words.push_back(word(size));
  digest.add(kind_of(name) | 1u, 0, std::span<std::uint64_t const>(words));
}

void add_value(Digest& digest, std::string const& name, Hdf5File::Value const& value) {
  std::vector<std::uint64_t> words = words_of(name);
  words.push_back(value.index());
  if (auto const* text = std::get_if<std::string>(&value)) {
    std::vector<std::uint64_t> const more = words_of(*text);
    words.insert(words.end(), more.begin(), more.end());
  } else {
    words.push_back(std::holds_alternative<double>(value) ? word(std::get<double>(value))
                                                          : word(std::get<std::int64_t>(value)));
  }
  digest.add(kind_of(name) | 1u, 1, std::span<std::uint64_t const>(words));
}

}  // namespace brisance::parallel
