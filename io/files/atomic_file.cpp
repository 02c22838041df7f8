// atomic_file.cpp: write under another name, sync, close, rename, sync the folder.
#include "io/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/require.hpp"

namespace wedge {
namespace {

constexpr std::size_t largest_write = std::size_t{1} << 30;  // bytes; one write(2) takes at most 2 GiB

/// A file descriptor that closes itself.
class Descriptor {
public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  /// Closes now. Returns the errno of a failed close, 0 otherwise.
  int close() {
    const int result = ::close(fd_);
    fd_ = -1;
    return result == 0 ? 0 : errno;
  }

private:
  int fd_;
};

/// Writes all parts. Returns an errno, 0 when all went well.
int write_all(int fd, std::initializer_list<Bytes> parts) {
  for (const Bytes& part : parts) {
    const char* next = static_cast<const char*>(part.data);
    std::size_t left = part.size;
    while (left > 0) {
      const ssize_t written = ::write(fd, next, std::min(left, largest_write));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      if (written == 0) return ENOSPC;
      next += written;
      left -= static_cast<std::size_t>(written);
    }
  }
  return 0;
}

/// Syncs a folder so that a rename in it survives a power cut. Some network file systems cannot (EINVAL): no error.
void sync_folder(const std::string& folder) {
  Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() < 0) throw_file_error(folder, "cannot open the folder", errno);
  if (::fsync(directory.get()) != 0 && errno != EINVAL && errno != ENOTSUP) {
    throw_file_error(folder, "cannot sync the folder", errno);
  }
}

}  // namespace

void throw_file_error(const std::string& path, const std::string& what, int error_number) {
  std::string message = path + ": " + what;
  if (error_number != 0) message += ": " + std::generic_category().message(error_number);
  throw FileError(message);
}

std::string parent_folder(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

PartFile::~PartFile() {
  if (committed_) return;
  // Emptied first: somebody may hold it open, and the disk may be full.
  if (::truncate(part_path().c_str(), 0) == 0) ::unlink(part_path().c_str());
}

void PartFile::commit() {
  const std::string part = part_path();
  Descriptor file(::open(part.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw_file_error(path_, "cannot write", errno);
  if (::fsync(file.get()) != 0) throw_file_error(path_, "cannot write", errno);
  if (std::rename(part.c_str(), path_.c_str()) != 0) throw_file_error(path_, "cannot write", errno);
  committed_ = true;
  sync_folder(parent_folder(path_));
}

void replace_file(const std::string& path, std::initializer_list<Bytes> parts) {
  PartFile part(path);
  {
    Descriptor file(::open(part.part_path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) throw_file_error(path, "cannot write", errno);
    int error = write_all(file.get(), parts);
    const int close_error = file.close();
    if (error == 0) error = close_error;
    if (error != 0) throw_file_error(path, "cannot write", error);
  }
  part.commit();
}

void write_text_file_atomically(const std::string& path, std::string_view text) {
  replace_file(path, {{text.data(), text.size()}});
}

std::string read_text_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw_file_error(path, "cannot open", errno);
  std::string text;
  struct stat status {};
  if (::fstat(file.get(), &status) == 0 && status.st_size > 0)
    text.reserve(static_cast<std::size_t>(status.st_size));
  std::string buffer(std::size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t got = ::read(file.get(), buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_file_error(path, "cannot read", errno);
    if (got == 0) return text;
    text.append(buffer, 0, static_cast<std::size_t>(got));
  }
}

}  // namespace wedge
