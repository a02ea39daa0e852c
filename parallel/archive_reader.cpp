// Every rank opens the file for itself: reading needs no collective, and the rows it wants are its own affair.
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <numeric>
#include <system_error>

#include "parallel/archive.hpp"
#include "parallel/archive_parts.hpp"

namespace brisance::parallel {
namespace {

constexpr std::int64_t read_at_once = std::int64_t{1} << 24;  // bytes
constexpr std::int64_t gap_worth_reading = std::int64_t{1} << 16;

void check_presence(std::string const& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0)
    throw Error(Failure::system, errno == ENOENT ? "there is no such file" : std::generic_category().message(errno));
  require(S_ISREG(about.st_mode), Failure::system, "this is not a file");
  require(about.st_size > 0, Failure::system, "the file is empty");
}

}  // namespace

struct ArchiveReader::Impl {
  Comm& comm;
  std::string path;
  std::unique_ptr<Hdf5File> file;
  std::map<std::string, Hdf5File::Dataset> datasets;
  std::map<std::string, Hdf5File::Value> values;

  void settle(Problem const& problem) { agree(comm, path + " cannot be read", problem); }

  void open() {
    settle(comm.rank() == 0 ? attempt([&] { check_presence(path); }) : Problem{});
    Problem problem = attempt([&] {
      file = std::make_unique<Hdf5File>(path, Hdf5File::Access::read);
      datasets = file->datasets();
      values = file->attributes();
    });
    if (!problem.text.empty()) problem.text = "the file is truncated, damaged or no HDF5 file (" + problem.text + ")";
    settle(problem);
    settle(attempt([&] {
      require(values.contains(format_name) && values.contains(checksum_name), Failure::system,
              "the file has no checksum: brisance did not write it");
      require(values.at(format_name) == Hdf5File::Value(format_text), Failure::system,
              "the file has another format: another version of brisance wrote it");
    }));
  }

  template <class T>
  void hash_share(std::string const& name, Hdf5File::Dataset const& dataset, Digest& digest) {
    std::int64_t const columns = columns_of(dataset), rows = dataset.elements() / std::max<std::int64_t>(columns, 1);
    std::int64_t const row_bytes = columns * Hdf5File::bytes(dataset.type);
    Range const share = Shares(rows, row_bytes, comm.size()).of(comm.rank());
    std::int64_t const step = std::max<std::int64_t>(1, read_at_once / row_bytes);
    std::vector<T> data;
    for (std::int64_t row = share.first; row < share.first + share.count; row += step) {
      std::int64_t const count = std::min(step, share.first + share.count - row);
      data.resize(static_cast<std::size_t>(count * columns));
      file->read(name, row * columns, count * columns, data.data());
      add_rows(digest, name, row, static_cast<std::size_t>(columns), std::span<T const>(data));
    }
  }

  /// The hash of all rows, read in even shares, against the one the writer left.
  void verify() {
    Digest digest;
    settle(attempt([&] {
      for (auto const& [name, dataset] : datasets) {
        if (comm.rank() == 0) add_dataset(digest, name, dataset);
        if (dataset.type == Hdf5File::Type::real) hash_share<double>(name, dataset, digest);
        if (dataset.type == Hdf5File::Type::single) hash_share<float>(name, dataset, digest);
        if (dataset.type == Hdf5File::Type::integer) hash_share<std::int64_t>(name, dataset, digest);
      }
      for (auto const& [name, value] : values)
        if (comm.rank() == 0 && name != checksum_name) add_value(digest, name, value);
    }));
    comm.sum(digest);
    settle(attempt([&] {
      require(values.at(checksum_name) == Hdf5File::Value(digest.hex()), Failure::system,
              "the file is damaged: its checksum does not fit its content. Use an older checkpoint.");
    }));
  }

  /// Reads the ranges in the order of the file, neighbours together, and returns them in the order asked for.
  template <class T>
  std::vector<T> read(std::string const& name, std::int64_t columns, std::span<Range const> ranges) {
    std::vector<std::size_t> order(ranges.size()), place(ranges.size());
    std::size_t total = 0;
    for (std::size_t k = 0; k != ranges.size(); ++k) {
      order[k] = k;
      place[k] = total;
      total += static_cast<std::size_t>(ranges[k].count * columns);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return ranges[a].first < ranges[b].first; });
    std::int64_t const row_bytes = columns * static_cast<std::int64_t>(sizeof(T));
    std::vector<T> result(total), buffer;
    for (std::size_t k = 0; k != order.size();) {
      std::int64_t const first = ranges[order[k]].first;
      std::int64_t end = first + ranges[order[k]].count;
      std::size_t last = k + 1;
      for (; last != order.size(); ++last) {
        Range const& next = ranges[order[last]];
        bool const near = (next.first - end) * row_bytes <= gap_worth_reading;
        if (!near || (next.first + next.count - first) * row_bytes > read_at_once) break;
        end = std::max(end, next.first + next.count);
      }
      buffer.resize(static_cast<std::size_t>((end - first) * columns));
      file->read(name, first * columns, (end - first) * columns, buffer.data());
      for (; k != last; ++k) {
        Range const& range = ranges[order[k]];
        auto const from = buffer.begin() + (range.first - first) * columns;
        std::copy(from, from + range.count * columns, result.begin() + static_cast<std::ptrdiff_t>(place[order[k]]));
      }
    }
    return result;
  }

  Hdf5File::Dataset const& find(std::string const& name, int columns, bool integers) const {
    auto const found = datasets.find(name);
    require(found != datasets.end(), Failure::system, "it holds no dataset " + name);
    require(columns_of(found->second) == columns, Failure::system,
            fmt::format("dataset {} has {} columns, {} are expected", name, columns_of(found->second), columns));
    require((found->second.type == Hdf5File::Type::integer) == integers, Failure::system,
            fmt::format("dataset {} does not hold {}", name, integers ? "integers" : "real numbers"));
    return found->second;
  }

  template <class T>
  T value(std::string const& name) const {
    auto const found = values.find(name);
    require(found != values.end(), Failure::system, path + " cannot be read: it holds no value " + name);
    require(std::holds_alternative<T>(found->second), Failure::system,
            path + " cannot be read: its value " + name + " has another type");
    return std::get<T>(found->second);
  }
};

ArchiveReader::ArchiveReader(Comm& comm, std::string const& path) : impl_(new Impl{comm, path, {}, {}, {}}) {
  impl_->open();
  impl_->verify();
}

ArchiveReader::~ArchiveReader() = default;

bool ArchiveReader::has(std::string const& name) const {
  return impl_->datasets.contains(name) || impl_->datasets.contains(name + "/id") || impl_->values.contains(name);
}

std::int64_t ArchiveReader::row_count(std::string const& name) const {
  auto const found = impl_->datasets.find(name);
  require(found != impl_->datasets.end(), Failure::system,
          impl_->path + " cannot be read: it holds no dataset " + name);
  return found->second.elements() / std::max<std::int64_t>(1, columns_of(found->second));
}

std::vector<std::string> ArchiveReader::values() const {
  std::vector<std::string> names;
  for (auto const& [name, value] : impl_->values)
    if (name != checksum_name && name != format_name) names.push_back(name);
  return names;
}

std::vector<double> ArchiveReader::rows(std::string const& name, int columns, std::span<Range const> ranges) {
  std::vector<double> result;
  impl_->settle(attempt([&] {
    if (impl_->find(name, columns, false).type == Hdf5File::Type::real) {
      result = impl_->read<double>(name, columns, ranges);
    } else {
      std::vector<float> const single = impl_->read<float>(name, columns, ranges);
      result.assign(single.begin(), single.end());
    }
  }));
  return result;
}

std::vector<std::int64_t> ArchiveReader::rows_int(std::string const& name, int columns, std::span<Range const> ranges) {
  std::vector<std::int64_t> result;
  impl_->settle(attempt([&] {
    impl_->find(name, columns, true);
    result = impl_->read<std::int64_t>(name, columns, ranges);
  }));
  return result;
}

ArchiveReader::Sparse ArchiveReader::sparse(std::string const& name, int columns) {
  Range const all{0, row_count(name + "/id")};
  std::span<Range const> const ranges(&all, 1);
  return {rows_int(name + "/id", 1, ranges), rows(name + "/data", columns, ranges)};
}

double ArchiveReader::real(std::string const& name) const { return impl_->value<double>(name); }
std::int64_t ArchiveReader::integer(std::string const& name) const { return impl_->value<std::int64_t>(name); }
std::string ArchiveReader::text(std::string const& name) const { return impl_->value<std::string>(name); }

}  // namespace brisance::parallel
