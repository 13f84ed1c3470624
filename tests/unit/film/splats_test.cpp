// Splats: the weights of every filter add up to 1, pixels agree with filter importance sampling,
// and results do not depend on crops, batches or threads.
#include "film/splats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/parallel.h"
#include "core/sampler.h"

namespace nephroid {
namespace {

constexpr int kSplatWidth = 9, kSplatHeight = 37;  // three strips of rows

std::unique_ptr<PixelFilter> filter_named(const std::string& name) {
  DirectiveDescription d;
  d.type = name;
  Diagnostics diagnostics;
  return make_pixel_filter(d, diagnostics);
}

FilmSettings settings_of(const PixelBounds& crop = {}) {
  FilmSettings settings;
  settings.width = kSplatWidth;
  settings.height = kSplatHeight;
  settings.crop = crop;
  return settings;
}

/// One group with two parts.
FilmLayout two_parts() {
  FilmLayout layout;
  layout.routes = {"first", "second"};
  layout.groups = {0, 0};
  layout.parts = {{0, {}}, {1, {}}};
  return layout;
}

/// Different frequencies in x and y, neither odd nor even in any pixel. Its mean is 1.
float smooth(const Vec2f& film) {
  return 1 + 0.5f * std::sin(0.9f * film.x + 0.3f) + 0.25f * std::cos(0.7f * film.y);
}

/// Positions that fill the film and a margin of `margin` pixels evenly, with their values for an
/// expected density of one per pixel.
std::vector<Splat> dense_splats(uint32_t count, float margin, float (*function)(const Vec2f&)) {
  const float width = kSplatWidth + 2 * margin, height = kSplatHeight + 2 * margin;
  const float worth = width * height / static_cast<float>(count);
  std::vector<Splat> splats;
  for (uint32_t i = 0; i < count; ++i) {
    const SobolPoint point(i);
    PathSampler sampler(point, 17);
    const Vec2f u = sampler.get_2d();
    Splat splat;
    splat.film = Vec2f(u.x * width - margin, u.y * height - margin);
    const float v = function(splat.film) * worth;
    splat.value = {v, 2 * v, -v};
    splat.part = static_cast<uint8_t>(i % 2);
    splats.push_back(splat);
  }
  return splats;
}

Film film_of(const std::vector<Splat>& splats, const PixelFilter& filter,
             const PixelBounds& crop = {}, double scale = 1) {
  Film film(settings_of(crop), two_parts());
  SplatBuffer buffer(film, 0, filter);
  buffer.add(splats);
  buffer.finish(scale);
  film.add_estimates(0, 1);
  return film;
}

bool same_bits(const Film& a, const Film& b, const PixelBounds& where) {
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x)
      for (int route = 0; route < 2; ++route)
        for (int c = 0; c < 3; ++c)
          if (a.route_value(route, x, y)[c] != b.route_value(route, x, y)[c]) return false;
  return true;
}

class Splats : public ::testing::TestWithParam<std::string> {};

TEST_P(Splats, WeightsAddUpToOneInEveryPixel) {
  // A regular grid, much finer than the filter, that extends beyond its reach. A pixel receives the
  // filter's integral, negative lobes included, up to summation error.
  const auto filter = filter_named(GetParam());
  const Vec2f radius = filter->radius();
  constexpr int kAcross = 16;
  std::vector<Splat> splats;
  const auto first = [](float r) { return -static_cast<int>(std::ceil(r + 1)) * kAcross; };
  const auto last = [](int size, float r) {
    return (size + static_cast<int>(std::ceil(r + 1))) * kAcross;
  };
  const PixelBounds crop{3, 14, 6, 18};  // on both sides of a strip's border
  for (int j = first(radius.y); j < last(kSplatHeight, radius.y); ++j)
    for (int i = first(radius.x); i < last(kSplatWidth, radius.x); ++i) {
      Splat splat;
      splat.film =
          Vec2f((static_cast<float>(i) + 0.5f) / kAcross, (static_cast<float>(j) + 0.5f) / kAcross);
      splat.value = {1, 1, 1};
      splats.push_back(splat);
    }
  const Film film = film_of(splats, *filter, crop, 1.0 / (kAcross * kAcross));
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) EXPECT_NEAR(film.value(x, y).r, 1, 2e-3);
}

TEST_P(Splats, OneSplatSpreadsOneOverThePixels) {
  // The mean over positions within a pixel of the sum over all pixels is exactly 1.
  const auto filter = filter_named(GetParam());
  const Film film = [&] {
    std::vector<Splat> splats;
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i) {
        Splat splat;
        splat.film = Vec2f(4 + (static_cast<float>(i) + 0.5f) / 32,
                           17 + (static_cast<float>(j) + 0.5f) / 32);
        splat.value = {1, 1, 1};
        splats.push_back(splat);
      }
    return film_of(splats, *filter, {}, 1.0 / (32 * 32));
  }();
  double sum = 0;
  for (int y = 0; y < kSplatHeight; ++y)
    for (int x = 0; x < kSplatWidth; ++x) sum += double{film.value(x, y).r};
  EXPECT_NEAR(sum, 1, 1e-3);
}

TEST_P(Splats, AgreesWithFilterImportanceSampling) {
  const auto filter = filter_named(GetParam());
  const float margin = std::max(filter->radius().x, filter->radius().y) + 1;
  const Film film = film_of(dense_splats(1 << 17, margin, smooth), *filter);
  // Corner, border and middle: at the border half of the filter is outside the film.
  const int pixels[][2] = {{0, 0}, {kSplatWidth - 1, 20}, {4, 15}, {4, 16}, {2, kSplatHeight - 1}};
  for (const auto& [x, y] : pixels) {
    double sum = 0, squares = 0;
    constexpr int kSamples = 1 << 13;
    for (uint32_t i = 0; i < kSamples; ++i) {
      const SobolPoint point(i);
      PathSampler sampler(point, hash_combine(3, static_cast<uint64_t>(x)));
      const PixelFilter::Sample s = filter->sample(sampler.get_2d());
      const Vec2f at(static_cast<float>(x) + 0.5f + s.offset.x,
                     static_cast<float>(y) + 0.5f + s.offset.y);
      const double v = double{s.weight} * double{smooth(at)};
      sum += v / kSamples;
      squares += v * v / kSamples;
    }
    // The splats are as evenly spread as the samples, but fewer fall into a pixel.
    const double error = std::sqrt((squares - sum * sum) / kSamples);
    EXPECT_NEAR(film.value(x, y).r, sum, 4 * error + 0.01) << x << ' ' << y;
    EXPECT_NEAR(film.value(x, y).g, 2 * sum, 8 * error + 0.02) << x << ' ' << y;
  }
}

TEST_P(Splats, CropIsAPartOfTheWhole) {
  const auto filter = filter_named(GetParam());
  const std::vector<Splat> splats = dense_splats(4000, 6, smooth);
  const Film whole = film_of(splats, *filter);
  for (const PixelBounds& crop :
       {PixelBounds{2, 5, 7, 30}, PixelBounds{0, 36, 9, 37}, PixelBounds{8, 0, 9, 1}})
    EXPECT_TRUE(same_bits(whole, film_of(splats, *filter, crop), crop));
}

TEST_P(Splats, BatchesOrderAndThreadsDoNotMatter) {
  const auto filter = filter_named(GetParam());
  std::vector<Splat> splats = dense_splats(5000, 5, smooth);
  const auto in_batches = [&](size_t size, int threads) {
    const ThreadLimit limit(threads);
    Film film(settings_of(), two_parts());
    SplatBuffer buffer(film, 0, *filter);
    for (size_t i = 0; i < splats.size(); i += size)
      buffer.add(std::span(splats).subspan(i, std::min(size, splats.size() - i)));
    buffer.finish(0.37);
    film.add_estimates(0, 1);
    return film;
  };
  const Film whole = in_batches(splats.size(), 1);
  EXPECT_GT(std::abs(whole.value(4, 20).r), 0.1f);
  EXPECT_TRUE(same_bits(whole, in_batches(7, 1), whole.bounds()));
  EXPECT_TRUE(same_bits(whole, in_batches(1000, 4), whole.bounds()));
  std::reverse(splats.begin(), splats.end());
  EXPECT_TRUE(same_bits(whole, in_batches(999, 2), whole.bounds()));
}

INSTANTIATE_TEST_SUITE_P(All, Splats,
                         ::testing::Values("box", "triangle", "gaussian", "mitchell", "sinc"),
                         [](const auto& test) { return test.param; });

Splat splat_at(float x, float y, const Rgb& value, uint8_t part = 0) {
  Splat splat;
  splat.film = Vec2f(x, y);
  splat.value = value;
  splat.part = part;
  return splat;
}

TEST(SplatBuffer, APassIsOneEstimate) {
  const auto box = filter_named("box");
  Film film(settings_of(), two_parts());
  SplatBuffer buffer(film, 0, *box);
  // Totals 6 and 2 of two passes: mean 4, standard error 2.
  const Splat first[] = {splat_at(3.5f, 5.5f, {2, 0, 0}), splat_at(3.2f, 5.1f, {10, 0, 0}, 1)};
  const Splat second[] = {splat_at(3.9f, 5.9f, {4, 0, 0}, 1)};
  buffer.add(first);
  buffer.finish(0.5);
  film.add_estimates(0, 1);
  buffer.add(second);
  buffer.finish(0.5);
  film.add_estimates(0, 1);
  EXPECT_FLOAT_EQ(film.value(3, 5).r, 4);
  EXPECT_FLOAT_EQ(film.route_value(0, 3, 5).r, 0.5f);
  EXPECT_FLOAT_EQ(film.route_value(1, 3, 5).r, 3.5f);
  EXPECT_FLOAT_EQ(film.standard_error(3, 5).r, 2);
  EXPECT_EQ(film.value(4, 5).r, 0.0f);
}

TEST(SplatBuffer, APointOnTheBorderOfTwoBoxesIsInOne) {
  const auto box = filter_named("box");
  const Film film = film_of({splat_at(3, 16, {1, 1, 1})}, *box);
  EXPECT_EQ(film.value(3, 16).r, 1.0f);
  EXPECT_EQ(film.value(2, 16).r, 0.0f);
  EXPECT_EQ(film.value(3, 15).r, 0.0f);
}

TEST(SplatBuffer, OutsideTheFilterTellsWhetherItCounts) {
  const auto triangle = filter_named("triangle");  // radius 2
  const Film film =
      film_of({splat_at(-1.0f, 0.5f, {1, 1, 1}), splat_at(-1.6f, 10.5f, {1, 1, 1}),
               splat_at(1e30f, 10.5f, {1, 1, 1}), splat_at(2.5f, -kInfinity, {1, 1, 1})},
              *triangle);
  EXPECT_FLOAT_EQ(film.value(0, 0).r, 0.5f / 4 * 2 / 4);
  EXPECT_EQ(film.value(0, 10).r, 0.0f);
  EXPECT_EQ(film.value(8, 10).r, 0.0f);
  EXPECT_EQ(film.bad_estimates(0).count, 0u);
}

TEST(SplatBuffer, TheTotalOverThePartsIsHeld) {
  FilmSettings settings = settings_of();
  settings.max_component = 5;
  Film film(settings, two_parts());
  const auto box = filter_named("box");
  SplatBuffer buffer(film, 0, *box);
  const Splat splats[] = {splat_at(3.5f, 5.5f, {60, 30, 0}), splat_at(3.5f, 5.5f, {40, 0, 20}, 1),
                          splat_at(4.5f, 5.5f, {40, 0, 0})};
  buffer.add(splats);
  buffer.finish(0.1);  // totals of 10, 3, 2 and of 4, 0, 0
  film.add_estimates(0, 1);
  EXPECT_FLOAT_EQ(film.value(3, 5).r, 5);
  EXPECT_FLOAT_EQ(film.value(3, 5).g, 1.5f);
  EXPECT_FLOAT_EQ(film.value(3, 5).b, 1);
  EXPECT_FLOAT_EQ(film.route_value(0, 3, 5).r, 3);
  EXPECT_FLOAT_EQ(film.value(4, 5).r, 4);
}

TEST(SplatBuffer, BadSplatsAreCountedAndLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto box = filter_named("box");
  const Film film =
      film_of({splat_at(3.5f, 5.5f, {1, 1, 1}), splat_at(3.5f, 5.5f, {1, nan, 1}),
               splat_at(nan, 5.5f, {1, 1, 1}), splat_at(3.5f, 5.5f, {kInfinity, 0, 0}),
               splat_at(4.5f, 5.5f, {1e20f, 0, 0})},
              *box, {}, 0x1p-34);
  EXPECT_EQ(film.bad_estimates(0).count, 3u);
  EXPECT_EQ(film.saturated_values(), 1u);
  EXPECT_FLOAT_EQ(film.value(3, 5).g, 0x1p-34f);
}

}  // namespace
}  // namespace nephroid
