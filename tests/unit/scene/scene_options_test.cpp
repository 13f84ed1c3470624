// Option, Accelerator, Sampler and Film directives: accepted, warned of, or refused.
#include "scene/scene_options.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "scene/scene.h"

namespace nephroid {
namespace {

struct BuiltWithOptions {
  std::unique_ptr<Scene> scene;
  std::string warnings;  ///< warnings with a location
};
BuiltWithOptions build(const std::string& text) {
  Diagnostics diagnostics;
  const SceneDescription d =
      parse_pbrt_string(text + "\nWorldBegin", "test.pbrt", ".", diagnostics);
  BuiltWithOptions built{build_scene(d, {}, diagnostics), {}};
  for (const Warning& w : diagnostics.warnings())
    if (w.where.line > 0) built.warnings += located(w.where, w.message) + "\n";
  return built;
}
std::string option_error(const std::string& text) {
  try {
    build(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneSize, ScenesTooSmallOrTooLargeForSinglePrecisionAreRefused) {
  const auto scene = [](const std::string& radius) {
    return "LookAt 0 0 1 0 0 0 0 1 0\nWorldBegin\nShape \"sphere\" \"float radius\" " + radius +
           "\nAttributeBegin AttributeEnd";
  };
  Diagnostics diagnostics;
  const auto build_text = [&](const std::string& text) {
    build_scene(parse_pbrt_string(text, "test.pbrt", ".", diagnostics), {}, diagnostics);
  };
  const auto expect_refused = [&](const std::string& radius, const char* message) {
    try {
      build_text(scene(radius));
      ADD_FAILURE() << radius << ": no error";
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  for (const char* radius : {"1e-7", "1e12", "5e12"}) EXPECT_NO_THROW(build_text(scene(radius)));
  expect_refused("1e-9", "below 1e-8 units");
  expect_refused("2e13", "above 1e13 units");
}

TEST(SceneOptions, Defaults) {
  const BuiltWithOptions b = build("");
  EXPECT_TRUE(b.scene->options.pixel_jitter && b.scene->options.wavelength_jitter);
  EXPECT_FALSE(b.scene->options.force_diffuse);
  EXPECT_EQ(b.scene->scene_seed, 0u);
  EXPECT_EQ(b.scene->samples_per_pixel, 16);
  EXPECT_EQ(b.warnings, "");
}

TEST(SceneOptions, ThoseThatChangePictures) {
  const BuiltWithOptions b = build(
      "Option \"disablepixeljitter\" true Option \"disablewavelengthjitter\" true "
      "Option \"forcediffuse\" true Option \"seed\" 7 Option \"rendercoordsys\" \"camera\"");
  EXPECT_FALSE(b.scene->options.pixel_jitter || b.scene->options.wavelength_jitter);
  EXPECT_TRUE(b.scene->options.force_diffuse);
  EXPECT_EQ(b.scene->scene_seed, 7u);
  EXPECT_EQ(b.warnings, "");
  EXPECT_EQ(build("Option \"seed\" 7 Sampler \"halton\" \"integer seed\" 3").scene->scene_seed, 3u);
  EXPECT_EQ(build("Option \"seed\" 7 Sampler \"halton\"").scene->scene_seed, 7u);
}

TEST(SceneOptions, WithoutEffect) {
  EXPECT_EQ(build("Option \"wavefront\" false Option \"pixelstats\" false").warnings, "");
  EXPECT_EQ(build("Option \"wavefront\" true").warnings,
            "test.pbrt:1:8: option \"wavefront\" has no effect here\n");
  EXPECT_EQ(build("Option \"bool disabletexturefiltering\" true").warnings, "");
  EXPECT_EQ(build("Option \"msereferenceimage\" \"a.exr\"").warnings,
            "test.pbrt:1:8: option \"msereferenceimage\" has no effect here; nephroid compare "
            "measures pictures\n");
  EXPECT_EQ(option_error("Option \"rendercoordsys\" \"object\""),
            "test.pbrt:1:8: unknown rendering coordinate system \"object\", expected \"camera\", "
            "\"cameraworld\" or \"world\"");
}

TEST(SceneOptions, Accelerator) {
  EXPECT_EQ(build("Accelerator \"kdtree\" \"integer maxdepth\" 3").warnings, "");
  EXPECT_EQ(build("Accelerator \"bvhh\"").warnings,
            "test.pbrt:1:1: unknown accelerator \"bvhh\", did you mean \"bvh\"?\n");
}

TEST(SceneOptions, Sampler) {
  EXPECT_EQ(build("Sampler \"independent\"").scene->samples_per_pixel, 4);
  EXPECT_EQ(build("Sampler \"zsobol\"").scene->samples_per_pixel, 16);
  EXPECT_EQ(build("Sampler \"stratified\" \"integer xsamples\" 3").scene->samples_per_pixel, 12);
  EXPECT_EQ(build("Sampler \"haltom\"").warnings,
            "test.pbrt:1:1: unknown sampler \"haltom\", did you mean \"halton\"?\n");
}

TEST(FilmLine, ExposureAndWhiteBalance) {
  const BuiltWithOptions plain = build(
      "Film \"rgb\" \"float iso\" 400 Camera \"perspective\" \"float "
      "shutteropen\" 0.25 \"float shutterclose\" 0.75");
  EXPECT_EQ(plain.scene->film.imaging_ratio, 2.0f);
  EXPECT_FALSE(plain.scene->film.white_balance.has_value());
  EXPECT_TRUE(build("Film \"rgb\" \"float whitebalance\" 5000").scene->film.white_balance);
  // A measured sensor is balanced for 6500 K.
  const BuiltWithOptions measured =
      build("Film \"rgb\" \"string sensor\" \"nikon_d850\" \"float iso\" 200");
  EXPECT_EQ(measured.scene->film.imaging_ratio, 2.0f);
  ASSERT_TRUE(measured.scene->film.white_balance);
  EXPECT_NEAR((*measured.scene->film.white_balance)[0][0], 1, 5e-3);
  EXPECT_EQ(measured.warnings,
            "test.pbrt:1:12: sensor \"nikon_d850\" is rendered as \"cie1931\" with its exposure\n");
  EXPECT_EQ(option_error("Film \"rgb\" \"string sensor\" \"nikon_d85\""),
            "test.pbrt:1:12: unknown sensor \"nikon_d85\", did you mean \"nikon_d850\"? (expected "
            "\"cie1931\" or a sensor of pbrt-v4)");
  EXPECT_EQ(option_error("Film \"rgb\" \"float whitebalance\" 20"),
            "test.pbrt:1:12: \"whitebalance\" must be 0 or a temperature from 500 to 100000 K");
}

TEST(FilmLine, Types) {
  EXPECT_EQ(build("Film \"rgb\"").scene->film.gbuffer, GBufferSpace::kNone);
  EXPECT_EQ(build("Film \"gbuffer\"").scene->film.gbuffer, GBufferSpace::kCamera);
  EXPECT_EQ(build("Film \"gbuffer\" \"string coordinatesystem\" \"world\"").scene->film.gbuffer,
            GBufferSpace::kWorld);
  EXPECT_EQ(build("Film \"rgb\" \"float diagonal\" 50").scene->film.diagonal_mm, 50.0f);
  EXPECT_EQ(option_error("Film \"gbuffer\" \"string coordinatesystem\" \"screen\""),
            "test.pbrt:1:16: unknown coordinate system \"screen\" of the film, expected \"camera\" "
            "or \"world\"");
  EXPECT_EQ(option_error("Film \"spectral\""),
            "test.pbrt:1:1: film \"spectral\" is not rendered: the film keeps colours, no spectra, "
            "expected "
            "one of \"rgb\", \"gbuffer\"");
  EXPECT_EQ(option_error("Film \"gbufer\""),
            "test.pbrt:1:1: unknown film \"gbufer\", did you mean \"gbuffer\"?");
}

}  // namespace
}  // namespace nephroid
