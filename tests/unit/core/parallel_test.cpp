// Parallel loops: each chunk runs once, chunks do not depend on the number of threads, and
// denormals are flushed.
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace nephroid {
namespace {

TEST(Parallel, EveryIndexOnceForAnyThreadCount) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(thread_count(), threads);
    std::vector<std::atomic<int>> seen(1000);
    std::vector<int64_t> chunk_begin(chunk_count(1000, 64), -1);
    parallel_chunks(1000, 64, [&](int64_t chunk, int64_t begin, int64_t end) {
      chunk_begin[static_cast<size_t>(chunk)] = begin;
      for (int64_t i = begin; i < end; ++i) ++seen[static_cast<size_t>(i)];
    });
    for (const auto& n : seen) EXPECT_EQ(n, 1);
    for (size_t c = 0; c < chunk_begin.size(); ++c)
      EXPECT_EQ(chunk_begin[c], static_cast<int64_t>(c) * 64);
  }
}

TEST(Parallel, NothingToDo) {
  parallel_chunks(0, 16, [](int64_t, int64_t, int64_t) { ADD_FAILURE(); });
}

/// Always wants attention, and throws at a given call.
class Watch final : public PassControl {
 public:
  explicit Watch(int last) : last_(last) {}
  bool is_wanted() const noexcept override { return true; }
  void attend() override {
    EXPECT_EQ(running, 0);
    if (++looks == last_) throw PassStopped{};
  }
  std::atomic<int> running{0};
  int looks = 0;

 private:
  int last_;
};

TEST(Parallel, AWatchedLoopIsLookedInOnBetweenChunks) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    Watch watch(0);
    std::vector<std::atomic<int>> seen(1000);
    parallel_chunks(watch, 1000, 10, [&](int64_t, int64_t begin, int64_t end) {
      ++watch.running;
      for (int64_t i = begin; i < end; ++i) ++seen[static_cast<size_t>(i)];
      --watch.running;
    });
    for (const auto& n : seen) EXPECT_EQ(n, 1);
    EXPECT_GE(watch.looks, 99 / threads);
    EXPECT_LE(watch.looks, 99);
  }
}

TEST(Parallel, AWatchedLoopEndsWithWholeChunks) {
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    Watch watch(4);
    std::vector<std::atomic<int>> seen(1000);
    EXPECT_THROW(parallel_chunks(watch, 1000, 10,
                                 [&](int64_t, int64_t begin, int64_t end) {
                                   for (int64_t i = begin; i < end; ++i)
                                     ++seen[static_cast<size_t>(i)];
                                 }),
                 PassStopped);
    int done = 0;
    for (size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i], seen[i / 10 * 10]);
      done += seen[i];
    }
    EXPECT_GE(done, 40);
    EXPECT_LE(done, 40 * threads);
  }
}

TEST(Parallel, DenormalsAreZeroInsideAndTheModeIsPutBack) {
#if defined(__SSE__)
  volatile float tiny = 1e-38f;
  std::atomic<bool> flushed{true};
  parallel_chunks(64, 1, [&](int64_t, int64_t, int64_t) {
    if (tiny * 0.01f != 0.0f) flushed = false;
  });
  EXPECT_TRUE(flushed);
  EXPECT_NE(tiny * 0.01f, 0.0f);
#endif
}

}  // namespace
}  // namespace nephroid
