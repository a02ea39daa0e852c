// One HDF5 file as the archive needs it: plain arrays and attributes. Hides hdf5.h; knows no checksum and no ranks but
// that several processes may write the data of an existing dataset at once.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace brisance::parallel {

/// Every function throws Error(system) with the cause HDF5 gives, on the process it happens on.
class Hdf5File {
 public:
  enum class Type { real, single, integer };
  enum class Access { read, change };
  struct Dataset {
    std::vector<std::int64_t> shape;  ///< slowest index first
    Type type = Type::real;
    std::int64_t elements() const;
  };
  using Value = std::variant<double, std::int64_t, std::string>;

  static void create(std::string const& path);  ///< an empty file
  static std::int64_t bytes(Type type);

  Hdf5File(std::string const& path, Access access);  ///< this process alone
  /// Collective over the MPI_Comm that `communicator` points to: for `write` of existing datasets through MPI-IO.
  Hdf5File(std::string const& path, void* communicator);
  ~Hdf5File();
  Hdf5File(Hdf5File const&) = delete;
  Hdf5File& operator=(Hdf5File const&) = delete;
  void close();

  void add(std::string const& name, Dataset const& dataset);  ///< its space is allocated, not written
  void set(std::string const& name, Value const& value);
  std::map<std::string, Dataset> datasets() const;
  std::map<std::string, Value> attributes() const;

  /// Elements [first, first + count) of the array in row-major order; the buffer has the type of the dataset.
  void write(std::string const& name, std::int64_t first, std::int64_t count, void const* data);
  void read(std::string const& name, std::int64_t first, std::int64_t count, void* data) const;

 private:
  std::int64_t file_ = -1;
};

}  // namespace brisance::parallel
