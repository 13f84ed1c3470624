// Every integrator and every estimator that a route may name finds the same picture. T-tests over
// independent seeds compare means of blocks and of the whole picture. Merging estimators are
// extrapolated to a radius of zero. The scenes are in scenes.cpp.
#include <gtest/gtest.h>

#include "agreement/scene_assets.h"
#include "agreement/scenes.h"
#include "integrator/path/path_options.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/photon_mapping/ppm.h"
#include "rendering.h"
#include "scene/camera/camera.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr int kAgreementAcross = 3, kAgreementSeeds = 32, kSeedsOfRoutes = 16;

void expect_equal(const SeedValues& found, const SeedValues& reference, const std::string& what,
                  double noise_limit) {
  const double quantile = reference[0].size() >= kAgreementSeeds ? kT31 : kT15;
  for (size_t i = 0; i < reference.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(reference[i]);
    EXPECT_NEAR(a.mean, b.mean, quantile * std::hypot(a.error, b.error)) << what << ", block " << i;
  }
  const Estimate a = estimate_of(mean_of_blocks(found)), b = estimate_of(mean_of_blocks(reference));
  const double error = std::hypot(a.error, b.error);
  std::printf(
      "%-52s %.5f against %.5f: off by %+.2f %%, standard error %.2f %% (%.2f %% and %.2f %%)\n",
      what.c_str(), a.mean, b.mean, 100 * (a.mean / b.mean - 1), 100 * error / b.mean,
      100 * a.error / b.mean, 100 * b.error / b.mean);
  EXPECT_NEAR(a.mean, b.mean, quantile * error) << what << ", whole picture";
  EXPECT_LT(error, max_error(noise_limit * b.mean)) << what << " is too noisy to tell";
}

IntegratorOptions options_for(const AgreementScene& description) {
  IntegratorOptions options;
  options.max_depth = description.max_depth;
  options.photons_per_pass = description.photons;
  options.radius = description.radius;
  options.camera_samples_per_pass = 1;
  options.edit<PpmOptions>().hit_points = 4;
  options.edit<PhotonMapOptions>().nearest_photons = kAllPhotons;
  return options;
}

SeedValues reference_values(const Scene& scene, const AgreementScene& description,
                            const IntegratorOptions& options, int seeds, uint32_t passes) {
  const std::string name = description.reference;
  return name == "path"
             ? block_values(scene, name, options, seeds, description.reference_passes * passes, 1,
                            kAgreementAcross)
             : unbiased_block_values(scene, name, options, seeds, passes, 1, kAgreementAcross);
}

class Agreement : public ::testing::TestWithParam<AgreementScene> {};

TEST_P(Agreement, OfAllIntegrators) {
  const AgreementScene& description = GetParam();
  const SceneAssets files;
  const auto scene = scene_from_text(agreement_scene_text(description, files.directory()));
  IntegratorOptions options = options_for(description);
  const SeedValues reference =
      reference_values(*scene, description, options, kAgreementSeeds, description.passes);
  uint64_t first_seed = 1000;
  options.camera_samples_per_pass = 8;  // keeps the path-traced part of few passes from being noisy
  for (const std::string integrator : {"mixed", "sppm", "bdpt"}) {
    if (integrator == description.reference) continue;
    options.edit<PathOptions>().specular_trees = integrator == "bdpt";
    expect_equal(unbiased_block_values(*scene, integrator, options, kAgreementSeeds,
                                       description.passes, first_seed, kAgreementAcross),
                 reference, std::string(description.name) + ", " + integrator, 0.01);
    first_seed += 1000;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, ::testing::ValuesIn(kAgreementScenes),
                         [](const auto& test) { return std::string(test.param.name); });

// Routes that the integrators above do not have: light tracing, photons that are both merged and
// connected, virtual point lights, and guided path tracing.
struct RoutesToCompare {
  const char* name;
  Plan plan;
};

std::vector<RoutesToCompare> routes_to_compare() {
  return {{"doidge2012", "doidge2012"},
          {"split", "split"},
          {"vertex", "vertex"},
          {"light-only", "light-only"},
          {"ppm", "ppm"},
          {"photonmap", "photonmap"},
          {"photonmap-direct", "photonmap-direct"},
          {"forecast", "forecast"},
          {"all-point-lights",
           plan_of({"caustic=C[SV]*[DG]S+L:photons", "all=.*:pointlights", "rest=.*:path"})},
          {"all-vertex", plan_of({"emission=C([SV]*L|.*M|.*H.*L):path", "rest=.*:photons+light"})}};
}

// The scenes in which these routes have code of their own. The others would test nothing new.
const char* const kScenesOfRoutes[] = {"subsurface",
                                       "rough_subsurface",
                                       "subsurface_curve",
                                       "tea",
                                       "fog",
                                       "glowing_gas",
                                       "cut_out_container",
                                       "half_hair",
                                       "hair",
                                       "dispersive_glass",
                                       "glossy_threshold",
                                       "thin_lens",
                                       "half_there_sheet_below_glass",
                                       "half_interface_sheet_below_glass",
                                       "mixed_receiver",
                                       "point_light_and_glass",
                                       "sky_and_glass",
                                       "moving_glass",
                                       "moving_receiver",
                                       "orthographic"};

std::vector<AgreementScene> scenes_of_routes() {
  std::vector<AgreementScene> scenes;
  for (const char* name : kScenesOfRoutes)
    for (const AgreementScene& scene : kAgreementScenes)
      if (scene.name == std::string(name)) scenes.push_back(scene);
  return scenes;
}

TEST(AgreementScenes, HaveTheNamesThatRoutesAreComparedOn) {
  EXPECT_EQ(scenes_of_routes().size(), std::size(kScenesOfRoutes));
}

class RoutesAgree : public ::testing::TestWithParam<AgreementScene> {};

TEST_P(RoutesAgree, WithTheReference) {
  const AgreementScene& description = GetParam();
  const SceneAssets files;
  const auto scene = scene_from_text(agreement_scene_text(description, files.directory()));
  IntegratorOptions options = options_for(description);
  const SeedValues reference =
      reference_values(*scene, description, options, kSeedsOfRoutes, kFewPasses);
  uint64_t first_seed = 1000;
  options.camera_samples_per_pass = 8;
  for (const RoutesToCompare& routes : routes_to_compare()) {
    if (std::any_of(description.left_out.begin(), description.left_out.end(),
                    [&](const LeftOut& l) { return routes.name == std::string(l.routes); }))
      continue;
    IntegratorOptions own = options;
    uint32_t passes = routes.name == std::string("ppm") ? description.passes_of_ppm : kFewPasses;
    use_whole_maps(routes.plan, own, passes);
    expect_equal(unbiased_block_values(*scene, routes.plan, own, kSeedsOfRoutes, passes, first_seed,
                                       kAgreementAcross),
                 reference, std::string(description.name) + ", " + routes.name, 0.02);
    first_seed += 1000;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RoutesAgree, ::testing::ValuesIn(scenes_of_routes()),
                         [](const auto& test) { return std::string(test.param.name); });

// Without this check the bump scene would agree even if nothing were bumped.
TEST(AgreementScenes, TheBumpedGlassIsBumped) {
  const SceneAssets files;
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
        bumped += dot(hit.shading.z, hit.ng) < 0.99f;  // more than eight degrees
      }
    EXPECT_GE(bumped, 4);
  }
}

}  // namespace
}  // namespace nephroid
