// Linux reports memory in /proc (proc(5)); writing 5 to clear_refs resets the peak. A limit on data
// segments (setrlimit(2)) counts reserved memory, which is more than what is held, so the
// difference is added to the limit.
#include "session/process_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "input/exr_header.h"

namespace nephroid {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanLimit = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kCanLimit = false;
#else
constexpr bool kCanLimit = true;
#endif
#else
constexpr bool kCanLimit = true;
#endif

/// The number in a line "Key:   123" of this process's status; 0 if there is none.
uint64_t status_number(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return std::stoull(line.substr(key.size()));
  return 0;
}

/// The bytes in a line "Key:   123 kB" of this process's status.
uint64_t status_bytes(const std::string& key) {
  return status_number(key) * 1024;
}

}  // namespace

uint64_t machine_memory() {
  uint64_t bytes = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE);
  const auto obey = [&](const std::filesystem::path& file) {
    uint64_t limit = 0;  // "max" is not a number
    if (std::ifstream(file) >> limit && limit > 0) bytes = std::min(bytes, limit);
  };
  // "0::/a/b" in cgroup version 2, "7:memory:/a/b" in version 1. Inside a container the path may
  // differ from the mounted one.
  obey("/sys/fs/cgroup/memory.max");
  obey("/sys/fs/cgroup/memory/memory.limit_in_bytes");
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const bool is_second = line.starts_with("0::");
    const size_t begin = line.find(":memory:");
    if (!is_second && begin == std::string::npos) continue;
    std::filesystem::path group = line.substr(is_second ? 3 : begin + 8);
    for (; group.has_relative_path(); group = group.parent_path())
      obey((is_second ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory") + group.string() +
           (is_second ? "/memory.max" : "/memory.limit_in_bytes"));
  }
  return bytes;
}

uint64_t memory_in_use() {
  return status_bytes("VmRSS:");
}

uint64_t bytes_of_stacks_to_come(int threads) {
  rlimit stack{};
  const bool is_known = ::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
  constexpr uint64_t kDefault = uint64_t{8} << 20;
  const uint64_t of_each =
      threads > 0 ? static_cast<uint64_t>(threads) : std::thread::hardware_concurrency();
  // Threads that render, threads of both image libraries, and this thread.
  const uint64_t of_images = std::min<uint64_t>(of_each, kMaxImageThreads);
  const uint64_t in_all = of_each + 2 * of_images + 1, started = status_number("Threads:");
  return in_all <= started ? 0
                           : (is_known ? uint64_t{stack.rlim_cur} : kDefault) * (in_all - started);
}

MemoryLimit::MemoryLimit() {
  rlimit limit{};
  if (kCanLimit && ::getrlimit(RLIMIT_DATA, &limit) == 0) of_user_ = limit.rlim_cur;
}

void MemoryLimit::set(uint64_t bytes, uint64_t to_come) {
  const uint64_t held = memory_in_use(), reserved = status_bytes("VmData:");
  rlimit limit{};
  if (of_user_ == 0 || held == 0 || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const uint64_t wanted = reserved + to_come + (bytes > held ? bytes - held : 0);
  limit.rlim_cur = std::min<rlim_t>(wanted, of_user_);
  ::setrlimit(RLIMIT_DATA, &limit);
}

void restart_memory_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

uint64_t memory_peak() {
  return status_bytes("VmHWM:");
}

}  // namespace nephroid
