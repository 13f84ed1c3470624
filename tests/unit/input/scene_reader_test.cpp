// Options that the format of a scene does not know.
#include "input/scene_reader.h"

#include <gtest/gtest.h>

#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

/// Warnings of read_scene that name `option`.
size_t warnings_about(const std::string& option, const std::string& file,
                      const std::string& contents, const ImportOptions& options) {
  const testing::TemporaryDirectory folder;
  Diagnostics diagnostics;
  read_scene(folder.write(file, contents), options, diagnostics);
  size_t count = 0;
  for (const Warning& warning : diagnostics.warnings())
    if (warning.message.starts_with(option)) ++count;
  return count;
}

TEST(SceneReader, OptionsOfOtherFormatsAreWarnings) {
  const std::string gltf = R"({"asset":{"version":"2.0"},"cameras":[{"type":"perspective",)"
                           R"("perspective":{"yfov":1,"znear":1}}],"nodes":[{"camera":0},)"
                           R"({"extensions":{"KHR_lights_punctual":{"light":0}}}],"extensions":)"
                           R"({"KHR_lights_punctual":{"lights":[{"type":"point"}]}}})";
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string mitsuba = R"(<scene version="3.0.0"><shape type="sphere"/></scene>)",
                    pbrt = "WorldBegin\n";
  ImportOptions solid, define;
  solid.solid_glass = true;
  define.defines["spp"] = "4";
  EXPECT_EQ(warnings_about("--solid-glass", "a.gltf", gltf, solid), 0u);
  EXPECT_EQ(warnings_about("--solid-glass", "a.obj", obj, solid), 0u);
  EXPECT_EQ(warnings_about("--solid-glass", "a.xml", mitsuba, solid), 1u);
  EXPECT_EQ(warnings_about("--solid-glass", "a.pbrt", pbrt, solid), 1u);
  EXPECT_EQ(warnings_about("--define", "a.gltf", gltf, define), 1u);
  EXPECT_EQ(warnings_about("--define", "a.pbrt", pbrt, define), 1u);
  EXPECT_EQ(warnings_about("--define is ignored", "a.xml", mitsuba, define), 0u);
}

}  // namespace
}  // namespace nephroid
