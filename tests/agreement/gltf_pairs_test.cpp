// Scenes of glTF and the same scenes written by hand in pbrt-v4's format: the same pictures, by
// t-tests of blocks (gltf/NAME.gltf, gltf/NAME.pbrt).
#include <gtest/gtest.h>

#include "input/scene_reader.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

struct Pair {
  const char* name;
  double time = 0;     ///< moment of the animations, s
  double shutter = 0;  ///< time from it for which the shutter is open, s
};

constexpr int kSide = 40, kGltfBlocks = 4, kGltfSeeds = 16, kGltfPasses = 24;

class GltfPair : public ::testing::TestWithParam<Pair> {};

std::unique_ptr<Scene> load(const std::string& name, const Pair& pair) {
  ImportOptions options;
  options.time = pair.time;
  options.shutter = pair.shutter;
  options.exposure = 0;
  Diagnostics diagnostics;
  const SceneDescription description =
      read_scene(source_directory() + "/tests/agreement/gltf/" + name, options, diagnostics);
  SceneOverrides overrides;
  overrides.width = overrides.height = kSide;
  return build_scene(description, overrides, diagnostics);
}

TEST_P(GltfPair, AgreesWithItsPbrtScene) {
  const std::string name = GetParam().name;
  const auto gltf = load(name + ".gltf", GetParam()), pbrt = load(name + ".pbrt", {});
  IntegratorOptions options;
  options.max_depth = 8;
  const SeedValues a =
      block_values(*gltf, "path", options, kGltfSeeds, kGltfPasses, 1, kGltfBlocks);
  const SeedValues b =
      block_values(*pbrt, "path", options, kGltfSeeds, kGltfPasses, 101, kGltfBlocks);
  ASSERT_EQ(a.size(), b.size());
  double sum = 0, error = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const Estimate x = estimate_of(a[i]), y = estimate_of(b[i]);
    const double s = std::hypot(x.error, y.error);
    EXPECT_LE(std::abs(x.mean - y.mean), kT31 * s + 1e-6)
        << "block " << i << ": " << x.mean << " and " << y.mean;
    sum += x.mean;
    error += s * s;
  }
  const double relative = std::sqrt(error) / sum;
  std::printf("%s: mean %.4f, relative error %.2f %%\n", name.c_str(), sum / double(a.size()),
              100 * relative);
  EXPECT_GT(sum, 0.01 * double(a.size()));
  EXPECT_LT(relative, max_error(0.01));
}

INSTANTIATE_TEST_SUITE_P(All, GltfPair,
                         ::testing::Values(Pair{"glass"}, Pair{"thin_glass"}, Pair{"rough_glass"},
                                           Pair{"metal"}, Pair{"coat"}, Pair{"textures"},
                                           Pair{"emissive"}, Pair{"skin", 1},
                                           Pair{"moving", 0.5, 1}, Pair{"lights"},
                                           Pair{"instances"}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
