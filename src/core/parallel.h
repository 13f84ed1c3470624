// Parallel loops over ranges. The chunks of a loop depend on its arguments alone, never on the
// number of threads, so results per chunk are the same on any machine. The .cpp is the only file
// that includes a threading library.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/pass_control.h"

namespace nephroid {

/// Number of threads that parallel loops use.
int thread_count();

/// Limits the threads of parallel loops during its lifetime; 0: one per core.
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

/// The same, roughly in order. `control` is asked between chunks; at least one chunk is done
/// between two calls of attend(). Passes on exceptions of attend(); no chunk is unfinished then.
void parallel_chunks(PassControl& control, int64_t count, int64_t chunk_size,
                     const std::function<void(int64_t chunk, int64_t begin, int64_t end)>& body);

/// Number of chunks of such a loop.
constexpr int64_t chunk_count(int64_t count, int64_t chunk_size) {
  return (count + chunk_size - 1) / chunk_size;
}

/// Runs work(result, begin, end) for the same chunks, each with its own T. Returns the results in
/// the order of the chunks.
template <class T, class Work>
std::vector<T> chunk_results(PassControl& control, int64_t count, int64_t chunk_size, Work&& work) {
  std::vector<T> results(chunk_count(count, chunk_size));
  parallel_chunks(control, count, chunk_size, [&](int64_t chunk, int64_t begin, int64_t end) {
    work(results[chunk], begin, end);
  });
  return results;
}

/// The same, then calls append(T&&) with each result, in order, on this thread. So the result does
/// not depend on the number of threads.
template <class T, class Work, class Append>
void ordered_reduce(PassControl& control, int64_t count, int64_t chunk_size, Work&& work,
                    Append&& append) {
  for (T& result : chunk_results<T>(control, count, chunk_size, std::forward<Work>(work)))
    append(std::move(result));
}

}  // namespace nephroid
