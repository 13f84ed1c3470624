// White furnace: if everything reflects all light and light arrives from everywhere, the radiance
// is 1 everywhere. Each integrator and preset must find it within its own noise. Merging estimators
// are extrapolated to a radius of zero.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "integrator/metropolis/metropolis_options.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/photon_mapping/ppm.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

struct FurnaceScene {
  const char* name;
  const char* objects;
  double lost = 0;     ///< share of light lost in a material that cannot be quite white
  double photons = 1;  ///< photons, relative to the other scenes; fewer if most are seen
};

// WALL: a white wall behind the objects, its edge out of view. BALL: a smooth ball of few
// triangles.
constexpr char kWall[] = R"(
  Material "diffuse" "spectrum reflectance" [300 1 900 1]
  AttributeBegin Translate 0 0 1.2 Shape "disk" "float radius" 3 AttributeEnd
)";
constexpr char kBall[] = R"(Shape "loopsubdiv" "integer levels" 3
  "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
  "point3 P" [1.2 0 0  -1.2 0 0  0 1.2 0  0 -1.2 0  0 0 1.2  0 0 -1.2])";

const FurnaceScene kScenes[] = {
    {"diffuse", R"(Material "diffuse" "spectrum reflectance" [300 1 900 1]
                   Shape "sphere" "float radius" 1)",
     0, 0.25},
    {"glass", R"(Material "dielectric" Shape "sphere" "float radius" 1)", 0, 0.25},
    // Microfacets shadow each other, and light between them is lost.
    {"rough_glass_before_wall",
     R"(WALL Material "dielectric" "float roughness" 0.02 "bool remaproughness" false
        Shape "sphere" "float radius" 0.7)",
     5e-3},
    {"glass_before_wall", R"(WALL Material "dielectric" Shape "sphere" "float radius" 0.7)"},
    {"thin_glass_before_wall", R"(WALL Material "thindielectric" Shape "disk" "float radius" 0.9)"},
    // A conductor of reflectance 1 has a large but finite complex index: it absorbs a few parts in
    // ten thousand at each reflection.
    {"mirror_before_wall",
     R"(WALL Material "conductor" "spectrum reflectance" [300 1 900 1] "float roughness" 0
        Shape "sphere" "float radius" 0.7)",
     1e-3},
    {"interface_around_diffuse",
     R"(Material "diffuse" "spectrum reflectance" [300 1 900 1]
        Shape "sphere" "float radius" 0.6
        Material "interface" Shape "sphere" "float radius" 1.1)",
     0, 0.25},
    {"translucent_sheet_behind_glass",
     R"(Material "dielectric" Shape "sphere" "float radius" 0.7
        Material "diffusetransmission" "spectrum reflectance" [300 0.6 900 0.6]
          "spectrum transmittance" [300 0.4 900 0.4]
        Translate 0 0 1.2 Shape "disk" "float radius" 3)"},
    {"half_there_behind_glass",
     R"(Material "dielectric" Shape "sphere" "float radius" 0.7
        Material "diffuse" "spectrum reflectance" [300 1 900 1]
        Translate 0 0 1.2 Shape "disk" "float radius" 3 "float alpha" 0.5)"},
    {"half_interface_behind_glass",
     R"(MakeNamedMaterial "white" "string type" "diffuse" "spectrum reflectance" [300 1 900 1]
        MakeNamedMaterial "gap" "string type" "interface"
        Material "dielectric" Shape "sphere" "float radius" 0.7
        Material "mix" "string materials" ["white" "gap"] "float amount" 0.4
        Translate 0 0 1.2 Shape "disk" "float radius" 3)"},
    {"half_glass_half_diffuse",
     R"(MakeNamedMaterial "white" "string type" "diffuse" "spectrum reflectance" [300 1 900 1]
        MakeNamedMaterial "pane" "string type" "thindielectric"
        WALL Material "mix" "string materials" ["white" "pane"] "float amount" 0.6
        Shape "disk" "float radius" 0.9)"},
    {"hair_before_wall",
     R"(WALL Material "hair" "rgb sigma_a" [0 0 0] Shape "curve" "string type" "cylinder"
        "float width" 0.3 "point3 P" [-1.2 -1 0  -0.5 2 0.5  0.6 -2 -0.5  1.3 1 0])"},
    // Shading normals send a little light into the ball, where it may stay.
    {"smooth_mesh", R"(Material "diffuse" "spectrum reflectance" [300 1 900 1] BALL)", 3e-3, 0.25},
    {"instance_behind_glass",
     R"(ObjectBegin "ball" Material "diffuse" "spectrum reflectance" [300 1 900 1] BALL ObjectEnd
        AttributeBegin Translate 0.2 0 1.5 Scale 1.6 1.3 0.8 ObjectInstance "ball" AttributeEnd
        Material "dielectric" Translate 0 0 -0.8 Shape "sphere" "float radius" 0.7)",
     3e-3, 0.25},
};

std::string furnace_text(const FurnaceScene& furnace) {
  std::string objects = furnace.objects;
  const auto fill_in = [&objects](const std::string& placeholder, const std::string& text) {
    if (const size_t at = objects.find(placeholder); at != std::string::npos)
      objects.replace(at, placeholder.size(), text);
  };
  fill_in("WALL", kWall);
  fill_in("BALL", kBall);
  return R"(
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective" "float fov" 30
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    PixelFilter "box"
    WorldBegin
    LightSource "infinite" "spectrum L" [300 1 900 1] "float scale" 1
    )" + objects;
}

class Furnace : public ::testing::TestWithParam<std::tuple<FurnaceScene, std::string>> {};

/// The view of the light alone: the constant spectrum has Y = 1 but is not sRGB white. Shared by
/// all rows.
const Estimate& light_alone() {
  static const Estimate estimate =
      mean_over_seeds(*scene_from_text(furnace_text({"empty", ""})), "path", {}, 16, 64, 1000);
  return estimate;
}

/// Passes that reduce the standard error to a few parts in a thousand.
uint32_t passes_of(const std::string& plan) {
  if (plan == "vcm") return 12;
  if (merges_photons(plan_named(plan))) return 8;
  if (plan == "pssmlt") return 4;
  if (plan == "light-only") return 16;
  if (plan == "mlt") return 24;
  return plan == "bdpt" ? 32 : 64;
}

TEST_P(Furnace, RadianceIsOne) {
  const auto& [furnace, plan] = GetParam();
  const auto scene = scene_from_text(furnace_text(furnace));
  IntegratorOptions options;
  // Plans in which photons carry nearly all light need many.
  const bool mostly_photons =
      plan == "sppm" || plan == "ppm" || plan == "bpm" || plan == "all-photons";
  options.photons_per_pass =
      static_cast<int64_t>(furnace.photons * (mostly_photons ? 16384 : 8192));
  options.radius = 1.0f;
  options.edit<PhotonMapOptions>().nearest_photons = kAllPhotons;
  options.edit<PpmOptions>().hit_points = 16;
  options.edit<MetropolisOptions>().mutations = 48;
  options.edit<MetropolisOptions>().large_step = 0.5f;
  uint32_t passes = passes_of(plan);
  use_whole_maps(plan_named(plan), options, passes);
  const Estimate e = estimate_of(unbiased_block_values(*scene, plan, options, 16, passes, 1)[0]);
  const Estimate& expected = light_alone();
  std::printf("%s, %s: off by %+.3f %%, standard error %.3f %%\n", furnace.name, plan.c_str(),
              100 * (e.mean / expected.mean - 1), 100 * e.error / expected.mean);
  EXPECT_NEAR(expected.mean, 1.0, 0.15);
  const double error = std::hypot(e.error, expected.error);
  EXPECT_LE(e.mean, expected.mean + kT15 * error + 1e-4);
  EXPECT_GE(e.mean, expected.mean * (1 - furnace.lost) - kT15 * error - 1e-4);
  EXPECT_LT(error, max_error(0.01 * expected.mean)) << "the estimate is too noisy to tell";
}

// Fibres that absorb nothing are invisible as well. No photons are merged on hair, so only path
// tracing is tested.
TEST(HairFurnace, RadianceIsOne) {
  std::string curls = "Material \"hair\" \"rgb sigma_a\" [0 0 0]\n";
  for (const char* type : {"flat", "cylinder", "ribbon"})
    curls += std::string(R"(Translate -0.1 0.1 0.2 Shape "curve" "float width" 0.3 "point3 P" [
             -1.2 -1 0  -0.5 2 0.5  0.6 -2 -0.5  1.3 1 0] "string type" ")") +
             type + (std::string(type) == "ribbon" ? "\" \"normal N\" [0 0 1 0 1 1]\n" : "\"\n");
  const auto scene = scene_from_text(furnace_text({"hair", curls.c_str()}));
  const Estimate e = mean_over_seeds(*scene, "path", {}, 16, 64);
  const Estimate& expected = light_alone();
  const double error = std::hypot(e.error, expected.error);
  EXPECT_NEAR(e.mean, expected.mean, kT15 * error + 1e-3);
  EXPECT_LT(error, max_error(0.01 * expected.mean));
  // Dark hair is visible.
  curls.replace(curls.find("[0 0 0]"), 7, "[9 9 9]");
  const auto dark = scene_from_text(furnace_text({"dark", curls.c_str()}));
  EXPECT_LT(mean_over_seeds(*dark, "path", {}, 16, 16).mean, 0.95 * expected.mean);
}

// The first plan with a given set of estimators is tested in all scenes. Other plans with that set
// differ only in how they divide the paths: these scenes have paths of every kind.
const char* const kScenesOfRoutes[] = {"glass_before_wall", "half_glass_half_diffuse"};

std::vector<std::tuple<FurnaceScene, std::string>> furnace_rows() {
  std::vector<std::tuple<FurnaceScene, std::string>> rows;
  std::set<std::set<const EstimatorTraits*>> tested;
  for (const std::string& plan : plan_names()) {
    std::set<const EstimatorTraits*> estimators;
    for (const RouteDefinition& route : plan_named(plan).routes) estimators.insert(route.estimator);
    const bool first = tested.insert(estimators).second;
    for (const FurnaceScene& scene : kScenes)
      if (first || std::any_of(std::begin(kScenesOfRoutes), std::end(kScenesOfRoutes),
                               [&](const char* name) { return name == std::string(scene.name); }))
        rows.emplace_back(scene, plan);
  }
  return rows;
}

TEST(FurnaceRows, HaveEveryPlanInTheScenesOfRoutesAndEveryEstimatorInAll) {
  std::set<const EstimatorTraits*> everywhere;
  std::map<std::string, size_t> scenes_of_plan;
  for (const auto& [scene, plan] : furnace_rows()) ++scenes_of_plan[plan];
  EXPECT_EQ(scenes_of_plan.size(), plan_names().size());
  for (const auto& [plan, count] : scenes_of_plan) {
    EXPECT_GE(count, std::size(kScenesOfRoutes)) << plan;
    if (count == std::size(kScenes))
      for (const RouteDefinition& route : plan_named(plan).routes)
        everywhere.insert(route.estimator);
  }
  for (const std::string& plan : plan_names())
    for (const RouteDefinition& route : plan_named(plan).routes)
      EXPECT_TRUE(everywhere.contains(route.estimator)) << route.estimator->name;
}

INSTANTIATE_TEST_SUITE_P(AllRoutes, Furnace, ::testing::ValuesIn(furnace_rows()),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) + "_" +
                                  test_name(std::get<1>(test.param));
                         });

}  // namespace
}  // namespace nephroid
