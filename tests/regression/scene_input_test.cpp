// Scenes from standard input and pipes, unknown names, and files of other formats, for the real
// program.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "film/image_io.h"
#include "regression/scene_folder.h"

namespace nephroid::testing_support {
namespace {

const std::string kUnknown = kHead + "Material \"diffuse\" \"rgb Kd\" [1 1 1]\n" + kTriangle;

TEST(SceneInput, IsStandardInputOrAPipe) {
  SceneFolder folder(kHead + "Include \"mesh.pbrt\"\n");
  folder.write("mesh.pbrt", kTriangle);
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--quiet", "--integrator", "path"});
    const ProgramRun run = run_program(folder.path("."), arguments, "scene.pbrt");
    EXPECT_EQ(run.status, 0) << run.errors;
    return run.errors;
  };
  render({"scene.pbrt", "--passes", "2", "-o", "file.exr"});
  render({"-", "--passes", "1", "-o", "input.exr"});
  EXPECT_EQ(render({"-", "--passes", "2", "-o", "input.exr", "--resume"}), "")
      << "resumed: the hash is of what was read";
  EXPECT_EQ(read_picture(folder.path("file.exr")).pixels,
            read_picture(folder.path("input.exr")).pixels);
  render({"/dev/stdin", "--passes", "2", "-o", "input.exr", "--resume"});

  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  for (const std::string command : {"info", "routes"}) {
    EXPECT_EQ(run_program(folder.path("."), {command, "-"}, "scene.pbrt").status, 0);
    std::thread writer([&] { std::ofstream(folder.path("pipe")) << kHead << kTriangle; });
    const ProgramRun run = run_program(folder.path("."), {command, "pipe"});
    EXPECT_EQ(run.status, 0) << run.errors;
    writer.join();
  }
  EXPECT_EQ(run_program(folder.path("."), {"info", "-"}).errors,
            "nephroid: error: <stdin>:1:1: the scene ends before WorldBegin\n");
}

TEST(SceneInput, UnknownNamesAreWarningsAndErrorsUnderStrict) {
  const SceneFolder folder(kUnknown);
  const std::string message =
      "scene.pbrt:7:20: unknown parameter \"Kd\" of material \"diffuse\", did you mean "
      "\"reflectance\"?";
  folder.expect_error(kScene, message, {"--strict", "--quiet"});
  folder.expect_picture({message});
}

TEST(SceneInput, ForeignFilesAreCalledByTheirName) {
  SceneFolder("mtllib a.mtl\nv 0 0 0\n")
      .expect_error(kScene,
                    "scene.pbrt:1:1: this is a Wavefront OBJ mesh, expected a pbrt-v4 scene");
}

}  // namespace
}  // namespace nephroid::testing_support
