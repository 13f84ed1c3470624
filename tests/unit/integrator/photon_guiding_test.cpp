// Guiding before any light path is traced. Casters are the ends of specular runs that start at a
// rough vertex. A small object in a large scene is found at once.
#include "integrator/learning/photon_guiding.h"

#include <gtest/gtest.h>

#include "estimators.h"
#include "integrator/learning/visible_points.h"
#include "owned_routes.h"
#include "photon/emission.h"
#include "rendering.h"
#include "scene/camera/camera.h"

namespace nephroid {
namespace {

using namespace testing_support;

const std::string kGuidedView = R"(
  LookAt 0 3 -4  0 0 0  0 1 0
  Camera "perspective" "float fov" 30
  Film "rgb" "integer xresolution" 64 "integer yresolution" 64
  PixelFilter "box"
  WorldBegin
  LightSource "point" "rgb I" [900 900 900] "point3 from" [20 60 -10]
  Material "diffuse"
  Shape "bilinearmesh" "point3 P" [-90 0 -90  90 0 -90  -90 0 90  90 0 90])";
const std::string kGuidedGlass = R"(
  AttributeBegin Translate 0 0.4 0
    Material "dielectric" Shape "sphere" "float radius" 0.3 AttributeEnd)";
const std::string kMirrorBehindTheEye = R"(
  Material "conductor" "float roughness" 0
  Shape "bilinearmesh" "point3 P" [-2 0 -6  2 0 -6  -2 4 -6  2 4 -6])";

std::vector<Vec3f> casters_of(const std::string& text, const IntegratorOptions& options = {}) {
  const auto scene = scene_from_text(text);
  const EstimatorSet set = make_estimators(Plan("doidge2012"), options, *scene);
  const Film film = film_for(*scene, set);
  const PhotonPass pass = start_photon_pass({1, 0}, *scene, film.format(), options);
  return caustic_casters(*scene, film.format(), pass, options).points;
}

TEST(CausticCasters, AreWhatSpecularRunsEndOn) {
  EXPECT_TRUE(casters_of(kGuidedView).empty());
  const auto glass = casters_of(kGuidedView + kGuidedGlass);
  EXPECT_GT(glass.size(), 20u);
  for (const Vec3f& p : glass) EXPECT_NEAR(length(p - Vec3f(0, 0.4f, 0)), 0.3f, 1e-4f);
  // Visible from the floor, not from the camera.
  const auto mirror = casters_of(kGuidedView + kMirrorBehindTheEye);
  EXPECT_GT(mirror.size(), 20u);
  for (const Vec3f& p : mirror) EXPECT_NEAR(p.z, -6, 1e-4f);
  // Glass in front of the camera is no caster: no rough vertex precedes it.
  EXPECT_TRUE(casters_of(R"(Camera "perspective" "float fov" 30
      Film "rgb" "integer xresolution" 64 "integer yresolution" 64 WorldBegin
      LightSource "infinite" "rgb L" [1 1 1]
      Material "dielectric" Translate 0 0 3 Shape "sphere" "float radius" 1)")
                  .empty());
}

TEST(CausticCasters, AreFoundInEveryRoundOfANarrowPicture) {
  // 20000 pixels are looked at in steps of two.
  const auto scene =
      scene_from_text(R"(Film "rgb" "integer xresolution" 20000 "integer yresolution" 1
    LookAt 0 3 -4  0 0.4 0  0 1 0
    Camera "perspective" "float fov" 10 "float screenwindow" [-20 20 -0.1 0.1]
    WorldBegin LightSource "infinite" "rgb L" [1 1 1]
    Material "diffuse" Shape "bilinearmesh" "point3 P" [-90 0 -90  90 0 -90  -90 0 90  90 0 90]
    Material "dielectric" Translate 0 0.4 0 Shape "sphere" "float radius" 0.3)");
  const EstimatorSet set = make_estimators(Plan("doidge2012"), {}, *scene);
  const Film film = film_for(*scene, set);
  for (uint32_t round = 0; round < 4; ++round) {
    const PhotonPass pass = start_photon_pass({1, round}, *scene, film.format(), {});
    EXPECT_FALSE(caustic_casters(*scene, film.format(), pass, {}).points.empty()) << round;
  }
}

TEST(CausticCasters, HaveNoNumbersOfTheirOwnInPathsThatAreTooShort) {
  IntegratorOptions options;
  options.max_depth = 1;
  EXPECT_TRUE(casters_of(kGuidedView + kGuidedGlass, options).empty());
}

TEST(PhotonGuiding, FindsASmallThingThatChanceDoesNot) {
  // The lamp emits 6 of a million photons towards the glass: a tenth of a path of the 16384 of a
  // round.
  const auto scene = scene_from_text(kGuidedView + kGuidedGlass);
  const EstimatorSet set = make_estimators(Plan("doidge2012"), {}, *scene);
  const Film film = film_for(*scene, set);
  size_t group = 0;
  while (set.routes->groups()[group].estimator != estimator_named("photons")) ++group;
  const auto symbols = std::make_shared<const SceneSymbols>(*scene, std::vector<std::string>{});
  const GuidedPhotons learned =
      guide_photons(1, *scene, film.format(), {set.routes, symbols, group}, {}, true);
  const EmissionGuide& guide = learned.guide.starts;
  EXPECT_GT(learned.rays, 3u << 14);
  ASSERT_FALSE(guide.empty());
  int met = 0;
  constexpr int kPaths = 4096;
  const auto lambda = SampledWavelengths::sample_visible(0.4f);
  for (uint32_t i = 0; i < kPaths; ++i) {
    const SobolPoint point(i, kEmissionDimensions);
    PathSampler sampler(point, 7);
    const auto start = emit(*scene, guide, lambda, 0, sampler);
    if (!start) continue;
    const Vec3f way = Vec3f(0, 0.4f, 0) - start->ray.o;
    met += length_squared(way - start->ray.d * dot(way, start->ray.d)) < 0.09f;
  }
  // The others light the floor behind the glass.
  EXPECT_GT(met, kPaths / 6);
}

// A lamp lights a spot on the floor, six metres away. Almost none of the scattered light hits the
// glass by chance.
TEST(PhotonGuiding, AimFromTheFloorAtTheGlass) {
  std::string text = kGuidedView + kGuidedGlass;
  const std::string lamp = R"(LightSource "point" "rgb I" [900 900 900] "point3 from" [20 60 -10])";
  text.replace(text.find(lamp), lamp.size(),
               R"(LightSource "spot" "rgb I" [90 90 90] "point3 from" [6 3 0] "point3 to" [6 0 0]
                  "float coneangle" 20)");
  const auto scene = scene_from_text(text);
  const OwnedRoutes owned =
      owned_routes(*scene, {"of-the-lit=C.*[DG]S+[DG]L:photons", "rest=.*:path"});
  const Film film = film_for(*scene, make_estimators(Plan("doidge2012"), {}, *scene));
  const PhotonGuide guide = guide_photons(1, *scene, film.format(), owned, {}, true).guide;
  ASSERT_FALSE(guide.casters.empty());
  const PhotonGuide from_lights_alone{guide.starts, {}};
  const auto stored = [&](const PhotonGuide& g) {
    PhotonTraceSettings settings = start_photon_pass({3, 0}, *scene, film.format(), {}).trace;
    settings.guide = &g;
    return trace_photons(*scene, owned, settings, 0, 1 << 14).useful_paths;
  };
  EXPECT_GT(stored(guide), 500u);
  EXPECT_GT(stored(guide), 5 * stored(from_lights_alone));
  // If all photons are useful, scattering is not guided.
  const OwnedRoutes all = owned_routes(*scene, {"all=.*:photons"});
  EXPECT_TRUE(guide_photons(1, *scene, film.format(), all, {}, true).guide.casters.empty());
}

// Casters exist, but no light reaches them: there is nothing to guide.
TEST(PhotonGuiding, StandsLampsThatAreBlack) {
  std::string text = kGuidedView + kGuidedGlass;
  const std::string lamp = "[900 900 900]";
  text.replace(text.find(lamp), lamp.size(), "[0 0 0]");
  const auto scene = scene_from_text(text);
  EXPECT_TRUE(EmissionGuide(*scene, casters_of(text)).empty());
  for (const char* plan : {"mixed", "doidge2012"}) {
    const Film film = render(*scene, plan, {}, 1, 2);
    EXPECT_EQ(picture_mean(film), 0.0) << plan;
  }
}

}  // namespace
}  // namespace nephroid
