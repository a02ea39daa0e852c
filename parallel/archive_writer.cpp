// Rank 0 makes the file and its datasets alone; then all ranks write rows through MPI-IO. So no metadata is ever
// written by two ranks, and a failure on one is a return code for all instead of a collective that some never reach.
#include <fmt/format.h>

#include <map>
#include <tuple>

#include "parallel/archive.hpp"
#include "parallel/archive_parts.hpp"
#include "parallel/part_file.hpp"

namespace brisance::parallel {
namespace {

constexpr std::int64_t metadata_space = 1 << 16;  // more than one dataset or attribute needs

/// One rank's share of a dataset: consecutive rows.
template <class T>
struct Slab {
  std::int64_t first = 0;
  std::vector<T> data;
};

template <class T>
void check_rows(std::string const& name, std::int64_t total, int columns, std::span<Range const> ranges,
                std::span<T const> data) {
  std::int64_t rows = 0;
  for (Range const& r : ranges) {
    require(r.first >= 0 && r.count >= 0 && r.first + r.count <= total, Failure::internal,
            fmt::format("dataset {} has {} rows, a rank gives rows {} to {}", name, total, r.first, r.first + r.count));
    rows += r.count;
  }
  require(
      columns > 0 && rows * columns == static_cast<std::int64_t>(data.size()), Failure::internal,
      fmt::format("dataset {}: {} rows of {} columns announced, {} values given", name, rows, columns, data.size()));
}

/// Collective. Moves every row to the rank that writes it: contiguous writes whatever the ranges, and a row that nobody
/// or two ranks gave does not go unseen.
template <class T>
Slab<T> route(Comm& comm, std::string const& name, std::int64_t total, std::size_t columns,
              std::span<Range const> ranges, std::span<T const> data, Problem& problem) {
  Shares const shares(total, static_cast<std::int64_t>(columns * sizeof(T)), comm.size());
  std::map<int, Bytes> outgoing;
  for (Range range : ranges)
    while (range.count > 0) {
      int const owner = shares.owner(range.first);
      Range const share = shares.of(owner);
      Range const piece{range.first, std::min(range.count, share.first + share.count - range.first)};
      Bytes& bytes = outgoing[owner];
      put(bytes, piece);
      auto const values = std::as_bytes(data.first(static_cast<std::size_t>(piece.count) * columns));
      bytes.insert(bytes.end(), values.begin(), values.end());
      data = data.subspan(static_cast<std::size_t>(piece.count) * columns);
      range = {range.first + piece.count, range.count - piece.count};
    }
  std::vector<Message> messages;
  for (auto& [owner, bytes] : outgoing) messages.push_back({owner, std::move(bytes)});
  outgoing.clear();

  Range const mine = shares.of(comm.rank());
  Slab<T> slab{mine.first, std::vector<T>(static_cast<std::size_t>(mine.count) * columns)};
  std::vector<bool> given(static_cast<std::size_t>(mine.count));
  for (Message const& message : comm.deliver(std::move(messages)))
    for (std::span<std::byte const> in = message.data; !in.empty();) {
      auto const piece = take<Range>(in);
      auto const at = static_cast<std::size_t>(piece.first - mine.first), count = static_cast<std::size_t>(piece.count);
      std::memcpy(slab.data.data() + at * columns, in.data(), count * columns * sizeof(T));
      in = in.subspan(count * columns * sizeof(T));
      for (std::size_t k = at; k != at + count; ++k) {
        if (given[k]) problem = {Failure::internal, fmt::format("row {} of {} is given twice", mine.first + k, name)};
        given[k] = true;
      }
    }
  auto const missing = std::find(given.begin(), given.end(), false);
  if (missing != given.end())
    problem = {Failure::internal,
               fmt::format("row {} of {} is given by no rank", mine.first + (missing - given.begin()), name)};
  return slab;
}

std::vector<std::int64_t> with_columns(std::vector<std::int64_t> shape, int columns) {
  if (columns > 1) shape.push_back(columns);
  return shape;
}

}  // namespace

struct ArchiveWriter::Impl {
  Comm& comm;
  std::string path, part;
  std::map<std::string, Hdf5File::Value> values;
  Digest digest;  // of this rank's shares
  bool open = true;

  /// Collective. One rank's problem is everyone's error, and the end of the file.
  void settle(Problem const& problem) {
    try {
      agree(comm, path + " cannot be written", problem);
    } catch (Error const&) {
      abandon();
      throw;
    }
  }

  void abandon() {
    if (open && comm.rank() == 0) remove_part(part);
    open = false;
  }

  template <class Work>
  Problem on_first_rank(Work const& work) {
    return comm.rank() == 0 ? attempt(work) : Problem{};
  }

  template <class T>
  void store(std::string const& name, Hdf5File::Dataset const& dataset, int columns, std::span<Range const> ranges,
             std::span<T const> data) {
    require(open, Failure::internal, path + ": a dataset is written after the end of the file");
    std::int64_t const total = dataset.elements() / std::max(1, columns);
    settle(attempt([&] { check_rows(name, total, columns, ranges, data); }));
    Problem problem;
    Slab<T> const slab = route(comm, name, total, static_cast<std::size_t>(columns), ranges, data, problem);
    settle(problem);
    settle(on_first_rank([&] {
      reserve(part, dataset.elements() * Hdf5File::bytes(dataset.type) + metadata_space);
      Hdf5File file(part, Hdf5File::Access::change);
      file.add(name, dataset);
      file.close();
    }));
    settle(attempt([&] { write(name, dataset, columns, slab); }));
    if (comm.rank() == 0) add_dataset(digest, name, dataset);
    add_rows(digest, name, slab.first, static_cast<std::size_t>(columns), std::span<T const>(slab.data));
  }

  template <class T>
  void write(std::string const& name, Hdf5File::Dataset const& dataset, int columns, Slab<T> const& slab) {
    if (dataset.elements() == 0) return;
    auto const file = comm.native() ? std::make_unique<Hdf5File>(part, comm.native())
                                    : std::make_unique<Hdf5File>(part, Hdf5File::Access::change);
    // Closing is collective: a rank whose write failed gets there as well, and throws afterwards.
    Problem const written = attempt([&] {
      file->write(name, slab.first * columns, static_cast<std::int64_t>(slab.data.size()), slab.data.data());
    });
    file->close();
    require(written.text.empty(), written.kind, written.text + ". Is the disk full or the quota used up?");
  }
};

ArchiveWriter::ArchiveWriter(Comm& comm, std::string const& path)
    : impl_(new Impl{comm, path, part_name(path), {}, {}, true}) {
  survive_size_limit();
  impl_->settle(impl_->on_first_rank([&] {
    create_part(impl_->part);
    reserve(impl_->part, metadata_space);
    Hdf5File::create(impl_->part);
  }));
  attribute(format_name, std::string(format_text));
}

ArchiveWriter::~ArchiveWriter() { impl_->abandon(); }

void ArchiveWriter::rows(std::string const& name, std::int64_t total_rows, int columns, std::span<Range const> ranges,
                         std::span<double const> data) {
  impl_->store(name, {with_columns({total_rows}, columns), Hdf5File::Type::real}, columns, ranges, data);
}

void ArchiveWriter::rows_int(std::string const& name, std::int64_t total_rows, int columns,
                             std::span<Range const> ranges, std::span<std::int64_t const> data) {
  impl_->store(name, {with_columns({total_rows}, columns), Hdf5File::Type::integer}, columns, ranges, data);
}

void ArchiveWriter::sparse(std::string const& name, int columns, std::span<std::int64_t const> ids,
                           std::span<double const> data) {
  // Every rank learns all ids, as a reader does: rows stand sorted by id, and no rank count shows in the file.
  Comm& comm = impl_->comm;
  Bytes mine;
  for (std::int64_t const id : ids) put(mine, id);
  struct Entry {
    std::int64_t id;
    int rank;
    std::size_t place;
  };
  std::vector<Entry> all;
  int rank = 0;
  for (Bytes const& bytes : comm.all_gather(mine)) {
    std::size_t place = 0;
    for (std::span<std::byte const> in = bytes; !in.empty();) all.push_back({take<std::int64_t>(in), rank, place++});
    ++rank;
  }
  std::sort(all.begin(), all.end(), [](Entry const& a, Entry const& b) {
    return std::tie(a.id, a.rank, a.place) < std::tie(b.id, b.rank, b.place);
  });
  std::vector<Range> rows(ids.size());
  for (std::size_t k = 0; k != all.size(); ++k)
    if (all[k].rank == comm.rank()) rows[all[k].place] = {static_cast<std::int64_t>(k), 1};
  auto const total = static_cast<std::int64_t>(all.size());
  rows_int(name + "/id", total, 1, rows, ids);
  this->rows(name + "/data", total, columns, rows, data);
}

void ArchiveWriter::grid(std::string const& name, std::array<std::int64_t, 3> cells, int columns,
                         std::span<Box const> boxes, std::span<double const> data, bool single_precision) {
  std::vector<Range> runs;
  for (Box const& box : boxes)
    for (std::int64_t z = box.first[2]; z < box.first[2] + box.size[2]; ++z)
      for (std::int64_t y = box.first[1]; y < box.first[1] + box.size[1]; ++y)
        runs.push_back({box.first[0] + cells[0] * (y + cells[1] * z), box.size[0]});
  std::vector<std::int64_t> const shape = with_columns({cells[2], cells[1], cells[0]}, columns);
  if (!single_precision) return impl_->store(name, {shape, Hdf5File::Type::real}, columns, runs, data);
  std::vector<float> reduced(data.size());
  std::transform(data.begin(), data.end(), reduced.begin(), [](double x) { return static_cast<float>(x); });
  impl_->store(name, {shape, Hdf5File::Type::single}, columns, runs, std::span<float const>(reduced));
}

void ArchiveWriter::attribute(std::string const& name, double value) { impl_->values[name] = value; }
void ArchiveWriter::attribute(std::string const& name, std::int64_t value) { impl_->values[name] = value; }
void ArchiveWriter::attribute(std::string const& name, std::string const& value) { impl_->values[name] = value; }

void ArchiveWriter::close() {
  Impl& it = *impl_;
  require(it.open, Failure::internal, it.path + ": closed twice");
  std::int64_t space = metadata_space;
  for (auto const& [name, value] : it.values) {
    if (it.comm.rank() == 0) add_value(it.digest, name, value);
    space += 1024 + static_cast<std::int64_t>(name.size());
    if (auto const* text = std::get_if<std::string>(&value)) space += 2 * static_cast<std::int64_t>(text->size());
  }
  it.comm.sum(it.digest);
  it.settle(it.on_first_rank([&] {
    reserve(it.part, space);
    Hdf5File file(it.part, Hdf5File::Access::change);
    for (auto const& [name, value] : it.values) file.set(name, value);
    file.set(checksum_name, it.digest.hex());
    file.close();
  }));
  it.settle(attempt([&] { sync_part(it.part); }));
  it.settle(it.on_first_rank([&] { publish(it.part, it.path); }));
  it.open = false;
}

void write_text_atomically(Comm& comm, std::string const& path, std::string const& content) {
  std::string const part = part_name(path);
  survive_size_limit();
  Problem problem;
  if (comm.rank() == 0) {
    problem = attempt([&] {
      create_part(part);
      write_part(part, content);
      publish(part, path);
    });
    if (!problem.text.empty()) remove_part(part);
  }
  agree(comm, path + " cannot be written", problem);
}

}  // namespace brisance::parallel
