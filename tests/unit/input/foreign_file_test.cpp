// Recognizes files of other programs that are given as a scene.
#include "input/foreign_file.h"

#include <gtest/gtest.h>

#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::TemporaryDirectory;

struct FileCase {
  const char* name;
  std::string bytes;
  const char* what;  ///< empty: it may be a scene
};

const FileCase kCases[] = {
    {"a", "{ \"asset\": { \"version\": \"2.0\" } }", "a glTF scene"},
    {"a.gltf", "\xef\xbb\xbf\n {\"scenes\": [], \"asset\": {}}", "a glTF scene"},
    {"a", "{ \"x\": 1 }", "a JSON file"},
    {"a", std::string("glTF\x02\x00\x00\x00", 8), "a binary glTF scene (GLB)"},
    {"a", "<scene version=\"3.0.0\">", "a Mitsuba scene"},
    {"a", "<?xml version=\"1.0\"?>\n<!-- c -->\n<scene version=\"0.6.0\">", "a Mitsuba scene"},
    {"a", "<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA scene"},
    {"a", "<?xml version=\"1.0\"?>", "an XML file"},
    {"a", "#usda 1.0\n(\n)", "a USD scene"},
    {"a", "PXR-USDC\x01", "a binary USD scene"},
    {"a", "BLENDER-v405", "a Blender file"},
    {"a.blend", "\x28\xb5\x2f\xfd", "a Blender file"},
    {"a", "Kaydara FBX Binary  ", "an FBX scene"},
    {"a", "; FBX 7.4.0 project file", "an FBX scene"},
    {"a", "ply\nformat ascii 1.0\n", "a PLY mesh"},
    {"a", "# made by hand\n\nmtllib a.mtl\n", "a Wavefront OBJ mesh"},
    {"a", "v 0 0 0\n", "a Wavefront OBJ mesh"},
    {"a", "vt 0 0\r\n", "a Wavefront OBJ mesh"},
    {"a", "f 1 2 3\n", "a Wavefront OBJ mesh"},
    {"a", "o cube\n", "a Wavefront OBJ mesh"},
    {"a.STL", "solid cube", "an STL mesh"},
    {"a", "\x89PNG\r\n", "a PNG picture"},
    {"a", "\x1f\x8b\x08", "a gzip file"},
    {"a.pbrt", "# a scene\nFilm \"rgb\"", ""},
    {"a.obj", "WorldBegin", ""},
    {"a.obj", "", ""},
    {"a.pbrt", "vertices", ""},
    {"a.pbrt", "v", ""},
};

TEST(ForeignFile, IsKnownByItsContentAndElseByItsName) {
  for (const FileCase& c : kCases) {
    const std::string error = foreign_file_error(c.bytes, c.name);
    const std::string begin = "this is " + std::string(c.what) + ", expected a pbrt-v4 scene";
    if (*c.what == '\0')
      EXPECT_EQ(error, "") << c.name << ": " << c.bytes;
    else
      EXPECT_EQ(error.substr(0, begin.size()), begin) << c.name << ": " << c.bytes;
  }
}

TEST(ForeignFile, IsRefusedAsASceneAndAsAPartOfOne) {
  const TemporaryDirectory directory;
  Diagnostics diagnostics;
  const std::string path = directory.write("a.obj", "mtllib a.mtl\n");
  EXPECT_EQ(
      error_of([&] { parse_pbrt_file(path, diagnostics); }),
      path +
          ":1:1: this is a Wavefront OBJ mesh, expected a pbrt-v4 scene (OBJ files are scenes "
          "if their names end in .obj; in scenes, meshes are PLY files)");
  const std::string top = directory.write("top.pbrt", "WorldBegin\nInclude \"a.obj\"");
  EXPECT_EQ(error_of([&] { parse_pbrt_file(top, diagnostics); }),
            top + ":2:9: \"" + path +
                "\": this is a Wavefront OBJ mesh, expected a pbrt-v4 scene (OBJ files are scenes "
                "if their names end in .obj; in scenes, meshes are PLY files)");
}

}  // namespace
}  // namespace nephroid
