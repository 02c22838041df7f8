// hdf5_file.cpp: handles of the HDF5 C library that close themselves, and its failures as FileError.
#include "io/files/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"

namespace wedge {
namespace {

constexpr std::size_t largest_attribute = 65536;  // bytes, the library's own limit
constexpr std::uintmax_t largest_packing = 1100;  // deflate packs 1032 bytes into one at best
constexpr std::size_t chunk_bytes = std::size_t{1}
                                    << 20;  // upper bound of a chunk, the library's default chunk cache

/// A handle and the function that closes it.
class Handle {
public:
  Handle() = default;
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0 && close_ != nullptr) close_(id_);
  }
  hid_t get() const { return id_; }
  /// Closes now; negative when the library could not write what it had kept back.
  herr_t close() { return close_(std::exchange(id_, -1)); }

private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// What the library noted where the failure began; for a failed read or write the system's own words.
std::string library_cause() {
  std::string cause = "unknown cause";
  const auto innermost = [](unsigned depth, const H5E_error2_t* error, void* text) -> herr_t {
    if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &cause);
  const std::string mark = "error message = '";  // H5FDsec2.c
  const std::size_t begin = cause.find(mark);
  if (begin == std::string::npos) return cause;
  return cause.substr(begin + mark.size(), cause.find('\'', begin + mark.size()) - begin - mark.size());
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw FileError(path + ": " + what + ": " + library_cause());
}

/// Passes on the result of a call of the library, or throws.
template <class Result>
Result check(Result result, const std::string& path, const std::string& what) {
  if (result < 0) fail(path, what);
  return result;
}

/// To be called before anything else of the library: no messages of its own, no clean-up at exit.
void tame_library() {
  static const bool once = H5dont_atexit() >= 0;
  static_cast<void>(once);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

hid_t type_of(NumberKind kind) {
  switch (kind) {
    case NumberKind::float64:
      return H5T_NATIVE_DOUBLE;
    case NumberKind::float32:
      return H5T_NATIVE_FLOAT;
    case NumberKind::int64:
      return H5T_NATIVE_INT64;
    case NumberKind::int32:
      return H5T_NATIVE_INT32;
    case NumberKind::uint8:
      return H5T_NATIVE_UINT8;
  }
  require(false, "a kind of number without an HDF5 type");
  return -1;
}

/// Little-endian in the file, whatever the machine.
hid_t stored_type_of(NumberKind kind) {
  switch (kind) {
    case NumberKind::float64:
      return H5T_IEEE_F64LE;
    case NumberKind::float32:
      return H5T_IEEE_F32LE;
    case NumberKind::int64:
      return H5T_STD_I64LE;
    case NumberKind::int32:
      return H5T_STD_I32LE;
    case NumberKind::uint8:
      return H5T_STD_U8LE;
  }
  require(false, "a kind of number without an HDF5 type");
  return -1;
}

/// Type of one string of `size` bytes (at least one: HDF5 knows no empty string), filled up with zeros.
Handle string_type(std::size_t size, H5T_cset_t characters) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(size, 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), characters);
  return type;
}

/// Text without the zeros that fill it up.
std::string unpadded(std::string text) {
  text.erase(text.find_last_not_of('\0') + 1);
  return text;
}

/// How a dataset is made: without the time of day, so that the same data are the same bytes.
Handle dataset_creation() {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  return creation;
}

std::string attribute_name(const std::string& object, const std::string& name) {
  return "attribute '" + name + "' of '" + object + "'";
}

}  // namespace

std::string hdf5_version() {
  tame_library();
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

// ---- writing

struct Hdf5Writer::Implementation {
  std::string path;  // in messages
  Handle file;
};

Hdf5Writer::Hdf5Writer(const PartFile& part, std::size_t user_block) : self_(std::make_unique<Implementation>()) {
  tame_library();
  self_->path = part.path();
  std::FILE* probe = std::fopen(part.part_path().c_str(), "wbe");  // for the system's own word on why not
  if (probe == nullptr) throw_file_error(self_->path, "cannot write", errno);
  std::fclose(probe);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), self_->path,
        "cannot set the format");
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  check(H5Pset_userblock(creation.get(), user_block), self_->path, "cannot set the user block");
  self_->file = Handle(H5Fcreate(part.part_path().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  check(self_->file.get(), self_->path, "cannot write");
}
Hdf5Writer::Hdf5Writer(Hdf5Writer&&) noexcept = default;
Hdf5Writer& Hdf5Writer::operator=(Hdf5Writer&&) noexcept = default;
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::group(const std::string& name) {
  const Handle made(H5Gcreate2(self_->file.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(made.get(), self_->path, "cannot make the group '" + name + "'");
}

namespace {

void write_attribute(hid_t file, const std::string& path, const std::string& object, const std::string& name,
                     std::array<hid_t, 3> stored_memory_space, const void* data) {
  const auto [stored, memory, space] = stored_memory_space;
  const Handle made(
      H5Acreate_by_name(file, object.c_str(), name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  check(made.get(), path, "cannot make the " + attribute_name(object, name));
  check(H5Awrite(made.get(), memory, data), path, "cannot write the " + attribute_name(object, name));
}

}  // namespace

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::string_view text) {
  const Handle type = string_type(text.size(), H5T_CSET_ASCII);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  write_attribute(self_->file.get(), self_->path, object, name, {type.get(), type.get(), space.get()},
                  padded.data());
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  write_attribute(self_->file.get(), self_->path, object, name, {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get()},
                  &value);
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  write_attribute(self_->file.get(), self_->path, object, name, {H5T_STD_I64LE, H5T_NATIVE_INT64, space.get()},
                  &value);
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::int64_t* values,
                           std::size_t size) {
  const hsize_t extent = size;
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  write_attribute(self_->file.get(), self_->path, object, name, {H5T_STD_I64LE, H5T_NATIVE_INT64, space.get()},
                  values);
}

namespace {

/// Fills a dataset and closes it, which may be what writes it.
void fill(Handle dataset, hid_t memory, const void* data, const std::string& path) {
  check(H5Dwrite(dataset.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path, "cannot write");
  check(dataset.close(), path, "cannot write");
}

}  // namespace

void Hdf5Writer::text(const std::string& name, std::string_view text) {
  const Handle type = string_type(text.size(), H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle creation = dataset_creation();
  Handle made(H5Dcreate2(self_->file.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, creation.get(),
                         H5P_DEFAULT),
              H5Dclose);
  check(made.get(), self_->path, "cannot make the dataset '" + name + "'");
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  fill(std::move(made), type.get(), padded.data(), self_->path);
}

void Hdf5Writer::write_numbers(const std::string& name, const void* data, NumberKind memory, Shape shape,
                               Packing packing, NumberKind stored) {
  const int rank = shape.columns == 0 ? 1 : 2;
  const hsize_t extent[2] = {shape.rows, shape.columns};
  const Handle space(H5Screate_simple(rank, extent, nullptr), H5Sclose);
  const Handle creation = dataset_creation();
  if (packing == Packing::shuffle_gzip && shape.size() > 0) {
    const std::size_t columns = std::max<std::size_t>(shape.columns, 1);
    const std::size_t row_bytes = columns * H5Tget_size(stored_type_of(stored));
    const hsize_t chunk[2] = {std::min(shape.rows, std::max<std::size_t>(chunk_bytes / row_bytes, 1)), columns};
    H5Pset_chunk(creation.get(), rank, chunk);
    H5Pset_shuffle(creation.get());
    check(H5Pset_deflate(creation.get(), 1), self_->path, "cannot compress");
  }
  Handle made(H5Dcreate2(self_->file.get(), name.c_str(), stored_type_of(stored), space.get(), H5P_DEFAULT,
                         creation.get(), H5P_DEFAULT),
              H5Dclose);
  check(made.get(), self_->path, "cannot make the dataset '" + name + "'");
  if (shape.size() == 0) return;
  fill(std::move(made), type_of(memory), data, self_->path);
}

void Hdf5Writer::link(const std::string& name, const std::string& alias) {
  check(H5Lcreate_hard(self_->file.get(), name.c_str(), self_->file.get(), alias.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        self_->path, "cannot link '" + alias + "' to '" + name + "'");
}

void Hdf5Writer::close() {
  check(H5Fflush(self_->file.get(), H5F_SCOPE_GLOBAL), self_->path, "cannot write");
  check(self_->file.close(), self_->path, "cannot write");
}

// ---- reading

struct Hdf5Reader::Implementation {
  std::string path;
  Handle file;
  std::uintmax_t file_size = 0;  // bytes

  /// Throws unless `count` numbers of `bytes` each can be what the dataset holds on disk: a damaged length must not
  /// become a request for memory.
  void check_size(const std::string& name, hid_t dataset, std::uintmax_t count, std::size_t bytes) const {
    const std::uintmax_t stored = H5Dget_storage_size(dataset);
    if (stored <= file_size && count <= largest_packing * stored / std::max<std::size_t>(bytes, 1)) return;
    throw_file_error(path, "dataset '" + name + "' is damaged: it claims to be larger than its file can hold");
  }

  Handle open_attribute(const std::string& object, const std::string& name) const {
    Handle opened(H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (opened.get() < 0) fail(path, "cannot find the " + attribute_name(object, name));
    const Handle space(H5Aget_space(opened.get()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.get()) != 1) {
      throw_file_error(path, attribute_name(object, name) + " is not one value");
    }
    return opened;
  }
  Handle open_dataset(const std::string& name) const {
    Handle opened(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (opened.get() < 0) fail(path, "cannot find the dataset '" + name + "'");
    return opened;
  }
};

Hdf5Reader::Hdf5Reader(std::string path) : self_(std::make_unique<Implementation>()) {
  tame_library();
  self_->path = std::move(path);
  std::FILE* probe = std::fopen(self_->path.c_str(), "rbe");  // for the system's own word on why not
  if (probe == nullptr) throw_file_error(self_->path, "cannot open", errno);
  std::fclose(probe);
  if (H5Fis_hdf5(self_->path.c_str()) <= 0) throw_file_error(self_->path, "is not an HDF5 file, or is cut short");
  self_->file = Handle(H5Fopen(self_->path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  check(self_->file.get(), self_->path, "cannot open");
  std::error_code ignored;
  self_->file_size = std::filesystem::file_size(self_->path, ignored);
}
Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;
Hdf5Reader& Hdf5Reader::operator=(Hdf5Reader&&) noexcept = default;
Hdf5Reader::~Hdf5Reader() = default;

const std::string& Hdf5Reader::path() const { return self_->path; }

bool Hdf5Reader::has(const std::string& name) const {
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    if (H5Lexists(self_->file.get(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute = self_->open_attribute(object, name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0) {
    throw_file_error(self_->path, attribute_name(object, name) + " is not a text of fixed length");
  }
  if (H5Tget_size(type.get()) > largest_attribute)
    throw_file_error(self_->path, attribute_name(object, name) + " is too long to be true");
  std::string text(H5Tget_size(type.get()), '\0');
  check(H5Aread(attribute.get(), type.get(), text.data()), self_->path,
        "cannot read the " + attribute_name(object, name));
  return unpadded(std::move(text));
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& name) const {
  double value = 0;
  check(H5Aread(self_->open_attribute(object, name).get(), H5T_NATIVE_DOUBLE, &value), self_->path,
        "cannot read the " + attribute_name(object, name));
  return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  check(H5Aread(self_->open_attribute(object, name).get(), H5T_NATIVE_INT64, &value), self_->path,
        "cannot read the " + attribute_name(object, name));
  return value;
}

std::string Hdf5Reader::text(const std::string& name) const {
  const Handle dataset = self_->open_dataset(name);
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw_file_error(self_->path, "dataset '" + name + "' is not a text of fixed length");
  }
  self_->check_size(name, dataset.get(), 1, H5Tget_size(type.get()));
  std::string text(H5Tget_size(type.get()), '\0');
  check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), self_->path,
        "cannot read the dataset '" + name + "'");
  return unpadded(std::move(text));
}

Shape Hdf5Reader::shape(const std::string& name) const {
  const Handle dataset = self_->open_dataset(name);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1 || rank > 2) throw_file_error(self_->path, "dataset '" + name + "' is neither a list nor a table");
  hsize_t extent[2] = {0, 0};
  H5Sget_simple_extent_dims(space.get(), extent, nullptr);
  if (rank == 2 && extent[1] == 0) extent[0] = 0;  // columns = 0 would mean a list
  const hsize_t columns = std::max<hsize_t>(extent[1], 1);
  if (extent[0] > std::numeric_limits<std::uint32_t>::max() || columns > std::numeric_limits<std::uint32_t>::max())
    throw_file_error(self_->path, "dataset '" + name + "' is damaged: it is too large to be true");
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  if (extent[0] > 0) self_->check_size(name, dataset.get(), extent[0] * columns, H5Tget_size(type.get()));
  return {extent[0], extent[1]};
}

void Hdf5Reader::read_numbers(const std::string& name, void* data, NumberKind memory, std::size_t expected) const {
  const std::size_t size = shape(name).size();
  if (size != expected) {
    throw_file_error(self_->path, "dataset '" + name + "' has " + std::to_string(size) + " numbers, expected " +
                                      std::to_string(expected));
  }
  if (size == 0) return;
  check(H5Dread(self_->open_dataset(name).get(), type_of(memory), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), self_->path,
        "cannot read the dataset '" + name + "'");
}

}  // namespace wedge
