// Reports of the shape table on unused parameters.
#include "scene/shape_table.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"

namespace nephroid {
namespace {

TEST(ShapeTable, WhereToSampleALampDoesNotChangeThePicture) {
  Diagnostics d;
  const SceneDescription scene = parse_pbrt_string(
      "WorldBegin\nShape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n"
      "  \"string emissionfilename\" \"there is no such file.exr\"",
      "t.pbrt", ".", d);
  const TextureLibrary textures(scene, d);
  const auto shapes = make_shapes({&scene.shapes.at(0), 1}, *scene.files, d, {textures});
  EXPECT_EQ(shapes.size(), 1u);
  report_unused_parameters(scene.shapes.at(0), d);
  ASSERT_EQ(d.warnings().size(), 1u);
  EXPECT_EQ(d.warnings()[0].where.line, 3);
  EXPECT_NE(d.warnings()[0].message.find("emissionfilename"), std::string::npos);
}

}  // namespace
}  // namespace nephroid
