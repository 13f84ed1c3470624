// Properties of whole integrators: counts, reports, limits, and invariance under straight-through
// surfaces and flipped cameras.
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "integrator/metropolis/metropolis_options.h"
#include "integrator/presets/integrator_table.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

const std::string kView = R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 30
  Film "rgb" "integer xresolution" 8 "integer yresolution" 8
  PixelFilter "box"
  WorldBegin
)";
const std::string kLampAndFloor = R"(
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
)";
const std::string kGlass =
    R"(Material "dielectric" Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)";

// Sum of the statistics of all estimators of a preset after some passes.
EstimatorStatistics statistics_after(const std::string& text, const std::string& integrator,
                                     const IntegratorOptions& options, uint32_t passes) {
  const auto scene = scene_from_text(text);
  EstimatorSet set = make_integrator(integrator, options, *scene);
  Film film = film_for(*scene, set);
  EstimatorStatistics sum;
  for (uint32_t pass = 0; pass < passes; ++pass) set.render_pass({1, pass}, *scene, film);
  for (const EstimatorStatistics& s : set.statistics()) {
    sum.rays += s.rays;
    sum.photon_paths += s.photon_paths;
    sum.photons_stored += s.photons_stored;
    sum.photon_paths_useful += s.photon_paths_useful;
    sum.photon_paths_specular += s.photon_paths_specular;
    sum.radius_min_pixels = std::max(sum.radius_min_pixels, s.radius_min_pixels);
    sum.radius_max_pixels = std::max(sum.radius_max_pixels, s.radius_max_pixels);
    sum.notes.insert(sum.notes.end(), s.notes.begin(), s.notes.end());
  }
  return sum;
}

TEST(Integrators, CountPhotonsExactly) {
  IntegratorOptions options;
  options.photons_per_pass = 5000;  // not a multiple of the chunk size
  for (const char* integrator : {"mixed", "sppm"}) {
    const EstimatorStatistics s =
        statistics_after(kView + kLampAndFloor + kGlass, integrator, options, 3);
    EXPECT_EQ(s.photon_paths, 15000u) << integrator;
    EXPECT_GT(s.photons_stored, 0u) << integrator;
    EXPECT_LE(s.photon_paths_useful, s.photon_paths) << integrator;
    EXPECT_LE(s.photon_paths_useful, s.photons_stored) << integrator;
    EXPECT_GT(s.photon_paths_specular, 0u) << integrator;
    EXPECT_GT(s.rays, s.photon_paths) << integrator;
  }
}

TEST(Integrators, RadiiShrinkAndArePositive) {
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  options.radius = 2;
  for (const char* integrator : {"mixed", "sppm"}) {
    const auto radius = [&](uint32_t passes) {
      return statistics_after(kView + kLampAndFloor + kGlass, integrator, options, passes)
          .radius_min_pixels;
    };
    const float first = radius(1), fourth = radius(4);
    EXPECT_GT(fourth, 0) << integrator;
    EXPECT_LT(fourth, first) << integrator;
    EXPECT_LE(first, 2.0f + 1e-5f) << integrator;
  }
}

TEST(Integrators, SayWhyThereIsNoCaustic) {
  IntegratorOptions options;
  options.photons_per_pass = 2000;
  const auto notes = [&](const std::string& world) {
    std::string all;
    for (const std::string& note : statistics_after(kView + world, "mixed", options, 1).notes)
      all += note + "\n";
    return all;
  };
  const std::string seen = notes(kLampAndFloor + kGlass);
  EXPECT_EQ(seen.find("specular"), std::string::npos) << seen;
  EXPECT_NE(notes(kLampAndFloor).find("no material of the scene has a specular or glossy lobe"),
            std::string::npos);
  // The glass is hidden below the floor: photons are emitted and none is useful.
  const std::string hidden =
      notes(kLampAndFloor +
            R"(Material "dielectric" Translate 0 -3 0 Shape "sphere" "float radius" 0.6)");
  EXPECT_NE(hidden.find("2000"), std::string::npos) << hidden;
}

TEST(Integrators, WithoutEventsOnlyLampsAreSeen) {
  // The camera looks up into the lamp, through things that add no event.
  const std::string up = R"(
    LookAt 0 0.5 0  0 4 0  0 0 1
    Camera "perspective" "float fov" 10
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    PixelFilter "box"
    WorldBegin
  )" + kLampAndFloor;
  const std::string interface = R"(
    Material "interface" Shape "bilinearmesh" "point3 P" [-1 2 -1  1 2 -1  -1 2 1  1 2 1])";
  const std::string pane = R"(
    Material "thindielectric" Shape "bilinearmesh" "point3 P" [-1 2 -1  1 2 -1  -1 2 1  1 2 1])";
  IntegratorOptions options;
  options.max_depth = 0;
  options.photons_per_pass = 1024;
  // At normal incidence a pane of index 1.5 reflects 2R/(1+R) = 0.0769 of the light.
  for (const std::string& integrator : integrator_names()) {
    const auto mean = [&](const std::string& world) {
      return picture_mean(render(*scene_from_text(up + world), integrator, options, 1, 64));
    };
    const double bare = mean("");
    EXPECT_GT(bare, 8) << integrator;
    EXPECT_NEAR(mean(interface), bare, 1e-3 * bare) << integrator;
    EXPECT_NEAR(mean(pane), (1 - 0.0769) * bare, 0.01 * bare) << integrator;
    EXPECT_EQ(
        picture_mean(render(*scene_from_text(kView + kLampAndFloor), integrator, options, 1, 2)), 0)
        << integrator;
  }
}

TEST(Integrators, AFlippedScreenIsTheSamePictureTurned) {
  // The lamp is so large that every picture contains its reflections and caustics in glass.
  const std::string world = R"(
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [1 0.9 0.8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 2.5
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
)" + kGlass;
  const auto scene = [&](const char* window) {
    return scene_from_text(std::string(R"(
      LookAt 0 3 -5  0 0.4 0  0 1 0
      Camera "perspective" "float fov" 30 "float screenwindow" )") +
                           window + R"(
      Film "rgb" "integer xresolution" 8 "integer yresolution" 8
      PixelFilter "box"
      WorldBegin )" + world);
  };
  IntegratorOptions options;
  options.photons_per_pass = 4000;
  options.edit<MetropolisOptions>().mutations = 128;  // blocks with a few percent of noise
  const auto straight = scene("[-1 1 -1 1]"), turned = scene("[1 -1 1 -1]");
  const std::vector<std::string> names = integrator_names();
  parallel_chunks(static_cast<int64_t>(names.size()), 1, [&](int64_t n, int64_t, int64_t) {
    const std::string& integrator = names[static_cast<size_t>(n)];
    const Film film = render(*straight, integrator, options, 1, 64);
    const Film turned_film = render(*turned, integrator, options, 1, 64);
    EXPECT_NEAR(picture_mean(turned_film), picture_mean(film), 0.1 * picture_mean(film))
        << integrator;
    const std::vector<double> a = block_means(film, 2), b = block_means(turned_film, 2);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(a[i], b[3 - i], 0.2 * a[i]) << integrator << ", block " << i;
  });
}

TEST(Integrators, ALimitBoundsEveryPixel) {
  // If the filter is nowhere negative, no mean exceeds the limit of its samples, in any route.
  const std::string text = R"(
    LookAt 0 3 -5  0 0.4 0  0 1 0
    Camera "perspective" "float fov" 30
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "float maxcomponentvalue" 0.05
    PixelFilter "box"
    WorldBegin
  )" + kLampAndFloor + kGlass;
  const auto scene = scene_from_text(text);
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  for (const char* integrator : {"path", "mixed"}) {
    const Film film = render(*scene, integrator, options, 1, 4);
    float largest = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        for (size_t r = 0; r < film.layout().routes.size(); ++r)
          for (int c = 0; c < 3; ++c)
            largest = std::max(largest, film.route_value(static_cast<int>(r), x, y)[c]);
    EXPECT_LE(largest, 0.05f * (1 + 1e-5f)) << integrator;
    EXPECT_GT(largest, 0.02f) << integrator << ": the limit does not bite";
  }
}

TEST(Integrators, WhatWasDroppedDoesNotHideTheHero) {
  // Blue fog behind flint glass: a path whose hero wavelength is red crosses the fog as red light
  // does. If the blue wavelengths that the glass dropped still counted, they would grow with every
  // collision.
  const auto scene = scene_from_text(R"(
    LookAt 0 1.2 -1.5  0 0 0  0 1 0
    Camera "perspective" "float fov" 60
    Film "rgb" "integer xresolution" 8 "integer yresolution" 6
    PixelFilter "box"
    WorldBegin
    MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [10 20 120]
      "rgb sigma_a" [0 0 0]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [300 300 300]
      Translate 0 3.2 0 Shape "sphere" "float radius" 0.1
    AttributeEnd
    AttributeBegin
      Material "dielectric" "spectrum eta" "glass-F11"
      Translate 0 3.2 0 Shape "sphere" "float radius" 0.4
    AttributeEnd
    AttributeBegin
      MediumInterface "fog" "" Material "interface"
      Translate 0 2 0 Scale 4 0.4 4
      Shape "trianglemesh"
        "point3 P" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1]
        "integer indices" [0 2 1 1 2 3 4 5 6 5 7 6 0 1 4 1 5 4 2 6 3 3 6 7 0 4 2 2 4 6 1 3 5 3 7 5]
    AttributeEnd
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  )");
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  const auto red_of = [&](const char* integrator, uint32_t passes) {
    const Film film = render(*scene, integrator, options, 3, passes);
    double sum = 0;
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 8; ++x) sum += film.value(x, y).r;
    return sum;
  };
  const double expected = red_of("path", 4096);
  for (const char* integrator : {"sppm", "bpm"})
    EXPECT_NEAR(red_of(integrator, 16), expected, 0.25 * expected) << integrator;
}

TEST(Integrators, GiveOnePictureInAllUnitsOfLength) {
  // Scales are powers of two, so that all numbers but densities keep their mantissas.
  const auto mean_at = [](int exponent, const char* integrator) {
    const auto number = [&](double x) {
      std::ostringstream text;
      text << std::setprecision(17) << std::ldexp(x, exponent);
      return text.str();
    };
    const std::string unit = number(1);
    const auto scene =
        scene_from_text("LookAt 0 " + number(3) + " " + number(-5) + "  0 0 0  0 1 0\n" + R"(
        Camera "perspective" "float fov" 30
        Film "rgb" "integer xresolution" 16 "integer yresolution" 16
        PixelFilter "box"
        WorldBegin Scale )" +
                        unit + " " + unit + " " + unit + "\n" + kLampAndFloor + kGlass);
    IntegratorOptions options;
    options.photons_per_pass = 4000;
    return block_means(render(*scene, integrator, options, 1, 4), 1)[0];
  };
  for (const char* integrator : {"path", "sppm", "bdpt", "vcm", "bpm", "mixed"}) {
    const double mean = mean_at(0, integrator);
    EXPECT_NEAR(mean_at(30, integrator), mean, 1e-3 * mean) << integrator;
    EXPECT_NEAR(mean_at(-25, integrator), mean, 1e-3 * mean) << integrator;
  }
}

TEST(Integrators, APixelOfSharedStatisticsGoesOnAfterAPassThatIsNotFinite) {
  // So bright that the sum over some photons is infinite in about a third of the pixels of a pass.
  // If infinity stayed in a pixel's flux, more than half of all estimates would be lost.
  const auto scene = scene_from_text(R"(
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective" "float fov" 30
    Film "rgb" "integer xresolution" 24 "integer yresolution" 24
         "float maxcomponentvalue" 1 "float iso" 5e11
    WorldBegin
    LightSource "point" "point3 from" [0 0 -4] "rgb I" [1e28 1e28 1e28]
    Material "diffuse"
    Shape "disk" "float radius" 2
  )");
  constexpr int kPasses = 8, kPixels = 24 * 24;
  IntegratorOptions options;
  options.photons_per_pass = 4000;
  const Film film = render(*scene, "sppm", options, 1, 64);
  uint64_t lost = 0;
  int dark = 0;
  for (size_t r = 0; r < film.layout().routes.size(); ++r)
    lost += film.bad_estimates(static_cast<int>(r)).count;
  EXPECT_GT(lost, uint64_t{kPasses * kPixels / 10});
  EXPECT_LT(lost, uint64_t{kPasses * kPixels / 2});
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      Rgb sum;
      for (size_t r = 0; r < film.layout().routes.size(); ++r)
        sum = sum + film.route_value(static_cast<int>(r), x, y);
      EXPECT_TRUE(std::isfinite(sum[0] + sum[1] + sum[2])) << x << "," << y;
      dark += sum[0] > 0 ? 0 : 1;
    }
  EXPECT_LT(dark, kPixels / 10);
}

}  // namespace
}  // namespace nephroid
