// Every integrator finds the same picture: means of blocks of pixels and of the whole picture, by
// t-tests over independent seeds. Photon integrators are extrapolated to a radius of zero. The
// scenes stand in scenes.cpp.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "agreement/scenes.h"
#include "measured_ggx.h"
#include "rendering.h"
#include "scene/camera/camera.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr int kAcross = 3, kSeeds = 32;
constexpr uint32_t kPhotonPasses = 6;

// The files that the scenes name: a smooth height field, a small coloured image and a measured
// reflection; gone with the object.
class SceneFiles {
 public:
  SceneFiles() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "nephroid-agreement-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw IoError("no temporary directory");
    directory_ = pattern;
    constexpr int kSize = 64;
    std::vector<float> waves, picture;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize,
                    v = (static_cast<float>(y) + 0.5f) / kSize;
        waves.push_back(0.02f * std::sin(12 * kPi * u) * std::sin(8 * kPi * v));
      }
    for (int i = 0; i < 64; ++i)
      for (const int period : {5, 3, 7}) picture.push_back(1.0f + static_cast<float>(i % period));
    write("/waves.pfm", "Pf", kSize, waves);
    write("/picture.pfm", "PF", 8, picture);
    const testing_measured::GgxSurface brushed{0.3f, 0.6f, 9, 1, 7, 24, 10, 2};
    std::ofstream(directory_ + "/brushed.bsdf", std::ios::binary)
        << testing_measured::bsdf_file_of(testing_measured::tables_of(brushed));
  }
  ~SceneFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }
  SceneFiles(const SceneFiles&) = delete;
  SceneFiles& operator=(const SceneFiles&) = delete;

  const std::string& directory() const { return directory_; }

 private:
  void write(const char* name, const char* kind, int size, const std::vector<float>& values) const {
    std::ofstream out(directory_ + name, std::ios::binary);
    out << kind << "\n" << size << ' ' << size << "\n-1.0\n";
    for (const float v : values) out.write(reinterpret_cast<const char*>(&v), sizeof v);
  }

  std::string directory_;
};

std::vector<double> whole(const SeedValues& blocks) {
  std::vector<double> values(blocks[0].size(), 0.0);
  for (const auto& block : blocks)
    for (size_t s = 0; s < block.size(); ++s)
      values[s] += block[s] / static_cast<double>(blocks.size());
  return values;
}

void expect_equal(const SeedValues& found, const SeedValues& reference, const std::string& what) {
  for (size_t i = 0; i < reference.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(reference[i]);
    EXPECT_NEAR(a.mean, b.mean, kT31 * std::hypot(a.error, b.error)) << what << ", block " << i;
  }
  const Estimate a = estimate_of(whole(found)), b = estimate_of(whole(reference));
  const double error = std::hypot(a.error, b.error);
  std::printf(
      "%-52s %.5f against %.5f: off by %+.2f %%, standard error %.2f %% (%.2f %% and %.2f %%)\n",
      what.c_str(), a.mean, b.mean, 100 * (a.mean / b.mean - 1), 100 * error / b.mean,
      100 * a.error / b.mean, 100 * b.error / b.mean);
  EXPECT_NEAR(a.mean, b.mean, kT31 * error) << what << ", whole picture";
  EXPECT_LT(error, 0.01 * b.mean) << what << " is too noisy to tell";
}

class Agreement : public ::testing::TestWithParam<AgreementScene> {};

TEST_P(Agreement, OfAllIntegrators) {
  const AgreementScene& description = GetParam();
  const SceneFiles files;
  const auto scene = scene_from_text(agreement_scene_text(description, files.directory()));
  IntegratorOptions options;
  options.max_depth = description.max_depth;
  options.photons_per_pass = description.photons;
  options.radius = description.radius;
  options.camera_samples_per_pass = 1;
  const std::string reference_name = description.reference;
  const SeedValues reference =
      reference_name == "path"
          ? block_values(*scene, "path", options, kSeeds, description.reference_passes, 1, kAcross)
          : unbiased_block_values(*scene, reference_name, options, kSeeds, kPhotonPasses, 1,
                                  kAcross);
  uint64_t first_seed = 1000;
  options.camera_samples_per_pass = 8;  // what the path tracer adds to few passes must not be noisy
  for (const std::string integrator : {"mixed", "sppm"}) {
    if (integrator == reference_name) continue;
    expect_equal(unbiased_block_values(*scene, integrator, options, kSeeds, kPhotonPasses,
                                       first_seed, kAcross),
                 reference, std::string(description.name) + ", " + integrator);
    first_seed += 1000;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, ::testing::ValuesIn(kAgreementScenes),
                         [](const auto& test) { return std::string(test.param.name); });

// The scene with bumps would agree as well if nothing were bumped.
TEST(AgreementScenes, TheBumpedGlassIsBumped) {
  const SceneFiles files;
  for (const AgreementScene& description : kAgreementScenes) {
    if (std::string(description.name) != "bumped_glass") continue;
    const auto scene = scene_from_text(agreement_scene_text(description, files.directory()));
    int bumped = 0;
    for (int y = 4; y < 8; ++y)
      for (int x = 4; x < 8; ++x) {
        SurfaceInteraction hit;
        const Vec2f film(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        ASSERT_TRUE(
            scene->intersect(scene->camera->generate_ray(film, Vec2f(0.5f, 0.5f), 0)->ray, hit));
        const Material& material = *scene->materials[static_cast<size_t>(hit.material)];
        if (!material.has_bump()) continue;
        material.bump(hit);
        bumped += dot(hit.shading.z, hit.ng) < 0.99f;  // eight degrees
      }
    EXPECT_GE(bumped, 4);
  }
}

}  // namespace
}  // namespace nephroid
