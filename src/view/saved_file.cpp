#include "view/saved_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/errors.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxBytesAtOnce = size_t{1} << 30;  ///< the system writes less than 2 GiB at once

[[noreturn]] void fail(const fs::path& path) {
  throw IoError(path.string() + ": cannot write: " + std::strerror(errno));
}

/// "a.exr", then "a-2.exr", "a-3.exr".
fs::path numbered(const std::string& directory, const fs::path& name, int number) {
  if (number == 1) return directory / name;
  return fs::path(directory) /
         fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string());
}

/// A new file, open for writing. Its path is set to the first one that is free.
int open_new(const std::string& directory, const std::string& name, fs::path* path) {
  for (int number = 1;; ++number) {
    *path = numbered(directory, name, number);
    // Fails if anything has that name, and does not follow links.
    const int file = ::open(path->c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) return file;
    if (errno != EEXIST) fail(*path);
  }
}

/// False with the reason in errno.
bool write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), std::min(bytes.size(), kMaxBytesAtOnce));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
  return true;
}

}  // namespace

std::string save_new_file(const std::string& directory, const std::string& name,
                          std::span<const std::byte> bytes) {
  fs::path path;
  const int file = open_new(directory, name, &path);
  const bool is_written = write_all(file, bytes);
  int error = is_written ? 0 : errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return path.string();
  ::unlink(path.c_str());
  errno = error;
  fail(path);
}

}  // namespace nephroid
