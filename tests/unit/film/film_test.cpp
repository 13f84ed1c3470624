// The statistics of a film against the same numbers computed plainly in double.
#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/sampler.h"

namespace nephroid {
namespace {

FilmSettings small_film() {
  FilmSettings settings;
  settings.width = 8;
  settings.height = 6;
  settings.crop = {2, 1, 7, 5};
  return settings;
}

float random_value(uint64_t i) {
  return bits_to_unit_float(static_cast<uint32_t>(mix_bits(i) >> 32)) * 3;
}

/// Mean and standard error of the mean, the textbook's way.
struct Plain {
  double mean = 0, error = 0;
};
Plain plain_statistics(const std::vector<float>& values) {
  const double n = static_cast<double>(values.size());
  Plain result;
  for (const float v : values) result.mean += v / n;
  double spread = 0;
  for (const float v : values) spread += (v - result.mean) * (v - result.mean);
  result.error = std::sqrt(spread / (n - 1) / n);
  return result;
}

TEST(Film, MeanAndErrorOfOneRoute) {
  Film film(small_film(), {"all"});
  std::vector<float> values;
  for (uint64_t i = 0; i < 40; ++i) {
    const float v = random_value(i);
    film.add(0, 3, 4, {v, 2 * v, -v});
    values.push_back(v);
  }
  film.add_estimates(0, values.size());
  const Plain plain = plain_statistics(values);
  const Rgb value = film.value(3, 4), error = film.standard_error(3, 4);
  EXPECT_FLOAT_EQ(value.r, static_cast<float>(plain.mean));
  EXPECT_FLOAT_EQ(value.g, static_cast<float>(2 * plain.mean));
  EXPECT_FLOAT_EQ(value.b, static_cast<float>(-plain.mean));
  EXPECT_FLOAT_EQ(error.r, static_cast<float>(plain.error));
  EXPECT_FLOAT_EQ(error.g, static_cast<float>(2 * plain.error));
  // Neighbours saw nothing.
  EXPECT_EQ(film.value(4, 4).r, 0.0f);
  EXPECT_EQ(film.value(3, 3).r, 0.0f);
}

TEST(Film, RoutesAddUpEachWithItsOwnCount) {
  Film film(small_film(), {"diffuse", "caustic"});
  std::vector<float> diffuse, caustic;
  for (uint64_t i = 0; i < 10; ++i) {
    diffuse.push_back(random_value(i));
    film.add(0, 2, 1, {diffuse.back(), 0, 0});
  }
  for (uint64_t i = 100; i < 125; ++i) {
    caustic.push_back(random_value(i));
    film.add(1, 2, 1, {caustic.back(), 0, 0});
  }
  film.add_estimates(0, 10);
  film.add_estimates(1, 25);
  const Plain d = plain_statistics(diffuse), c = plain_statistics(caustic);
  EXPECT_FLOAT_EQ(film.route_value(0, 2, 1).r, static_cast<float>(d.mean));
  EXPECT_FLOAT_EQ(film.route_value(1, 2, 1).r, static_cast<float>(c.mean));
  EXPECT_FLOAT_EQ(film.value(2, 1).r, static_cast<float>(d.mean + c.mean));
  EXPECT_FLOAT_EQ(film.standard_error(2, 1).r, static_cast<float>(std::hypot(d.error, c.error)));
}

TEST(Film, BeautyIsRoundedOnce) {
  // Each route alone rounds to 1: only the exact sum of both shows the rest.
  Film film(small_film(), {"a", "b"});
  film.add(0, 2, 1, {1, 0, 0});
  film.add(1, 2, 1, {0x1p-23f, 0, 0});
  film.add(1, 2, 1, {-0x1p-25f, 0, 0});
  film.add_estimates(0, 1);
  film.add_estimates(1, 1);
  EXPECT_EQ(film.value(2, 1).r, 1.0f + 0x1p-23f);
}

TEST(Film, NoEstimateIsBlackAndOneHasNoError) {
  Film film(small_film(), {"all"});
  EXPECT_EQ(film.value(2, 1).g, 0.0f);
  film.add(0, 2, 1, {1, 2, 3});
  film.add_estimates(0, 1);
  EXPECT_EQ(film.value(2, 1).g, 2.0f);
  EXPECT_EQ(film.standard_error(2, 1).g, 0.0f);
}

TEST(Film, EqualEstimatesHaveNoErrorToSpeakOf) {
  Film film(small_film(), {"all"});
  for (int i = 0; i < 100; ++i) film.add(0, 2, 1, {0.1f, 1e6f, 3});
  film.add_estimates(0, 100);
  // What is left is the rounding of the mean square in double: sqrt(2^-52 / 99) of the value.
  EXPECT_LE(film.standard_error(2, 1).r, 0.1f * 2e-9f);
  EXPECT_LE(film.standard_error(2, 1).g, 1e6f * 2e-9f);
}

TEST(Film, NotFiniteIsCountedAndLeftOut) {
  Film film(small_film(), {"all"});
  film.add(0, 2, 1, {1, 1, 1});
  film.add(0, 2, 1, {1, std::numeric_limits<float>::quiet_NaN(), 1});
  film.add(0, 3, 1, {kInfinity, 0, 0});
  film.add_estimates(0, 2);
  EXPECT_EQ(film.bad_values(), 2u);
  EXPECT_EQ(film.value(2, 1).r, 0.5f);
  EXPECT_EQ(film.value(3, 1).r, 0.0f);
}

TEST(Film, SaturationIsCounted) {
  Film film(small_film(), {"all"});
  film.add(0, 2, 1, {1e9f, 0, 0});
  EXPECT_EQ(film.saturated_values(), 0u);
  film.add(0, 2, 1, {1e20f, 0, 0});
  EXPECT_EQ(film.saturated_values(), 1u);
}

TEST(Film, LargestComponentIsHeldWithTheHueKept) {
  const Rgb large = clamp_component({8, 4, 2}, 4), small = clamp_component({4, 1, 1}, 4);
  EXPECT_EQ(large.r, 4.0f);
  EXPECT_EQ(large.g, 2.0f);
  EXPECT_EQ(large.b, 1.0f);
  EXPECT_EQ(small.r, 4.0f);
  EXPECT_EQ(small.g, 1.0f);
  // A negative lobe is held as a positive one is.
  EXPECT_EQ(clamp_component({-8, 4, 2}, 4).r, -4.0f);
  EXPECT_EQ(clamp_component({-8, 4, 2}, 4).g, 2.0f);
}

TEST(Film, ReplaceForgetsWhatWasThere) {
  Film film(small_film(), {"all"});
  film.add(0, 2, 1, {5, 5, 5});
  film.replace(0, 2, 1, {1, 2, 3});
  film.set_estimates(0, 1);
  EXPECT_EQ(film.value(2, 1).b, 3.0f);
  film.replace(0, 2, 1, {kInfinity, 2, 3});
  EXPECT_EQ(film.bad_values(), 1u);
  EXPECT_EQ(film.value(2, 1).b, 3.0f);
}

TEST(Film, Features) {
  Film film(small_film(), {"all"});
  film.add_features(2, 1, {0.5f, 0.25f, 1}, {0, 0, 1}, 10);
  film.add_features(2, 1, {0.5f, 0.75f, 1}, {0, 1, 0}, 20);
  film.add_features(2, 1, {0, 0, 0}, {0, 0, 0}, kInfinity);  // missed everything
  film.add_features(2, 1, {0, 0, 0}, {0, 0, 0}, 0);          // the same in other words
  film.add_feature_estimates(4);
  EXPECT_FLOAT_EQ(film.albedo(2, 1).r, 0.25f);
  EXPECT_FLOAT_EQ(film.albedo(2, 1).g, 0.25f);
  EXPECT_FLOAT_EQ(film.albedo(2, 1).b, 0.5f);
  EXPECT_FLOAT_EQ(film.normal(2, 1).y, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(film.normal(2, 1).z, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(film.depth(2, 1), 15);
  EXPECT_EQ(film.depth(3, 1), 0.0f);
  EXPECT_EQ(film.normal(3, 1).z, 0.0f);
  EXPECT_EQ(film.bad_values(), 0u);
}

TEST(Film, EmptyCropIsTheWholePicture) {
  FilmSettings settings;
  settings.width = 4;
  settings.height = 3;
  const Film film(settings, {"all"});
  EXPECT_EQ(film.bounds().area(), 12);
  EXPECT_EQ(film.settings().crop.x1, 4);
}

}  // namespace
}  // namespace nephroid
