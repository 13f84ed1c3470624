// Scenes from standard input and pipes, unknown names, and files of other formats, for the real
// program.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "film/image_io.h"
#include "regression/piped_program.h"
#include "regression/scene_folder.h"
#include "unit/input/gltf_text.h"

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

TEST(SceneInput, NamesOfPbrtV3AreUnderstoodUnderStrictToo) {
  const SceneFolder folder(kHead + "Material \"matte\" \"rgb Kd\" [0.5 0.4 0.3]\n" + kTriangle);
  const ProgramRun run = folder.render({"--strict"});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("pbrt-v3"), std::string::npos) << run.errors;
}

TEST(SceneInput, ClassesOfMaterialsAreListedAndWhatIsNormalIsNoWarning) {
  testing::TriangleScene scene;
  scene.primitive_members = ",\"material\":0";
  SceneFolder folder;
  folder.write("pane.gltf",
               scene.file.text(scene.members(
                   R"(,"materials":[{"name":"pane","pbrMetallicRoughness":{"metallicFactor":0},)"
                   R"("emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":)"
                   R"({"emissiveStrength":9}}}],"extensionsUsed":)"
                   R"(["KHR_materials_emissive_strength"])")));
  PipedProgram info(folder.path("."), {"info", "pane.gltf"});
  const std::string output = info.read(1 << 16);
  EXPECT_NE(output.find("\nlabels of materials: pane [DG]\n"), std::string::npos) << output;
  EXPECT_NE(output.find("\nwarnings: 0\n"), std::string::npos) << output;
  const ProgramRun run = run_program(folder.path("."), {"info", "pane.gltf"});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.errors.find("warning"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("note: pane.gltf: the file has no camera"), std::string::npos);
  // The pane does not light itself, so no exposure is chosen.
  EXPECT_EQ(run.errors.find("exposure"), std::string::npos) << run.errors;
}

TEST(SceneInput, ConvertKeepsWhatItWouldReplace) {
  SceneFolder folder;
  const std::string scene = "Camera \"perspective\"\nWorldBegin\n# mine\nShape \"sphere\"\n";
  folder.write("a.pbrt", scene);
  folder.write("b.pbrt", "# edited\n");
  const auto converted = [&](const std::string& to) {
    return run_program(folder.path("."), {"convert", "a.pbrt", to});
  };
  const auto content = [&](const std::string& name) {
    std::ifstream file(folder.path(name));
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const ProgramRun itself = converted("./a.pbrt");
  EXPECT_EQ(itself.status, 2);
  EXPECT_NE(itself.errors.find("'./a.pbrt' is the scene to convert"), std::string::npos)
      << itself.errors;
  EXPECT_EQ(content("a.pbrt"), scene);
  const ProgramRun over = converted("b.pbrt");
  EXPECT_EQ(over.status, 0) << over.errors;
  EXPECT_NE(over.errors.find("b.pbrt is there already; it is kept as b.previous.pbrt"),
            std::string::npos)
      << over.errors;
  EXPECT_EQ(content("b.previous.pbrt"), "# edited\n");
  EXPECT_NE(content("b.pbrt").find("Shape \"sphere\""), std::string::npos);
}

TEST(SceneInput, PicturesOfTwoFilesDoNotMeet) {
  SceneFolder folder;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("vase.obj", obj);
  const ProgramRun run =
      run_program(folder.path("."), {"render", "vase.obj", "--passes", "1", "--resolution", "8x8"});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(std::filesystem::exists(folder.path("vase.exr")));
  EXPECT_EQ(run.errors.find("maxdepth"), std::string::npos) << run.errors;
  EXPECT_EQ(run.errors.find("can belong to it"), std::string::npos) << run.errors;
  PipedProgram convert(folder.path("."), {"convert", "vase.obj", "vase.pbrt"});
  EXPECT_EQ(convert.read(1 << 16), "wrote vase.pbrt\n");
  std::ifstream converted(folder.path("vase.pbrt"));
  const std::string text{std::istreambuf_iterator<char>(converted), {}};
  EXPECT_NE(text.find("\"string filename\" [ \"vase.exr\" ]"), std::string::npos) << text;
  const ProgramRun own = run_program(
      folder.path("."), {"render", "vase.obj", "--passes", "1", "--resolution", "8x8", "--route",
                         "card=C<L.'card'>:path", "--route", "rest=.*:path"});
  EXPECT_NE(own.errors.find("'card' is black: no path in this scene can belong to it"),
            std::string::npos)
      << own.errors;
}

TEST(SceneInput, ForeignFilesAreCalledByTheirName) {
  SceneFolder("mtllib a.mtl\nv 0 0 0\n")
      .expect_error(kScene,
                    "scene.pbrt:1:1: this is a Wavefront OBJ mesh, expected a pbrt-v4 scene");
  SceneFolder("<scene version=\"3.0.0\">\n")
      .expect_error(kScene,
                    "scene.pbrt:1:1: this is a Mitsuba scene, expected a pbrt-v4 scene (scenes of "
                    "this format have names that end in .xml)");
}

}  // namespace
}  // namespace nephroid::testing_support
