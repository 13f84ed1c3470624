// The bias of merging. [E4] What it says of its own bias against what it is: the difference to a
// much smaller radius, in the light of a point light, which falls off around the middle. [W13]
// Things that are narrower than the radius are not too dark.
#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// A square picture from above.
std::string view(int pixels) {
  const std::string side = std::to_string(pixels);
  return "LookAt 0 3 0  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 10 Film \"rgb\" "
         "\"integer "
         "xresolution\" " +
         side + " \"integer yresolution\" " + side +
         " PixelFilter \"box\" \"float xradius\" 0.5 \"float yradius\" 0.5 WorldBegin\n";
}
constexpr char kFloor[] = R"(
  LightSource "point" "rgb I" [1 1 1] "point3 from" [0 1 0]
  Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
  Shape "bilinearmesh" "point3 P" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]
)";
// Light that goes nearly straight on behind an S.
constexpr char kPane[] = R"(
  Material "dielectric" "float eta" 1.01
  Shape "bilinearmesh" "point3 P" [-2 0.5 -2  2 0.5 -2  -2 0.5 2  2 0.5 2]
)";

struct Sums {
  double light = 0, bias = 0;
};

Sums sums_of(const Scene& scene, const std::string& plan, float radius_pixels) {
  IntegratorOptions options;
  options.radius = radius_pixels;
  options.photons_per_pass = 1 << 16;
  options.max_depth = 4;
  EstimatorSet set =
      make_estimators(plan_of({"bare=C[SV]*(L|.*M):path", "all=.*:" + plan}), options, scene);
  Film film = film_for(scene, set);
  for (uint32_t pass = 0; pass < 16; ++pass) set.render_pass({1, pass}, scene, film);
  EXPECT_TRUE(film.has_bias());
  Sums sums;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Rgb value = film.value(x, y);
      sums.light += (double{value.r} + value.g + value.b) / 3;
      sums.bias += double{film.bias(x, y)};
      EXPECT_GT(film.bias_error(x, y), 0.0f);
    }
  return sums;
}

class MergeBias : public ::testing::TestWithParam<std::string> {};

TEST_P(MergeBias, IsTheDifferenceToASmallRadius) {
  const bool behind_pane = GetParam() == "path+photons";
  const auto scene = scene_from_text(view(8) + kFloor + (behind_pane ? kPane : ""));
  const Sums sharp = sums_of(*scene, GetParam(), 1.5f), blurred = sums_of(*scene, GetParam(), 6);
  const double bias = blurred.light - sharp.light;
  EXPECT_LT(bias, -0.02 * sharp.light);
  EXPECT_NEAR(blurred.bias - sharp.bias, bias, 0.15 * -bias);
}

INSTANTIATE_TEST_SUITE_P(Estimators, MergeBias,
                         ::testing::Values("photons", "photons+light", "bpm", "path+photons"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name)
                             if (c == '+') c = '_';
                           return name;
                         });

// What does not merge has no such layer.
TEST(MergeBiasOfFilms, IsOfMergesAlone) {
  const auto scene = scene_from_text(view(8) + kFloor);
  EstimatorSet set = make_estimators(plan_of({"all=.*:path"}), {}, *scene);
  const Film film = film_for(*scene, set);
  EXPECT_FALSE(film.has_bias());
  EXPECT_EQ(film.bias(0, 0), 0.0f);
}

// Slats far above a floor, with gaps as wide as they are, all of it narrower than the radius.
TEST(NarrowThings, AreAsBrightAsByPathTracing) {
  std::string text = view(16) +
                     "LightSource \"infinite\" \"rgb L\" [1 1 1] Material \"diffuse\" \"rgb "
                     "reflectance\" [0.5 0.5 0.5]\n";
  for (int i = -6; i < 6; ++i) {
    const std::string x0 = std::to_string(0.05 * i), x1 = std::to_string(0.05 * i + 0.025);
    text += "Shape \"bilinearmesh\" \"point3 P\" [" + x0 + " 0 -1 " + x1 + " 0 -1 " + x0 + " 0 1 " +
            x1 + " 0 1]\n";
  }
  text += "Shape \"bilinearmesh\" \"point3 P\" [-2 -1 -2  2 -1 -2  -2 -1 2  2 -1 2]\n";
  const auto scene = scene_from_text(text);
  IntegratorOptions options;
  options.radius = 4;
  options.photons_per_pass = 1 << 16;
  options.max_depth = 6;
  const double path = picture_mean(render(*scene, "path", options, 3, 512));
  const Film film = render(*scene, "bpm", options, 3, 32);
  EXPECT_NEAR(picture_mean(film), path, 0.02 * path);
  // Nor does the estimate of the bias take the gaps for one.
  double bias = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) bias += film.bias(x, y) / 256;
  EXPECT_NEAR(bias, 0, 0.05 * path);
}

}  // namespace
}  // namespace nephroid
