// Transforms of Mitsuba scenes: order, handedness and matrices.
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

/// The transform of a shape with these elements in its <transform>.
TransformDescription transform_of(const std::string& elements) {
  MitsubaScene scene;
  return scene
      .read("<shape type=\"disk\"><transform name=\"toWorld\">" + elements +
            "</transform></shape>\n")
      .shapes.at(0)
      .transform;
}

Vec3d moved(const std::string& elements, const Vec3d& point) {
  Vec3d result;
  transform_of(elements).start.multVecMatrix(point, result);
  return result;
}

void expect_close(const Vec3d& found, const Vec3d& expected) {
  EXPECT_NEAR((found - expected).length(), 0, 1e-9) << found.x << " " << found.y << " " << found.z;
}

TEST(MitsubaTransform, LaterElementsAreAppliedLater) {
  expect_close(moved("<scale value=\"2\"/><translate x=\"1\"/>", {1, 1, 1}), {3, 2, 2});
  expect_close(moved("<translate x=\"1\"/><scale x=\"2\" y=\"3\"/>", {1, 1, 1}), {4, 3, 1});
}

TEST(MitsubaTransform, RotationsAreRightHanded) {
  expect_close(moved("<rotate z=\"1\" angle=\"90\"/>", {1, 0, 0}), {0, 1, 0});
  expect_close(moved("<rotate value=\"0, 2, 0\" angle=\"90\"/>", {0, 0, 1}), {1, 0, 0});
}

TEST(MitsubaTransform, MatricesMultiplyColumns) {
  expect_close(moved("<matrix value=\"0 -1 0 5  1 0 0 6  0 0 1 7  0 0 0 1\"/>", {1, 2, 3}),
               {3, 7, 10});
  expect_close(moved("<matrix value=\"0 -1 0  1 0 0  0 0 1\"/>", {1, 2, 3}), {-2, 1, 3});
}

TEST(MitsubaTransform, LookAtTurnsZToTheTargetAndXToTheLeft) {
  const std::string look = "<lookat origin=\"1, 2, 3\" target=\"1, 2, 0\" up=\"0, 1, 0\"/>";
  expect_close(moved(look, {0, 0, 0}), {1, 2, 3});
  expect_close(moved(look, {0, 0, 1}), {1, 2, 2});
  expect_close(moved(look, {0, 1, 0}), {1, 3, 3});
  // Who looks along -z has -x at the left.
  expect_close(moved(look, {1, 0, 0}), {0, 2, 3});
}

TEST(MitsubaTransform, AnimationsHaveAFirstAndALastKeyframe) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(
      "<shape type=\"sphere\"><animation name=\"toWorld\">"
      "<transform time=\"1\"><translate x=\"5\"/></transform>"
      "<transform time=\"0\"><translate x=\"2\"/></transform></animation></shape>\n");
  EXPECT_EQ(d.shapes[0].transform.start[3][0], 2);
  EXPECT_EQ(d.shapes[0].transform.end[3][0], 5);
}

TEST(MitsubaTransform, WrongOnesAreErrors) {
  MitsubaScene scene;
  const auto error = [&](const std::string& elements) {
    return scene.error("<shape type=\"disk\"><transform name=\"toWorld\">\n" + elements +
                       "</transform></shape>\n");
  };
  EXPECT_EQ(error("<scale value=\"0\"/>"),
            "scene.xml:3:1: <scale> has no inverse, expected a transform that can be inverted");
  EXPECT_EQ(error("<rotate angle=\"3\"/>"),
            "scene.xml:3:1: the axis of <rotate> is the zero vector, expected \"x\", \"y\" or "
            "\"z\" other than 0");
  EXPECT_EQ(error("<matrix value=\"1 2 3\"/>"),
            "scene.xml:3:1: <matrix> has 3 numbers, expected 16 or 9");
  EXPECT_EQ(error("<skew/>").substr(0, 45), "scene.xml:3:1: <skew> in a transform is unkno");
  EXPECT_EQ(error("<lookat origin=\"0,0,0\" target=\"0,0,0\"/>"),
            "scene.xml:3:1: <lookat> has its origin at its target, expected two points");
}

}  // namespace
}  // namespace nephroid::testing
