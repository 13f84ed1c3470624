// The noise that a film tells of, and how much of its light each route has.
#include "session/noise.h"

#include <gtest/gtest.h>

#include "unit/film/one_part.h"

namespace nephroid {
namespace {

using testing_support::add_one;

TEST(Noise, NeedsTwoEstimatesOfEveryGroup) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  Film film(settings, FilmLayout::of_routes({"a", "b"}));
  film.add_estimates(0, 5);
  film.add_estimates(1, 1);
  EXPECT_FALSE(estimated_noise(film).has_value());
  film.add_estimates(1, 1);
  EXPECT_EQ(*estimated_noise(film), 0.0);
}

TEST(Noise, WhatIsHeldIsAShareOfAllAndCountsAsNoise) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  Film plain(settings, FilmLayout::of_routes({"a"})), film = plain;
  film.reject_outliers({{1.0f}, 8});
  for (Film* f : {&plain, &film}) {
    for (const int x : {0, 1}) add_one(*f, 0, x, 0, {1, 1, 1});
    f->add_estimates(0, 1);
    f->finish_pass();
    add_one(*f, 0, 1, 1, {6, 0, 0});
    f->add_estimates(0, 1);
    f->finish_pass();
  }
  EXPECT_EQ(energy_shares(plain).outliers, 0.0);
  EXPECT_NEAR(energy_shares(film).outliers, 0.5, 1e-7);
  EXPECT_EQ(energy_shares(film).routes, std::vector<double>{1});
  EXPECT_NEAR(*estimated_noise(film), *estimated_noise(plain), 1e-6 * *estimated_noise(plain))
      << "the error is that of all light, and relative to all of it";
}

TEST(Noise, SharesOfRoutes) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  Film film(settings, FilmLayout::of_routes({"a", "b"}));
  EXPECT_EQ(energy_shares(film).routes, (std::vector<double>{0, 0}));
  add_one(film, 0, 0, 0, {2, 0, 0});
  add_one(film, 1, 1, 1, {3, 6, 0});
  film.add_estimates(0, 2);  // means 1 and 3
  film.add_estimates(1, 3);
  const auto shares = energy_shares(film).routes;
  EXPECT_NEAR(shares[0], 0.25, 1e-7);
  EXPECT_NEAR(shares[1], 0.75, 1e-7);
}

}  // namespace
}  // namespace nephroid
