// The light sampler: probabilities sum to one, samples follow them, and they are zero only where no
// light arrives. For no light, a few and very many.
#include "scene/light/light_sampler.h"

#include "scene/light/light_tree.h"
#include "unit/light/zoo_of_lights.h"

namespace nephroid::testing_light {
namespace {

TEST(LightSampler, FrequenciesAreTheProbabilities) {
  for (const int n : {0, 1, 2, 4, 5, 6, 40, 300})
    for (const int infinite : {0, 1, 2}) {
      const auto lights = zoo(n, infinite);
      const LightSampler sampler(lights);
      expect_frequencies(sampler, lights, {0.4f, 0.5f, -0.3f}, {0, 0, 1}, 20000);
      expect_frequencies(sampler, lights, {0.5f, 0.5f, 0.5f}, normalize(Vec3f(1, 1, -2)), 20000);
      expect_frequencies(sampler, lights, {7, -3, 2}, {0, 0, 0}, 20000);
    }
}

TEST(LightSampler, ProbabilitiesSumToOneIfAllLightsShineEverywhere) {
  TestRandom random(41);
  std::vector<LightPtr> lights;
  for (int i = 0; i < 500; ++i)
    lights.push_back(std::make_unique<FakeLight>(Vec3f(random.next(), random.next(), random.next()),
                                                 random.next()));
  const LightSampler sampler(lights);
  for (int k = 0; k < 50; ++k) {
    const Vec3f p = Vec3f(random.next(), random.next(), random.next()) * 3.0f - Vec3f(1);
    double sum = 0;
    for (int i = 0; i < 500; ++i) sum += sampler.pmf(p, {0, 1, 0}, i);
    EXPECT_NEAR(sum, 1.0, 1e-5);
  }
}

TEST(LightSampler, InfiniteLightsShareAsPbrtDoes) {
  const LightSampler sampler(zoo(10, 2));
  EXPECT_FLOAT_EQ(sampler.pmf({0, 0, 0}, {0, 0, 1}, 0), 1.0f / 3);
  EXPECT_FLOAT_EQ(sampler.pmf({0, 0, 0}, {0, 0, 1}, 1), 1.0f / 3);
  EXPECT_EQ(sampler.infinite_lights(), (std::vector<int>{0, 1}));
  const LightSampler only(zoo(0, 2));
  EXPECT_FLOAT_EQ(only.pmf({0, 0, 0}, {0, 0, 1}, 1), 0.5f);
  EXPECT_EQ(only.pmf({0, 0, 0}, {0, 0, 1}, 7), 0.0f);
}

TEST(LightSampler, NoLightThatArrivesIsForgotten) {
  for (const int n : {3, 60, 300}) {
    const auto lights = zoo(n, 0);
    const LightSampler sampler(lights);
    TestRandom random(51);
    int arriving = 0;
    for (int k = 0; k < 200; ++k) {
      const Vec3f p = Vec3f(random.next(), random.next(), random.next()) * 2.0f - Vec3f(0.5f);
      const Vec3f normal = square_to_sphere(random.next2());
      for (int i = 0; i < n; ++i) {
        const auto s = lights[i]->sample_towards(p, random.next2(), test_wavelengths());
        if (!s || s->radiance.is_black()) continue;
        ++arriving;
        EXPECT_GT(sampler.pmf(p, normal, i), 0.0f) << i;
        EXPECT_GT(sampler.pmf(p, {0, 0, 0}, i), 0.0f) << i;
      }
    }
    EXPECT_GT(arriving, 100);
  }
}

TEST(LightSampler, BlackLightsAreNeverChosen) {
  std::vector<LightPtr> lights;
  for (int i = 0; i < 20; ++i)
    lights.push_back(
        std::make_unique<FakeLight>(Vec3f(static_cast<float>(i), 0, 0), i % 2 ? 1.0f : 0.0f));
  const LightSampler sampler(lights);
  for (int i = 0; i < 1000; ++i) {
    float u = (static_cast<float>(i) + 0.5f) / 1000;
    EXPECT_EQ(sampler.sample({3, 1, 0}, {0, 0, 0}, u)->light % 2, 1);
    EXPECT_EQ(sampler.sample_by_power(u)->light % 2, 1);
  }
  EXPECT_EQ(sampler.pmf({3, 1, 0}, {0, 0, 0}, 4), 0.0f);
}

TEST(LightSampler, NearAndBrightLightsComeFirst) {
  std::vector<LightPtr> lights;
  for (int i = 0; i < 100; ++i)
    lights.push_back(std::make_unique<FakeLight>(Vec3f(static_cast<float>(i) * 10, 0, 0), 1.0f));
  const LightSampler sampler(lights);
  // A uniform choice would give 0.01 each.
  EXPECT_GT(sampler.pmf({500, 0, 1}, {0, 0, 0}, 50), 0.2f);
  EXPECT_LT(sampler.pmf({500, 0, 1}, {0, 0, 0}, 0), 0.01f);
}

TEST(LightSampler, NothingIsSpentOnWindowsSeenFromBehind) {
  // The bounding sphere of a large window reaches far behind it, its light does not. Straight or
  // tilted, far from the origin, with one pane or eight.
  const Vec3f tilted = normalize(Vec3f(1, 2, 3)), side = normalize(cross(tilted, Vec3f(0, 0, 1)));
  const std::pair<Vec3f, Vec3f> frames[] = {{{0, 0, 1}, {1, 0, 0}}, {tilted, side}};
  for (const auto& frame : frames)
    for (const int panes : {1, 8}) {
      const Vec3f normal = frame.first, along = frame.second, across = cross(normal, along);
      const auto at = [&](float x, float y, float z) {
        return Vec3f(100, 2000, 30) + along * x + across * y + normal * z;
      };
      std::vector<LightPtr> lights;
      for (int i = 0; i < panes; ++i) {
        const auto x0 = -20 + 40 * static_cast<float>(i) / static_cast<float>(panes);
        const auto x1 = -20 + 40 * static_cast<float>(i + 1) / static_cast<float>(panes);
        MeshData m;
        m.positions = {at(x0, -20, 0), at(x1, -20, 0), at(x0, 20, 0), at(x1, 20, 0)};
        m.quads = {0, 1, 2, 3};
        lights.push_back(area_light_of("", make_bilinear_mesh(m, false)));
      }
      const int lamp = panes;
      lights.push_back(std::make_unique<FakeLight>(at(60, 10, -30), 1e-3f));
      const LightSampler sampler(lights);
      EXPECT_EQ(sampler.pmf(at(-5, 8, -1), {0, 0, 0}, lamp), 1.0f) << panes;
      EXPECT_EQ(sampler.pmf(at(40, 0, -2), {0, 0, 0}, lamp), 1.0f) << panes;
      EXPECT_LT(sampler.pmf(at(-5, 8, 1), {0, 0, 0}, lamp), 0.01f) << panes;
    }
}

TEST(LightSampler, ChoicesDoNotDependOnTheUnitOfLength) {
  std::vector<LightPtr> lights[2];
  const float unit = 1.0f / 8192;
  TestRandom random(61);
  for (int i = 0; i < 60; ++i) {
    const Vec3f p(random.next(), random.next(), random.next());
    const float power = random.next();
    lights[0].push_back(std::make_unique<FakeLight>(p, power));
    lights[1].push_back(std::make_unique<FakeLight>(p * unit, power));
  }
  const LightSampler large(lights[0]), small(lights[1]);
  for (int k = 0; k < 20; ++k) {
    const Vec3f p(random.next(), random.next(), random.next());
    for (int i = 0; i < 60; ++i)
      EXPECT_NEAR(large.pmf(p, {0, 0, 1}, i), small.pmf(p * unit, {0, 0, 1}, i),
                  1e-4f * large.pmf(p, {0, 0, 1}, i) + 1e-12f);
  }
}

TEST(LightSampler, ManyLightsKeepTheirProbabilities) {
  constexpr int kLights = 100000, kCount = 1000000, kBins = 1000;
  TestRandom random(71);
  std::vector<LightPtr> lights;
  for (int i = 0; i < kLights; ++i)
    lights.push_back(std::make_unique<FakeLight>(Vec3f(random.next(), random.next(), random.next()),
                                                 0.5f + random.next()));
  const LightSampler sampler(lights);
  const Vec3f p(0.3f, 0.4f, 2), n(0, 0, -1);
  std::vector<double> observed(kBins), expected(kBins);
  double sum = 0;
  for (int i = 0; i < kLights; ++i) {
    const double pmf = sampler.pmf(p, n, i);
    sum += pmf;
    expected[i % kBins] += kCount * pmf;
  }
  EXPECT_NEAR(sum, 1, 1e-4);
  for (int i = 0; i < kCount; ++i) ++observed[sampler.sample(p, n, random.next())->light % kBins];
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST(LightSampler, AlongARayProbabilitiesAreThoseOfTheSamples) {
  const Ray ray{Vec3f(-0.5f, 0.4f, 0.3f), normalize(Vec3f(1, 0.1f, 0.2f)), kInfinity, 0};
  for (const int n : {3, 60}) {
    const LightSampler sampler(zoo(n, 2));
    constexpr int kCount = 100000;
    std::vector<double> observed(n + 2), expected(n + 2);
    TestRandom random(31);
    for (int i = 0; i < kCount; ++i) {
      const auto chosen = sampler.sample_along(ray, 2.5f, random.next());
      ASSERT_TRUE(chosen.has_value());
      if (chosen->light < 0) continue;
      ++observed[chosen->light];
      const auto found = sampler.find_along(ray, 2.5f, chosen->light);
      ASSERT_TRUE(found.has_value());
      EXPECT_FLOAT_EQ(chosen->pdf_p, found->pdf_p);
      const float t = chosen->distances.sample(random.next());
      EXPECT_GT(chosen->pdf(t), 0.0f);
      EXPECT_FLOAT_EQ(chosen->pdf(t), found->pdf(t));
    }
    for (int l = 0; l < n + 2; ++l)
      if (const auto found = sampler.find_along(ray, 2.5f, l))
        expected[l] = kCount * static_cast<double>(found->pdf_p);
    EXPECT_EQ(expected[0] + expected[1], 0) << "infinite lights";
    EXPECT_GT(chi_square_test(observed, expected), 1e-4) << n;
  }
}

TEST(LightSampler, AlongARayThatNoLightShinesOn) {
  std::vector<LightPtr> lights;
  for (int i = 0; i < 6; ++i) {
    const LightSampler sampler(lights);
    const Ray behind{Vec3f(-1, 0, -3), Vec3f(1, 0, 0), kInfinity, 0};
    // A tree can notice it late.
    const auto chosen = sampler.sample_along(behind, 5, 0.5f);
    EXPECT_TRUE(!chosen || chosen->light < 0) << i;
    EXPECT_FALSE(sampler.find_along(behind, 5, 0)) << i;
    lights.push_back(light_of("LightSource \"spot\" \"point3 from\" [0 0 " + std::to_string(i) +
                              "] \"point3 to\" [0 0 9]"));
  }
}

TEST(LightTree, StaysShallowForAwkwardPlaces) {
  const auto depth = [](const std::function<Vec3f(int)>& place, int n) {
    std::vector<LightTree::Item> items;
    for (int i = 0; i < n; ++i) {
      LightTree::Item item;
      item.bounds.bounds = Bounds3f(place(i));
      item.bounds.power = 1;
      item.light = i;
      items.push_back(item);
    }
    return LightTree(std::move(items), n).depth();
  };
  EXPECT_LE(depth([](int) { return Vec3f(1, 2, 3); }, 1000), 10);
  EXPECT_LE(depth([](int i) { return Vec3f(std::ldexp(1.0f, -i), 0, 0); }, 120), 63);
  EXPECT_LE(depth([](int i) { return Vec3f(static_cast<float>(i), 0, 0); }, 1024), 20);
}

TEST(LightSampler, ByPowerFollowsThePowersAndGivesANewNumber) {
  std::vector<LightPtr> lights;
  const float powers[] = {0, 1, 3, 0, 4, 0};
  for (const float p : powers) lights.push_back(std::make_unique<FakeLight>(Vec3f(0.0f), p));
  const LightSampler sampler(lights);
  TestRandom random(81);
  std::vector<double> observed(6), expected(6), rest(10), uniform(10, 1000.0);
  for (int i = 0; i < 10000; ++i) {
    float u = random.next();
    const auto choice = sampler.sample_by_power(u);
    ++observed[choice->light];
    EXPECT_EQ(choice->pdf_p, sampler.pmf_by_power(choice->light));
    ASSERT_TRUE(u >= 0 && u < 1);
    ++rest[static_cast<int>(u * 10)];
  }
  for (int i = 0; i < 6; ++i) {
    expected[i] = 10000 * powers[i] / 8;
    EXPECT_FLOAT_EQ(sampler.pmf_by_power(i), powers[i] / 8);
  }
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
  EXPECT_GT(chi_square_test(rest, uniform), 1e-4);
}

TEST(LightSampler, NoLightsNoChoice) {
  const LightSampler sampler{std::vector<LightPtr>()};
  float u = 0.5f;
  EXPECT_FALSE(sampler.sample({0, 0, 0}, {0, 0, 1}, u));
  EXPECT_FALSE(sampler.sample_by_power(u));
  EXPECT_EQ(sampler.pmf({0, 0, 0}, {0, 0, 1}, 0), 0.0f);
}

}  // namespace
}  // namespace nephroid::testing_light
