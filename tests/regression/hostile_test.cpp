// Hostile scenes (tests/hostile, with their outcomes in expected.txt): each gives a picture or a
// located message, soon and with little memory.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "regression/program.h"
#include "source_directory.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing_support {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxSeconds = 10, kMaxCpuSeconds = 10;
constexpr uint64_t kMaxMemory = uint64_t{1} << 30;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSlowAndLarge = true;
#else
constexpr bool kIsSlowAndLarge = false;
#endif

/// Scenes that would take all memory where --memory has no effect.
const std::set<std::string> kNeedALimit = {"displacement_edges_of_1e-9.pbrt",
                                           "film_of_4_gigapixels.pbrt", "only_worldbegin.pbrt",
                                           "zip_bomb.pbrt.gz"};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool is_scene(const std::string& name) {
  return name.ends_with(".pbrt") || name.ends_with(".pbrt.gz") || name.ends_with(".obj") ||
         name.ends_with(".xml") || name.ends_with(".gltf") || name.ends_with(".glb");
}

/// By scene name: "picture", or the exit status and the beginning of the message.
std::map<std::string, std::string> expectations(const fs::path& folder) {
  std::map<std::string, std::string> found;
  std::ifstream file(folder / "expected.txt");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    found[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return found;
}

TEST(HostileScenes, GiveAPictureOrALocatedMessage) {
  const fs::path hostile = fs::path(source_directory()) / "tests/hostile";
  const testing::TemporaryDirectory folder;
  for (const auto& entry : fs::directory_iterator(hostile))
    fs::copy_file(entry.path(), folder.path(entry.path().filename().string()));
  // 100 times 16 MB of spaces.
  const std::string member = bytes_of(hostile / "zip_bomb.member");
  std::string bomb;
  for (int i = 0; i < 100; ++i) bomb += member;
  folder.write("zip_bomb.pbrt.gz", bomb);

  std::map<std::string, std::string> expected = expectations(hostile);
  size_t scenes = 0;
  for (const std::string& name : names_in(folder.path())) {
    if (!is_scene(name)) continue;
    SCOPED_TRACE(name);
    ++scenes;
    if (kIsSlowAndLarge && kNeedALimit.contains(name)) continue;
    const ProgramRun run = run_program(folder.path(), {"render", name, "--memory", "1G", "--passes",
                                                       "1", "-t", "2", "-o", "picture.exr"});
    EXPECT_FALSE(run.hung);
    EXPECT_EQ(run.signal, 0) << run.errors;
    if (!kIsSlowAndLarge) {
      EXPECT_LT(run.seconds, kMaxSeconds);
      EXPECT_LT(run.cpu_seconds, kMaxCpuSeconds);
      EXPECT_LT(run.peak_memory, kMaxMemory);
    }
    const std::string wanted = expected[name];
    if (wanted == "picture") {
      EXPECT_EQ(run.status, 0) << run.errors;
      EXPECT_TRUE(fs::remove(folder.path("picture.exr")));
      continue;
    }
    ASSERT_GT(wanted.size(), 2u) << "no expectation";
    const std::string message = "nephroid: error: " + wanted.substr(2);
    EXPECT_EQ(std::to_string(run.status), wanted.substr(0, 1)) << run.errors;
    EXPECT_NE(("\n" + run.errors).find("\n" + message), std::string::npos)
        << "expected: " << message << "\nfound: " << run.errors;
    EXPECT_FALSE(fs::exists(folder.path("picture.exr")));
  }
  EXPECT_EQ(scenes, expected.size());
  EXPECT_GE(scenes, 60u);
}

}  // namespace
}  // namespace nephroid::testing_support
