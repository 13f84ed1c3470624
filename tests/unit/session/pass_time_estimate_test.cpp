#include "session/pass_time_estimate.h"

#include <gtest/gtest.h>

#include <vector>

namespace nephroid {
namespace {

TEST(PassTimeEstimate, KnowsNothingBeforeThereArePixels) {
  PassTimeEstimate estimate;
  EXPECT_EQ(estimate.seconds_left(5), 0);
  EXPECT_FALSE(estimate.seconds_of_pass());
  estimate.begin(10, std::vector{0.0});
  estimate.observe(14, std::vector{0.0});
  EXPECT_FALSE(estimate.seconds_left(14));
  EXPECT_FALSE(estimate.seconds_of_pass());
}

// Two seconds of photons, then ten of pixels.
TEST(PassTimeEstimate, FollowsThePixelsOfTheFirstPass) {
  PassTimeEstimate estimate;
  estimate.begin(10, std::vector{0.0});
  estimate.observe(12, std::vector{0.0});
  estimate.observe(13, std::vector{0.1});
  EXPECT_NEAR(*estimate.seconds_of_pass(), 12, 1e-9);
  EXPECT_NEAR(*estimate.seconds_left(13), 9, 1e-9);
  EXPECT_NEAR(*estimate.seconds_left(14), 8, 1e-9);
  EXPECT_EQ(*estimate.seconds_left(40), 0);
}

TEST(PassTimeEstimate, GroupsWithoutWorkCountForNothing) {
  PassTimeEstimate estimate;
  estimate.begin(0, std::vector{0.0, 0.0});
  estimate.observe(0.5, std::vector{1.0, 0.0});
  EXPECT_FALSE(estimate.seconds_left(0.5));
  estimate.observe(2.5, std::vector{1.0, 0.25});
  EXPECT_NEAR(*estimate.seconds_left(2.5), 6, 1e-9);
}

TEST(PassTimeEstimate, LaterGroupsAreExpectedToTakeAsLong) {
  PassTimeEstimate estimate;
  estimate.begin(0, std::vector{0.0, 0.0, 0.0});
  estimate.observe(1, std::vector{0.5, 0.0, 0.0});
  EXPECT_NEAR(*estimate.seconds_of_pass(), 6, 1e-9);
}

// What is learned before the first pass is not part of the others.
TEST(PassTimeEstimate, LaterPassesTellTheNext) {
  PassTimeEstimate estimate;
  double now = 0;
  const auto pass = [&](double seconds) {
    estimate.begin(now, std::vector{0.0});
    now += seconds;
    estimate.end(now);
  };
  pass(9);
  EXPECT_EQ(*estimate.seconds_of_pass(), 9);
  pass(4);
  pass(6);
  EXPECT_EQ(*estimate.seconds_of_pass(), 5);
  estimate.begin(now, std::vector{0.0});
  estimate.observe(now + 2, std::vector{0.0});
  EXPECT_EQ(*estimate.seconds_left(now + 2), 3);
}

// Photons and learning of a resumed pass take their whole time, so it does not tell that of others.
TEST(PassTimeEstimate, AResumedPassTellsOfItselfAlone) {
  PassTimeEstimate estimate;
  estimate.begin(0, std::vector{0.5});
  estimate.observe(2, std::vector{0.5});
  estimate.observe(3, std::vector{0.75});
  EXPECT_NEAR(*estimate.seconds_left(3), 1, 1e-9);
  EXPECT_FALSE(estimate.seconds_of_pass());
  estimate.end(4);
  EXPECT_FALSE(estimate.seconds_of_pass());
  estimate.begin(4, std::vector{0.0});
  estimate.observe(6, std::vector{0.0});
  estimate.observe(7, std::vector{0.5});
  EXPECT_NEAR(*estimate.seconds_of_pass(), 4, 1e-9);
}

// As of integrators whose pixels are done all at once.
TEST(PassTimeEstimate, APassThatTakesLongerHasNothingLeft) {
  PassTimeEstimate estimate;
  estimate.begin(0, std::vector{0.0});
  estimate.end(3);
  estimate.begin(3, std::vector{0.0});
  EXPECT_EQ(*estimate.seconds_left(5), 1);
  EXPECT_EQ(*estimate.seconds_left(7), 0);
}

TEST(PassTimeEstimate, AGroupBeginsWhenItWasNotSeenYet) {
  PassTimeEstimate estimate;
  estimate.begin(0, std::vector{0.0, 0.0});
  estimate.observe(2, std::vector{0.9, 0.0});
  estimate.observe(3, std::vector{1.0, 0.25});
  EXPECT_NEAR(*estimate.seconds_left(3), 3, 1e-9);
}

}  // namespace
}  // namespace nephroid
