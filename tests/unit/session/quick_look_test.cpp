// The quick first picture by path tracing: when it is made, and what it shows.
#include "session/quick_look.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>

#include "film/film_settings.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

std::string lit_floor(int width, int height) {
  return fmt::format(R"(
    LookAt 0 2 -4  0 0 0  0 1 0 Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" {} "integer yresolution" {}
    WorldBegin
    LightSource "infinite" "rgb L" [1 1 1]
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Shape "bilinearmesh" "point3 P" [-9 0 -9  9 0 -9  -9 0 9  9 0 9])",
                     width, height);
}

FilmFormat format_for(const Scene& scene, const EstimatorSet& set) {
  return Film(film_settings(scene.film), set.layout).format();
}

TEST(QuickLook, IsForLargePicturesOfAlgorithmsThatStartAtLights) {
  const auto large = scene_from_text(lit_floor(512, 300)),
             small = scene_from_text(lit_floor(64, 64));
  for (const auto& [name, expected] :
       {std::pair{"mixed", true}, {"sppm", true}, {"bdpt", true}, {"path", false}}) {
    const EstimatorSet set = make_estimators(plan_named(name), {}, *large);
    EXPECT_EQ(is_worth_a_quick_look(set, format_for(*large, set)), expected) << name;
    const EstimatorSet of_small = make_estimators(plan_named(name), {}, *small);
    EXPECT_FALSE(is_worth_a_quick_look(of_small, format_for(*small, of_small))) << name;
  }
}

TEST(QuickLook, ShowsTheScene) {
  const auto scene = scene_from_text(lit_floor(512, 300));
  const SignalFlags signals;
  double seconds = 0;
  double sum = 0;
  size_t count = 0;
  const auto add_lower_half = [&](const Film& film) {
    const PixelBounds& bounds = film.bounds();
    for (int y = bounds.height() / 2; y < bounds.y1; ++y)
      for (int x = bounds.x0; x < bounds.x1; ++x, ++count) sum += film.value(x, y).g;
  };
  const QuickLook look{*scene, 5, 1, add_lower_half};
  take_quick_look(look, signals, [&] { return seconds; });
  ASSERT_GT(count, 0u);
  EXPECT_NEAR(sum / static_cast<double>(count), 0.5, 0.02);
}

TEST(QuickLook, IsGivenUpAtASignal) {
  const auto scene = scene_from_text(lit_floor(512, 300));
  SignalFlags signals;
  signals.stop = SIGINT;
  bool is_shown = false;
  const QuickLook look{*scene, 5, 1, [&](const Film&) { is_shown = true; }};
  take_quick_look(look, signals, [] { return 0.0; });
  EXPECT_FALSE(is_shown);
}

}  // namespace
}  // namespace nephroid
