// Guided emission: weighted counts of light paths have the same mean as with unguided emission, for
// every kind of light. The density of a start integrates to one.
#include "photon/emission_guide.h"

#include <gtest/gtest.h>

#include "photon/emission.h"
#include "unit/bsdf/statistics.h"
#include "unit/photon/useful_starts.h"

namespace nephroid {
namespace {

using testing_bsdf::Mean;
using testing_bsdf::TestRandom;
using testing_guide::add_cluster;
using testing_guide::scene_with;

struct Lights {
  const char* name;
  const char* text;
};
const Lights kLights[] = {
    {"lamp_that_shines_down", R"(AttributeBegin Translate 0 2.5 0 Rotate 90 1 0 0
       AreaLightSource "diffuse" "rgb L" [9 8 7] Shape "disk" "float radius" 0.5 AttributeEnd)"},
    {"lamp_that_shines_up_and_down", R"(AttributeBegin Translate 0 1 0 Rotate 90 1 0 0
       AreaLightSource "diffuse" "rgb L" [9 8 7] "bool twosided" true
       Shape "disk" "float radius" 0.5 AttributeEnd)"},
    {"ball", R"(AttributeBegin Translate 0 2.5 0
       AreaLightSource "diffuse" "rgb L" [9 8 7] Shape "sphere" "float radius" 0.4 AttributeEnd)"},
    {"point", R"(LightSource "point" "rgb I" [2 3 4] "point3 from" [0.3 2.5 0])"},
    {"spot", R"(LightSource "spot" "rgb I" [2 3 4] "point3 from" [0.3 2.5 0] "point3 to" [0.8 0 0.3]
       "float coneangle" 65 "float conedeltaangle" 30)"},
    {"goniometric", R"(AttributeBegin Translate 0.3 2.5 0
       LightSource "goniometric" "string filename" "PICTURE" AttributeEnd)"},
    {"projection", R"(AttributeBegin Translate 0.3 2.5 0 Rotate 90 1 0 0
       LightSource "projection" "string filename" "PICTURE" "float fov" 110 AttributeEnd)"},
    {"distant", R"(LightSource "distant" "point3 from" [1 3 0.5] "point3 to" [0 0 0])"},
    {"uniform_sky", R"(LightSource "infinite" "rgb L" [0.1 0.2 0.3])"},
    {"image_sky", R"(LightSource "infinite" "string filename" "PICTURE")"},
    {"sky_through_a_portal", R"(LightSource "infinite" "string filename" "PICTURE"
       "point3 portal" [-1 2 -1  1 2 -1  1 2 1  -1 2 1])"},
    {"many", R"(AttributeBegin Translate 0 2.5 0 Rotate 90 1 0 0
       AreaLightSource "diffuse" "rgb L" [9 8 7] Shape "disk" "float radius" 0.3 AttributeEnd
       LightSource "point" "rgb I" [1 1 1] "point3 from" [-1.5 1.5 1]
       LightSource "distant" "float illuminance" 0.3 "point3 from" [1 3 0.5] "point3 to" [0 0 0]
       LightSource "infinite" "rgb L" [0.05 0.05 0.05])"},
};

/// Two distant useful places for each light, and one that the lamps intersect. Lights of one scene
/// have different places.
EmissionGuide guide_for(const Scene& scene) {
  TestRandom random(5);
  std::vector<UsefulStart> starts;
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const int light = static_cast<int>(i);
    const float shift = 0.2f * static_cast<float>(i);
    add_cluster(starts, light, {0.8f, 0.2f + shift, 0.5f}, 0.25f, 200, random);
    add_cluster(starts, light, {-1.2f, 0.4f, -0.6f + shift}, 0.1f, 150, random);
    if (i == 0) add_cluster(starts, light, {0.3f, 2.4f, 0}, 0.3f, 60, random);
  }
  return {scene, starts, 20000};
}

/// The same with potentially useful places, the casters.
EmissionGuide guide_to_casters(const Scene& scene) {
  TestRandom random(6);
  std::vector<UsefulStart> starts;
  add_cluster(starts, 0, {0.8f, 0.2f, 0.5f}, 0.25f, 200, random);
  add_cluster(starts, 0, {-1.2f, 0.4f, -0.6f}, 0.1f, 150, random);
  std::vector<Vec3f> points;
  for (const UsefulStart& start : starts) points.push_back(start.first_hit);
  return {scene, points};
}

SampledWavelengths test_wavelengths() {
  return SampledWavelengths::sample_visible(0.37f);
}

std::optional<Emission> random_start(const Scene& scene, const EmissionGuide& guide, uint32_t i,
                                     uint64_t seed) {
  const SobolPoint point(i, 0);  // independent numbers
  PathSampler sampler(point, seed);
  return emit(scene, guide, test_wavelengths(), 0, sampler);
}

/// Counts of starts, binned by direction and by position on a plane that the rays cross.
class Bins {
 public:
  void add(const Emission* e) {
    ++paths_;
    if (!e) return;
    const Vec3f& w = e->ray.d;
    const int row = std::clamp(static_cast<int>((w.y + 1) / 2 * kRows), 0, kRows - 1);
    const int column = std::clamp(
        static_cast<int>((std::atan2(w.z, w.x) / (2 * kPi) + 0.5f) * kColumns), 0, kColumns - 1);
    add_to(static_cast<size_t>(row * kColumns + column), *e);
    const float t = (kPlane - e->ray.o.y) / w.y;
    if (!(t > 0)) return;
    const Vec3f p = e->ray.o + w * t;
    const int x = static_cast<int>(std::floor((p.x + 3) / 6 * kGrid)),
              z = static_cast<int>(std::floor((p.z + 3) / 6 * kGrid));
    if (x < 0 || z < 0 || x >= kGrid || z >= kGrid) return;
    add_to(static_cast<size_t>(kRows * kColumns + z * kGrid + x), *e);
  }
  static constexpr size_t kCount = 8 * 16 + 12 * 12;
  bool counts(size_t bin) const { return flux_[bin].n >= 150; }
  Mean flux(size_t bin) const { return of_all(flux_[bin]); }
  Mean number(size_t bin) const { return of_all(number_[bin]); }

 private:
  static constexpr int kRows = 8, kColumns = 16, kGrid = 12;
  static constexpr float kPlane = 0.3f;
  void add_to(size_t bin, const Emission& e) {
    flux_[bin].add(e.flux[0]);
    number_[bin].add(e.weight);
  }
  /// Paths in other bins count as zero.
  Mean of_all(Mean m) const {
    m.n = paths_;
    return m;
  }
  double paths_ = 0;
  std::vector<Mean> flux_ = std::vector<Mean>(kCount), number_ = flux_;
};

void expect_same_mean(const Mean& a, const Mean& b, const std::string& what) {
  // One of ten thousand means exceeds this by chance with a probability of a few in a thousand. The
  // seeds are fixed.
  EXPECT_NEAR(a.mean(), b.mean(), 5.2 * std::hypot(a.error(), b.error())) << what;
}

class GuidedEmission : public ::testing::TestWithParam<Lights> {};

TEST_P(GuidedEmission, HasTheMeansOfTheLightsOwn) {
  constexpr uint32_t kPaths = 300000;
  const auto scene = scene_with(GetParam().text);
  const EmissionGuide after_light = guide_for(*scene), before_it = guide_to_casters(*scene);
  ASSERT_GE(after_light.places(), 2u);
  ASSERT_GE(before_it.places(), 2u);
  Bins own, guided;
  for (uint32_t i = 0; i < kPaths; ++i) {
    const EmissionGuide& guide = i % 2 == 0 ? after_light : before_it;
    const auto a = random_start(*scene, kUnguided, i, 1), b = random_start(*scene, guide, i, 2);
    own.add(a ? &*a : nullptr);
    guided.add(b ? &*b : nullptr);
  }
  int tested = 0;
  for (size_t bin = 0; bin < Bins::kCount; ++bin) {
    if (!own.counts(bin) || !guided.counts(bin)) continue;
    ++tested;
    const std::string what = std::string(GetParam().name) + ", bin " + std::to_string(bin);
    expect_same_mean(guided.flux(bin), own.flux(bin), "flux of " + what);
    expect_same_mean(guided.number(bin), own.number(bin), "number of " + what);
  }
  EXPECT_GE(tested, 20);
}

TEST_P(GuidedEmission, AimsAtTheTargets) {
  const auto scene = scene_with(GetParam().text);
  if (scene->lights[0]->is_infinite() && !scene->lights[0]->emits_through_disk())
    GTEST_SKIP() << "starts as the light has it";
  const auto share_near = [&](const EmissionGuide& g) {
    int near = 0;
    for (uint32_t i = 0; i < 10000; ++i) {
      const auto e = random_start(*scene, g, i, 3);
      if (!e) continue;
      const Vec3f way = Vec3f(-1.2f, 0.4f, -0.6f) - e->ray.o;
      near += length_squared(way - e->ray.d * dot(way, e->ray.d)) < sqr(0.15f);
    }
    return near;
  };
  EXPECT_GT(share_near(guide_for(*scene)), 3 * share_near(kUnguided));
  EXPECT_GT(share_near(guide_to_casters(*scene)), 3 * share_near(kUnguided));
}

INSTANTIATE_TEST_SUITE_P(Lights, GuidedEmission, ::testing::ValuesIn(kLights),
                         [](const auto& test) { return std::string(test.param.name); });

/// The integral of the density over all directions from `p`.
double over_directions(const Scene& scene, const EmissionGuide& guide, int light,
                       const EmissionSample& start) {
  constexpr int kRows = 600, kColumns = 1200;
  const Light& l = *scene.lights[static_cast<size_t>(light)];
  const Vec3f& p = l.is_area() ? start.p : start.ray.o;
  double sum = 0;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const Vec3f w =
          testing_bsdf::spherical((y + 0.4871) / kRows * 2 - 1, (x + 0.5137) / kColumns * 2 * M_PI);
      sum += guide.density(scene, light, p, w, l.emission_pdf(start.ng, w).pdf_w);
    }
  return sum * 4 * M_PI / kRows / kColumns;
}

/// The integral of the density over all rays along `w`, by the area across them.
double over_places(const Scene& scene, const EmissionGuide& guide, int light, const Vec3f& w) {
  constexpr int kSide = 1000;
  const double half = 1.5 * static_cast<double>(scene.sphere.radius);
  const double own = scene.lights[static_cast<size_t>(light)]->emission_pdf({0, 0, 0}, w).pdf_a;
  const Frame frame = Frame::from_z(w);
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double a = ((x + 0.4871) / kSide * 2 - 1) * half,
                   b = ((y + 0.5137) / kSide * 2 - 1) * half;
      const Vec3f p =
          scene.sphere.center + frame.x * static_cast<float>(a) + frame.y * static_cast<float>(b);
      const bool on_disk = a * a + b * b < sqr(static_cast<double>(scene.sphere.radius));
      sum += guide.density(scene, light, p, w, on_disk ? own : 0);
    }
  return sum * sqr(2 * half / kSide);
}

TEST_P(GuidedEmission, HasADensityThatIntegratesToItsGain) {
  const auto scene = scene_with(GetParam().text);
  const EmissionGuide guide = guide_for(*scene);
  double all = 0;
  for (size_t i = 0; i < scene->lights.size(); ++i) {
    const int light = static_cast<int>(i);
    const Light& l = *scene->lights[i];
    all += static_cast<double>(scene->light_sampler->pmf_by_power(light)) * guide.gain(light);
    if (l.is_infinite() && !l.emits_through_disk()) continue;
    for (const float u : {0.2f, 0.71f}) {
      const auto start = l.sample_emission({u, 0.31f}, {u, 0.6f}, test_wavelengths());
      ASSERT_TRUE(start);
      const double sum = l.is_infinite() ? over_places(*scene, guide, light, start->ray.d)
                                         : over_directions(*scene, guide, light, *start);
      EXPECT_NEAR(sum, guide.gain(light), 0.01 * guide.gain(light)) << "light " << i;
    }
  }
  EXPECT_NEAR(all, 1, 1e-5) << "some light is chosen";
}

TEST(EmissionGuide, ChoosesLightsByPowerTimesGain) {
  // With more lights than clusters, several lights share their records.
  std::string lights;
  for (int i = 0; i < 600; ++i)
    lights += "LightSource \"point\" \"rgb I\" [1 1 1] \"float scale\" " +
              std::to_string(i % 7 == 3 ? 0 : 1 + i % 5) + " \"point3 from\" [" +
              std::to_string(0.01 * i - 3) + " 2 0]\n";
  const auto scene = scene_with(lights);
  ASSERT_EQ(scene->lights.size(), 600u);
  TestRandom random(5);
  std::vector<UsefulStart> starts;
  for (const int light : {2, 3, 55, 301, 599})
    add_cluster(starts, light, {0.01f * static_cast<float>(light) - 3, 0.2f, 0.5f}, 0.2f,
                40 + light, random);
  const EmissionGuide guide(*scene, starts, 50000);
  constexpr int kNumbers = 1 << 20;
  std::vector<double> chosen(600), own(600);
  for (int i = 0; i < kNumbers; ++i) {
    const auto choice = guide.choose(*scene, (static_cast<float>(i) + 0.5f) / kNumbers);
    ASSERT_TRUE(choice);
    ASSERT_LT(choice->target, static_cast<int>(guide.targets().size()));
    auto& counts = choice->target < 0 ? own : chosen;
    counts[static_cast<size_t>(choice->light)] += 1.0 / kNumbers;
  }
  double most = 0;
  for (int i = 0; i < 600; ++i) {
    const size_t at = static_cast<size_t>(i);
    const double pmf = static_cast<double>(scene->light_sampler->pmf_by_power(i));
    EXPECT_NEAR(own[at], EmissionGuide::kDefensive * pmf, 1e-5) << "light " << i;
    EXPECT_NEAR(own[at] + chosen[at], pmf * guide.gain(i), 1e-5) << "light " << i;
    most = std::max(most, guide.gain(i));
  }
  EXPECT_GT(most, 10) << "the guide has a will of its own";
}

TEST(EmissionGuide, ThatHasLearnedNothingLeavesThePathsAsTheyAre) {
  for (const Lights& lights : kLights) {
    const auto scene = scene_with(lights.text);
    const EmissionGuide learned_nothing(*scene, {}, 1000);
    EXPECT_TRUE(learned_nothing.empty());
    for (uint32_t i = 0; i < 200; ++i) {
      const auto e = random_start(*scene, learned_nothing, i, 4);
      // By hand: numbers for light 1, position 2, direction 2.
      const SobolPoint point(i, 0);
      PathSampler sampler(point, 4);
      float u = sampler.get_1d();
      const Vec2f position = sampler.get_2d(), direction = sampler.get_2d();
      const auto choice = scene->light_sampler->sample_by_power(u);
      ASSERT_TRUE(choice);
      const auto own = scene->lights[static_cast<size_t>(choice->light)]->sample_emission(
          position, direction, test_wavelengths());
      if (!e || !own) continue;
      ASSERT_EQ(e->light, choice->light) << lights.name;
      ASSERT_TRUE(e->ray.o == own->ray.o && e->ray.d == own->ray.d) << lights.name;
      ASSERT_EQ(e->weight, 1.0f);
      ASSERT_FLOAT_EQ(e->pdf_start, choice->pdf_p * own->pdf_a) << lights.name;
      const float flux =
          own->radiance[0] * own->cos_theta / (choice->pdf_p * own->pdf_a * own->pdf_w);
      ASSERT_NEAR(e->flux[0], flux, 2e-6f * flux) << lights.name;
    }
  }
}

TEST(EmissionGuide, TellsTheDensityOfStartPoints) {
  // No path is lost behind this lamp.
  const auto scene =
      scene_with(std::string(kLights[1].text) + "\n" +
                 R"(LightSource "point" "rgb I" [9 9 9] "point3 from" [-1.5 1.5 1])");
  const EmissionGuide guide = guide_for(*scene);
  const int lamp = scene->lights[0]->is_area() ? 0 : 1;
  EXPECT_GT(std::abs(guide.gain(lamp) - 1), 0.05) << "the guide has a will of its own";
  for (const EmissionGuide* g : {&kUnguided, &guide}) {
    Mean area;
    for (uint32_t i = 0; i < 20000; ++i) {
      const auto e = random_start(*scene, *g, i, 6);
      area.add(e && e->light == lamp ? 1 / static_cast<double>(e->pdf_start) : 0.0);
    }
    EXPECT_NEAR(area.mean(), M_PI * 0.25, 4.5 * area.error());
  }
}

// A target so small that rounding moves rays across its edge. No ray may get the weight of an
// unguided one, which is ten million times as large.
TEST(EmissionGuide, AimsAtSmallTargetsInSpiteOfRounding) {
  for (const char* name : {"point", "ball", "uniform_sky", "distant"}) {
    const auto lights = std::find_if(std::begin(kLights), std::end(kLights),
                                     [&](const Lights& l) { return l.name == std::string(name); });
    const auto scene = scene_with(lights->text);
    const Vec3f spot(1.1f, 0.1f, 0.7f);
    const std::vector<UsefulStart> starts(100, {0, spot, 1});
    const EmissionGuide guide(*scene, starts, 1e9);
    ASSERT_EQ(guide.targets().size(), 1u);
    const double radius = static_cast<double>(guide.targets()[0].radius);
    ASSERT_LT(radius, 1e-3);
    std::vector<double> weights;
    double sum = 0, expected = 0;
    constexpr uint32_t kPaths = 100000;
    for (uint32_t i = 0; i < kPaths; ++i) {
      const auto e = random_start(*scene, guide, i, 9);
      if (!e) continue;
      const Vec3f way = spot - e->ray.o;
      const double aside2 = length_squared(way - e->ray.d * dot(way, e->ray.d));
      if (aside2 > sqr(1.1 * radius)) continue;
      weights.push_back(static_cast<double>(e->weight));
      sum += weights.back() / kPaths;
      if (name == std::string("point"))
        expected = sqr(radius) / (4 * static_cast<double>(length_squared(way)));
      if (scene->lights[0]->is_infinite())
        expected = sqr(radius / static_cast<double>(scene->sphere.radius));
    }
    ASSERT_GT(weights.size(), 0.5 * EmissionGuide::kDefensive * kPaths) << name;
    std::sort(weights.begin(), weights.end());
    EXPECT_LT(weights.back(), 20 * weights[weights.size() / 2]) << name;
    if (expected > 0) {
      EXPECT_NEAR(sum, expected, 0.01 * expected) << name;
    }
  }
}

}  // namespace
}  // namespace nephroid
