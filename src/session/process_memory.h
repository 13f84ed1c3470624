// The memory of this process and of the machine, as the system counts it. It must not know what the
// memory is for.
#pragma once

#include <cstdint>

namespace nephroid {

/// Bytes that this machine has, or that it lets this group of processes have (cgroup), if less.
uint64_t machine_memory();

/// Bytes of physical memory that the process holds now; 0 if the system does not tell.
uint64_t memory_in_use();

/// The system's limit on the process. Does nothing where the system has none, and in builds with
/// sanitizers, which need memory of their own.
class MemoryLimit {
 public:
  /// Remembers the limit that the user has set, which is never raised.
  MemoryLimit();
  /// From now on the process cannot hold more than `bytes`: allocations beyond throw
  /// std::bad_alloc. The stacks of threads that start later count in full, so `to_come` is given
  /// beyond.
  void set(uint64_t bytes, uint64_t to_come = 0);

 private:
  uint64_t of_user_ = 0;  ///< 0: there is no way to limit
};

/// Of the stacks of the threads that are still to be started for rendering with so many; 0: with
/// all of the machine.
uint64_t bytes_of_stacks_to_come(int threads);

/// Starts a new peak, where the system can do that; else the peak stays that of the whole process.
void restart_memory_peak();

/// Bytes of physical memory held at most since the last restart; 0 if the system does not tell.
uint64_t memory_peak();

}  // namespace nephroid
