// Direct light at points of flights that pass close to lamps which are sampled by area.
#include "transport/flight_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

constexpr int kSamples = 200000;

struct Found {
  double mean = 0, square = 0, largest = 0;
  /// Variance of the mean.
  double variance() const { return (square - mean * mean) / kSamples; }
};

/// The light that arrives along a flight, which passes the plane z = 0 at a distance `z`.
Found found_in(const Scene& scene, float z, FlightTechniques techniques) {
  Found found;
  for (int i = 0; i < kSamples; ++i) {
    Walk walk;
    walk.ray.o = {-1, 0.2f, z};
    walk.ray.d = {1, 0, 0};
    walk.medium = scene.media[0].get();
    walk.lambda = SampledWavelengths::sample_visible(0.3f);
    FlightRandom random(-1.0f, hash_combine(7, static_cast<uint64_t>(i)));
    const float u_light = random.next();
    const Vec2f u(random.next(), random.next());
    double sum = 0;
    for (const auto& light :
         sample_flight_light(scene, *walk.medium, walk, 2.0f, random, techniques, u_light, u))
      if (light && !scene.blocked(light->direct.shadow_ray))
        sum += light->throughput[0] * light->direct.radiance[0] *
               light->vertex.phase.eval(light->vertex.wo, light->direct.wi_world);
    found.mean += sum / kSamples;
    found.square += sum * sum / kSamples;
    found.largest = std::max(found.largest, sum);
  }
  return found;
}

struct Lamp {
  const char* name;
  const char* shape;
};
const Lamp kLamps[] = {
    {"disk", R"(Shape "disk" "float radius" 0.5)"},
    {"cylinder", R"(Rotate 90 0 1 0
       Shape "cylinder" "float radius" 0.2 "float zmin" -0.5 "float zmax" 0.5)"},
    {"triangle", R"(Shape "trianglemesh" "point3 P" [-0.7 -0.4 0  0.8 0 0  0 0.9 0])"},
    {"rectangle",
     R"(Shape "bilinearmesh" "point3 P" [-0.5 -0.5 0  0.5 -0.5 0  -0.5 0.5 0  0.5 0.5 0])"},
    {"bent patch",
     R"(Shape "bilinearmesh" "point3 P" [-0.5 -0.5 0  0.5 -0.5 -0.2  -0.5 0.5 -0.3  0.5 0.5 0])"},
    {"sphere", R"(Translate 0 0 -0.4 Shape "sphere" "float radius" 0.4)"},
    {"clipped sphere", R"(Translate 0 0 -0.3 Shape "sphere" "float radius" 0.4 "float zmax" 0.3)"}};

class FlightLightNear : public ::testing::TestWithParam<Lamp> {};

TEST_P(FlightLightNear, IsTheSameWithDirectionsOfThePhaseFunction) {
  const auto scene = lamp_in_fog(GetParam().shape);
  ASSERT_TRUE(scene->lights[0]->has_whole_surface());
  const Found alone = found_in(*scene, 0.1f, FlightTechniques::kLight);
  const Found both = found_in(*scene, 0.1f, FlightTechniques::kLightAndPhase);
  const double error = std::sqrt(alone.variance() + both.variance());
  EXPECT_LT(error, 0.03 * both.mean);
  EXPECT_NEAR(both.mean, alone.mean, 4 * error);
}

TEST_P(FlightLightNear, IsBounded) {
  const auto scene = lamp_in_fog(GetParam().shape);
  const Found both = found_in(*scene, 0.001f, FlightTechniques::kLightAndPhase);
  EXPECT_LT(both.largest, 20 * both.mean);
}

INSTANTIATE_TEST_SUITE_P(Lamps, FlightLightNear, ::testing::ValuesIn(kLamps),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(FlightLight, HasNoBoundByNextEventEstimationAloneNearADisk) {
  const auto scene = lamp_in_fog(kLamps[0].shape);
  const Found alone = found_in(*scene, 0.001f, FlightTechniques::kLight);
  EXPECT_GT(alone.largest, 2000 * alone.mean);
}

// Rays may pass through such lamps, so next-event estimation finds all of their light.
TEST(FlightLight, HasOneTechniqueForLampsThatLetRaysPass) {
  const std::string disk = R"(Shape "disk" "float radius" 0.5 )";
  for (const std::string& lamp :
       {disk + R"("float alpha" 0.5)", R"(Material "thindielectric" )" + disk}) {
    const auto scene = lamp_in_fog(lamp);
    EXPECT_FALSE(scene->lights[0]->has_whole_surface());
    const Found alone = found_in(*scene, 0.1f, FlightTechniques::kLight);
    const Found both = found_in(*scene, 0.1f, FlightTechniques::kLightAndPhase);
    EXPECT_EQ(both.mean, alone.mean);
  }
}

}  // namespace
}  // namespace nephroid
