// Direct light at points of flights that pass close to lamps which are sampled by area.
#include "transport/flight_light.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "scene/scene.h"

namespace nephroid {
namespace {

/// Thin fog everywhere, and a lamp.
std::unique_ptr<Scene> lamp_in_fog(const std::string& shape) {
  Diagnostics diagnostics;
  return build_scene(parse_pbrt_string(R"(
    MakeNamedMedium "fog" "string type" "homogeneous" "float g" 0.5
      "rgb sigma_a" [0 0 0] "rgb sigma_s" [0.1 0.1 0.1]
    MediumInterface "" "fog"
    LookAt 0 0 -1  0 0 0  0 1 0 Camera "perspective" Film "rgb"
    WorldBegin
    MediumInterface "fog" "fog"
    AreaLightSource "diffuse" "bool twosided" true )" +
                                           shape,
                                       "test.pbrt", ".", diagnostics),
                     {}, diagnostics);
}

struct Found {
  double mean = 0, square = 0, largest = 0;
};

/// The light that arrives along a flight past the lamp, at a distance of a thousandth.
Found found_in(const Scene& scene, FlightTechniques techniques) {
  constexpr int kSamples = 200000;
  Found found;
  for (int i = 0; i < kSamples; ++i) {
    Walk walk;
    walk.ray.o = {-1, 0.2f, 0.001f};
    walk.ray.d = {1, 0, 0};
    walk.medium = scene.media[0].get();
    walk.lambda = SampledWavelengths::sample_visible(0.3f);
    FlightRandom random(-1.0f, hash_combine(7, static_cast<uint64_t>(i)));
    const float u_light = random.next();
    const Vec2f u(random.next(), random.next());
    double sum = 0;
    for (const auto& light :
         sample_flight_light(scene, *walk.medium, walk, 2.0f, random, techniques, u_light, u))
      if (light)
        sum += light->throughput[0] * light->direct.radiance[0] *
               light->vertex.phase.eval(light->vertex.wo, light->direct.wi_world);
    found.mean += sum / kSamples;
    found.square += sum * sum / kSamples;
    found.largest = std::max(found.largest, sum);
  }
  return found;
}

double error_of(const Found& found) {
  return std::sqrt(found.square / 200000);
}

class FlightLightNear : public ::testing::TestWithParam<const char*> {};

TEST_P(FlightLightNear, IsBoundedWithDirectionsOfThePhaseFunction) {
  const auto scene = lamp_in_fog(GetParam());
  const Found alone = found_in(*scene, FlightTechniques::kLight);
  const Found both = found_in(*scene, FlightTechniques::kLightAndPhase);
  EXPECT_NEAR(both.mean, alone.mean, 4 * (error_of(alone) + error_of(both)));
  EXPECT_LT(both.largest, 20 * both.mean);
  EXPECT_GT(alone.largest, 100 * both.largest);
}

INSTANTIATE_TEST_SUITE_P(Lamps, FlightLightNear,
                         ::testing::Values(R"(Shape "disk" "float radius" 0.5)",
                                           R"(Rotate 90 0 1 0
                                           Shape "cylinder" "float radius" 0.199
                                             "float zmin" -0.5 "float zmax" 0.5)"));

// Rays may pass through such a lamp, so next-event estimation finds all of its light.
TEST(FlightLight, HasNoOtherTechniqueForLampsWithHoles) {
  const auto scene = lamp_in_fog(R"(Shape "disk" "float radius" 0.5 "float alpha" 0.5)");
  EXPECT_FALSE(scene->lights[0]->has_whole_surface());
  const Found alone = found_in(*scene, FlightTechniques::kLight);
  const Found both = found_in(*scene, FlightTechniques::kLightAndPhase);
  EXPECT_EQ(both.mean, alone.mean);
}

}  // namespace
}  // namespace nephroid
