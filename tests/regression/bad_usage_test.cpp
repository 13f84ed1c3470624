// Bad command lines for the real program and outputs that it cannot write. The picture of an
// earlier render survives a render that fails. bad_input_test.cpp has bad scenes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "regression/scene_folder.h"

namespace nephroid::testing_support {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(BadIntegrator, OfTheSceneMattersWhenItIsFollowed) {
  const SceneFolder folder("Integrator \"pth\"\n" + kHead + kTriangle);
  folder.expect_error(kScene, "scene.pbrt:1:1: unknown integrator \"pth\", expected one of",
                      {"--integrator", "scene"});
  folder.expect_picture({"scene.pbrt:1:1: unknown integrator \"pth\", \"mixed\" is used"});
  SceneFolder("Integrator \"path\" \"integer maxdepth\" -3\n" + kHead)
      .expect_error(kScene, "scene.pbrt:1:19: \"maxdepth\" is -3, expected at least 0");
}

TEST(BadUsage, SaysWhatIsExpected) {
  const SceneFolder folder;
  folder.expect_error(kUsage, "--integrator: unknown integrator 'pth', expected one of",
                      {"--integrator", "pth"});
  folder.expect_error(kUsage, "-D: unknown key 'raduis', expected one of", {"-D", "raduis=1"});
  folder.expect_error(kUsage, "--resolution: '8by8' is not valid, expected WIDTHxHEIGHT",
                      {"--resolution", "8by8"});
  folder.expect_error(kUsage, "--resolution: 4294967296 pixels (65536 x 65536) need about",
                      {"--resolution", "65536x65536"});
}

TEST(BadOutput, IsAnOutputError) {
  SceneFolder folder;
  std::filesystem::create_directory(folder.path("a.exr"));
  folder.expect_error(kInputOutput, "a.exr: cannot write: it is a directory", {"-o", "a.exr"});
  std::filesystem::create_directory(folder.path("b.png"));
  folder.expect_error(kInputOutput, "b.png: cannot write: it is a directory", {"-o", "b.exr"});
  folder.expect_error(kInputOutput, "scene.pbrt/c.exr: cannot write into its directory",
                      {"-o", "scene.pbrt/c.exr"});
  folder.expect_error(kInputOutput, "absent/c.exr: cannot write into its directory: No such file",
                      {"-o", "absent/c.exr"});
}

TEST(BadOutput, AClosedDirectoryIsAnOutputError) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const SceneFolder folder;
  std::filesystem::create_directory(folder.path("closed"));
  std::filesystem::permissions(folder.path("closed"), std::filesystem::perms::owner_read);
  folder.expect_error(kInputOutput, "closed/a.exr: cannot write into its directory",
                      {"-o", "closed/a.exr"});
  std::filesystem::permissions(folder.path("closed"), std::filesystem::perms::owner_all);
}

TEST(BadScene, LeavesAnEarlierPictureAlone) {
  SceneFolder folder(kHead + "Shape \"sphere\" \"float radius\" -1\n");
  folder.write("picture.exr", "earlier");
  folder.write("picture.png", "picture");
  folder.expect_error(kScene, "scene.pbrt:7:16: ", {"-o", "picture.exr"});
  EXPECT_EQ(contents(folder.path("picture.exr")), "earlier");
  EXPECT_EQ(contents(folder.path("picture.png")), "picture");
}

}  // namespace
}  // namespace nephroid::testing_support
