#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#if defined(__SSE__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#ifndef NEPHROID_STD_THREADS
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace nephroid {

namespace {

// Flushes denormal numbers to zero within a scope: a hundred times faster where they occur, and the
// same on every thread. The caller's mode is restored.
class FlushToZero {
 public:
#if defined(__SSE__)
  FlushToZero() : saved_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushToZero() {
    _mm_setcsr(saved_);
  }

 private:
  unsigned saved_;
#else
  FlushToZero() {}
#endif
};

}  // namespace

#ifdef NEPHROID_STD_THREADS

namespace {
std::atomic<int> limit{0};
}

struct ThreadLimit::Impl {
  int previous = 0;
};

ThreadLimit::ThreadLimit(int threads) : impl_(std::make_unique<Impl>()) {
  impl_->previous = limit.exchange(threads);
}
ThreadLimit::~ThreadLimit() {
  limit = impl_->previous;
}

int thread_count() {
  const int n = limit;
  return n > 0 ? n : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

namespace {

/// Runs `work` on `count` threads, including the caller's.
void on_threads(int64_t count, const std::function<void()>& work) {
  std::vector<std::thread> threads;
  for (int64_t i = 1; i < count; ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
}

}  // namespace

void parallel_chunks(int64_t count, int64_t chunk_size,
                     const std::function<void(int64_t, int64_t, int64_t)>& body) {
  parallel_chunks(unwatched, count, chunk_size, body);
}

#else

struct ThreadLimit::Impl {
  std::unique_ptr<tbb::global_control> control;
};

ThreadLimit::ThreadLimit(int threads) : impl_(std::make_unique<Impl>()) {
  if (threads > 0)
    impl_->control = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, threads);
}
ThreadLimit::~ThreadLimit() = default;

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

namespace {

/// Runs `loop` in an arena with room for all threads: the implicit one has a slot per core.
template <class Loop>
void in_arena(Loop&& loop) {
  if (thread_count() > tbb::this_task_arena::max_concurrency())
    tbb::task_arena(thread_count()).execute(loop);
  else
    loop();
}

void on_threads(int64_t count, const std::function<void()>& work) {
  in_arena([&] {
    tbb::parallel_for(
        tbb::blocked_range<int64_t>(0, count, 1),
        [&](const tbb::blocked_range<int64_t>&) { work(); }, tbb::simple_partitioner());
  });
}

}  // namespace

void parallel_chunks(int64_t count, int64_t chunk_size,
                     const std::function<void(int64_t, int64_t, int64_t)>& body) {
  in_arena([&] {
    tbb::parallel_for(
        tbb::blocked_range<int64_t>(0, chunk_count(count, chunk_size), 1),
        [&](const tbb::blocked_range<int64_t>& range) {
          const FlushToZero scope;
          for (int64_t c = range.begin(); c < range.end(); ++c)
            body(c, c * chunk_size, std::min(count, (c + 1) * chunk_size));
        },
        tbb::simple_partitioner());
  });
}

#endif

void parallel_chunks(PassControl& control, int64_t count, int64_t chunk_size,
                     const std::function<void(int64_t, int64_t, int64_t)>& body) {
  const int64_t chunks = chunk_count(count, chunk_size);
  std::atomic<int64_t> next{0};
  const auto work = [&] {
    const FlushToZero scope;
    do {
      const int64_t c = next++;
      if (c >= chunks) return;
      body(c, c * chunk_size, std::min(count, (c + 1) * chunk_size));
    } while (!control.is_wanted());
  };
  while (next < chunks) {
    on_threads(std::min<int64_t>(thread_count(), chunks - next), work);
    if (next < chunks) control.attend();
  }
}

}  // namespace nephroid
