// The error that a film states, and each route's share of the light.
#include "session/report/noise.h"

#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_FALSE(estimated_error(film).has_value());
  film.add_estimates(1, 1);
  EXPECT_EQ(estimated_error(film)->total(), 0.0);
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
  EXPECT_NEAR(estimated_error(film)->total(), estimated_error(plain)->total(),
              1e-6 * estimated_error(plain)->total())
      << "the error is that of all light, and relative to all of it";
}

// [F5]
TEST(Noise, BiasCountsWithoutItsOwnNoise) {
  FilmSettings settings;
  settings.width = 2;
  settings.height = 1;
  FilmLayout layout = FilmLayout::of_routes({"a", "b"});
  layout.merges = {false, true};
  Film film(settings, layout);
  // A bias of 0.2 with an error of 0.1 in one pixel of value 1: the squared error, 0.01, is
  // subtracted from the squared bias.
  for (const float b : {0.3f, 0.1f}) {
    add_one(film, 0, 0, 0, {1, 1, 1});
    for (int g = 0; g < 2; ++g) film.add_estimates(g, 1);
    film.add_bias(0, std::vector<float>{9, 9});
    film.add_bias(1, std::vector<float>{b, 0});
  }
  EXPECT_TRUE(film.has_bias());
  EXPECT_NEAR(film.bias(0, 0), 0.2, 1e-7);
  EXPECT_NEAR(film.bias_error(0, 0), 0.1, 1e-7);
  EXPECT_EQ(film.bias(1, 0), 0.0f);
  const double expected = std::sqrt((0.2 * 0.2 - 0.1 * 0.1) / (1 + 0.01) / 2);
  EXPECT_NEAR(estimated_error(film)->total(), expected, 1e-6);
  const auto shares = error_shares(film);
  EXPECT_EQ(shares->groups, (std::vector<double>{0, 0}));
  EXPECT_NEAR(shares->bias, expected, 1e-6);
}

TEST(Noise, OfGroupsAddsUpToThatOfTheFilm) {
  FilmSettings settings;
  settings.width = settings.height = 1;
  Film film(settings, FilmLayout::of_routes({"a", "b"}));
  for (const float v : {1.0f, 3.0f}) {
    add_one(film, 0, 0, 0, {v, 0, 0});
    add_one(film, 1, 0, 0, {0, 0, 2 * v});
    for (int g = 0; g < 2; ++g) film.add_estimates(g, 1);
  }
  const auto shares = error_shares(film);
  ASSERT_EQ(shares->groups.size(), 2u);
  // Standard errors 1 and 2 for values 2 and 4.
  EXPECT_NEAR(shares->groups[0], std::sqrt(1 / 4.01 / 3), 1e-6);
  EXPECT_NEAR(shares->groups[1], std::sqrt(4 / 16.01 / 3), 1e-6);
  EXPECT_EQ(shares->bias, 0.0);
  EXPECT_NEAR(estimated_error(film)->total(), std::hypot(shares->groups[0], shares->groups[1]),
              1e-6);
}

TEST(Noise, SaysHowManyPassesATargetTakes) {
  EXPECT_NEAR(passes_to({0.2, 0}, 0.1), 4, 1e-9);
  EXPECT_NEAR(passes_to({0, 0.2}, 0.1), 8, 1e-9);
  EXPECT_NEAR(passes_to({0.1, 0}, 0.2), 0.25, 1e-9);
  EXPECT_EQ(passes_to({0, 0}, 0.1), 0.0);
  const double g = passes_to({0.3, 0.1}, 0.07);
  EXPECT_NEAR(0.3 * 0.3 / g + 0.1 * 0.1 / std::pow(g, 2.0 / 3), 0.07 * 0.07, 1e-9);
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
