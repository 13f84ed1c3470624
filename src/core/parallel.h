// Loops over ranges on several threads. The chunks of a loop depend on its arguments alone, never
// on the number of threads, so that results which are kept per chunk are the same on any machine.
// The .cpp is the only file that includes a threading library.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace nephroid {

/// Number of threads that parallel loops use.
int thread_count();

/// Limits the threads of parallel loops for as long as it lives; 0 means all of the machine.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Calls body(chunk, begin, end) for the chunks [0, chunk_size), [chunk_size, 2*chunk_size), ... of
/// [0, count), in any order and on any thread, with flush-to-zero arithmetic. Returns when all are
/// done.
void parallel_chunks(int64_t count, int64_t chunk_size,
                     const std::function<void(int64_t chunk, int64_t begin, int64_t end)>& body);

/// Number of chunks of such a loop.
constexpr int64_t chunk_count(int64_t count, int64_t chunk_size) {
  return (count + chunk_size - 1) / chunk_size;
}

}  // namespace nephroid
