// Scene options that change a picture: pixels without jitter, forced diffuse surfaces, and the
// layers of a gbuffer film.
#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

const std::string kPlainFilm =
    R"(PixelFilter "box" Film "rgb" "integer xresolution" 4 "integer yresolution" 4 )";

// A wall that is half lamp: without jitter each pixel is all lamp or none, without noise.
TEST(Options, PixelsWithoutJitter) {
  const std::string world = R"(Camera "orthographic" )" + kPlainFilm + R"(WorldBegin
      AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
      Shape "bilinearmesh" "point3 P" [-2 -2 3  0.3 -2 3  -2 2 3  0.3 2 3])";
  const Film without =
      render(*scene_from_text(R"(Option "disablepixeljitter" true )" + world), "path", {}, 1, 64);
  const Film with = render(*scene_from_text(world), "path", {}, 1, 64);
  // The edge lies in the third column, right of its centre.
  EXPECT_NEAR(without.value(2, 1).g, 1, 0.05);
  EXPECT_EQ(without.value(3, 1).g, 0.0f);
  EXPECT_NEAR(with.value(2, 1).g, 0.6, 0.08);
}

TEST(Options, WavelengthsWithoutJitter) {
  const std::string world = R"(Camera "orthographic" )" + kPlainFilm + R"(WorldBegin
      LightSource "infinite" "rgb L" [0.9 0.2 0.1])";
  const Film film = render(*scene_from_text(R"(Option "disablewavelengthjitter" true )" + world),
                           "path", {}, 1, 8);
  EXPECT_LT(film.standard_error(1, 1).r, 1e-6f);
  EXPECT_GT(render(*scene_from_text(world), "path", {}, 1, 8).standard_error(1, 1).r, 1e-4f);
}

// At normal incidence a smooth dielectric of index n reflects F and transmits (1 - F) / n^2 of the
// radiance. Forced diffuse, it reflects their sum into a uniform room.
TEST(Options, ForcedDiffuse) {
  const auto scene = scene_from_text(R"(Option "forcediffuse" true
      Camera "perspective" "float fov" 1 )" +
                                     kPlainFilm + R"(WorldBegin
      LightSource "infinite" "rgb L" [1 1 1]
      Material "dielectric" "float eta" 1.5
      Shape "bilinearmesh" "point3 P" [2 -2 3  -2 -2 3  2 2 3  -2 2 3])");
  EXPECT_FALSE(scene->has_specular_material);
  const Film film = render(*scene, "path", {}, 1, 256);
  const double expected = 0.04 + 0.96 / 2.25;
  EXPECT_NEAR(picture_mean(film), expected, 0.02 * expected);
}

// A plane z = 3.5 + x/2 in front of a camera at (1, 2, 0) that looks along z.
const std::string kPlane = R"( "integer xresolution" 8 "integer yresolution" 8
      Translate -1 -2 0
      Camera "orthographic" "float screenwindow" [-1 1 -1 1]
      PixelFilter "box" Option "disablepixeljitter" true
      WorldBegin LightSource "infinite"
      Shape "bilinearmesh" "point3 P" [-3 -2 2  5 -2 6  -3 6 2  5 6 6])";

TEST(GBuffer, LayersOfAPlane) {
  for (const bool world : {false, true}) {
    const auto scene = scene_from_text(R"(Film "gbuffer" "string coordinatesystem" )" +
                                       std::string(world ? "\"world\"" : "\"camera\"") + kPlane);
    const Film film = render(*scene, "path", {}, 1, 4);
    const SurfaceSample s = film.surface(6, 1);
    // The pixel's centre is (5/8, 5/8) in camera space.
    const Vec3f camera_p(0.625f, 0.625f, 4.3125f);
    const Vec3f offset = world ? Vec3f(1, 2, 0) : Vec3f(0, 0, 0);
    EXPECT_LT(length(s.p - (camera_p + offset)), 1e-5f);
    const Vec3f towards = normalize(Vec3f(0.5f, 0, -1));
    EXPECT_LT(length(s.n - towards), 1e-5f);
    EXPECT_LT(length(s.ns - towards), 1e-5f);
    EXPECT_NEAR(s.uv.x, 4.625f / 8, 1e-5f);
    EXPECT_NEAR(s.uv.y, 4.625f / 8, 1e-5f);
    // A pixel is 1/4 wide.
    EXPECT_NEAR(s.dzdx, 0.125f, 1e-5f);
    EXPECT_NEAR(s.dzdy, 0.0f, 1e-5f);
  }
}

TEST(GBuffer, SkyHasNoSurface) {
  const auto scene = scene_from_text(R"(Film "gbuffer" "integer xresolution" 2
      "integer yresolution" 2 WorldBegin LightSource "infinite")");
  const SurfaceSample s = render(*scene, "path", {}, 1, 2).surface(1, 1);
  EXPECT_EQ(s.p, Vec3f(0, 0, 0));
  EXPECT_EQ(s.n, Vec3f(0, 0, 0));
}

}  // namespace
}  // namespace nephroid
