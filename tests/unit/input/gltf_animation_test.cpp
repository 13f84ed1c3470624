// Animations, skins and morph targets of glTF at a moment.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/input/gltf_text.h"

namespace nephroid::testing {
namespace {

/// A triangle whose node moves by one track over two seconds.
struct MovingTriangle {
  TriangleScene t;
  std::string path = "translation", mode = "LINEAR", type = "VEC3";
  std::vector<float> times = {0, 2};
  std::vector<float> outputs = {0, 0, 0, 4, 0, 0};
  size_t width = 3;

  std::string text() {
    const size_t input = t.file.floats(times, "SCALAR", 1);
    const size_t output = t.file.floats(outputs, type, width);
    return t.file.text(t.members(fmt::format(
        R"(,"animations":[{{"channels":[{{"sampler":0,"target":{{"node":0,"path":"{}"}}}}],)"
        R"("samplers":[{{"input":{},"output":{},"interpolation":"{}"}}]}}])",
        path, input, output, mode)));
  }
};

TransformDescription transform_at(const std::string& text, double time, double shutter = 0) {
  ImportOptions options;
  options.time = time;
  options.shutter = shutter;
  return read_gltf_text(text, options).scene.shapes.at(0).transform;
}
double x_at(const std::string& text, double time) {
  return transform_at(text, time).start[3][0];
}

TEST(GltfAnimation, LinearTracksAndTheirEnds) {
  const std::string text = MovingTriangle().text();
  EXPECT_NEAR(x_at(text, 0.5), 1, 1e-6);
  EXPECT_NEAR(x_at(text, -1), 0, 1e-6);
  EXPECT_NEAR(x_at(text, 9), 4, 1e-6);
}

TEST(GltfAnimation, TheShutterGivesTwoTransforms) {
  const TransformDescription moving = transform_at(MovingTriangle().text(), 0.5, 0.25);
  EXPECT_NEAR(moving.start[3][0], 1, 1e-6);
  EXPECT_NEAR(moving.end[3][0], 1.5, 1e-6);
}

TEST(GltfAnimation, AreListedWithTheirTimes) {
  MovingTriangle m;
  m.times = {0.5, 2};
  const std::string text = m.text();
  const auto read_at = [&](double time) {
    ImportOptions options;
    options.time = time;
    return read_gltf_text(text, options);
  };
  const ReadScene within = read_at(2);
  EXPECT_EQ(within.scene.choices.animations, std::vector<std::string>{"animation 0, 0.5 to 2 s"});
  EXPECT_TRUE(within.warnings.empty());
  const ReadScene after = read_at(3);
  ASSERT_EQ(after.warnings.size(), 1u);
  EXPECT_EQ(after.warnings[0].message,
            "--at: 3 s is after the end of all animations (animation 0, 0.5 to 2 s), their last "
            "moments are shown");
}

TEST(GltfAnimation, NodesWithAMatrixStandStillWithAWarning) {
  MovingTriangle m;
  m.t.node_members = R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1])";
  const ReadScene read = read_gltf_text(m.text());
  EXPECT_EQ(read.scene.shapes.at(0).transform.start[3][0], 5);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_NE(read.warnings[0].message.find("the node has a matrix"), std::string::npos);
}

TEST(GltfAnimation, Steps) {
  MovingTriangle m;
  m.mode = "STEP";
  const std::string text = m.text();
  EXPECT_EQ(x_at(text, 1.9), 0);
  EXPECT_EQ(x_at(text, 2), 4);
}

TEST(GltfAnimation, CubicSplinesAreHermite) {
  MovingTriangle m;
  m.mode = "CUBICSPLINE";
  // In-tangent, value, out-tangent: from 0 with slope 3 to 4 with slope -1.
  m.outputs = {0, 0, 0, 0, 0, 0, 3, 0, 0, -1, 0, 0, 4, 0, 0, 0, 0, 0};
  const double t = 0.25, p1 = 4, m0 = 2 * 3, m1 = 2 * -1;
  const double expected = (t * t * t - 2 * t * t + t) * m0 + (3 * t * t - 2 * t * t * t) * p1 +
                          (t * t * t - t * t) * m1;
  EXPECT_NEAR(x_at(m.text(), 0.5), expected, 1e-6);
}

TEST(GltfAnimation, RotationsTakeTheShorterArcAtConstantSpeed) {
  MovingTriangle m;
  m.path = "rotation";
  m.type = "VEC4";
  m.width = 4;
  const auto half = static_cast<float>(std::sqrt(0.5));
  // A quarter turn about z; the second quaternion is written with the other sign.
  m.outputs = {0, 0, 0, 1, 0, 0, -half, -half};
  const Mat44d at = transform_at(m.text(), 2.0 / 3.0).start;
  EXPECT_NEAR(std::atan2(at[0][1], at[0][0]), 3.14159265358979 / 6, 1e-6);
}

TEST(GltfAnimation, DamagedTracksAreErrors) {
  MovingTriangle backwards;
  backwards.times = {2, 0};
  EXPECT_EQ(gltf_error(backwards.text()),
            "scene.gltf#/animations/0/samplers/0: the times of keyframes are missing or not in "
            "increasing order, expected increasing ones");
  MovingTriangle few;
  few.outputs = {1, 2, 3};
  EXPECT_NE(gltf_error(few.text()), "");
  MovingTriangle mode;
  mode.mode = "BEZIER";
  EXPECT_NE(gltf_error(mode.text()).find("unknown interpolation"), std::string::npos);
  MovingTriangle path;
  path.path = "colour";
  EXPECT_NE(gltf_error(path.text()).find("unknown path"), std::string::npos);
}

TEST(GltfMorph, TargetsAreAddedByTheirWeights) {
  TriangleScene t;
  const size_t a = t.file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const size_t b = t.file.vec3({8, 0, 0, 0, 0, 0, 0, 0, 0});
  t.primitive_members = fmt::format(R"(,"targets":[{{"POSITION":{}}},{{"POSITION":{}}}])", a, b);
  t.node_members = R"(,"weights":[0.5,0.25])";
  const ReadScene read = read_gltf_text(t.file.text(t.members()));
  EXPECT_EQ(numbers_of(read.scene.shapes.at(0).parameters, "P"),
            (std::vector<double>{2, 0, 0.5, 1, 0, 0.5, 0, 1, 0.5}));
}

TEST(GltfMorph, TargetsOfOtherAttributesAreWarnings) {
  TriangleScene t;
  const size_t zeros = t.file.vec3({0, 0, 0, 0, 0, 0, 0, 0, 0});
  t.primitive_members =
      fmt::format(R"(,"targets":[{{"POSITION":{0},"TEXCOORD_1":0,"COLOR_0":{0}}}])", zeros);
  t.node_members = R"(,"weights":[0.5])";
  const std::vector<Warning> warnings = read_gltf_text(t.file.text(t.members())).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].message.find("COLOR_0"), std::string::npos);
  EXPECT_NE(warnings[1].message.find("TEXCOORD_1"), std::string::npos);
}

TEST(GltfMorph, AnimatedWeightsWin) {
  MovingTriangle m;
  const size_t target = m.t.file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  m.t.primitive_members = fmt::format(R"(,"targets":[{{"POSITION":{}}}])", target);
  m.t.node_members = R"(,"weights":[0.5])";
  m.path = "weights";
  m.type = "SCALAR";
  m.width = 1;
  m.outputs = {0, 1};
  ImportOptions options;
  options.time = 1.5;
  const ReadScene read = read_gltf_text(m.text(), options);
  EXPECT_EQ(numbers_of(read.scene.shapes.at(0).parameters, "P")[2], 0.75);
}

/// A triangle between two joints: node 1 at the origin and node 2, which is turned about z.
std::string skinned(const std::string& joints = "1,2", const std::string& skin_members = "") {
  TriangleScene t;
  const size_t numbers =
      t.file.add_accessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4", 5121, 4);
  const size_t weights = t.file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4", 4);
  t.attributes = fmt::format(R"(,"JOINTS_0":{},"WEIGHTS_0":{})", numbers, weights);
  t.node_members =
      R"(,"skin":0,"translation":[100,0,0]},{"translation":[0,0,1]},{"rotation":[0,0,0.70710678118654752,0.70710678118654752])";
  return t.file.text(t.members(R"(,"skins":[{"joints":[)" + joints + "]" + skin_members + "}]"));
}

TEST(GltfSkin, JointsMoveVerticesAndTheNodeDoesNot) {
  const ReadScene read = read_gltf_text(skinned());
  const std::vector<double> p = numbers_of(read.scene.shapes.at(0).parameters, "P");
  const std::vector<double> expected = {0, 0, 1, 0, 1, 0, -0.5, 0.5, 0.5};
  ASSERT_EQ(p.size(), 9u);
  for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(p[i], expected[i], 1e-6) << i;
  EXPECT_EQ(read.scene.shapes[0].transform.start, Mat44d());
}

TEST(GltfSkin, MirroredJointsKeepTheOutsideOutside) {
  TriangleScene t;
  const size_t joints = t.file.add_accessor<uint8_t>(std::vector<uint8_t>(12, 0), "VEC4", 5121, 4);
  const size_t weights = t.file.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  const size_t normals = t.file.vec3({0, 0, 1, 0.6f, 0, 0.8f, 0, 0, 1});
  t.attributes =
      fmt::format(R"(,"JOINTS_0":{},"WEIGHTS_0":{},"NORMAL":{})", joints, weights, normals);
  t.node_members = R"(,"skin":0},{"scale":[-2,1,1])";
  const ReadScene read = read_gltf_text(t.file.text(t.members(R"(,"skins":[{"joints":[1]}])")));
  const ParameterSet& p = read.scene.shapes.at(0).parameters;
  EXPECT_EQ(numbers_of(p, "P")[3], -2);
  EXPECT_EQ(numbers_of(p, "indices"), (std::vector<double>{0, 2, 1}));
  const std::vector<double> n = numbers_of(p, "N");
  ASSERT_EQ(n.size(), 9u);
  EXPECT_NEAR(n[2], 1, 1e-6);
  // The inverse transposed: (0.6 / -2, 0, 0.8) with the length 1.
  EXPECT_NEAR(n[3] / n[5], -0.3 / 0.8, 1e-6);
  EXPECT_GT(n[5], 0);
}

TEST(GltfSkin, DamagedSkinsAreErrors) {
  EXPECT_NE(gltf_error(skinned("1")).find("joint 1 is out of range, the skin has 1"),
            std::string::npos);
  EXPECT_NE(gltf_error(skinned("1,9")).find("index 9 into \"nodes\" is out of range"),
            std::string::npos);
  EXPECT_NE(gltf_error(skinned("")).find("a skin has no joints"), std::string::npos);
  EXPECT_NE(gltf_error(skinned("1,2", R"(,"inverseBindMatrices":0)")), "");
}

}  // namespace
}  // namespace nephroid::testing
