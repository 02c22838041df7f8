// hdf5_file.hpp: HDF5 files as wedge writes and reads them; the one place that knows the HDF5 library.
//
// A file being written goes to disk dataset by dataset, so that it costs no memory, under the name that a PartFile
// gives. The library keeps bytes back until a dataset or the file is closed: the failure of a close is a failure to
// write. A file that could not be closed (a full disk) stays open inside the library until the program ends; the
// library's own clean-up at exit, which would try again, is switched off. The file format is the oldest the library
// can write (HDF5 1.6 reads it). The library of most systems is not safe to use from several threads: use these
// classes from one thread at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/array.hpp"
#include "io/files/atomic_file.hpp"

namespace wedge {

/// Rows and columns of a dataset; columns = 0 is a 1-D dataset of `rows` numbers.
struct Shape {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t size() const { return columns == 0 ? rows : rows * columns; }
};

/// How numbers lie in a file: as they are in one piece, or in chunks through shuffle and gzip level 1.
enum class Packing { plain, shuffle_gzip };

/// The numbers a file can hold, in memory and in the file.
enum class NumberKind { float64, float32, int64, int32, uint8 };

template <class T>
constexpr NumberKind number_kind() {
  if constexpr (std::is_same_v<T, double>) return NumberKind::float64;
  if constexpr (std::is_same_v<T, float>) return NumberKind::float32;
  if constexpr (std::is_same_v<T, std::int64_t>) return NumberKind::int64;
  if constexpr (std::is_same_v<T, std::int32_t>) return NumberKind::int32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return NumberKind::uint8;
}

/// "1.10.8": the library in use.
std::string hdf5_version();

/// A file being made. Names are full paths in the file ("particles/position"); groups must be made before what they
/// hold. All functions throw FileError.
class Hdf5Writer {
public:
  /// Makes the file part.part_path(). `user_block`: bytes left free (zero) before the HDF5 part, 0 or a power of
  /// two from 512 on.
  explicit Hdf5Writer(const PartFile& part, std::size_t user_block = 0);
  Hdf5Writer(Hdf5Writer&&) noexcept;
  Hdf5Writer& operator=(Hdf5Writer&&) noexcept;
  ~Hdf5Writer();

  void group(const std::string& name);
  /// Attribute of the group or dataset `object` ("/" is the file): a fixed-length ASCII string.
  void attribute(const std::string& object, const std::string& name, std::string_view text);
  void attribute(const std::string& object, const std::string& name, const char* text) {
    attribute(object, name, std::string_view(text));
  }
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, int value) {
    attribute(object, name, static_cast<std::int64_t>(value));
  }
  /// Attribute that is a list of `size` whole numbers.
  void attribute(const std::string& object, const std::string& name, const std::int64_t* values, std::size_t size);

  /// A text of any length, as a dataset that holds one fixed-length UTF-8 string.
  void text(const std::string& name, std::string_view text);
  /// shape.size() numbers, stored as `stored` (double to float rounds to nearest).
  template <class T>
  void write(const std::string& name, const T* data, Shape shape, Packing packing = Packing::plain,
             NumberKind stored = number_kind<T>()) {
    write_numbers(name, data, number_kind<T>(), shape, packing, stored);
  }
  /// `alias` becomes a second name (a hard link) of the object `name`.
  void link(const std::string& name, const std::string& alias);

  /// Ends the file: all bytes are with the system. Nothing may be written afterwards.
  void close();

private:
  void write_numbers(const std::string& name, const void* data, NumberKind memory, Shape shape, Packing packing,
                     NumberKind stored);
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

/// A file being read. All functions throw FileError.
class Hdf5Reader {
public:
  explicit Hdf5Reader(std::string path);
  Hdf5Reader(Hdf5Reader&&) noexcept;
  Hdf5Reader& operator=(Hdf5Reader&&) noexcept;
  ~Hdf5Reader();

  const std::string& path() const;
  bool has(const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  std::string text(const std::string& name) const;
  Shape shape(const std::string& name) const;
  /// Reads shape(name).size() numbers, converted to T. Pre: `data` has room for `expected` numbers; another number
  /// of them in the file is a FileError.
  template <class T>
  void read(const std::string& name, T* data, std::size_t expected) const {
    read_numbers(name, data, number_kind<T>(), expected);
  }
  /// Reads a whole dataset; `data` gets its size.
  template <class T>
  void read(const std::string& name, Array<T>& data) const {
    data.resize(shape(name).size());
    read_numbers(name, data.data(), number_kind<T>(), data.size());
  }

private:
  void read_numbers(const std::string& name, void* data, NumberKind memory, std::size_t expected) const;
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace wedge
