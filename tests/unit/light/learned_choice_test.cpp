// Light samplers that have learned which lights reach which places.
#include "scene/light/light_sampler.h"
#include "unit/light/zoo_of_lights.h"

namespace nephroid::testing_light {
namespace {

/// Makes the sampler learn from random points around the zoo, by the light that `arrives(light, p)`
/// says.
template <class Arrives>
void teach(LightSampler& sampler, const Arrives& arrives) {
  TestRandom random(51);
  std::vector<SurveyedPoint> points(12000);
  for (SurveyedPoint& point : points) {
    point.p = Vec3f(random.next(), random.next(), random.next()) * 3.0f - Vec3f(1);
    for (int k = 0; k < 8; ++k)
      sampler.survey(
          point.p, {0, 0, 1}, random.next(), [&](int light) { return arrives(light, point.p); },
          point.samples);
  }
  sampler.learn(LightVisibility(points, sampler.slot_count()));
}

TEST(LearnedChoice, HasTheFrequenciesOfItsProbabilities) {
  for (const int n : {0, 1, 2, 4, 5, 40, 300})
    for (const int infinite : {0, 1, 2, 20}) {
      const auto lights = zoo(n, infinite);
      LightSampler sampler(lights);
      if (sampler.slot_count() == 0) continue;
      teach(sampler, [](int light, const Vec3f& p) { return light % 3 == 0 ? 0.0f : p.x + 2; });
      expect_frequencies(sampler, lights, {0.4f, 0.5f, -0.3f}, {0, 0, 1}, 20000);
      expect_frequencies(sampler, lights, {0.5f, 0.5f, 0.5f}, normalize(Vec3f(1, 1, -2)), 20000);
      expect_frequencies(sampler, lights, {70, -3, 2}, {0, 1, 0}, 20000);
    }
}

// Lights of equal power in a ring; a wall hides the half on the other side.
TEST(LearnedChoice, KnowsWhichLightsReachAPlace) {
  for (const int count : {2, 4, 8, 60}) {
    std::vector<LightPtr> lights;
    std::vector<Vec3f> places;
    for (int i = 0; i < count; ++i) {
      const float turn = 2 * kPi * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
      places.emplace_back(2 * std::sin(turn), 2 * std::cos(turn), 1.0f);
      lights.push_back(std::make_unique<FakeLight>(places.back(), 1.0f));
    }
    LightSampler sampler(lights);
    teach(sampler, [&](int light, const Vec3f& p) {
      const bool same_side = (places[light].x < 0) == (p.x < 0);
      return same_side ? 1 / length_squared(p - places[light]) : 0.0f;
    });
    double visible = 0, all = 0;
    for (int i = 0; i < count; ++i) {
      const float pmf = sampler.pmf({-0.5f, 0, 0}, {0, 0, 1}, i);
      EXPECT_GT(pmf, 0.0f) << "what was not seen may be there";
      all += pmf;
      if (places[i].x < 0) visible += pmf;
    }
    EXPECT_NEAR(all, 1, 1e-5);
    EXPECT_GT(visible, 0.85) << count << " lights";
    // Nothing was learned for media.
    double in_fog = 0;
    for (int i = 0; i < count; ++i)
      if (places[i].x < 0) in_fog += sampler.pmf({-0.01f, 0, 0}, {0, 0, 0}, i);
    EXPECT_NEAR(in_fog, 0.5, 0.1) << count << " lights";
  }
}

TEST(LearnedChoice, KnowsHowBrightInfiniteLightsAreInAPlace) {
  const auto lights = zoo(3, 2);
  LightSampler sampler(lights);
  // The second sky is hidden from x < 0.5, and much brighter than all else.
  teach(sampler,
        [](int light, const Vec3f& p) { return light == 1 ? (p.x < 0.5f ? 0.0f : 100.0f) : 0.1f; });
  EXPECT_LT(sampler.pmf({-0.5f, 0, 0}, {0, 0, 1}, 1), 0.1f);
  EXPECT_GT(sampler.pmf({1.5f, 0, 0}, {0, 0, 1}, 1), 0.9f);
}

TEST(LearnedChoice, IsNothingWithoutAChoice) {
  EXPECT_EQ(LightSampler(zoo(0, 0)).slot_count(), 0u);
  EXPECT_EQ(LightSampler(zoo(1, 0)).slot_count(), 0u);
  EXPECT_EQ(LightSampler(zoo(0, 1)).slot_count(), 0u);
  EXPECT_GT(LightSampler(zoo(1, 1)).slot_count(), 0u);
  EXPECT_GT(LightSampler(zoo(5, 0)).slot_count(), 0u);
}

// [D5]: at least a tenth of the probability without learning is left, however deep the tree.
TEST(LearnedChoice, LeavesEachLightATenthOfItsChance) {
  const auto lights = zoo(300, 1);
  LightSampler sampler(lights);
  teach(sampler, [](int light, const Vec3f&) { return light == 18 ? 1.0f : 0.0f; });
  const Vec3f p(0.4f, 0.5f, -0.3f), n(0, 0, 1);
  for (int i = 0; i < static_cast<int>(lights.size()); ++i)
    EXPECT_GE(sampler.pmf(p, n, i), 0.0999f * sampler.plain_pmf(p, n, i)) << "light " << i;
  EXPECT_GT(sampler.pmf(p, n, 18), 0.5f);
}

// One sample goes down the tree, so that at each turn nothing is known of the other side.
TEST(LearnedChoice, DoesNotTakeWhatWasNotSampledForDark) {
  std::vector<LightPtr> lights;
  for (int i = 0; i < 12; ++i)
    lights.push_back(std::make_unique<FakeLight>(Vec3f(0, 0, static_cast<float>(i)),
                                                 std::pow(0.01f, static_cast<float>(i))));
  LightSampler sampler(lights);
  std::vector<SurveyedPoint> points(1);
  points.front().p = {5, 0, 0};
  sampler.survey(
      points.front().p, {0, 0, 1}, 0.5f, [](int) { return 1.0f; }, points.front().samples);
  sampler.learn(LightVisibility(points, sampler.slot_count()));
  for (int i = 0; i < 12; ++i)
    EXPECT_FLOAT_EQ(sampler.pmf({5, 0, 0}, {0, 0, 1}, i),
                    sampler.plain_pmf({5, 0, 0}, {0, 0, 1}, i))
        << "light " << i;
}

// A lamp that shines on no surveyed point says nothing about the others.
TEST(LearnedChoice, IsNotSpoiltByALampThatShinesNowhere) {
  std::vector<LightPtr> lights;
  lights.push_back(std::make_unique<FakeLight>(Vec3f(-2, 0, 1), 1.0f));
  lights.push_back(std::make_unique<FakeLight>(Vec3f(2, 0, 1), 1.0f));
  lights.push_back(std::make_unique<FakeLight>(Vec3f(0, 0, -9), 1.0f, Vec3f(0, 0, -1), 0.9999f));
  LightSampler sampler(lights);
  ASSERT_EQ(sampler.plain_pmf({0, 0, 0}, {0, 0, 1}, 2), 0.0f);
  teach(sampler, [](int light, const Vec3f&) { return light == 0 ? 1.0f : 0.0f; });
  EXPECT_GT(sampler.pmf({0, 0, 0}, {0, 0, 1}, 0), 0.9f);
}

// The bounds of the lamp are no use, so nothing but its own power chooses it.
TEST(LearnedChoice, NeverChoosesALampOutsideOfAllGroups) {
  auto lights = zoo(0, 2);
  lights.push_back(std::make_unique<FakeLight>(Vec3f(0, 0, 0), kInfinity));
  LightSampler sampler(lights);
  teach(sampler, [](int, const Vec3f&) { return 1.0f; });
  EXPECT_EQ(sampler.pmf({1, 0, 0}, {0, 0, 1}, 2), 0.0f);
  EXPECT_EQ(sampler.plain_pmf({1, 0, 0}, {0, 0, 1}, 2), 0.0f);
  EXPECT_NEAR(sampler.pmf({1, 0, 0}, {0, 0, 1}, 0), 0.5f, 0.01f);
}

}  // namespace
}  // namespace nephroid::testing_light
