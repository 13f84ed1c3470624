// The program on an OBJ file: it renders, describes and converts it, and does not resume a render
// with other options about the scene.
#include <gtest/gtest.h>

#include <filesystem>

#include "regression/program.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing_support {
namespace {

class ObjProgram : public ::testing::Test {
 protected:
  ObjProgram() {
    folder_.write("cube.obj",
                  "mtllib cube.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
                  "v 1 0 1\nv 1 1 1\nv 0 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\n"
                  "f 2 3 7 6\nf 4 1 5 8\n");
    folder_.write("cube.mtl", "newmtl red\nKd .7 .1 .1\n");
  }
  ProgramRun run(const std::vector<std::string>& arguments) const {
    return run_program(folder_.path(), arguments);
  }
  /// A small render with more arguments.
  ProgramRun render(const std::string& scene, std::vector<std::string> more = {}) const {
    more.insert(more.begin(),
                {"render", scene, "--resolution", "16x12", "--passes", "1", "-t", "2"});
    return run(more);
  }
  testing::TemporaryDirectory folder_;
};

TEST_F(ObjProgram, NamesThePictureAfterTheFileAndSaysWhatWasAdded) {
  const ProgramRun run = render("cube.obj", {"--floor"});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("the file has no camera"), std::string::npos);
  EXPECT_NE(run.errors.find("the file has no light"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_.path("cube.exr")));
}

TEST_F(ObjProgram, WarnsOfChoicesThatTheFileDoesNotHave) {
  const ProgramRun run =
      render("cube.obj", {"--at", "1", "--shutter", "1/48s", "--variant", "red", "--camera", "1"});
  EXPECT_EQ(run.status, 0) << run.errors;
  for (const char* option : {"--at", "--shutter", "--variant", "--camera"})
    EXPECT_NE(run.errors.find(std::string(option) + " is ignored: the file has no "),
              std::string::npos)
        << run.errors;
}

TEST_F(ObjProgram, ResumesOnlyWithTheSameOptionsAboutTheScene) {
  ASSERT_EQ(render("cube.obj", {"--sun", "30,45"}).status, 0);
  EXPECT_EQ(render("cube.obj", {"--sun", "30,45", "--resume"}).status, 0);
  const ProgramRun other = render("cube.obj", {"--sun", "31,45", "--resume"});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.errors.find("sun 30,45, here 31,45"), std::string::npos) << other.errors;
  EXPECT_EQ(render("cube.obj", {"--resume"}).status, 2);
}

TEST_F(ObjProgram, ConvertsToASceneThatRenders) {
  const ProgramRun converted = run({"convert", "cube.obj", "cube.pbrt", "--floor", "--sun", "9,8"});
  EXPECT_EQ(converted.status, 0) << converted.errors;
  const ProgramRun rendered = render("cube.pbrt");
  EXPECT_EQ(rendered.status, 0) << rendered.errors;
  EXPECT_EQ(rendered.errors.find("warning"), std::string::npos) << rendered.errors;
  EXPECT_EQ(run({"convert", "cube.obj", "no/folder/cube.pbrt"}).status, 4);
}

TEST_F(ObjProgram, DescribesTheFile) {
  EXPECT_EQ(run({"info", "cube.obj", "--floor"}).status, 0);
  EXPECT_EQ(run({"routes", "cube.obj", "--passes", "1"}).status, 0);
}

}  // namespace
}  // namespace nephroid::testing_support
