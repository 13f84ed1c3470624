// Virtual point lights: the share that is theirs is bounded, and they are chosen by their flux.
#include "integrator/point_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "integrator/point_light_pool.h"
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

// [L4]
TEST(PointLightPool, ChoosesByFlux) {
  const auto scene = scene_from_text(R"(
  Camera "perspective"
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.1 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Shape "bilinearmesh" "point3 P" [-6 0 2  6 0 2  -6 4 2  6 4 2])");
  const OwnedRoutes owned = owned_routes(*scene, {"all=.*:pointlights", "rest=.*:path"});
  PhotonTraceSettings settings;
  settings.key = {1, 0};
  settings.photons_per_pass = 64;
  settings.lambda = SampledWavelengths::sample_visible(0.3f);
  settings.max_events = 8;
  const PointLightPool pool(*scene, owned, settings);
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
  // The numbers lie evenly, so each is chosen as often as it should be, to within one or two.
  for (size_t i = 0; i < pool.size(); ++i)
    EXPECT_NEAR(chosen[&pool[i]],
                kCount * kNumbers * static_cast<double>(pool[i].flux.max_component()) / total, 2);
}

}  // namespace
}  // namespace nephroid
