// Every integrator finds the same picture: means of blocks of pixels by a t-test over independent seeds.
// Merged light is biased by its radius, and the bias falls with r^2, so photon integrators are
// extrapolated from two radii.
#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

struct AgreementScene {
  const char* name;
  const char* camera;
  const char* world;
};

constexpr char kCamera[] = R"(LookAt 0 1.5 -5  0 0.4 0  0 1 0 Camera "perspective" "float fov" 32)";
constexpr char kLensCamera[] =
    R"(LookAt 0 1.5 -5  0 0.4 0  0 1 0
       Camera "perspective" "float fov" 32 "float lensradius" 0.15 "float focaldistance" 4)";

constexpr char kRoom[] = R"(
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Material "diffuse" "rgb reflectance" [0 0 0]
    Translate 0 3 0 Rotate 90 1 0 0
    Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Shape "bilinearmesh" "point3 P" [-6 0 2.5  6 0 2.5  -6 6 2.5  6 6 2.5]
)";

const AgreementScene kScenes[] = {
    {"diffuse", kCamera, R"(Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {"glass", kCamera,
     R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)"},
    {"bumped_glass", kCamera,
     R"(Texture "waves" "float" "checkerboard" "float uscale" 6 "float vscale" 6
          "float tex1" 0.01 "float tex2" 0
        Material "dielectric" "float eta" 1.3 "texture displacement" "waves"
        Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)"},
    {"dispersive_glass", kCamera,
     R"(Material "dielectric" "spectrum eta" "glass-SF11" Translate 0 0.9 0
        Shape "sphere" "float radius" 0.6)"},
    {"mirror", kCamera,
     R"(Material "conductor" "float roughness" 0 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {"glossy_threshold", kCamera,
     R"(Material "conductor" "float roughness" 0.04 "bool remaproughness" false
        Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {"glossy", kCamera,
     R"(Material "conductor" "float roughness" 0.2 "bool remaproughness" false
        Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {"coated", kCamera,
     R"(Material "coateddiffuse" "rgb reflectance" [0.2 0.5 0.7] "float roughness" 0
        Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {"coated_conductor", kCamera,
     R"(Material "coatedconductor" "float interface.roughness" 0
        "float conductor.roughness" 0.2 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {"thin_lens", kLensCamera,
     R"(Material "dielectric" Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)"},
};

constexpr int kSize = 12, kBlock = 4, kBlocks = (kSize / kBlock) * (kSize / kBlock);
constexpr int kSeeds = 16;

// Means of the picture's blocks for one seed.
std::vector<double> blocks(const Film& film) {
  std::vector<double> sums(kBlocks, 0.0);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Rgb v = film.value(x, y);
      sums[static_cast<size_t>(y / kBlock * (kSize / kBlock) + x / kBlock)] +=
          (static_cast<double>(v.r) + v.g + v.b) / (3.0 * kBlock * kBlock);
    }
  return sums;
}

std::vector<Estimate> render_blocks(const Scene& scene, const std::string& integrator,
                                    const IntegratorOptions& options, uint32_t passes,
                                    uint64_t first_seed) {
  std::vector<std::vector<double>> values(kBlocks);
  for (int s = 0; s < kSeeds; ++s) {
    const auto b =
        blocks(render(scene, integrator, options, first_seed + static_cast<uint64_t>(s), passes));
    for (size_t i = 0; i < b.size(); ++i) values[i].push_back(b[i]);
  }
  std::vector<Estimate> out;
  for (const auto& v : values) out.push_back(estimate_of(v));
  return out;
}

class Agreement : public ::testing::TestWithParam<std::tuple<AgreementScene, std::string>> {};

TEST_P(Agreement, WithPathTracing) {
  const auto& [description, integrator] = GetParam();
  const auto scene = scene_from_text(std::string(description.camera) + R"(
    Film "rgb" "integer xresolution" 12 "integer yresolution" 12
    PixelFilter "box"
    Integrator "path" "integer maxdepth" 12
    WorldBegin
  )" + kRoom + description.world);
  IntegratorOptions options;
  options.max_depth = 12;
  const auto reference = render_blocks(*scene, "path", options, 256, 1);

  // Two radii, r^2 halved: 2 L(r^2/2) - L(r^2) has no bias of first order in r^2.
  options.photons_per_pass = 8192;
  options.radius = 0.5f;
  const auto large = render_blocks(*scene, integrator, options, 14, 100);
  options.radius = 0.5f * std::sqrt(0.5f);
  const auto small = render_blocks(*scene, integrator, options, 14, 200);
  double all_mean = 0, all_variance = 0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const double extrapolated = 2 * small[i].mean - large[i].mean;
    const double error = std::sqrt(4 * small[i].error * small[i].error +
                                   large[i].error * large[i].error +
                                   reference[i].error * reference[i].error);
    EXPECT_NEAR(extrapolated, reference[i].mean, kT15 * error)
        << "block " << i << " of " << description.name << ", " << integrator;
    all_mean += reference[i].mean;
    all_variance += error * error;
  }
  // The test must be able to see a few per cent of the picture.
  EXPECT_LT(std::sqrt(all_variance), 0.02 * all_mean);
}

INSTANTIATE_TEST_SUITE_P(AllIntegrators, Agreement,
                         ::testing::Combine(::testing::ValuesIn(kScenes),
                                            ::testing::Values("mixed", "sppm")),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) + "_" +
                                  std::get<1>(test.param);
                         });

}  // namespace
}  // namespace nephroid
