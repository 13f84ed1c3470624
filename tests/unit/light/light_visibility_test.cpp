// Cells of learned visibility.
#include "scene/light/light_visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/bsdf/statistics.h"

namespace nephroid {
namespace {

using testing_bsdf::TestRandom;

/// Random points in a unit cube, each with one sample of slot 0.
template <class Value>
std::vector<SurveyedPoint> points_in_a_cube(int count, const Value& value) {
  TestRandom random(61);
  std::vector<SurveyedPoint> points(count);
  for (SurveyedPoint& point : points) {
    point.p = {random.next(), random.next(), random.next()};
    point.samples = {{0, value(point.p)}};
  }
  return points;
}

TEST(LightVisibility, IsTheMeanOfTheSamples) {
  int number = 0;
  const LightVisibility visibility(
      points_in_a_cube(5000, [&](const Vec3f&) { return ++number % 2 == 0 ? 0.6f : 0.0f; }), 1);
  TestRandom random(62);
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(*visibility.at({random.next(), random.next(), random.next()}), 0.3f, 0.2f);
}

TEST(LightVisibility, DiffersFromPlaceToPlace) {
  const LightVisibility visibility(
      points_in_a_cube(20000, [](const Vec3f& p) { return p.y < 0.5f ? 0.0f : 1.0f; }), 1);
  TestRandom random(63);
  for (int i = 0; i < 100; ++i) {
    const float x = random.next(), z = random.next();
    EXPECT_LT(*visibility.at({x, 0.2f, z}), 0.1f);
    EXPECT_GT(*visibility.at({x, 0.8f, z}), 0.9f);
    // Outside of all points the nearest cell counts.
    EXPECT_GT(*visibility.at({x, 100, z}), 0.9f);
  }
}

TEST(LightVisibility, TakesSlotsWithoutSamplesFromTheCellAround) {
  std::vector<SurveyedPoint> points = points_in_a_cube(1000, [](const Vec3f&) { return 1.0f; });
  points.front().samples.push_back({1, 0.25f});
  const LightVisibility visibility(points, 3);
  for (const Vec3f& p : {Vec3f(0.1f, 0.1f, 0.1f), Vec3f(0.9f, 0.9f, 0.9f)}) {
    EXPECT_NEAR(visibility.at(p)[1], 0.25f, 1e-6f);
    EXPECT_LT(visibility.at(p)[2], 0.0f) << "not known";
  }
}

// A wall at the end of a room fills most of the view.
TEST(LightVisibility, TellsAWallFromTheRoomInFrontOfIt) {
  std::vector<SurveyedPoint> points = points_in_a_cube(5000, [](const Vec3f&) { return 0.0f; });
  for (size_t i = 0; i < points.size(); ++i) {
    points[i].p.z *= 3;
    if (i % 5 >= 3) continue;
    points[i].p.z = 0;
    points[i].samples.front().value = 1;
  }
  std::vector<SurveyedPoint> mostly_wall = points;
  for (size_t i = 0; i < points.size(); i += 5) mostly_wall.push_back(points[i]);
  for (const auto& all : {points, mostly_wall}) {
    const LightVisibility visibility(all, 1);
    EXPECT_GT(*visibility.at({0.5f, 0.5f, 0}), 0.9f);
    EXPECT_LT(*visibility.at({0.5f, 0.5f, 1.5f}), 0.1f);
  }
}

TEST(LightVisibility, LeavesOutWhatIsNotFinite) {
  std::vector<SurveyedPoint> points = points_in_a_cube(100, [](const Vec3f&) { return 0.5f; });
  points[3].samples = {{0, std::numeric_limits<double>::infinity()}, {0, std::nan("")}};
  EXPECT_NEAR(*LightVisibility(points, 1).at({0.5f, 0.5f, 0.5f}), 0.5f, 1e-6f);
}

TEST(LightVisibility, EndsWherePointsCoincide) {
  std::vector<SurveyedPoint> points(1000);
  for (SurveyedPoint& point : points) point = {{1, 2, 3}, {{0, 0.5f}}};
  EXPECT_NEAR(*LightVisibility(points, 1).at({1, 2, 3}), 0.5f, 1e-6f);
}

TEST(LightVisibility, OfNoPointsIsEmpty) {
  EXPECT_TRUE(LightVisibility().empty());
  EXPECT_TRUE(LightVisibility(std::vector<SurveyedPoint>(), 3).empty());
}

}  // namespace
}  // namespace nephroid
