// Files that other programs wrote (gltf_files/make.mjs): three.js's exporter, and the ball of
// tests/agreement/gltf/metal.gltf packed by gltf-transform in three ways, in tests/regression.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "input/gltf/gltf_reader.h"
#include "source_directory.h"
#include "unit/input/gltf_text.h"

namespace nephroid::testing {
namespace {

SceneDescription read_file(const std::string& name, Diagnostics& diagnostics) {
  return read_gltf(testing_support::source_directory() + "/tests/" + name, {}, diagnostics);
}

class PackedBall : public ::testing::TestWithParam<const char*> {};

TEST_P(PackedBall, IsTheUnitBallAtItsPlace) {
  Diagnostics diagnostics;
  const std::string name = GetParam();
  const SceneDescription scene = read_file("regression/features/" + name + ".glb", diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  ASSERT_TRUE(scene.camera);
  size_t balls = 0;
  for (const ShapeDescription& shape : scene.shapes) {
    const std::vector<double> p = numbers_of(shape.parameters, "P");
    const std::vector<double> indices = numbers_of(shape.parameters, "indices");
    if (indices.size() != 240) continue;
    ++balls;
    EXPECT_EQ(p.size(), 3 * 42u);
    const std::vector<double> n = numbers_of(shape.parameters, "N");
    ASSERT_EQ(n.size(), p.size());
    for (size_t i = 0; i < p.size(); i += 3) {
      Vec3d world;
      shape.transform.start.multVecMatrix(Vec3d(p[i], p[i + 1], p[i + 2]), world);
      const Vec3d from_center = world - Vec3d(0, 1, 0);
      EXPECT_NEAR(from_center.length(), 1, 2e-3);
      EXPECT_GT(from_center.normalized().dot(Vec3d(n[i], n[i + 1], n[i + 2]).normalized()), 0.999);
    }
    // Each edge has a triangle on both sides, in opposite directions.
    std::multiset<std::pair<double, double>> edges;
    for (size_t t = 0; t < indices.size(); t += 3)
      for (size_t k = 0; k < 3; ++k) edges.insert({indices[t + k], indices[t + (k + 1) % 3]});
    for (const auto& [a, b] : edges) {
      EXPECT_EQ(edges.count({a, b}), 1u);
      EXPECT_EQ(edges.count({b, a}), 1u);
    }
  }
  EXPECT_EQ(balls, 1u);
}

INSTANTIATE_TEST_SUITE_P(All, PackedBall,
                         ::testing::Values("KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                           "KHR_mesh_quantization"),
                         [](const auto& test) { return std::string(test.param); });

TEST(GltfExporters, DracoObeysTheAccessorsNormalisation) {
  Diagnostics diagnostics;
  const SceneDescription scene = read_file("unit/input/gltf_files/colors_draco.glb", diagnostics);
  const ParameterSet& parameters = scene.shapes.at(0).parameters;
  const std::vector<double> p = numbers_of(parameters, "P");
  const std::vector<double> colors = numbers_of(parameters, "vertexcolors");
  ASSERT_EQ(p.size(), 9u);
  ASSERT_EQ(colors.size(), 12u);
  for (size_t i = 0; i < 3; ++i) {
    const bool is_second = p[3 * i] > 0.5, is_third = p[3 * i + 1] > 0.5;
    EXPECT_NEAR(colors[4 * i], is_second || is_third ? 0 : 1, 1e-6);
    EXPECT_NEAR(colors[4 * i + 1], is_second ? 1 : 0, 1e-6);
    EXPECT_NEAR(colors[4 * i + 2], is_third ? 0.2 : 0, 1e-6);
    EXPECT_NEAR(colors[4 * i + 3], is_third ? 0.2 : 1, 1e-6);
  }
}

TEST(GltfExporters, ThreeJs) {
  Diagnostics diagnostics;
  const SceneDescription scene = read_file("unit/input/gltf_files/three.gltf", diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  ASSERT_EQ(scene.shapes.size(), 2u);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "glass");
  EXPECT_EQ(number_of(scene.materials[0].parameters, "specular_ior"), 1.4);
  EXPECT_EQ(scene.shapes[0].inside_medium, scene.media.at(0).name);
  EXPECT_EQ(number_of(scene.materials[1].parameters, "coat_weight"), 0.7);
  EXPECT_EQ(number_of(scene.materials[1].parameters, "thin_film_weight"), 0.5);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, "spot");
  ASSERT_TRUE(scene.camera);
  EXPECT_NEAR(number_of(scene.camera->parameters, "fov"), 40, 1e-6);
}

}  // namespace
}  // namespace nephroid::testing
