// Options that the format of a scene does not know.
#include "input/scene_reader.h"

#include <gtest/gtest.h>

#include "unit/input/gltf_text.h"
#include "unit/input/parse_text.h"

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
  const testing::TriangleScene triangle;
  const std::string gltf = triangle.file.text(triangle.members());
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string mitsuba = R"(<scene version="3.0.0"><shape type="sphere"/></scene>)";
  const std::string pbrt = "WorldBegin\n";
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

/// The name of the picture of a scene without a name of its own.
std::string picture_of(const std::string& file, const std::string& contents) {
  const testing::TemporaryDirectory folder;
  Diagnostics diagnostics;
  const SceneDescription scene = read_scene(folder.write(file, contents), {}, diagnostics);
  return scene.film ? scene.film->parameters.get_string("filename", "") : "";
}

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(SceneReader, PicturesAreNamedAfterTheFileWithOrWithoutACamera) {
  const testing::TriangleScene triangle;
  testing::TriangleScene seen;
  seen.node_members = ",\"camera\":0";
  const std::string camera =
      R"(,"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":0}}])";
  EXPECT_EQ(picture_of("vase.gltf", triangle.file.text(triangle.members())), "vase.exr");
  EXPECT_EQ(picture_of("vase.gltf", seen.file.text(seen.members(camera))), "vase.exr");
  EXPECT_EQ(picture_of("room.v2.obj", kObj), "room.v2.exr");
  const std::string body = R"(<scene version="3.0.0"><shape type="sphere"/>)";
  EXPECT_EQ(picture_of("ball.xml", body + "</scene>"), "ball.exr");
  EXPECT_EQ(picture_of("ball.xml", body + R"(<sensor type="perspective"/></scene>)"), "ball.exr");
  EXPECT_EQ(picture_of("a.pbrt", "WorldBegin\n"), "");
}

TEST(SceneReader, AllMissingImagesAreNamedAtOnce) {
  const testing::TemporaryDirectory folder;
  folder.write("m.mtl",
               "newmtl a\nmap_Kd oak.png\nmap_Ks oak.png\nnewmtl b\nmap_Kd C:\\tile.png\n"
               "norm bumps.png\nnewmtl unused\nmap_Kd other.png\n");
  const auto error = [&](const std::string& faces) {
    return testing::error_of([&] {
      Diagnostics diagnostics;
      read_scene(folder.write("room.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces), {},
                 diagnostics);
    });
  };
  const std::string mtl = folder.path("m.mtl");
  EXPECT_EQ(error("usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n"),
            mtl + ":2: 3 images are missing, expected files: \"oak.png\", \"C:/tile.png\" (" + mtl +
                ":5), \"bumps.png\" (" + mtl + ":4)");
  EXPECT_EQ(error("usemtl a\nf 1 2 3\n"), "no error") << "one is an error of its reader";
}

}  // namespace
}  // namespace nephroid
