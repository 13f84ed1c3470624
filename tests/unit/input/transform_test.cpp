// The transform directives, observed in the transform of the shape that follows.
#include <gtest/gtest.h>

#include <cmath>

#include "input/transform_directives.h"
#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::parse;
using testing::parse_error;
using testing::parse_warnings;

constexpr double kTolerance = 1e-14;  // a few roundings of numbers near 1

TransformDescription after(const std::string& directives) {
  return parse("WorldBegin " + directives + " Shape \"sphere\"").shapes.at(0).transform;
}
Vec3d apply(const Mat44d& m, const Vec3d& p) {
  Vec3d result;
  m.multVecMatrix(p, result);
  return result;
}
void expect_near(const Vec3d& a, const Vec3d& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], kTolerance) << a << " and " << b;
}

TEST(Transforms, EachMovesPointsAsItShould) {
  const Vec3d p(1, 2, 3);
  expect_near(apply(after("").start, p), p);
  expect_near(apply(after("Translate 10 20 30").start, p), {11, 22, 33});
  expect_near(apply(after("Scale 2 -3 4").start, p), {2, -6, 12});
  expect_near(apply(after("Rotate 90 0 0 5").start, p), {-2, 1, 3});
  expect_near(apply(after("Rotate 90 1 0 0").start, p), {1, -3, 2});
  expect_near(apply(after("Rotate -90 0 1 0").start, p), {-3, 2, 1});
  expect_near(apply(after("Rotate 120 1 1 1").start, p), {3, 1, 2});
  expect_near(apply(after("Rotate 360000 1 2 3").start, p), p);
}

TEST(Transforms, QuarterTurnsAreExact) {
  for (int turns = -5; turns <= 5; ++turns) {
    const Mat44d m = *rotation_matrix(90.0 * turns, {0, 0, 2});
    const int sines[] = {0, 1, 0, -1};
    const size_t quarter = static_cast<size_t>((turns + 8) % 4);
    EXPECT_EQ(m[0][1], sines[quarter]) << turns;
    EXPECT_EQ(m[0][0], sines[(quarter + 1) % 4]) << turns;
    EXPECT_EQ(m[2][2], 1) << turns;
  }
}

TEST(Transforms, RotationsAgreeWithTheirAngle) {
  for (double degrees = -720; degrees <= 720; degrees += 7.5) {
    const Mat44d m = *rotation_matrix(degrees, {0, 0, -3});
    EXPECT_NEAR(m[0][0], std::cos(degrees * 0.017453292519943295), 1e-14) << degrees;
    EXPECT_NEAR(m[0][1], -std::sin(degrees * 0.017453292519943295), 1e-14) << degrees;
  }
}

TEST(Transforms, TheNearestToTheShapeComesFirst) {
  expect_near(apply(after("Translate 10 0 0 Scale 2 2 2").start, {1, 1, 1}), {12, 2, 2});
  expect_near(apply(after("Scale 2 2 2 Translate 10 0 0").start, {1, 1, 1}), {22, 2, 2});
}

TEST(Transforms, TheSixteenNumbersAreMemoryOrder) {
  const Mat44d m = after("Transform [2 0 0 0  0 3 0 0  0 0 4 0  5 6 7 1]").start;
  EXPECT_EQ(m[3][0], 5);
  EXPECT_EQ(m[3][2], 7);
  expect_near(apply(m, {1, 1, 1}), {7, 9, 11});
  EXPECT_EQ(after("Transform 2 0 0 0 0 3 0 0 0 0 4 0 5 6 7 1").start, m);
  EXPECT_EQ(after("Translate 9 9 9 Transform [2 0 0 0  0 3 0 0  0 0 4 0  5 6 7 1]").start, m);
  expect_near(apply(after("Scale 2 2 2 ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]").start,
                    {1, 1, 1}),
              {12, 14, 16});
  EXPECT_EQ(after("Translate 1 2 3 Identity").start, Mat44d());
}

TEST(Transforms, LookAtMapsTheWorldToTheCamera) {
  const SceneDescription scene =
      parse("LookAt 1 2 3  1 2 13  0 5 0 Camera \"perspective\" WorldBegin");
  const Mat44d m = scene.camera->world_to_camera.start;
  expect_near(apply(m, {1, 2, 3}), {0, 0, 0});
  expect_near(apply(m, {1, 2, 13}), {0, 0, 10});
  expect_near(apply(m, {1, 4, 3}), {0, 2, 0});
  expect_near(apply(m, {2, 2, 3}), {1, 0, 0});
}

TEST(Transforms, LookAtKeepsDistancesForAnyDirection) {
  const Mat44d m = *look_at_matrix({1, -2, 3}, {-4, 5, 0.5}, {0.3, 1, -0.2});
  expect_near(apply(m, {1, -2, 3}), {0, 0, 0});
  expect_near(apply(m, {-4, 5, 0.5}), {0, 0, std::sqrt(25 + 49 + 6.25)});
  const Mat44d unit = m * m.transposed();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(unit[i][j] - m[i][3] * m[j][3], i == j ? 1 : 0, kTolerance);
  Vec3d up;
  m.multDirMatrix(Vec3d(0.3, 1, -0.2), up);
  EXPECT_NEAR(up.x, 0, kTolerance);
  EXPECT_GT(up.y, 0);
}

TEST(Transforms, ActiveTransformChoosesTheKeyframe) {
  const TransformDescription t = after(
      "Translate 1 0 0 ActiveTransform StartTime Translate 0 1 0 ActiveTransform EndTime "
      "Translate 0 0 1 ActiveTransform All Scale 2 2 2");
  expect_near(apply(t.start, {1, 1, 1}), {3, 3, 2});
  expect_near(apply(t.end, {1, 1, 1}), {3, 2, 3});
  EXPECT_TRUE(t.is_animated());
  EXPECT_FALSE(after("Translate 1 0 0").is_animated());
  const TransformDescription identity = after("Translate 1 0 0 ActiveTransform EndTime Identity");
  EXPECT_EQ(identity.end, Mat44d());
  EXPECT_EQ(identity.start[3][0], 1);
  EXPECT_FALSE(
      after("AttributeBegin ActiveTransform EndTime AttributeEnd Translate 1 2 3").is_animated());
}

TEST(Transforms, WorldBeginResetsEverything) {
  const SceneDescription scene = parse(
      "Translate 1 2 3 ActiveTransform EndTime Translate 1 0 0 Camera \"perspective\" WorldBegin "
      "Shape \"sphere\" Translate 1 0 0 Shape \"sphere\"");
  EXPECT_TRUE(scene.camera->world_to_camera.is_animated());
  EXPECT_EQ(scene.shapes[0].transform.start, Mat44d());
  EXPECT_FALSE(scene.shapes[1].transform.is_animated());
}

TEST(Transforms, CoordinateSystems) {
  EXPECT_EQ(after("Translate 1 2 3 CoordinateSystem \"here\" Identity Scale 2 2 2 "
                  "CoordSysTransform \"here\"")
                .start[3][1],
            2);
  EXPECT_EQ(after("Translate 1 2 3 CoordSysTransform \"world\"").start, Mat44d());
  const SceneDescription scene = parse(
      "Translate 1 2 3 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" "
      "Shape \"sphere\"");
  expect_near(apply(scene.shapes[0].transform.start, {0, 0, 0}), {-1, -2, -3});
  EXPECT_EQ(parse_warnings("CoordinateSystem \"here\" WorldBegin\nCoordSysTransform \"hare\""),
            "t.pbrt:2:1: coordinate system \"hare\" is not defined, the transform stays as it is, "
            "did you mean \"here\"?\n");
}

TEST(Transforms, TransformTimes) {
  const SceneDescription scene = parse("TransformTimes 0.25 3 WorldBegin");
  EXPECT_EQ(scene.transform_start_time, 0.25f);
  EXPECT_EQ(scene.transform_end_time, 3.0f);
  EXPECT_EQ(parse("WorldBegin").transform_end_time, 1.0f);
  EXPECT_EQ(parse_error("TransformTimes 3 1"),
            "t.pbrt:1:1: TransformTimes ends before it starts, expected start <= end");
}

TEST(Transforms, SingularOnesAreErrors) {
  const std::string message = " gives a singular matrix, expected one that can be inverted";
  EXPECT_EQ(parse_error("\n Scale 1 0 1"), "t.pbrt:2:2: Scale" + message);
  EXPECT_EQ(parse_error("Scale 0 0 0"), "t.pbrt:1:1: Scale" + message);
  EXPECT_EQ(parse_error("ConcatTransform [1 2 3 0 4 5 6 0 7 8 9 0 0 0 0 1]"),
            "t.pbrt:1:1: ConcatTransform" + message);
  EXPECT_EQ(parse_error("Transform [.1 .2 .3 0 .4 .5 .6 0 .7 .8 .9 0 0 0 0 1]"),
            "t.pbrt:1:1: Transform is a singular matrix, expected one that can be inverted");
  EXPECT_EQ(parse_error("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0]"),
            "t.pbrt:1:1: Transform is a singular matrix, expected one that can be inverted");
  EXPECT_EQ(parse_error("Rotate 90 0 0 0"),
            "t.pbrt:1:1: the axis of Rotate is the zero vector, expected a direction");
  EXPECT_EQ(parse_error("LookAt 1 2 3 1 2 3 0 1 0"),
            "t.pbrt:1:1: LookAt looks from a point to itself, expected two different points");
  EXPECT_EQ(parse_error("LookAt 0 0 0 1 2 3 2 4 6"),
            "t.pbrt:1:1: the up vector of LookAt is zero or parallel to the view direction, "
            "expected another direction");
  EXPECT_EQ(parse_error("LookAt 0 0 0 1 2 3 -.1 -.2 -.3"),
            "t.pbrt:1:1: the up vector of LookAt is zero or parallel to the view direction, "
            "expected another direction");
  EXPECT_EQ(parse_error("LookAt 0 0 0 1 2 3 0 0 0"),
            "t.pbrt:1:1: the up vector of LookAt is zero or parallel to the view direction, "
            "expected another direction");
}

TEST(Transforms, ExtremeUnitsAreNotSingular) {
  for (const char* fine :
       {"Scale 1e-6 1e-6 1e-6", "Scale 1 1 1e-9", "Scale 1e8 1e8 1e8 Translate 1e9 0 0",
        "Transform [1e-5 0 0 0 0 1e5 0 0 0 0 1 0 1e7 -1e7 1e7 1]",
        "Transform [1 0 0 0 1e8 1 0 0 0 0 1 0 0 0 0 1]",
        "Scale 1 1 1e-9 Rotate 45 1 1 0 Rotate 30 0 1 1"})
    EXPECT_EQ(parse_error(std::string(fine) + " WorldBegin"), "no error") << fine;
  EXPECT_EQ(parse_error("Scale 1e-60 1e-60 1e-60 Scale 1e-60 1e-60 1e-60"),
            "t.pbrt:1:25: Scale gives a singular matrix, expected one that can be inverted");
}

TEST(Transforms, BadNumbersAreErrors) {
  EXPECT_EQ(parse_error("Translate 1 x 3"),
            "t.pbrt:1:13: expected a number of Translate, found \"x\"");
  EXPECT_EQ(parse_error("Translate 1 2"),
            "t.pbrt:1:14: expected a number of Translate, found the end of the file");
  EXPECT_EQ(parse_error("Translate [1 2 3]"),
            "t.pbrt:1:11: expected a number of Translate, found '['");
  EXPECT_EQ(parse_error("Rotate 90 \"x\" 0 0"),
            "t.pbrt:1:11: expected a number of Rotate, found \"x\"");
  EXPECT_EQ(parse_error("Scale nan 1 1"),
            "t.pbrt:1:7: \"nan\" is not a finite number, expected a number of Scale");
  EXPECT_EQ(parse_error("Scale 1 inf 1"),
            "t.pbrt:1:9: \"inf\" is not a finite number, expected a number of Scale");
  EXPECT_EQ(parse_error("Transform [1 2 3]"),
            "t.pbrt:1:17: expected a number of Transform, found ']'");
  EXPECT_EQ(parse_error("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 5]"),
            "t.pbrt:1:44: expected ']' after the 16 numbers of Transform, found \"5\"");
  EXPECT_EQ(parse_error("ActiveTransform Both"),
            "t.pbrt:1:17: expected All, StartTime or EndTime, found \"Both\"");
}

}  // namespace
}  // namespace nephroid
