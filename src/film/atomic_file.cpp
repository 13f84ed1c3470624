// The POSIX recipe: temporary file, fsync, rename, fsync of the directory.
#include "film/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include "core/errors.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
  throw IoError(path + ": cannot " + what + ": " + std::strerror(error));
}

/// The target of `path` with links resolved. Throws IoError if it cannot be a regular file.
fs::path resolved_target(const std::string& path) {
  if (path.empty()) throw IoError("cannot write a file without a name");
  std::error_code error;
  fs::path target(path);
  // The target of a link need not exist yet.
  for (int link = 0; fs::is_symlink(fs::symlink_status(target, error)); ++link) {
    const fs::path next = fs::read_symlink(target, error);
    if (error || link == kMaxLinks) throw IoError(path + ": cannot follow the link");
    target = target.parent_path() / next;
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) throw IoError(path + ": cannot write: it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw IoError(path + ": cannot write: it is not a regular file");
  return target;
}

fs::path directory_of(const fs::path& target) {
  const fs::path parent = target.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// Name prefix of a target's temporary files on this machine. The process id and a counter follow.
std::string temporary_stem(const fs::path& target) {
  char host[65] = {};
  ::gethostname(host, sizeof host - 1);
  return "." + target.filename().string().substr(0, 128) + ".tmp-" +
         std::string(host, ::strnlen(host, 32)) + "@";
}

/// True if a process still writes to a temporary file. Empty if the file system has no locks. (A
/// shared lock does not require a file open for writing, which matters on NFS.)
std::optional<bool> is_held(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  std::optional<bool> held;
  if (::flock(descriptor, LOCK_SH | LOCK_NB) == 0)
    held = false;
  else if (errno == EWOULDBLOCK)
    held = true;
  ::close(descriptor);
  return held;
}

/// True if the process that wrote to the temporary file has ended. Its id alone does not tell: it
/// may be reused after a restart, and ids of other containers are not visible.
bool is_abandoned(const fs::path& path, pid_t process) {
  const bool is_ours = process == ::getpid();
  if (!is_ours && (::kill(process, 0) == 0 || errno != ESRCH)) return false;
  const std::optional<bool> held = is_held(path);
  return held ? !*held : !is_ours;
}

/// Removes temporary files of the target whose processes were killed.
void remove_leftovers(const fs::path& target) {
  const std::string stem = temporary_stem(target);
  std::error_code error;
  for (fs::directory_iterator i(directory_of(target), error), end; !error && i != end;
       i.increment(error)) {
    const std::string name = i->path().filename().string();
    if (name.rfind(stem, 0) != 0) continue;
    pid_t process = 0;
    const char* const digits = name.data() + stem.size();
    const auto [after, wrong] = std::from_chars(digits, name.data() + name.size(), process);
    if (wrong != std::errc() || process <= 0 || *after != '-') continue;
    if (is_abandoned(i->path(), process)) ::unlink(i->path().c_str());
  }
}

/// An open file beside the target, removed at the end unless it was renamed.
class TemporaryFile {
 public:
  /// `shown` is the name for messages: users do not know temporary files.
  TemporaryFile(const fs::path& target, const std::string& shown) : shown_(shown) {
    const fs::path directory = directory_of(target);
    const std::string stem = temporary_stem(target) + std::to_string(::getpid());
    for (int attempt = 0; attempt < 100; ++attempt) {
      path_ = directory / (stem + "-" + std::to_string(attempt));
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0 || errno != EEXIST) break;
    }
    if (descriptor_ < 0) fail(shown_, "write into its directory", errno);
    // Checked by is_abandoned.
    ::flock(descriptor_, LOCK_EX | LOCK_NB);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      // The kernel takes at most 2 GiB at once.
      const size_t chunk = std::min(bytes.size(), size_t{1} << 30);
      const ssize_t written =
          ::pwrite(descriptor_, bytes.data(), chunk, static_cast<off_t>(offset));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(shown_, "write", errno);
      if (written == 0) fail(shown_, "write", ENOSPC);
      bytes = bytes.subspan(written);
      offset += written;
    }
  }
  void rename_to(const fs::path& target) {
    if (::fsync(descriptor_) != 0) fail(shown_, "flush", errno);
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail(shown_, "close", errno);
    if (::rename(path_.c_str(), target.c_str()) != 0) fail(shown_, "replace", errno);
    renamed_ = true;
    flush_directory(directory_of(target));
  }

 private:
  /// Errors are ignored: the rename is done, and some file systems cannot flush a directory.
  static void flush_directory(const fs::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
  }

  std::string shown_;
  fs::path path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

}  // namespace

struct AtomicFile::State {
  explicit State(const std::string& path) : target(resolved_target(path)), file(target, path) {}
  fs::path target;
  TemporaryFile file;
};

AtomicFile::AtomicFile(const std::string& path) : state_(std::make_unique<State>(path)) {}
AtomicFile::~AtomicFile() = default;
void AtomicFile::write(uint64_t offset, std::span<const std::byte> bytes) {
  state_->file.write(offset, bytes);
}
void AtomicFile::commit() {
  state_->file.rename_to(state_->target);
}

void write_file_atomically(const std::string& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(0, bytes);
  file.commit();
}

void check_file_can_be_written(const std::string& path) {
  const fs::path target = resolved_target(path);
  remove_leftovers(target);
  const TemporaryFile probe(target, path);
}

}  // namespace nephroid
