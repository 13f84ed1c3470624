// Camera ray weights: a realistic lens transmits the share of light that its ray weights say, in
// path tracing and in photon mapping.
#include <gtest/gtest.h>

#include "rendering.h"
#include "scene/camera/camera.h"

namespace nephroid {
namespace {

using namespace testing_support;

const std::string kLens =
    R"(Camera "realistic" "string lensfile" "unit/camera/lenses/symmetric.dat"
         "float aperturediameter" 12 "float focusdistance" 2
       Film "rgb" "integer xresolution" 6 "integer yresolution" 4
       PixelFilter "box" )";

// In a room of radiance 1 a pixel equals the lens's transmittance. Blocked samples count as zero.
TEST(CameraWeight, PathTakesTheLensesShare) {
  const auto scene =
      scene_from_text(kLens + R"(WorldBegin LightSource "infinite" "rgb L" [1 1 1])");
  const Film film = render(*scene, "path", {}, 1, 1600);
  for (const Vec2i& pixel : {Vec2i(0, 0), Vec2i(3, 2)}) {
    double expected = 0;
    constexpr int kSide = 60;
    for (int i = 0; i < kSide * kSide; ++i) {
      const float u = (static_cast<float>(i % kSide) + 0.5f) / kSide;
      const float v = (static_cast<float>(i / kSide) + 0.5f) / kSide;
      const auto c =
          scene->camera->generate_ray({static_cast<float>(pixel.x) + std::fmod(7 * u, 1.0f),
                                       static_cast<float>(pixel.y) + std::fmod(7 * v, 1.0f)},
                                      {u, v}, 0);
      if (c) expected += static_cast<double>(c->weight) / (kSide * kSide);
    }
    const Rgb value = film.value(pixel.x, pixel.y);
    EXPECT_NEAR(value.g, expected, 0.02 * expected) << pixel.x;
    EXPECT_NEAR(value.r, expected, 0.03 * expected) << pixel.x;
  }
}

// Photons and paths see the same floor through the same lens.
TEST(CameraWeight, PhotonsAgreeWithPaths) {
  const auto scene = scene_from_text(kLens + R"(WorldBegin
      AttributeBegin AreaLightSource "diffuse" "rgb L" [9 9 9]
        Translate 0 1 1 Rotate 90 1 0 0 Shape "disk" "float radius" 0.3 AttributeEnd
      Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
      Shape "bilinearmesh" "point3 P" [-2 -2 2  2 -2 2  -2 2 2  2 2 2])");
  IntegratorOptions options;
  options.max_depth = 1;
  options.photons_per_pass = 1 << 13;
  const Estimate path = mean_over_seeds(*scene, "path", options, 8, 64);
  const Estimate photons = mean_over_seeds(*scene, "sppm", options, 8, 8);
  EXPECT_GT(path.mean, 0);
  EXPECT_LT(path.error, 0.02 * path.mean);
  EXPECT_NEAR(photons.mean, path.mean, 0.02 * path.mean + 5 * photons.error);
}

}  // namespace
}  // namespace nephroid
