// The scenes of this repository are read by the real program without a warning and give a picture.
// It must not know what the pictures show.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "regression/program.h"
#include "source_directory.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing_support {
namespace {

namespace fs = std::filesystem;

/// Files below scenes/ that are whole scenes, not parts of one.
std::vector<std::string> own_scenes() {
  std::vector<std::string> found;
  for (const auto& entry :
       fs::recursive_directory_iterator(testing_support::source_directory() + "/scenes")) {
    if (entry.path().extension() != ".pbrt") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.find("\nWorldBegin") != std::string::npos) found.push_back(entry.path().string());
  }
  return found;
}

TEST(OwnScenes, AreReadWithoutAWarning) {
  const std::vector<std::string> scenes = own_scenes();
  ASSERT_GE(scenes.size(), 20u);
  for (const std::string& scene : scenes) {
    const ProgramRun run = run_program(fs::temp_directory_path(), {"info", scene});
    EXPECT_EQ(run.status, 0) << scene;
    EXPECT_EQ(run.errors, "") << scene;
  }
}

TEST(OwnScenes, GiveAPicture) {
  const testing::TemporaryDirectory folder;
  for (const std::string& scene : own_scenes()) {
    const ProgramRun run =
        run_program(folder.path(), {"render", scene, "-o", "picture.exr", "--resolution", "12x9",
                                    "--passes", "1", "--quiet", "--no-state"});
    EXPECT_EQ(run.status, 0) << scene;
    EXPECT_EQ(run.errors, "") << scene;
    EXPECT_TRUE(fs::remove(folder.path("picture.exr"))) << scene;
    EXPECT_TRUE(fs::remove(folder.path("picture.png"))) << scene;
  }
}

}  // namespace
}  // namespace nephroid::testing_support
