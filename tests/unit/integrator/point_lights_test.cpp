// Virtual point lights: their share is bounded, and they are chosen by flux.
#include "integrator/virtual_lights/point_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/parallel.h"
#include "integrator/virtual_lights/point_light_pool.h"
#include "owned_routes.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// [L1]
TEST(PointLightShare, LeavesTheWalkWhatWouldBeASpot) {
  EXPECT_EQ(point_light_share(0, 0), 0) << "without point lights the walk has all";
  EXPECT_EQ(point_light_share(0, 1), 0);
  EXPECT_EQ(point_light_share(2, 0), 1) << "what no walk finds is theirs";
  EXPECT_EQ(point_light_share(2, 1), 1);
  EXPECT_FLOAT_EQ(point_light_share(2, 8), 0.25f);
  EXPECT_EQ(point_light_share(2, kInfinity), 0);
}

constexpr const char* kCorner = R"(
  LookAt 0 2 -6  0 1 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 6 "integer yresolution" 6
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.1 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Shape "bilinearmesh" "point3 P" [-6 0 2  6 0 2  -6 4 2  6 4 2])";

/// A lamp in a ball that reflects all light.
constexpr const char* kWhiteBall = R"(
  Camera "perspective"
  WorldBegin
  LightSource "point"
  Material "diffuse" "rgb reflectance" [1 1 1]
  Shape "sphere" "float radius" 2)";

PhotonTraceSettings settings_of(uint32_t pass, int64_t paths, int max_events = 8) {
  PhotonTraceSettings settings;
  settings.key = {1, pass};
  settings.photons_per_pass = paths;
  settings.lambda = SampledWavelengths::sample_visible(0.3f);
  settings.max_events = max_events;
  return settings;
}

const std::vector<std::string> kAllByPointLights = {"all=.*:pointlights", "rest=.*:path"};

// [L4]
TEST(PointLightPool, ChoosesByFlux) {
  const auto scene = scene_from_text(kCorner);
  const OwnedRoutes owned = owned_routes(*scene, kAllByPointLights);
  const PointLightPool pool(*scene, owned, settings_of(0, 64), 1 << 20);
  ASSERT_GT(pool.size(), 64u);
  EXPECT_LE(pool.useful_paths(), 64u);
  double total = 0;
  for (size_t i = 0; i < pool.size(); ++i)
    total += static_cast<double>(pool[i].flux.max_component());
  constexpr int kCount = 8, kNumbers = 4096;
  std::map<const PointLight*, int> chosen;
  for (int j = 0; j < kNumbers; ++j) {
    double flux = 0;
    for (int k = 0; k < kCount; ++k) {
      const ChosenLight c =
          pool.choose(k, kCount, (static_cast<float>(j) + 0.5f) / static_cast<float>(kNumbers));
      ++chosen[c.light];
      flux += static_cast<double>(c.factor * c.light->flux.max_component());
    }
    ASSERT_NEAR(flux, total, 1e-5 * total);
  }
  // The numbers are evenly spaced, so each light is chosen the right number of times, within one or
  // two.
  for (size_t i = 0; i < pool.size(); ++i)
    EXPECT_NEAR(chosen[&pool[i]],
                kCount * kNumbers * static_cast<double>(pool[i].flux.max_component()) / total, 2);
}

/// Flux of the point lights on the left, and of all.
std::pair<double, double> fluxes(const PointLightPool& pool) {
  double left = 0, all = 0;
  for (size_t i = 0; i < pool.size(); ++i) {
    const double flux = static_cast<double>(pool[i].flux.max_component());
    all += flux;
    if (pool[i].surface.p.x < -0.5f) left += flux;
  }
  return {left, all};
}

// [L5]
TEST(PointLightPool, KeepsTheFluxOfThoseThatItCannotHold) {
  const auto scene = scene_from_text(kCorner);
  const OwnedRoutes owned = owned_routes(*scene, kAllByPointLights);
  constexpr int64_t kMax = 64;
  std::vector<double> lost;
  for (uint32_t pass = 0; pass < 400; ++pass) {
    const PointLightPool full(*scene, owned, settings_of(pass, 256), 1 << 20);
    const PointLightPool few(*scene, owned, settings_of(pass, 256), kMax);
    ASSERT_GT(full.size(), 2 * static_cast<size_t>(kMax));
    ASSERT_LE(few.size(), static_cast<size_t>(kMax));
    EXPECT_LE(few.bytes() * full.size(), full.bytes() * kMax * 5 / 4);
    EXPECT_EQ(few.useful_paths(), full.useful_paths());
    const auto [left_of_full, all_of_full] = fluxes(full);
    const auto [left_of_few, all_of_few] = fluxes(few);
    ASSERT_NEAR(all_of_few, all_of_full, 1e-4 * all_of_full);
    lost.push_back(left_of_few / left_of_full - 1);
  }
  const Estimate e = estimate_of(lost);
  EXPECT_GT(e.error, 0) << "other lights were chosen";
  EXPECT_LT(e.error, 0.01);
  EXPECT_NEAR(e.mean, 0, 4 * e.error);
}

// [L5] Where no light is absorbed, a path leaves a point light at each of its events.
TEST(PointLightPool, HoldsNoMoreHoweverDeepAPathIs) {
  const auto scene = scene_from_text(kWhiteBall);
  const OwnedRoutes owned = owned_routes(*scene, kAllByPointLights);
  const PointLightPool full(*scene, owned, settings_of(0, 2, 2000), 1 << 20);
  ASSERT_GT(full.size(), 2000u);
  const PointLightPool few(*scene, owned, settings_of(0, 2, 2000), 256);
  EXPECT_LE(few.size(), 256u);
  EXPECT_GE(few.size(), 32u);
  EXPECT_LE(few.bytes() * full.size(), full.bytes() * 256 * 5 / 4);
  const double all = fluxes(full).second;
  EXPECT_NEAR(fluxes(few).second, all, 1e-3 * all);
}

TEST(PointLightPool, IsThinnedAlikeByAnyNumberOfThreads) {
  const auto scene = scene_from_text(kCorner);
  const OwnedRoutes owned = owned_routes(*scene, kAllByPointLights);
  const auto pool_by = [&](int threads) {
    const ThreadLimit limit(threads);
    return PointLightPool(*scene, owned, settings_of(3, 4096), 1024);
  };
  const PointLightPool one = pool_by(1), many = pool_by(5);
  ASSERT_GT(one.size(), 512u);
  ASSERT_EQ(one.size(), many.size());
  for (size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].flux, many[i].flux);
    ASSERT_EQ(one[i].surface.p.x, many[i].surface.p.x);
  }
}

// The memory of one photon has room for a thousand point lights.
TEST(PointLights, FindTheSameLightInLittleMemory) {
  const auto scene = scene_from_text(kCorner);
  IntegratorOptions options;
  options.edit<PointLightsOptions>().connections = 64;
  std::vector<double> differences;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    options.memory_photons = 1 << 20;
    const double full = picture_mean(render(*scene, plan_of(kAllByPointLights), options, seed, 1));
    options.memory_photons = 1;
    EstimatorSet set = make_estimators(plan_of(kAllByPointLights), options, *scene);
    Film film = film_for(*scene, set);
    set.render_pass({seed, 0}, *scene, film);
    EXPECT_LE(set.statistics().front().photons_stored, 1024u);
    EXPECT_LT(set.statistics().front().photon_bytes, 5u << 20);
    differences.push_back(picture_mean(film) / full - 1);
  }
  const Estimate e = estimate_of(differences);
  EXPECT_LT(e.error, 0.005);
  EXPECT_NEAR(e.mean, 0, 4 * e.error);
}

}  // namespace
}  // namespace nephroid
