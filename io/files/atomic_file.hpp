// atomic_file.hpp: files that are there whole or not at all, and errors of files that name path and cause.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace wedge {

/// A stretch of memory to be written.
struct Bytes {
  const void* data = nullptr;
  std::size_t size = 0;
};

/// Throws FileError "PATH: WHAT: CAUSE"; the cause is the text of `error_number` (an errno), left out when it is 0.
[[noreturn]] void throw_file_error(const std::string& path, const std::string& what, int error_number = 0);

/// Folder that holds `path`, "." for a bare name.
std::string parent_folder(const std::string& path);

/// A file in the making: written under another name, PATH.part, until commit() puts it in its place.
class PartFile {
public:
  explicit PartFile(std::string path) : path_(std::move(path)) {}
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  /// Removes PATH.part unless it was committed.
  ~PartFile();

  const std::string& path() const { return path_; }
  /// Where to write.
  std::string part_path() const { return path_ + ".part"; }
  /// Syncs PATH.part, renames it, syncs the folder. Throws FileError. Pre: PATH.part is written and closed.
  void commit();

private:
  std::string path_;
  bool committed_ = false;
};

/// Replaces (or makes) the file `path` by the parts, one after the other, by way of a PartFile. Post: `path` holds
/// the new content, or FileError was thrown and `path` is as before and PATH.part is gone.
void replace_file(const std::string& path, std::initializer_list<Bytes> parts);

/// replace_file with a text.
void write_text_file_atomically(const std::string& path, std::string_view text);

/// The whole file, byte for byte. Throws FileError.
std::string read_text_file(const std::string& path);

}  // namespace wedge
