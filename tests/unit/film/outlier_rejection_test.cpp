// Films that reject outliers: which estimates stay, go and return. No light is lost.
#include "film/outlier_rejection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/sampler.h"
#include "film/film.h"
#include "unit/film/one_part.h"

namespace nephroid {
namespace {

using testing_support::add_one;
using testing_support::replace_one;

constexpr int kWidth = 16, kHeight = 12;

FilmSettings settings_of_test() {
  FilmSettings settings;
  settings.width = kWidth + 3;
  settings.height = kHeight + 2;
  settings.crop = {2, 1, 2 + kWidth, 1 + kHeight};
  return settings;
}

/// A rejecting film with `groups` routes, each in its own group.
Film rejecting(int groups = 1, float exposed_pixels = 1) {
  std::vector<std::string> names;
  for (int g = 0; g < groups; ++g) names.push_back("r" + std::to_string(g));
  Film film(settings_of_test(), FilmLayout::of_routes(names));
  film.reject_outliers({std::vector<float>(static_cast<size_t>(groups), exposed_pixels), 8});
  return film;
}

float random_number(uint64_t i) {
  return bits_to_unit_float(static_cast<uint32_t>(mix_bits(i) >> 32));
}

Rgb grey(float v) {
  return {v, v, v};
}

/// Calls body(x, y) for each pixel of the crop.
template <class Body>
void for_each_pixel(const Film& film, const Body& body) {
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) body(x, y);
}

/// One estimate of about 1 in each pixel.
void add_pass(Film& film, uint64_t pass) {
  for_each_pixel(film, [&](int x, int y) {
    add_one(film, 0, x, y,
            grey(0.75f + 0.5f * random_number(hash_combine(pass, static_cast<uint64_t>(x),
                                                           static_cast<uint64_t>(y)))));
  });
  film.add_estimates(0, 1);
}

/// Heavy tails: one estimate in 16 is 2 to 2^12 times as bright as the rest, or negative.
Rgb heavy(uint64_t pass, int x, int y, int group) {
  const uint64_t key = hash_combine(pass, static_cast<uint64_t>(x), static_cast<uint64_t>(y),
                                    static_cast<uint64_t>(group));
  const float u = random_number(key), v = random_number(key + 1);
  if (u > 0.5f && group > 0) return {};
  const float value = u < 1.0f / 16 ? std::exp2(1 + 11 * v) : 0.5f + v;
  return {value, 0.5f * value, v < 0.1f ? -value : 2 * value};
}

void add_heavy_pass(Film& film, uint64_t pass) {
  parallel_chunks(film.bounds().height(), 1, [&](int64_t row, int64_t, int64_t) {
    const int y = film.bounds().y0 + static_cast<int>(row);
    for (int g = 0; g < film.layout().group_count(); ++g)
      for (int x = film.bounds().x0; x < film.bounds().x1; ++x)
        add_one(film, g, x, y, heavy(pass, x, y, g));
  });
  for (int g = 0; g < film.layout().group_count(); ++g) film.add_estimates(g, 1);
  film.finish_pass();
}

void expect_same(const Rgb& a, const Rgb& b, int x, int y) {
  EXPECT_EQ(a.r, b.r) << x << ' ' << y;
  EXPECT_EQ(a.g, b.g) << x << ' ' << y;
  EXPECT_EQ(a.b, b.b) << x << ' ' << y;
}

TEST(OutlierRejection, WhatIsDenseIsThePictureWithoutRejectionToTheBit) {
  Film plain(settings_of_test(), FilmLayout::of_routes({"all"}));
  Film film = rejecting();
  for (uint64_t pass = 0; pass < 3; ++pass) {
    add_pass(plain, pass);
    add_pass(film, pass);
    film.finish_pass();
    EXPECT_EQ(film.rejection()->held_estimates(), 0u);
    for_each_pixel(film, [&](int x, int y) {
      expect_same(film.value(x, y), plain.value(x, y), x, y);
      expect_same(film.standard_error(x, y), plain.standard_error(x, y), x, y);
    });
  }
}

TEST(OutlierRejection, WhatIsIsolatedIsInItsOwnLayer) {
  Film film = rejecting();
  add_pass(film, 0);
  film.finish_pass();
  const Rgb before = film.value(7, 6);
  add_one(film, 0, 7, 6, {1000, 500, 250});
  for_each_pixel(film, [&](int x, int y) {
    if (x != 7 || y != 6) add_one(film, 0, x, y, grey(1));
  });
  film.add_estimates(0, 1);
  film.finish_pass();
  EXPECT_EQ(film.rejection()->held_estimates(), 1u);
  expect_same(film.outliers(7, 6), {500, 250, 125}, 7, 6);
  expect_same(film.value(7, 6), before * 0.5f, 7, 6);
  EXPECT_EQ(film.outliers(8, 6).r, 0.0f);
}

TEST(OutlierRejection, WhatIsConfirmedReturns) {
  Film plain(settings_of_test(), FilmLayout::of_routes({"all"}));
  Film film = rejecting();
  // One bright estimate per pass, each in another pixel of a 3 x 3 block: the eighth confirms all.
  for (uint64_t pass = 0; pass < 8; ++pass) {
    for (Film* f : {&plain, &film}) {
      add_pass(*f, pass);
      add_one(*f, 0, 6 + static_cast<int>(pass) % 3, 6 + static_cast<int>(pass) / 3,
              grey(1000 + 10 * static_cast<float>(pass)));
      f->finish_pass();
    }
    EXPECT_EQ(film.rejection()->held_estimates(), pass < 7 ? pass + 1 : 0) << pass;
  }
  for_each_pixel(film, [&](int x, int y) {
    expect_same(film.value(x, y), plain.value(x, y), x, y);
    expect_same(film.outliers(x, y), {}, x, y);
  });
}

TEST(OutlierRejection, WhatIsRareInAWholeRegionIsShown) {
  // The only light of a region comes in one estimate of fifty, like that of a rarely chosen lamp.
  FilmSettings settings;
  settings.width = settings.height = 48;
  settings.crop = {0, 0, 48, 48};
  Film film(settings, FilmLayout::of_routes({"all"}));
  film.reject_outliers({{1.0f}, 8});
  uint64_t bright = 0;
  for (uint64_t pass = 0; pass < 8; ++pass) {
    for_each_pixel(film, [&](int x, int y) {
      const bool hit = random_number(hash_combine(pass, static_cast<uint64_t>(x),
                                                  static_cast<uint64_t>(y))) < 0.02f;
      add_one(film, 0, x, y, grey(hit ? 50.0f : 0.0f));
      bright += hit ? 1 : 0;
    });
    film.add_estimates(0, 1);
    film.finish_pass();
  }
  EXPECT_GT(bright, 300u);
  // In the corners the window has a quarter of its usual size.
  EXPECT_LT(film.rejection()->held_estimates(), bright / 50);
}

TEST(OutlierRejection, OneAfterAnotherInOnePixelIsConfirmedToo) {
  Film film = rejecting();
  for (uint64_t pass = 0; pass < 8; ++pass) {
    EXPECT_EQ(film.rejection()->held_estimates(), pass);
    add_pass(film, pass);
    add_one(film, 0, 7, 6, grey(1000));
    film.finish_pass();
  }
  EXPECT_EQ(film.rejection()->held_estimates(), 0u);
}

TEST(OutlierRejection, WhatIsNotMuchBrighterThanItsSurroundingsStays) {
  for (const auto& [value, held] : {std::pair{1.9f, 0u}, {40.0f, 1u}}) {
    Film film = rejecting();
    add_pass(film, 0);
    film.finish_pass();
    add_one(film, 0, 7, 6, grey(value));
    film.finish_pass();
    EXPECT_EQ(film.rejection()->held_estimates(), held) << value;
  }
}

TEST(OutlierRejection, WhatHardlyChangesItsPixelReturns) {
  Film film = rejecting();
  add_pass(film, 0);
  add_one(film, 0, 7, 6, grey(40));
  film.finish_pass();
  uint64_t passes = 1;
  for (; film.rejection()->held_estimates() == 1 && passes < 1000; ++passes) {
    add_pass(film, passes);
    film.finish_pass();
  }
  // The octave of 40 ends at 64. This is a quarter of 256 times the surroundings of about 1.
  EXPECT_NEAR(static_cast<double>(passes), 256, 26);
}

TEST(OutlierRejection, APhotonDoesNotConfirmItself) {
  for (const float exposed : {1.0f, 9.0f}) {
    Film film = rejecting(1, exposed);
    for (uint64_t pass = 0; pass < 6; ++pass) add_pass(film, pass), film.finish_pass();
    for (int y = 5; y < 8; ++y)
      for (int x = 6; x < 9; ++x) add_one(film, 0, x, y, grey(1000));
    film.finish_pass();
    EXPECT_EQ(film.rejection()->held_estimates(), exposed > 1 ? 9u : 0u);
  }
}

// The image of a small lamp: always bright, by different octaves, and in one pixel alone, where
// photons of one light path would expose many.
TEST(OutlierRejection, APixelThatIsMostlyBrightIsShown) {
  for (const uint64_t one_in : {2u, 3u}) {
    Film film = rejecting(1, 100);
    uint64_t bright = 0;
    for (uint64_t pass = 0; pass < 40; ++pass) {
      add_pass(film, pass);
      if (pass % one_in == 0) add_one(film, 0, 7, 6, grey(++bright % 2 == 0 ? 4000.0f : 1000.0f));
      film.finish_pass();
    }
    // Those of the higher octave are a quarter of all.
    EXPECT_EQ(film.rejection()->held_estimates(), one_in == 2 ? 10u : bright);
  }
}

// Counts of a pixel saturate at 255, and so does the required count, even if one light path splats
// on all pixels.
TEST(OutlierRejection, HalfOf255PassesConfirmHoweverManyThereAre) {
  for (const uint64_t bright : {127u, 128u}) {
    OutlierRejection rejection(1, 1, {1}, {{1e6f}, 8});
    uint64_t released = 0;
    const auto release = [&](int, size_t, std::span<const RgbSum>) { ++released; };
    const Rgb value = grey(1000);
    for (uint64_t i = 0; i < bright; ++i) EXPECT_TRUE(rejection.hold(0, 0, {&value, 1}, release));
    const float nothing = 0;
    rejection.finish_pass(0, 1000, {&nothing, 1}, release);
    EXPECT_EQ(released, bright == 128 ? 1u : 0u);
    EXPECT_EQ(rejection.held_estimates(), bright == 128 ? 0u : bright);
  }
}

TEST(OutlierRejection, NothingIsLost) {
  Film plain(settings_of_test(), FilmLayout::of_routes({"a", "b"}));
  Film film = rejecting(2);
  double held = 0;
  for (uint64_t pass = 0; pass < 12; ++pass) {
    add_heavy_pass(plain, pass);
    add_heavy_pass(film, pass);
    for_each_pixel(film, [&](int x, int y) {
      // The standard error uses the sums of both layers: equal bits show equal sums.
      expect_same(film.standard_error(x, y), plain.standard_error(x, y), x, y);
      const Rgb whole = plain.value(x, y), kept = film.value(x, y), out = film.outliers(x, y);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(kept[c] + out[c], whole[c], 1e-6f * (std::abs(kept[c]) + std::abs(out[c])));
        held += static_cast<double>(std::abs(out[c]));
      }
    });
  }
  EXPECT_GT(held, 0.0);
  EXPECT_GT(film.rejection()->held_estimates(), 10u);
}

TEST(OutlierRejection, AnEstimateMovesWithAllItsParts) {
  FilmLayout layout;
  layout.routes = {"all"};
  layout.aovs = {"some"};
  layout.parts = {{0, {}}, {0, {0}}};
  layout.groups = {0};
  Film film(settings_of_test(), layout);
  film.reject_outliers({{1.0f}, 8});
  const std::vector<Rgb> usual = {grey(1), grey(0.5f)}, bright = {grey(3), grey(4096)};
  for_each_pixel(film, [&](int x, int y) { film.add(0, x, y, usual); });
  film.add_estimates(0, 1);
  film.finish_pass();
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(film.route_value(0, 7, 6).r, 1.5f);
    EXPECT_EQ(film.aov_value(0, 7, 6).r, 0.5f);
    EXPECT_EQ(film.outliers(7, 6).r, 4099.0f * static_cast<float>(i));
    film.add(0, 7, 6, bright);
    film.finish_pass();
  }
  EXPECT_EQ(film.outliers(7, 6).r, 0.0f);
  EXPECT_EQ(film.aov_value(0, 7, 6).r, 0.5f + 8 * 4096);
  EXPECT_EQ(film.route_value(0, 7, 6).r, 1.5f + 8 * 4099);
}

TEST(OutlierRejection, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<Film> films;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    films.push_back(rejecting(2));
    for (uint64_t pass = 0; pass < 8; ++pass) add_heavy_pass(films.back(), pass);
  }
  EXPECT_GT(films[0].rejection()->held_estimates(), 0u);
  for (size_t i = 1; i < films.size(); ++i) {
    EXPECT_EQ(films[i].rejection()->held_estimates(), films[0].rejection()->held_estimates());
    for_each_pixel(films[0], [&](int x, int y) {
      expect_same(films[i].value(x, y), films[0].value(x, y), x, y);
      expect_same(films[i].outliers(x, y), films[0].outliers(x, y), x, y);
    });
  }
}

TEST(OutlierRejection, UnitsOfLightDoNotMatter) {
  constexpr float kScale = 0x1p12f;
  Film film = rejecting(), other = rejecting();
  for (uint64_t pass = 0; pass < 6; ++pass) {
    for_each_pixel(film, [&](int x, int y) {
      add_one(film, 0, x, y, heavy(pass, x, y, 0));
      add_one(other, 0, x, y, heavy(pass, x, y, 0) * kScale);
    });
    for (Film* f : {&film, &other}) f->add_estimates(0, 1), f->finish_pass();
  }
  EXPECT_GT(film.rejection()->held_estimates(), 0u);
  for_each_pixel(film, [&](int x, int y) {
    expect_same(other.outliers(x, y), film.outliers(x, y) * kScale, x, y);
  });
}

TEST(OutlierRejection, APixelHoldsSoManyBrightnessesOnly) {
  Film film = rejecting();
  add_pass(film, 0);
  film.finish_pass();
  const float before = film.value(7, 6).r;
  // From dark to bright, each 16 times the previous one: the darkest make room for the brightest.
  float sum = 0, brightest = 0;
  for (int i = 0; i < 6; ++i) {
    const float value = std::ldexp(1.0f, 6 + 4 * i);
    add_one(film, 0, 7, 6, grey(value));
    if (i < 2) sum += value;
    if (i >= 2) brightest += value;
  }
  EXPECT_EQ(film.rejection()->held_estimates(), uint64_t{OutlierRejection::kMaxHeld});
  EXPECT_EQ(film.value(7, 6).r, before + sum);
  EXPECT_EQ(film.outliers(7, 6).r, brightest);
  // An estimate darker than all held ones is not held either.
  add_one(film, 0, 7, 6, grey(32));
  EXPECT_EQ(film.rejection()->held_estimates(), uint64_t{OutlierRejection::kMaxHeld});
  EXPECT_EQ(film.value(7, 6).r, before + sum + 32);
}

TEST(OutlierRejection, WhatReplacesAPixelIsNotHeld) {
  Film film = rejecting();
  replace_one(film, 0, 7, 6, grey(1000));
  film.set_estimates(0, 1);
  film.finish_pass();
  EXPECT_EQ(film.value(7, 6).r, 1000.0f);
  EXPECT_EQ(film.outliers(7, 6).r, 0.0f);
}

TEST(OutlierRejection, ValuesThatAreNotFiniteAreCountedAndLeftOut) {
  Film film = rejecting();
  add_one(film, 0, 7, 6, {1, INFINITY, 1});
  add_one(film, 0, 7, 6, {1, NAN, 1});
  EXPECT_EQ(film.bad_estimates(0).count, 2u);
  EXPECT_EQ(film.rejection()->held_estimates(), 0u);
}

TEST(OutlierRejection, WithoutItThereIsNothingHeld) {
  Film film(settings_of_test(), FilmLayout::of_routes({"all"}));
  add_one(film, 0, 7, 6, grey(1000));
  film.add_estimates(0, 1);
  film.finish_pass();
  EXPECT_EQ(film.rejection(), nullptr);
  EXPECT_EQ(film.value(7, 6).r, 1000.0f);
  EXPECT_EQ(film.outliers(7, 6).r, 0.0f);
}

}  // namespace
}  // namespace nephroid
