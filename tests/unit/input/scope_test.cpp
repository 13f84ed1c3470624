// Scopes and objects: nesting of AttributeBegin, ObjectBegin and their ends, instances.
#include <gtest/gtest.h>

#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::parse;
using testing::parse_error;
using testing::parse_warnings;

TEST(Scopes, AttributesRestoreTheState) {
  const SceneDescription scene = parse(
      "WorldBegin Translate 1 0 0 AttributeBegin Translate 0 1 0 AttributeBegin Translate 0 0 1 "
      "AttributeEnd Shape \"sphere\" AttributeEnd Shape \"sphere\"");
  EXPECT_EQ(scene.shapes.at(0).transform.start[3][1], 1);
  EXPECT_EQ(scene.shapes[0].transform.start[3][2], 0);
  EXPECT_EQ(scene.shapes.at(1).transform.start[3][0], 1);
  EXPECT_EQ(scene.shapes[1].transform.start[3][1], 0);
}

TEST(Scopes, TransformBeginIsDeprecatedButWorks) {
  const std::string text =
      "WorldBegin\nTransformBegin Translate 1 2 3 TransformEnd Shape \"sphere\"";
  EXPECT_EQ(parse(text).shapes.at(0).transform.start, Mat44d());
  EXPECT_EQ(parse_warnings(text), "t.pbrt:2:1: TransformBegin is deprecated, use AttributeBegin\n");
}

TEST(Scopes, MismatchesAreErrors) {
  EXPECT_EQ(parse_error("WorldBegin\nAttributeEnd"),
            "t.pbrt:2:1: AttributeEnd without AttributeBegin");
  EXPECT_EQ(parse_error("WorldBegin\n  AttributeBegin\n"),
            "t.pbrt:2:3: AttributeBegin without AttributeEnd");
  EXPECT_EQ(parse_error("WorldBegin\nObjectEnd"), "t.pbrt:2:1: ObjectEnd without ObjectBegin");
  EXPECT_EQ(parse_error("WorldBegin\nObjectBegin \"a\""),
            "t.pbrt:2:1: ObjectBegin without ObjectEnd");
  EXPECT_EQ(parse_error("WorldBegin\nObjectBegin \"a\"\nAttributeEnd"),
            "t.pbrt:3:1: AttributeEnd, but the ObjectBegin at t.pbrt:2:1 is still open, expected "
            "ObjectEnd");
  EXPECT_EQ(parse_error("WorldBegin\nObjectBegin \"a\" AttributeBegin\nObjectEnd"),
            "t.pbrt:3:1: ObjectEnd, but the AttributeBegin at t.pbrt:2:17 is still open, expected "
            "AttributeEnd");
}

TEST(Objects, KeepTheirShapesApart) {
  const SceneDescription scene = parse(
      "WorldBegin Translate 1 0 0 ObjectBegin \"a\" Translate 0 1 0 Shape \"sphere\" "
      "AttributeBegin Shape \"disk\" AttributeEnd ObjectEnd Shape \"cylinder\" "
      "ObjectInstance \"a\" Scale 2 2 2 ObjectInstance \"a\"");
  ASSERT_EQ(scene.objects.size(), 1u);
  const ObjectDescription& object = scene.objects.at("a");
  EXPECT_EQ(object.name, "a");
  EXPECT_EQ(object.where.to_string(), "t.pbrt:1:28");
  ASSERT_EQ(object.shapes.size(), 2u);
  EXPECT_EQ(object.shapes[0].transform.start[3][1], 1);
  ASSERT_EQ(scene.shapes.size(), 1u);
  EXPECT_EQ(scene.shapes[0].transform.start[3][1], 0);  // ObjectEnd restores the state
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].object, "a");
  EXPECT_EQ(scene.instances[0].transform.start[3][0], 1);
  EXPECT_EQ(scene.instances[1].transform.start[0][0], 2);
}

TEST(Objects, ErrorsHaveTheirPlace) {
  EXPECT_EQ(parse_error("WorldBegin ObjectBegin \"a\" ObjectEnd\nObjectBegin \"a\" ObjectEnd"),
            "t.pbrt:2:1: object \"a\" is already defined at t.pbrt:1:12");
  EXPECT_EQ(parse_error("WorldBegin ObjectBegin \"a\"\nObjectBegin \"b\""),
            "t.pbrt:2:1: ObjectBegin inside of the object \"a\" that was begun at t.pbrt:1:12, "
            "expected ObjectEnd first");
  EXPECT_EQ(parse_error("WorldBegin ObjectBegin \"a\" ObjectEnd ObjectBegin \"b\"\n"
                        "ObjectInstance \"a\""),
            "t.pbrt:2:1: ObjectInstance inside of the object \"b\", objects cannot contain "
            "instances");
  EXPECT_EQ(parse_error("WorldBegin ObjectBegin \"tree\" ObjectEnd\nObjectInstance \"three\""),
            "t.pbrt:2:1: object \"three\" is not defined, did you mean \"tree\"?");
  EXPECT_EQ(parse_error("WorldBegin ObjectBegin \"a\"\nNamedMaterial \"m\" Shape \"sphere\" "
                        "ObjectEnd"),
            "t.pbrt:2:1: named material \"m\" is not defined");
}

TEST(Objects, AreaLightsAreDroppedWithAWarning) {
  const std::string text =
      "WorldBegin\nAreaLightSource \"diffuse\"\nObjectBegin \"a\"\nShape \"sphere\"\n"
      "Shape \"sphere\"\nObjectEnd\nShape \"sphere\"";
  const SceneDescription scene = parse(text);
  EXPECT_FALSE(scene.objects.at("a").shapes[0].area_light);
  EXPECT_FALSE(scene.objects.at("a").shapes[1].area_light);
  EXPECT_TRUE(scene.shapes[0].area_light);
  EXPECT_EQ(parse_warnings(text),
            "t.pbrt:4:1: area lights are not supported on instances: the surface does not emit "
            "(object \"a\")\n");
}

}  // namespace
}  // namespace nephroid
