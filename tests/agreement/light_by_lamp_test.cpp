// Light by lamp: the counts add up to the picture, each is the light of its lamp alone, and they do
// not depend on the number of threads.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "rendering.h"

namespace nephroid {
namespace {

using testing_support::film_for, testing_support::plan_named, testing_support::scene_from_text;

constexpr const char* kLampView = R"(
  LookAt 0 3 -6  0 0.5 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 16 "integer yresolution" 12
  PixelFilter "box"
  WorldBegin
  Shape "bilinearmesh" "point3 P" [-9 0 -9 9 0 -9 -9 0 9 9 0 9]
  AttributeBegin Translate 0 0.6 0 Material "dielectric" Shape "sphere" "float radius" 0.5
  AttributeEnd
)";
constexpr const char* kBallLamp = R"(AttributeBegin
  AreaLightSource "diffuse" "rgb L" [9 3 3] "string name" "lamp"
  Translate 2 3 0 Shape "sphere" "float radius" 0.4 AttributeEnd
)";
constexpr const char* kLampSky = "LightSource \"infinite\" \"rgb L\" [0.2 0.2 0.4]\n";
constexpr const char* kBoxed = R"(AttributeBegin Translate -3 2 0
  Shape "sphere" "float radius" 0.5
  LightSource "point" "rgb I" [5 5 5] AttributeEnd
)";

struct Counts {
  std::vector<LampLight> lamps;
  double film = 0;  ///< sum of the components of all pixels
  bool tells = true;

  double light(const std::string& label) const {
    double sum = 0;
    for (const LampLight& lamp : lamps)
      if (lamp.name.rfind(label + " (", 0) == 0) sum += lamp.light;
    return sum;
  }
};

Counts counts_of(const std::string& world, const std::string& plan, uint32_t passes) {
  const auto scene = scene_from_text(kLampView + world);
  EstimatorSet set = make_estimators(plan_named(plan), {}, *scene);
  Film film = film_for(*scene, set);
  for (uint32_t pass = 0; pass < passes; ++pass) set.render_pass({7, pass}, *scene, film);
  Counts counts;
  for (const EstimatorStatistics& s : set.statistics()) {
    counts.tells = counts.tells && s.tells_lamps;
    for (size_t i = 0; i < s.lamps.size(); ++i) {
      if (counts.lamps.size() <= i) counts.lamps.push_back({s.lamps[i].name});
      counts.lamps[i].light += s.lamps[i].light / std::min(passes, 8u);
      counts.lamps[i].rays += s.lamps[i].rays;
    }
  }
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      const Rgb value = film.value(x, y);
      counts.film += static_cast<double>(value.r) + value.g + value.b;
    }
  return counts;
}

class LightByLamp : public ::testing::TestWithParam<const char*> {};

TEST_P(LightByLamp, AddsUpToThePicture) {
  const Counts counts = counts_of(std::string(kBallLamp) + kLampSky + kBoxed, GetParam(), 8);
  EXPECT_TRUE(counts.tells);
  ASSERT_EQ(counts.lamps.size(), 3u);
  EXPECT_EQ(counts.light("point1"), 0);
  EXPECT_GT(counts.light("lamp"), 0);
  EXPECT_GT(counts.light("infinite1"), 0);
  EXPECT_NEAR((counts.light("lamp") + counts.light("infinite1")) / counts.film, 1, 1e-5);
}

TEST_P(LightByLamp, IsTheLightOfEachLampAlone) {
  const Counts both = counts_of(std::string(kBallLamp) + kLampSky, GetParam(), 8);
  const double share = both.light("lamp") / both.film;
  const double lamp = counts_of(kBallLamp, GetParam(), 8).film,
               sky = counts_of(kLampSky, GetParam(), 8).film;
  // The standard error of the share is about 0.02.
  EXPECT_NEAR(share, lamp / (lamp + sky), 0.08);
}

TEST_P(LightByLamp, ThreadsDoNotMatter) {
  std::vector<Counts> counts;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    counts.push_back(counts_of(std::string(kBallLamp) + kLampSky + kBoxed, GetParam(), 2));
  }
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(counts[0].lamps[i].light, counts[1].lamps[i].light);
    EXPECT_EQ(counts[0].lamps[i].rays, counts[1].lamps[i].rays);
  }
}

TEST_P(LightByLamp, LaterPassesAreNotCounted) {
  const Counts eight = counts_of(kLampSky, GetParam(), 8),
               more = counts_of(kLampSky, GetParam(), 10);
  EXPECT_EQ(eight.lamps[0].light, more.lamps[0].light);
}

INSTANTIATE_TEST_SUITE_P(Estimators, LightByLamp,
                         ::testing::Values("mixed", "path", "bdpt", "vcm", "bpm"),
                         [](const auto& row) { return std::string(row.param); });

TEST(LightByLamp, LightsOfOneNameAreOneAndGlowingMediaAreOthers) {
  const Counts counts = counts_of(std::string(kBallLamp) + kBallLamp + R"(
    MakeNamedMedium "fire" "string type" "homogeneous" "rgb Le" [1 1 1] "rgb sigma_a" [1 1 1]
      "rgb sigma_s" [0 0 0]
    AttributeBegin MediumInterface "fire" "" Material "interface" Translate 1 1 1
    Shape "sphere" "float radius" 0.5 AttributeEnd)",
                                  "mixed", 2);
  ASSERT_EQ(counts.lamps.size(), 2u);
  EXPECT_EQ(counts.lamps[1].name, "fire");
  EXPECT_GT(counts.lamps[1].light, 0);
}

TEST(LightByLamp, OtherEstimatorsSayThatTheyDoNotTell) {
  EXPECT_FALSE(counts_of(kLampSky, "sppm", 1).tells);
}

}  // namespace
}  // namespace nephroid
