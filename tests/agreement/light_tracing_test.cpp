// Light tracing agrees with path tracing on visible lamps, every camera that connects, media, crops
// and wide filters, by t-tests over independent seeds. integrators_test.cpp compares the scenes of
// scenes.cpp.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr int kTracedAcross = 3, kTracedSeeds = 16;

// Nothing here is seen in a mirror, so light tracing finds the whole picture.
const std::string kTracedBall = R"(
  AttributeBegin Material "diffuse" "rgb reflectance" [0.7 0.4 0.2]
  Translate 0 0.6 0 Shape "sphere" "float radius" 0.6 AttributeEnd )";
const std::string kTracedRoom = R"(
  Material "diffuse" "rgb reflectance" [0.5 0.5 0.6]
  Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
  Shape "bilinearmesh" "point3 P" [-3 0 3  3 0 3  -3 3 3  3 3 3] )";
// Two-sided and in view.
const std::string kTracedLamp = R"(
  AttributeBegin AreaLightSource "diffuse" "rgb L" [5 4 3] "bool twosided" true
  Material "diffuse" "rgb reflectance" [0.2 0.2 0.2]
  Translate 0.8 1.6 0.9 Rotate 40 1 0 0 Shape "disk" "float radius" 0.5 AttributeEnd )";
const std::string kLookAt = "LookAt 0 2.2 -3.5  0 0.8 0  0 1 0 ";
const std::string kTracedView = kLookAt + R"(Camera "perspective" "float fov" 45 )";
const std::string kTracedFilm =
    R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12 PixelFilter "box" )";

struct LightScene {
  const char* name;
  std::string before;  ///< camera and film
  std::string world;
  bool all_light = true;  ///< light tracing finds all of it
};

std::vector<LightScene> light_scenes() {
  const std::string spherical = "Translate 0 -1.2 1 Camera \"spherical\" ";
  const std::string fog = R"(MakeNamedMedium "fog" "string type" "homogeneous"
    "rgb sigma_a" [0.02 0.04 0.1] "rgb sigma_s" [0.3 0.15 0.05] "float g" 0.3 )";
  return {
      {"lamp_in_view", kTracedView + kTracedFilm, kTracedLamp + kTracedRoom + kTracedBall},
      {"half_there_lamp", kTracedView + kTracedFilm,
       R"(AttributeBegin AreaLightSource "diffuse" "rgb L" [5 4 3] Translate 0 2 1 Rotate 140 1 0 0
          Shape "disk" "float radius" 0.7 "float alpha" 0.4 AttributeEnd )" +
           kTracedRoom},
      {"thin_lens",
       kLookAt + R"(Camera "perspective" "float fov" 45 "float lensradius" 0.2
                    "float focaldistance" 2.5 )" +
           kTracedFilm,
       kTracedLamp + kTracedRoom + kTracedBall},
      {"turned_window_and_crop",
       kLookAt + R"(Camera "perspective" "float fov" 60 "float screenwindow" [0.8 -0.6 -0.9 0.9]
                    Film "rgb" "integer xresolution" 24 "integer yresolution" 24
                    "float cropwindow" [0.25 0.75 0.5 1] PixelFilter "gaussian" )",
       kTracedLamp + kTracedRoom + kTracedBall},
      {"uneven_moving_camera",
       R"(Scale 1.3 0.8 1 LookAt 0 2.2 -3.5  0 0.8 0  0 1 0 ActiveTransform EndTime
          Translate 0.4 0.2 0 Rotate 10 0 1 0 ActiveTransform All Camera "perspective" )" +
           kTracedFilm,
       kTracedLamp + kTracedRoom + kTracedBall},
      {"orthographic",
       kLookAt + R"(Camera "orthographic" "float screenwindow" [-1.6 1.6 -1.6 1.6] )" + kTracedFilm,
       kTracedLamp + kTracedRoom + kTracedBall},
      // Filters reach across the seam, where the picture wraps around.
      {"equirectangular",
       spherical + R"("string mapping" "equirectangular" Film "rgb" "integer xresolution" 12
                     "integer yresolution" 12 PixelFilter "gaussian" )",
       kTracedLamp + kTracedRoom + kTracedBall},
      {"equal_area", spherical + R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12
                     PixelFilter "gaussian" )",
       kTracedLamp + kTracedRoom + kTracedBall},
      // Everything is in fog, including the camera, the lamp and both sides of the sheets.
      {"fog", fog + R"(MediumInterface "fog" "fog" )" + kTracedView + kTracedFilm,
       R"(MediumInterface "fog" "fog" )" + kTracedLamp + kTracedRoom + kTracedBall},
      {"spot_light_in_grid_fog", kTracedView + kTracedFilm,
       R"(MakeNamedMedium "grid" "string type" "uniformgrid" "integer nx" 2 "integer ny" 2
          "integer nz" 2 "float density" [0.2 1 0.6 0.1 0.9 0.3 0.5 1] "point3 p0" [-1 0 -1]
          "point3 p1" [1 2 1] "rgb sigma_a" [0.1 0.2 0.4] "rgb sigma_s" [1.5 1 0.5]
          AttributeBegin MediumInterface "grid" "" Material "interface"
          Translate 0 0.9 0 Shape "sphere" "float radius" 0.85 AttributeEnd
          LightSource "spot" "rgb I" [30 26 22] "point3 from" [1.5 2.5 -1] "point3 to" [0 0.6 0]
          "float coneangle" 35 )" +
           kTracedRoom},
      {"sky_and_gloss", kTracedView + kTracedFilm,
       R"(LightSource "infinite" "rgb L" [0.5 0.6 0.7]
          AttributeBegin Material "conductor" "float roughness" 0.3 Translate 0 0.7 0
          Shape "sphere" "float radius" 0.6 AttributeEnd )" +
           kTracedRoom},
      {"caustic_of_a_large_lamp", kTracedView + kTracedFilm,
       R"(AttributeBegin AreaLightSource "diffuse" "rgb L" [3 3 3] Translate 0 3.5 0
          Rotate 90 1 0 0 Shape "disk" "float radius" 1.5 AttributeEnd
          AttributeBegin Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
          Shape "sphere" "float radius" 0.5 AttributeEnd )" +
           kTracedRoom,
       false},
  };
}

std::unique_ptr<Scene> scene_of(const LightScene& s) {
  return scene_from_text(s.before + " WorldBegin " + s.world);
}

class LightTracingAgrees : public ::testing::TestWithParam<LightScene> {};

TEST_P(LightTracingAgrees, WithPathTracing) {
  const auto scene = scene_of(GetParam());
  IntegratorOptions options;
  options.max_depth = 6;
  options.photons_per_pass = 12000;
  options.camera_samples_per_pass = 16;
  const SeedValues traced =
      block_values(*scene, "light-only", options, kTracedSeeds, 4, 1, kTracedAcross);
  const SeedValues reference =
      block_values(*scene, "path-only", options, kTracedSeeds, 6, 1000, kTracedAcross);
  double sum = 0, squared_error = 0, difference = 0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const Estimate a = estimate_of(traced[i]), b = estimate_of(reference[i]);
    const double error = std::hypot(a.error, b.error);
    EXPECT_NEAR(a.mean, b.mean, kT15 * error + 1e-6) << "block " << i;
    sum += b.mean;
    difference += a.mean - b.mean;
    squared_error += error * error;
  }
  std::printf("%-28s off by %+.2f %%, standard error %.2f %%\n", GetParam().name,
              100 * difference / sum, 100 * std::sqrt(squared_error) / sum);
  EXPECT_NEAR(difference, 0, kT15 * std::sqrt(squared_error));
  EXPECT_LT(std::sqrt(squared_error), max_error(0.02 * sum)) << "too noisy to tell";

  // Light tracing does carry the light; path tracing does not stand in for it.
  const Film film = render(*scene, "light-only", options, 1, 1);
  double light = 0, rest = 0;
  for (int y = film.bounds().y0; y < film.bounds().y1; ++y)
    for (int x = film.bounds().x0; x < film.bounds().x1; ++x) {
      light += double(film.route_value(0, x, y).g);
      rest += double(film.route_value(1, x, y).g);
    }
  EXPECT_GT(light, 0);
  EXPECT_EQ(rest == 0, GetParam().all_light);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightTracingAgrees, ::testing::ValuesIn(light_scenes()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(LightTracing, SameBitsForAnyNumberOfThreads) {
  const auto scene = scene_of(light_scenes()[0]);
  IntegratorOptions options;
  options.photons_per_pass = 5000;
  std::vector<Rgb> first;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    const Film film = render(*scene, "light-only", options, 1, 2);
    std::vector<Rgb> pixels;
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x) pixels.push_back(film.value(x, y));
    if (first.empty()) first = pixels;
    for (size_t i = 0; i < pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) ASSERT_EQ(pixels[i][c], first[i][c]);
  }
}

TEST(LightTracing, RefusesMeasuredLenses) {
  const auto scene = scene_from_text(
      R"(Camera "realistic" "string lensfile" "unit/camera/lenses/thin.dat"
         "float focusdistance" 1 Film "rgb" "integer xresolution" 4 "integer yresolution" 4
         WorldBegin )" +
      kTracedLamp);
  EXPECT_THROW(render(*scene, "light-only", {}, 1, 1), UsageError);
}

}  // namespace
}  // namespace nephroid
