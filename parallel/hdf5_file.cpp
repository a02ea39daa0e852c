#include "parallel/hdf5_file.hpp"

#include <hdf5.h>
#include <mpi.h>

#include <algorithm>
#include <cstring>

#include "parallel/error.hpp"

namespace brisance::parallel {
namespace {

/// One transfer moves at most this much, so that no count overflows on the way to the disk.
constexpr std::int64_t largest_transfer = std::int64_t{1} << 28;

/// The innermost message of the error stack: the one that holds errno.
herr_t innermost(unsigned, H5E_error2_t const* error, void* text) {
  auto& cause = *static_cast<std::string*>(text);
  if (cause.empty() && error->desc) cause = error->desc;
  return 0;
}

[[noreturn]] void fail(char const* what) {
  std::string cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &cause);
  throw Error(Failure::system, std::string("HDF5 ") + what + (cause.empty() ? "" : ": " + cause));
}

hid_t checked(hid_t id, char const* what) {
  if (id < 0) fail(what);
  return id;
}
void done(herr_t status, char const* what) {
  if (status < 0) fail(what);
}

/// An HDF5 identifier and the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), char const* what) : id_(checked(id, what)), close_(close) {}
  ~Handle() { close_(id_); }
  Handle(Handle const&) = delete;
  Handle& operator=(Handle const&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void silence() {
  // Our errors carry the message; HDF5 would print its stack from every rank.
  static bool const once = H5open() >= 0 && H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  require(once, Failure::system, "the HDF5 library does not start");
}

/// Metadata of format 1.8 and later carries checksums of its own, so damage anywhere shows.
void use_checked_format(hid_t access) {
  done(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "sets the format");
}

hid_t file_type(Hdf5File::Type type) {
  if (type == Hdf5File::Type::integer) return H5T_STD_I64LE;
  return type == Hdf5File::Type::real ? H5T_IEEE_F64LE : H5T_IEEE_F32LE;
}
hid_t memory_type(Hdf5File::Type type) {
  if (type == Hdf5File::Type::integer) return H5T_NATIVE_INT64;
  return type == Hdf5File::Type::real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
}

Hdf5File::Dataset describe(hid_t dataset) {
  Handle const space(H5Dget_space(dataset), H5Sclose, "reads a shape");
  Handle const type(H5Dget_type(dataset), H5Tclose, "reads a type");
  Hdf5File::Dataset result;
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  done(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "reads a shape");
  result.shape.assign(shape.begin(), shape.end());
  for (auto const known : {Hdf5File::Type::real, Hdf5File::Type::single, Hdf5File::Type::integer}) {
    result.type = known;
    if (H5Tequal(type, file_type(known)) > 0) return result;
  }
  throw Error(Failure::system, "a dataset has a type this program does not write");
}

struct Box {
  std::vector<hsize_t> start, size;
  std::int64_t elements = 1;
};

/// The largest box of whole inner dimensions that begins at element `first` and holds at most `most` elements.
Box box_at(std::vector<std::int64_t> const& shape, std::int64_t first, std::int64_t most) {
  Box box;
  std::vector<std::int64_t> stride(shape.size(), 1);
  for (std::size_t d = shape.size(); d-- > 1;) stride[d - 1] = stride[d] * shape[d];
  std::size_t level = shape.size() - 1;
  while (level > 0 && first % stride[level - 1] == 0 && most >= stride[level - 1]) --level;
  for (std::size_t d = 0; d != shape.size(); ++d) {
    std::int64_t const index = first / stride[d] % shape[d];
    std::int64_t size = 1;
    if (d == level) size = std::min(most / stride[d], shape[d] - index);
    if (d > level) size = shape[d];
    box.start.push_back(static_cast<hsize_t>(index));
    box.size.push_back(static_cast<hsize_t>(size));
    box.elements *= size;
  }
  return box;
}

/// Cuts a run of elements into boxes and hands each to `transfer(memory type, memory space, file space, byte offset)`.
template <class Transfer>
void for_boxes(hid_t dataset, std::int64_t first, std::int64_t count, Transfer const& transfer) {
  Hdf5File::Dataset const about = describe(dataset);
  require(first >= 0 && count >= 0 && first + count <= about.elements(), Failure::internal,
          "rows outside the dataset: elements " + std::to_string(first) + " to " + std::to_string(first + count) +
              " of " + std::to_string(about.elements()));
  std::int64_t const size = Hdf5File::bytes(about.type);
  for (std::int64_t at = 0; at < count;) {
    Box const box = box_at(about.shape, first + at, std::min(count - at, largest_transfer / size));
    Handle const file_space(H5Dget_space(dataset), H5Sclose, "reads a shape");
    done(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, box.start.data(), nullptr, box.size.data(), nullptr),
         "selects rows");
    auto const length = static_cast<hsize_t>(box.elements);
    Handle const memory_space(H5Screate_simple(1, &length, nullptr), H5Sclose, "describes a buffer");
    transfer(memory_type(about.type), memory_space, file_space, at * size);
    at += box.elements;
  }
}

Hdf5File::Value read_attribute(hid_t attribute) {
  Handle const type(H5Aget_type(attribute), H5Tclose, "reads an attribute");
  if (H5Tget_class(type) == H5T_STRING) {
    std::string text(H5Tget_size(type), '\0');
    done(H5Aread(attribute, type, text.data()), "reads an attribute");
    text.resize(text.find_last_not_of('\0') + 1);
    return text;
  }
  if (H5Tget_class(type) == H5T_INTEGER) {
    std::int64_t value = 0;
    done(H5Aread(attribute, H5T_NATIVE_INT64, &value), "reads an attribute");
    return value;
  }
  double value = 0;
  done(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "reads an attribute");
  return value;
}

}  // namespace

std::int64_t Hdf5File::Dataset::elements() const {
  std::int64_t n = 1;
  for (std::int64_t const size : shape) n *= size;
  return n;
}

std::int64_t Hdf5File::bytes(Type type) { return type == Type::single ? 4 : 8; }

void Hdf5File::create(std::string const& path) {
  silence();
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepares a file");
  use_checked_format(access);
  done(H5Pset_file_locking(access, false, true), "turns file locks off");
  Handle const creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "prepares a file");
  done(H5Pset_obj_track_times(creation, false), "prepares a file");  // of the root group
  hid_t const file = checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), "cannot create the file");
  done(H5Fclose(file), "cannot write the file");
}

Hdf5File::Hdf5File(std::string const& path, Access mode) {
  silence();
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepares a file");
  use_checked_format(access);
  done(H5Pset_file_locking(access, false, true), "turns file locks off");
  unsigned const flags = mode == Access::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR;
  file_ = checked(H5Fopen(path.c_str(), flags, access), "cannot open the file");
}

Hdf5File::Hdf5File(std::string const& path, void* communicator) {
  silence();
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepares a file");
  use_checked_format(access);
  done(H5Pset_fapl_mpio(access, *static_cast<MPI_Comm*>(communicator), MPI_INFO_NULL), "prepares parallel access");
  file_ = checked(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), "cannot open the file on all ranks");
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::close() {
  hid_t const file = file_;
  file_ = -1;
  done(H5Fclose(file), "cannot write the file");
}

void Hdf5File::add(std::string const& name, Dataset const& dataset) {
  std::vector<hsize_t> const shape(dataset.shape.begin(), dataset.shape.end());
  Handle const space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                     "describes a dataset");
  Handle const creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "prepares a dataset");
  done(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY), "prepares a dataset");
  done(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), "prepares a dataset");
  done(H5Pset_obj_track_times(creation, false), "prepares a dataset");  // equal content, equal bytes
  // Groups are made one by one: those HDF5 adds by itself carry the time of day.
  Handle const group(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "prepares a group");
  done(H5Pset_obj_track_times(group, false), "prepares a group");
  for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    std::string const path = name.substr(0, slash);
    if (H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0) continue;
    Handle const made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, group, H5P_DEFAULT), H5Gclose,
                      "cannot create a group");
  }
  Handle const made(H5Dcreate2(file_, name.c_str(), file_type(dataset.type), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                    H5Dclose, "cannot create a dataset");
}

void Hdf5File::set(std::string const& name, Value const& value) {
  Handle const space(H5Screate(H5S_SCALAR), H5Sclose, "describes an attribute");
  Handle const type(H5Tcopy(H5T_C_S1), H5Tclose, "describes an attribute");
  hid_t kind = std::holds_alternative<double>(value) ? H5T_IEEE_F64LE : H5T_STD_I64LE;
  hid_t memory = std::holds_alternative<double>(value) ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
  void const* data = std::visit([](auto const& v) { return static_cast<void const*>(&v); }, value);
  if (auto const* text = std::get_if<std::string>(&value)) {
    done(H5Tset_size(type, std::max<std::size_t>(1, text->size())), "describes an attribute");
    done(H5Tset_strpad(type, H5T_STR_NULLPAD), "describes an attribute");
    kind = memory = type;
    data = text->c_str();
  }
  Handle const attribute(H5Acreate2(file_, name.c_str(), kind, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "cannot create an attribute");
  done(H5Awrite(attribute, memory, data), "cannot write an attribute");
}

std::map<std::string, Hdf5File::Dataset> Hdf5File::datasets() const {
  std::vector<std::string> names;
  auto const visit = [](hid_t, char const* name, H5O_info_t const* info, void* list) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  done(H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, visit, &names, H5O_INFO_BASIC), "cannot list the datasets");
  std::map<std::string, Dataset> result;
  for (std::string const& name : names)
    result[name] = describe(Handle(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, "cannot open a dataset"));
  return result;
}

std::map<std::string, Hdf5File::Value> Hdf5File::attributes() const {
  std::vector<std::string> names;
  auto const visit = [](hid_t, char const* name, H5A_info_t const*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  done(H5Aiterate2(file_, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names), "cannot list the attributes");
  std::map<std::string, Value> result;
  for (std::string const& name : names)
    result[name] =
        read_attribute(Handle(H5Aopen(file_, name.c_str(), H5P_DEFAULT), H5Aclose, "cannot open an attribute"));
  return result;
}

void Hdf5File::write(std::string const& name, std::int64_t first, std::int64_t count, void const* data) {
  Handle const dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, "cannot open a dataset");
  for_boxes(dataset, first, count, [&](hid_t type, hid_t memory, hid_t file, std::int64_t offset) {
    done(H5Dwrite(dataset, type, memory, file, H5P_DEFAULT, static_cast<std::byte const*>(data) + offset),
         "cannot write rows");
  });
}

void Hdf5File::read(std::string const& name, std::int64_t first, std::int64_t count, void* data) const {
  Handle const dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, "cannot open a dataset");
  for_boxes(dataset, first, count, [&](hid_t type, hid_t memory, hid_t file, std::int64_t offset) {
    done(H5Dread(dataset, type, memory, file, H5P_DEFAULT, static_cast<std::byte*>(data) + offset), "cannot read rows");
  });
}

}  // namespace brisance::parallel
