#include "session/pass_forecast.h"

#include <gtest/gtest.h>

#include <vector>

namespace nephroid {
namespace {

TEST(PassForecast, KnowsNothingBeforeThereArePixels) {
  PassForecast forecast;
  EXPECT_EQ(forecast.seconds_left(5), 0);
  EXPECT_FALSE(forecast.seconds_of_pass());
  forecast.begin(10, std::vector{0.0});
  forecast.look(14, std::vector{0.0});
  EXPECT_FALSE(forecast.seconds_left(14));
  EXPECT_FALSE(forecast.seconds_of_pass());
}

// Two seconds of photons, then ten of pixels.
TEST(PassForecast, FollowsThePixelsOfTheFirstPass) {
  PassForecast forecast;
  forecast.begin(10, std::vector{0.0});
  forecast.look(12, std::vector{0.0});
  forecast.look(13, std::vector{0.1});
  EXPECT_NEAR(*forecast.seconds_of_pass(), 12, 1e-9);
  EXPECT_NEAR(*forecast.seconds_left(13), 9, 1e-9);
  EXPECT_NEAR(*forecast.seconds_left(14), 8, 1e-9);
  EXPECT_EQ(*forecast.seconds_left(40), 0);
}

TEST(PassForecast, GroupsWithoutWorkCountForNothing) {
  PassForecast forecast;
  forecast.begin(0, std::vector{0.0, 0.0});
  forecast.look(0.5, std::vector{1.0, 0.0});
  EXPECT_FALSE(forecast.seconds_left(0.5));
  forecast.look(2.5, std::vector{1.0, 0.25});
  EXPECT_NEAR(*forecast.seconds_left(2.5), 6, 1e-9);
}

TEST(PassForecast, LaterGroupsAreExpectedToTakeAsLong) {
  PassForecast forecast;
  forecast.begin(0, std::vector{0.0, 0.0, 0.0});
  forecast.look(1, std::vector{0.5, 0.0, 0.0});
  EXPECT_NEAR(*forecast.seconds_of_pass(), 6, 1e-9);
}

// What is learned before the first pass is not part of the others.
TEST(PassForecast, LaterPassesTellTheNext) {
  PassForecast forecast;
  double now = 0;
  const auto pass = [&](double seconds) {
    forecast.begin(now, std::vector{0.0});
    now += seconds;
    forecast.end(now);
  };
  pass(9);
  EXPECT_EQ(*forecast.seconds_of_pass(), 9);
  pass(4);
  pass(6);
  EXPECT_EQ(*forecast.seconds_of_pass(), 5);
  forecast.begin(now, std::vector{0.0});
  forecast.look(now + 2, std::vector{0.0});
  EXPECT_EQ(*forecast.seconds_left(now + 2), 3);
}

TEST(PassForecast, AResumedPassIsAPartOfOne) {
  PassForecast forecast;
  forecast.begin(0, std::vector{0.5});
  forecast.look(1, std::vector{0.75});
  EXPECT_NEAR(*forecast.seconds_left(1), 1, 1e-9);
  EXPECT_NEAR(*forecast.seconds_of_pass(), 4, 1e-9);
  forecast.end(2);
  EXPECT_NEAR(*forecast.seconds_of_pass(), 4, 1e-9);
}

}  // namespace
}  // namespace nephroid
