// Expectations on statuses, messages and folders.
#include "regression/scene_folder.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/errors.h"
#include "input/pbrt_parser.h"
#include "scene/scene.h"

namespace nephroid::testing_support {

const std::string kOptions =
    "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 "
    "\"string filename\" \"picture.exr\"\n"
    "Sampler \"independent\" \"integer pixelsamples\" 1\n"
    "LookAt 0 0 -5 0 0 0 0 1 0\n"
    "Camera \"perspective\" \"float fov\" 40\n";
namespace {
const std::string kWorld = "WorldBegin\nLightSource \"point\" \"point3 from\" [ 0 0 -4 ]\n";
}  // namespace
const std::string kHead = kOptions + kWorld;
const std::string kTriangle = "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 0 1 -1 0 0 1 0 ]\n";

namespace {

void expect_ended(const ProgramRun& run, int status) {
  EXPECT_FALSE(run.hung) << run.errors;
  EXPECT_EQ(run.signal, 0) << "crashed: " << run.errors;
  EXPECT_EQ(run.status, status) << run.errors;
}

void expect_line(const ProgramRun& run, const std::string& beginning) {
  EXPECT_NE(("\n" + run.errors).find("\n" + beginning), std::string::npos)
      << "expected: " << beginning << "\nfound: " << run.errors;
}

}  // namespace

ProgramRun SceneFolder::render(std::vector<std::string> more) const {
  std::vector<std::string> arguments = {"render", "scene.pbrt", "-t", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(directory_.path(), arguments);
}

void SceneFolder::expect_error(int status, const std::string& message,
                               std::vector<std::string> more) const {
  const std::set<std::string> before = names_in(directory_.path());
  const ProgramRun run = render(std::move(more));
  expect_ended(run, status);
  expect_line(run, "nephroid: error: " + message);
  EXPECT_EQ(names_in(directory_.path()), before);
}

void SceneFolder::expect_picture(const std::vector<std::string>& warnings,
                                 std::vector<std::string> more) const {
  std::set<std::string> names = names_in(directory_.path());
  const ProgramRun run = render(std::move(more));
  expect_ended(run, 0);
  for (const std::string& warning : warnings) expect_line(run, "nephroid: warning: " + warning);
  names.insert({"picture.exr", "picture.png", "picture.state"});
  EXPECT_EQ(names_in(directory_.path()), names);
}

void expect_scene_error(const std::string& lines, const std::string& message) {
  SCOPED_TRACE(lines);
  SceneFolder(kHead + lines).expect_error(kScene, "scene.pbrt:" + message);
}

void expect_refused(const std::string& lines, const std::string& message,
                    const std::string& options) {
  SCOPED_TRACE(options + lines);
  try {
    Diagnostics diagnostics;
    const SceneDescription scene =
        parse_pbrt_string(options + kWorld + lines, "scene.pbrt", ".", diagnostics);
    build_scene(scene, {}, diagnostics);
    ADD_FAILURE() << "expected: " << message;
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("scene.pbrt:" + message, 0), 0u) << error.what();
  }
}

}  // namespace nephroid::testing_support
