// Replays every input that a fuzzer ever failed on, and a few that lead it into the code.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "film/state_file.h"
#include "fuzz/targets.h"
#include "session/checkpoint/film_metadata.h"
#include "source_directory.h"

namespace nephroid {
namespace {

struct Target {
  const char* name;
  void (*run)(const std::string& bytes);
};

class FuzzCorpus : public ::testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, NothingCrashes) {
  const auto folder = std::filesystem::path(testing_support::source_directory()) /
                      "tests/fuzz/corpus" / GetParam().name;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    ASSERT_TRUE(in) << entry.path();
    SCOPED_TRACE(entry.path().filename().string());
    EXPECT_NO_THROW(GetParam().run({std::istreambuf_iterator<char>(in), {}}));
    ++files;
  }
  EXPECT_GE(files, 5);
}

// A state of another format would lead a fuzzer nowhere. tools/make_fuzz_states renders new ones.
TEST(FuzzSeeds, StatesHaveTheFormatOfToday) {
  int states = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(testing_support::source_directory()) /
           "tests/fuzz/corpus/checkpoint")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("seed-") || name.starts_with("seed-held")) continue;
    SCOPED_TRACE(name);
    EXPECT_NO_THROW({
      const StateFile file(entry.path().string());
      film_of(file);
    });
    ++states;
  }
  EXPECT_GE(states, 5);
}

INSTANTIATE_TEST_SUITE_P(
    AllTargets, FuzzCorpus,
    ::testing::Values(Target{"scene", fuzz::scene}, Target{"ply", fuzz::ply},
                      Target{"obj", fuzz::obj}, Target{"bsdf", fuzz::bsdf},
                      Target{"routes", fuzz::routes}, Target{"image", fuzz::image},
                      Target{"environment", fuzz::environment}, Target{"nanovdb", fuzz::nanovdb},
                      Target{"checkpoint", fuzz::checkpoint}, Target{"learned", fuzz::learned},
                      Target{"command", fuzz::command}, Target{"gltf", fuzz::gltf},
                      Target{"mitsuba", fuzz::mitsuba}, Target{"serialized", fuzz::serialized},
                      Target{"volume", fuzz::volume}, Target{"view_request", fuzz::view_request}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
