// --memory is kept, or the render is refused before it starts.
#include <gtest/gtest.h>

#include "regression/program.h"
#include "regression/scene_folder.h"
#include "source_directory.h"

namespace nephroid::testing_support {
namespace {

const std::string kCausticRoom = source_directory() + "/scenes/caustic-room/scene.pbrt";

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsLarge = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kIsLarge = true;
#else
constexpr bool kIsLarge = false;
#endif
#else
constexpr bool kIsLarge = false;
#endif

class MemoryLimit : public ::testing::TestWithParam<const char*> {};

TEST_P(MemoryLimit, IsKept) {
  if (kIsLarge) GTEST_SKIP() << "sanitizers take memory of their own";
  const testing::TemporaryDirectory folder;
  const ProgramRun run =
      run_program(folder.path(), {"render", kCausticRoom, "--memory", "320M", "--resolution",
                                  "240x160", "--passes", "2", "-t", "2", "--integrator", GetParam(),
                                  "-o", "picture.exr", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_LT(run.peak_memory, uint64_t{320} << 20);
}

TEST_P(MemoryLimit, IsRefusedBeforeItStarts) {
  const testing::TemporaryDirectory folder;
  const ProgramRun run =
      run_program(folder.path(), {"render", kCausticRoom, "--memory", "320M", "--resolution",
                                  "2400x1600", "--passes", "2", "-t", "2", "--integrator",
                                  GetParam(), "-o", "picture.exr", "--quiet"});
  EXPECT_EQ(run.status, kUsage) << run.errors;
  EXPECT_NE(run.errors.find("nephroid: error: --memory: 3840000 pixels (2400 x 1600) need about "),
            std::string::npos)
      << run.errors;
  EXPECT_EQ(names_in(folder.path()).count("picture.exr"), 0u);
}

INSTANTIATE_TEST_SUITE_P(Integrators, MemoryLimit,
                         ::testing::Values("mixed", "path", "sppm", "ppm", "photonmap", "vcm",
                                           "mlt"));

// Each thread has a stack, and each thread of the encoder has buffers of whole rows. What fits is
// rendered and written; anything larger is refused before it starts.
TEST(MemoryLimitOption, ManyThreadsAndWidePicturesAreCounted) {
  if (kIsLarge) GTEST_SKIP() << "sanitizers take memory of their own";
  const testing::TemporaryDirectory folder;
  folder.write("scene.pbrt", kHead + kTriangle);
  const auto status = [&](const char* threads, const char* memory, const char* resolution) {
    const ProgramRun run =
        run_program(folder.path(), {"render", "scene.pbrt", "--integrator", "path", "--passes", "2",
                                    "--checkpoint", "0.01s", "-t", threads, "--memory", memory,
                                    "--resolution", resolution, "--quiet"});
    const bool is_refused = run.errors.find("need about") != std::string::npos;
    EXPECT_EQ(run.status, is_refused ? kUsage : 0)
        << threads << " threads, " << memory << ", " << resolution << ": " << run.signal << ' '
        << run.errors;
    return run.status;
  };
  EXPECT_EQ(status("64", "256M", "64x64"), 0);
  EXPECT_EQ(status("16", "400M", "4000x100"), 0);
  EXPECT_EQ(status("64", "600M", "1100x1000"), 0);
  for (const char* threads : {"1", "24"})
    for (const char* resolution : {"420x420", "560x560", "620x620", "12000x30", "20000x16"})
      status(threads, "256M", resolution);
  EXPECT_EQ(status("24", "256M", "1000x1000"), kUsage);
}

TEST(MemoryLimitOption, TooLittleForTheProgramItselfIsSaid) {
  SceneFolder().expect_error(kUsage, "--memory: '10M' is not valid, expected at least 256M",
                             {"--memory", "10M"});
}

}  // namespace
}  // namespace nephroid::testing_support
