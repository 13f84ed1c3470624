// The statistics of a film against a direct computation in double precision.
#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/sampler.h"
#include "unit/film/one_part.h"

namespace nephroid {
namespace {

using testing_support::add_one;
using testing_support::replace_one;

FilmSettings small_settings() {
  FilmSettings settings;
  settings.width = 8;
  settings.height = 6;
  settings.crop = {2, 1, 7, 5};
  return settings;
}

float random_value(uint64_t i) {
  return bits_to_unit_float(static_cast<uint32_t>(mix_bits(i) >> 32)) * 3;
}

/// Mean and standard error of the mean, by definition.
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
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  std::vector<float> values;
  for (uint64_t i = 0; i < 40; ++i) {
    const float v = random_value(i);
    add_one(film, 0, 3, 4, {v, 2 * v, -v});
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
  // Neighbours received nothing.
  EXPECT_EQ(film.value(4, 4).r, 0.0f);
  EXPECT_EQ(film.value(3, 3).r, 0.0f);
}

TEST(Film, RoutesAddUpEachWithItsOwnCount) {
  Film film(small_settings(), FilmLayout::of_routes({"diffuse", "caustic"}));
  std::vector<float> diffuse, caustic;
  for (uint64_t i = 0; i < 10; ++i) {
    diffuse.push_back(random_value(i));
    add_one(film, 0, 2, 1, {diffuse.back(), 0, 0});
  }
  for (uint64_t i = 100; i < 125; ++i) {
    caustic.push_back(random_value(i));
    add_one(film, 1, 2, 1, {caustic.back(), 0, 0});
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
  // Each route alone rounds to 1: only the exact sum shows the rest.
  Film film(small_settings(), FilmLayout::of_routes({"a", "b"}));
  add_one(film, 0, 2, 1, {1, 0, 0});
  add_one(film, 1, 2, 1, {0x1p-23f, 0, 0});
  add_one(film, 1, 2, 1, {-0x1p-25f, 0, 0});
  film.add_estimates(0, 1);
  film.add_estimates(1, 1);
  EXPECT_EQ(film.value(2, 1).r, 1.0f + 0x1p-23f);
}

TEST(Film, NoEstimateIsBlackAndOneHasNoError) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  EXPECT_EQ(film.value(2, 1).g, 0.0f);
  add_one(film, 0, 2, 1, {1, 2, 3});
  film.add_estimates(0, 1);
  EXPECT_EQ(film.value(2, 1).g, 2.0f);
  EXPECT_EQ(film.standard_error(2, 1).g, 0.0f);
}

TEST(Film, EqualEstimatesHaveNoErrorToSpeakOf) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  for (int i = 0; i < 100; ++i) add_one(film, 0, 2, 1, {0.1f, 1e6f, 3});
  film.add_estimates(0, 100);
  // Squares are rounded to steps of 2^-48, and their mean in double: sqrt(2^-52 / 99) of the value.
  EXPECT_LE(film.standard_error(2, 1).r, std::sqrt(0x1p-49f / 99) + 0.1f * 2e-9f);
  EXPECT_LE(film.standard_error(2, 1).g, 1e6f * 2e-9f);
}

TEST(Film, NotFiniteIsCountedAndLeftOut) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  add_one(film, 0, 2, 1, {1, 1, 1});
  add_one(film, 0, 2, 1, {1, std::numeric_limits<float>::quiet_NaN(), 1});
  add_one(film, 0, 3, 1, {kInfinity, 0, 0});
  film.add_estimates(0, 2);
  EXPECT_EQ(film.bad_estimates(0).count, 2u);
  EXPECT_EQ(film.value(2, 1).r, 0.5f);
  EXPECT_EQ(film.value(3, 1).r, 0.0f);
}

TEST(Film, SaturationIsCounted) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  add_one(film, 0, 2, 1, {1e9f, 0, 0});
  EXPECT_EQ(film.saturated_values(), 0u);
  add_one(film, 0, 2, 1, {1e20f, 0, 0});
  EXPECT_EQ(film.saturated_values(), 1u);
}

TEST(Film, ReplaceForgetsWhatWasThere) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  add_one(film, 0, 2, 1, {5, 5, 5});
  replace_one(film, 0, 2, 1, {1, 2, 3});
  film.set_estimates(0, 1);
  EXPECT_EQ(film.value(2, 1).b, 3.0f);
  replace_one(film, 0, 2, 1, {kInfinity, 2, 3});
  EXPECT_EQ(film.bad_estimates(0).count, 1u);
  EXPECT_EQ(film.value(2, 1).b, 3.0f);
}

TEST(Film, Features) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  film.add_features(2, 1, {0.5f, 0.25f, 1}, {0, 0, 1}, 10);
  film.add_features(2, 1, {0.5f, 0.75f, 1}, {0, 1, 0}, 20);
  film.add_features(2, 1, {0, 0, 0}, {0, 0, 0}, kInfinity);  // hit nothing
  film.add_features(2, 1, {0, 0, 0}, {0, 0, 0}, 0);          // also hit nothing
  EXPECT_EQ(film.saturated_values(), 0u);
  film.add_feature_estimates(4);
  EXPECT_FLOAT_EQ(film.albedo(2, 1).r, 0.25f);
  EXPECT_FLOAT_EQ(film.albedo(2, 1).g, 0.25f);
  EXPECT_FLOAT_EQ(film.albedo(2, 1).b, 0.5f);
  EXPECT_FLOAT_EQ(film.normal(2, 1).y, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(film.normal(2, 1).z, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(film.depth(2, 1), 15);
  EXPECT_EQ(film.depth(3, 1), 0.0f);
  EXPECT_EQ(film.normal(3, 1).z, 0.0f);
  EXPECT_EQ(film.bad_estimates(0).count, 0u);
}

/// Three routes in two groups: the parts 0, 2 and 3 of routes 0 and 2 are rendered together.
FilmLayout layout_with_aovs() {
  FilmLayout layout;
  layout.routes = {"diffuse", "caustic", "rest"};
  layout.aovs = {"key", "fill", "dark"};
  layout.groups = {0, 1, 0};
  layout.parts = {{0, {0}}, {1, {0, 1}}, {2, {}}, {0, {1}}};
  return layout;
}

TEST(Film, BadEstimatesAreThoseOfARouteAndAPixel) {
  Film film(small_settings(), layout_with_aovs()), other(small_settings(), layout_with_aovs());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(film.bad_estimates(0).first_pixel, BadEstimates::kNoPixel);
  film.count_bad(0, 0, {3, 2});
  film.count_bad(0, 0, {2, 1});
  film.count_bad(0, 0, {-1, 1});
  const Rgb values[] = {{1, 1, 1}, {nan, 0, 0}, {nan, 0, 0}};
  film.add(0, 3, 1, values);
  const PixelBounds& crop = film.bounds();
  const auto index = [&](int x, int y) {
    return static_cast<uint64_t>((y - crop.y0) * crop.width() + x - crop.x0);
  };
  EXPECT_EQ(film.bad_estimates(0).count, 3u);
  EXPECT_EQ(film.bad_estimates(0).first_pixel, index(2, 1));
  EXPECT_EQ(film.bad_estimates(2).count, 1u);
  EXPECT_EQ(film.bad_estimates(2).first_pixel, index(3, 1));
  EXPECT_EQ(film.bad_estimates(1).count, 0u);
  other.count_bad(0, 0, {3, 1});
  other.add(film);
  EXPECT_EQ(other.bad_estimates(0).count, 4u);
  EXPECT_EQ(other.bad_estimates(0).first_pixel, index(2, 1));
}

TEST(Film, PartsAddUpToRoutesAovsAndBeauty) {
  Film film(small_settings(), layout_with_aovs());
  EXPECT_EQ(film.layout().group_count(), 2);
  EXPECT_EQ(film.parts_of(0), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(film.parts_of(1), (std::vector<int>{1}));
  double sums[4] = {0, 0, 0, 0};
  std::vector<float> first, second;  // total estimate of each group
  for (uint64_t i = 0; i < 30; ++i) {
    const Rgb values[] = {
        {random_value(i), 0, 0}, {random_value(i + 1000), 0, 0}, {-random_value(i + 2000), 0, 0}};
    film.add(0, 4, 2, values);
    sums[0] += double{values[0].r};
    sums[2] += double{values[1].r};
    sums[3] += double{values[2].r};
    first.push_back(values[0].r + values[1].r + values[2].r);
  }
  for (uint64_t i = 0; i < 12; ++i) {
    second.push_back(random_value(i + 3000));
    sums[1] += double{second.back()};
    add_one(film, 1, 4, 2, {second.back(), 0, 0});
  }
  film.add_estimates(0, 30);
  film.add_estimates(1, 12);
  const auto near = [](const Rgb& value, double expected) {
    EXPECT_FLOAT_EQ(value.r, static_cast<float>(expected));
  };
  near(film.route_value(0, 4, 2), (sums[0] + sums[3]) / 30);
  near(film.route_value(1, 4, 2), sums[1] / 12);
  near(film.route_value(2, 4, 2), sums[2] / 30);
  near(film.aov_value(0, 4, 2), sums[0] / 30 + sums[1] / 12);
  near(film.aov_value(1, 4, 2), sums[3] / 30 + sums[1] / 12);
  EXPECT_EQ(film.aov_value(2, 4, 2).r, 0.0f);
  near(film.value(4, 2), (sums[0] + sums[2] + sums[3]) / 30 + sums[1] / 12);
  // The error follows from the groups' totals: parts of an estimate are not independent.
  const Plain a = plain_statistics(first), b = plain_statistics(second);
  EXPECT_NEAR(film.standard_error(4, 2).r, std::hypot(a.error, b.error), 1e-6);
}

TEST(Film, PartsThatCancelInEachEstimateHaveNoError) {
  Film film(small_settings(), layout_with_aovs());
  for (uint64_t i = 0; i < 20; ++i) {
    const float v = random_value(i);
    const Rgb values[] = {{v, 0, 0}, {3, 0, 0}, {-v, 0, 0}};
    film.add(0, 2, 1, values);
  }
  film.add_estimates(0, 20);
  EXPECT_FLOAT_EQ(film.value(2, 1).r, 3);
  EXPECT_LE(film.standard_error(2, 1).r, 1e-7f);
}

TEST(Film, SumsOfPartsAreRoundedOnce) {
  // Each part alone rounds to 1 or vanishes beside it. Sums over parts are exact.
  FilmLayout layout;
  layout.routes = {"all"};
  layout.aovs = {"same"};
  layout.groups = {0};
  layout.parts = {{0, {0}}, {0, {0}}};
  Film film(small_settings(), layout);
  const Rgb values[] = {{1, 0, 0}, {0x1p-23f, 0, 0}}, rest[] = {{0, 0, 0}, {-0x1p-25f, 0, 0}};
  film.add(0, 2, 1, values);
  film.add(0, 2, 1, rest);
  film.add_estimates(0, 1);
  for (const Rgb& value : {film.value(2, 1), film.route_value(0, 2, 1), film.aov_value(0, 2, 1)})
    EXPECT_EQ(value.r, 1.0f + 0x1p-23f);
}

TEST(Film, AnEstimateWithOneBadPartIsLeftOutAsAWhole) {
  Film film(small_settings(), layout_with_aovs());
  const Rgb bad[] = {{1, 1, 1}, {0, std::numeric_limits<float>::quiet_NaN(), 0}, {1, 1, 1}};
  film.add(0, 2, 1, bad);
  film.add_estimates(0, 1);
  EXPECT_EQ(film.bad_estimates(2).count, 1u);
  EXPECT_EQ(film.value(2, 1).r, 0.0f);
  film.count_saturated(5);
  EXPECT_EQ(film.saturated_values(), 5u);
}

TEST(Film, ReplaceForgetsEveryPartOfItsGroupAlone) {
  Film film(small_settings(), layout_with_aovs());
  const Rgb before[] = {{1, 1, 1}, {2, 2, 2}, {4, 4, 4}},
            after[] = {{8, 8, 8}, {0, 0, 0}, {0, 0, 0}};
  film.add(0, 2, 1, before);
  add_one(film, 1, 2, 1, {16, 16, 16});
  film.replace(0, 2, 1, after);
  film.set_estimates(0, 1);
  film.add_estimates(1, 1);
  EXPECT_EQ(film.value(2, 1).g, 24.0f);
  EXPECT_EQ(film.route_value(2, 2, 1).g, 0.0f);
  EXPECT_EQ(film.aov_value(0, 2, 1).g, 24.0f);
  EXPECT_EQ(film.aov_value(1, 2, 1).g, 16.0f);
}

// A lamp in view is much brighter than what 64 bits of a sum hold.
TEST(Film, SumsOfBrightLampsAreExact) {
  Film film(small_settings(), layout_with_aovs()), other(small_settings(), layout_with_aovs());
  const Rgb values[] = {{3e7f, 0.25f, 1}, {0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < 100; ++i) film.add(0, 2, 1, values);
  other.add(0, 2, 1, values);
  film.add_estimates(0, 100);
  other.add_estimates(0, 1);
  other.add(film);
  EXPECT_EQ(other.aov_value(0, 2, 1).r, 3e7f);
  EXPECT_EQ(other.aov_value(0, 2, 1).g, 0.25f);
  EXPECT_EQ(other.saturated_values(), 0u);
  // A state has all of it.
  Film loaded(small_settings(), layout_with_aovs());
  const RenderState from = other.state(), to = loaded.state();
  ASSERT_EQ(from.arrays.size(), to.arrays.size());
  for (size_t i = 0; i < from.arrays.size(); ++i)
    std::ranges::copy(from.arrays[i].bytes, to.arrays[i].bytes.begin());
  for (size_t i = 0; i < from.streams.size(); ++i) to.streams[i].load(from.streams[i].save());
  EXPECT_EQ(loaded.aov_value(0, 2, 1).r, 3e7f);
  for (int c = 0; c < 3; ++c) {
    for (int route = 0; route < 3; ++route)
      EXPECT_EQ(loaded.route_value(route, 2, 1)[c], other.route_value(route, 2, 1)[c]);
    EXPECT_EQ(loaded.standard_error(2, 1)[c], other.standard_error(2, 1)[c]);
  }
  EXPECT_LT(loaded.standard_error(2, 1).r, 3e7f * 1e-7f);
}

TEST(Film, DimEstimatesAreRoundedToSteps) {
  Film film(small_settings(), FilmLayout::of_routes({"all"}));
  for (int i = 0; i < 100; ++i)
    add_one(film, 0, 2, 1, {i % 2 == 0 ? 2e-7f : 0, i % 2 == 0 ? 2e-8f : 0, 1e-10f});
  film.add_estimates(0, 100);
  EXPECT_NEAR(film.value(2, 1).r, 1e-7f, 0x1p-45f);
  EXPECT_NEAR(film.value(2, 1).g, 1e-8f, 0x1p-45f);
  EXPECT_NEAR(film.value(2, 1).b, 1e-10f, 0x1p-45f);
  // Squares have steps of 2^-48: below 2^-24.5 an error is not seen.
  EXPECT_NEAR(film.standard_error(2, 1).r, 1e-8f, 5e-10f);
  EXPECT_EQ(film.standard_error(2, 1).g, 0);
}

TEST(Film, EmptyCropIsTheWholePicture) {
  FilmSettings settings;
  settings.width = 4;
  settings.height = 3;
  const Film film(settings, FilmLayout::of_routes({"all"}));
  EXPECT_EQ(film.bounds().area(), 12);
  EXPECT_EQ(film.settings().crop.x1, 4);
}

}  // namespace
}  // namespace nephroid
