// The colour of a few passes. Paths that merge share eight wavelengths, so a grey scene must be
// grey from the first pass, and a prism must not have the colour of one wavelength.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

/// A floor and a ball of glass under a sky and a spot light. `eta`: the parameter, or nothing.
std::string ball_over_a_floor(const std::string& eta) {
  return R"(
    LookAt 0 2 -5  0 0.5 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 48 "integer yresolution" 36
    PixelFilter "box"
    WorldBegin
    LightSource "infinite" "rgb L" [0.3 0.3 0.3]
    LightSource "spot" "point3 from" [0 5 0] "point3 to" [0 0 0] "rgb I" [40 40 40]
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
    Translate 0 1 0
    Material "dielectric" )" +
         eta + R"(
    Shape "sphere" "float radius" 0.7
  )";
}

using Channels = std::array<double, 3>;

Channels channels_of(const Rgb& c) {
  return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

/// Means of red, green and blue of the picture, then of the albedo.
std::vector<double> mean_colors(const Film& film) {
  std::vector<double> means(6, 0.0);
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const Channels light = channels_of(film.value(x, y));
      const Channels albedo = channels_of(film.albedo(x, y));
      for (size_t c = 0; c < 3; ++c) {
        means[c] += light[c] / static_cast<double>(b.area());
        means[3 + c] += albedo[c] / static_cast<double>(b.area());
      }
    }
  return means;
}

TEST(Tint, OnePassOfGreyThingsIsGrey) {
  const auto scene = scene_from_text(ball_over_a_floor(""));
  const SeedValues one = values_over_seeds(
      16, 0, [&](uint64_t seed) { return mean_colors(render(*scene, "mixed", {}, seed, 1)); });
  const SeedValues many = values_over_seeds(
      4, 100, [&](uint64_t seed) { return mean_colors(render(*scene, "mixed", {}, seed, 64)); });
  for (size_t c = 0; c < one.size(); ++c) {
    const double right = estimate_of(many[c]).mean;
    double squares = 0;
    for (const double value : one[c]) squares += (value / right - 1) * (value / right - 1);
    EXPECT_LT(std::sqrt(squares / 16), max_error(0.01))
        << (c < 3 ? "picture, " : "albedo, ") << "rgb"[c % 3];
  }
}

TEST(Tint, SixteenPassesOfAPrismHaveAllColours) {
  const auto scene = scene_from_text(ball_over_a_floor(R"("spectrum eta" "glass-F11")"));
  const auto spread = [&](const char* integrator) {
    const SeedValues values = values_over_seeds(16, 0, [&](uint64_t seed) {
      return mean_colors(render(*scene, integrator, {}, seed, 16));
    });
    Channels result{};
    for (size_t c = 0; c < 3; ++c) {
      const Estimate e = estimate_of(values[c]);
      result[c] = 4 * e.error / e.mean;  // of one seed
    }
    return result;
  };
  const Channels mixed = spread("mixed"), path = spread("path");
  for (size_t c = 0; c < 3; ++c) EXPECT_LE(mixed[c], max_error(4 * path[c])) << "rgb"[c];
}

TEST(Tint, AFewPassesHaveAllColoursOfAPrism) {
  // A flint glass ball leaves grey light grey for any wavelengths of the pass, although each
  // refracted path keeps a single wavelength.
  const auto scene = scene_from_text(R"(
    LookAt 0 2 -4  0 0.3 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 32 "integer yresolution" 24
    PixelFilter "box"
    WorldBegin
    LightSource "spot" "point3 from" [0 5 0] "point3 to" [0 0 0] "rgb I" [60 60 60]
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Shape "bilinearmesh" "point3 P" [-3 -0.5 -3  3 -0.5 -3  -3 -0.5 3  3 -0.5 3]
    Material "dielectric" "spectrum eta" "glass-F11"
    Translate 0 0.4 0 Shape "sphere" "float radius" 0.8
  )");
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  constexpr int kSeeds = 8;
  for (const char* integrator : {"mixed", "sppm", "vcm", "bpm"}) {
    double squares = 0;
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
      const Film film = render(*scene, integrator, options, seed, 4);
      Rgb sum;
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x) sum = sum + film.value(x, y);
      squares += std::pow(sum.g / sum.r - 1, 2) + std::pow(sum.b / sum.g - 1, 2);
    }
    // If all paths of a pass kept the same wavelength, this would be 10 to 30 %.
    EXPECT_LT(std::sqrt(squares / (2 * kSeeds)), 0.03) << integrator;
  }
}

}  // namespace
}  // namespace nephroid
