// The memory of this process and of the machine, as reported by the system. It must not know what
// the memory is for.
#pragma once

#include <cstdint>

namespace nephroid {

/// Bytes of the machine's memory, or the limit of this group of processes (cgroup) if that is
/// lower.
uint64_t machine_memory();

/// Bytes of physical memory that the process holds now; 0 if unknown.
uint64_t memory_in_use();

/// The system's memory limit of the process. Has no effect if the system has no limits, or in
/// builds with sanitizers, which need memory of their own.
class MemoryLimit {
 public:
  /// Reads the limit that the user has set, which is never raised.
  MemoryLimit();
  /// Limits the process to `bytes`: allocations beyond throw std::bad_alloc. `to_come` is added for
  /// the stacks of threads that start later, which count in full.
  void set(uint64_t bytes, uint64_t to_come = 0);

 private:
  uint64_t of_user_ = 0;  ///< the user's limit; 0: limits are not possible
};

/// Stack bytes of threads not yet started, for rendering with `threads` (0: one per core).
uint64_t bytes_of_stacks_to_come(int threads);

/// Resets the peak if the system supports it; else the peak stays that of the whole process.
void restart_memory_peak();

/// Peak bytes of physical memory since the last restart_memory_peak(); 0 if unknown.
uint64_t memory_peak();

}  // namespace nephroid
