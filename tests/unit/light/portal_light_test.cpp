// Infinite lights with a portal: the windowed distribution, visibility, densities of directions,
// and closed forms.
#include "core/equal_area_map.h"
#include "scene/light/windowed_distribution.h"
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

using Window = WindowedDistribution::Window;

TEST(WindowedDistribution, IntegratesAnyWindow) {
  constexpr int kWidth = 5, kHeight = 3;
  std::vector<float> weights;
  for (int i = 0; i < kWidth * kHeight; ++i) weights.push_back(static_cast<float>((i * 7) % 4));
  const WindowedDistribution grid(weights, kWidth, kHeight);
  TestRandom random(1);
  for (int n = 0; n < 1000; ++n) {
    double x[2] = {random.next(), random.next()}, y[2] = {random.next(), random.next()};
    if (n == 0) x[0] = y[0] = 0.0, x[1] = y[1] = 1.0;
    const Window w{std::min(x[0], x[1]), std::min(y[0], y[1]), std::max(x[0], x[1]),
                   std::max(y[0], y[1])};
    double expected = 0;
    for (int j = 0; j < kHeight; ++j)
      for (int i = 0; i < kWidth; ++i) {
        const auto overlap = [](double a, double b, int k, int count) {
          return std::max(0.0, std::min(b, (k + 1.0) / count) - std::max(a, k * 1.0 / count));
        };
        expected += weights[j * kWidth + i] * overlap(w.x0, w.x1, i, kWidth) *
                    overlap(w.y0, w.y1, j, kHeight);
      }
    EXPECT_NEAR(grid.integral(w), expected, 1e-12);
  }
}

TEST(WindowedDistribution, SamplesWindowsByTheirWeights) {
  constexpr int kWidth = 7, kHeight = 5;
  std::vector<float> weights;
  for (int i = 0; i < kWidth * kHeight; ++i) weights.push_back(static_cast<float>((i * 7) % 4));
  weights[17] = 100;
  const WindowedDistribution grid(weights, kWidth, kHeight);
  for (const Window w : {Window{}, Window{0.1, 0.05, 0.93, 0.71}, Window{0.31, 0.22, 0.4, 0.36},
                         Window{0.44, 0.5, 0.5, 0.501}, Window{0.0, 0.3, 0.2, 1.0}}) {
    // Bins are parts of the window; each has its own expected integral.
    constexpr int kBins = 12, kCount = 60000;
    std::vector<double> observed(kBins * kBins), expected(kBins * kBins);
    TestRandom random(2);
    for (int i = 0; i < kCount; ++i) {
      const auto s = grid.sample(random.next2(), w);
      ASSERT_TRUE(s);
      ASSERT_TRUE(s->x >= w.x0 && s->x <= w.x1 && s->y >= w.y0 && s->y <= w.y1);
      EXPECT_EQ(s->column, std::min(static_cast<int>(s->x * kWidth), kWidth - 1));
      EXPECT_EQ(s->row, std::min(static_cast<int>(s->y * kHeight), kHeight - 1));
      EXPECT_NEAR(s->pdf, weights[s->row * kWidth + s->column] / grid.integral(w), 1e-9 * s->pdf);
      const int bx = std::min(static_cast<int>((s->x - w.x0) / (w.x1 - w.x0) * kBins), kBins - 1);
      const int by = std::min(static_cast<int>((s->y - w.y0) / (w.y1 - w.y0) * kBins), kBins - 1);
      ++observed[by * kBins + bx];
    }
    for (int by = 0; by < kBins; ++by)
      for (int bx = 0; bx < kBins; ++bx) {
        const double dx = (w.x1 - w.x0) / kBins, dy = (w.y1 - w.y0) / kBins;
        const Window bin{w.x0 + bx * dx, w.y0 + by * dy, w.x0 + (bx + 1) * dx,
                         w.y0 + (by + 1) * dy};
        expected[by * kBins + bx] = kCount * grid.integral(bin) / grid.integral(w);
      }
    EXPECT_GT(chi_square_test(observed, expected), 1e-4) << w.x0 << " " << w.y0;
  }
}

TEST(WindowedDistribution, ABlackWindowGivesNothing) {
  std::vector<float> weights(16, 0.0f);
  weights[15] = 1;
  const WindowedDistribution grid(weights, 4, 4);
  EXPECT_FALSE(grid.sample({0.5f, 0.5f}, {0, 0, 0.7, 0.7}));
  EXPECT_EQ(grid.pdf(0, 0, {0, 0, 0.7, 0.7}), 0.0);
  EXPECT_TRUE(grid.sample({0.5f, 0.5f}, {0, 0, 0.8, 0.8}));
}

/// A window of 2 x 1 at z = 1.5 above the origin, its outside up.
const std::string kPortal = "\"point3 portal\" [-1 -0.5 1.5  -1 0.5 1.5  1 0.5 1.5  1 -0.5 1.5] ";
const SceneSphere kSphere{{0, 0, 0}, 3};

class PortalLight : public ::testing::Test {
 protected:
  /// Two skies: a smooth one, and one of distinct pixels.
  void SetUp() override {
    std::vector<float> smooth, pixels;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const Vec3f w = equal_area_square_to_sphere(
            {(static_cast<float>(x) + 0.5f) / 64, (static_cast<float>(y) + 0.5f) / 64});
        const float v = 2 + w.x + 0.5f * w.y + 0.3f * w.z;
        smooth.insert(smooth.end(), {v, v, v});
      }
    for (int i = 0; i < 256; ++i)
      for (const int period : {5, 3, 7}) pixels.push_back(static_cast<float>(i % period));
    pixels[3 * 136] = 20;
    write_square(scratch.file("smooth.exr"), 64, smooth);
    write_square(scratch.file("pixels.exr"), 16, pixels);
  }
  LightPtr make(const std::string& parameters, const std::string& before = "") const {
    return light_of(before + "\nLightSource \"infinite\" " + parameters, kSphere,
                    scratch.path().string());
  }
  static float seen(const Light& light, const Vec3f& from, const Vec3f& w) {
    return light.radiance_at_infinity(from, normalize(w), test_wavelengths())[0];
  }
  ScratchDirectory scratch;
};

TEST_F(PortalLight, IsSeenThroughThePortalOnly) {
  const LightPtr light = make(kPortal);
  EXPECT_GT(seen(*light, {0, 0, 0}, {0, 0, 1}), 0.0f);
  EXPECT_GT(seen(*light, {0, 0, 0}, {0.99f, 0.49f, 1.5f}), 0.0f);
  EXPECT_EQ(seen(*light, {0, 0, 0}, {1.01f, 0.49f, 1.5f}), 0.0f);
  EXPECT_EQ(seen(*light, {0, 0, 0}, {0.99f, -0.51f, 1.5f}), 0.0f);
  EXPECT_EQ(seen(*light, {0, 0, 0}, {0, 0, -1}), 0.0f);
  EXPECT_EQ(seen(*light, {5, 0, 0}, {0, 0, 1}), 0.0f);
  EXPECT_GT(seen(*light, {5, 0, 0}, {-5, 0, 1.5f}), 0.0f);
  // From outside nothing is seen in any direction, not even through the portal.
  EXPECT_EQ(seen(*light, {0, 0, 2}, {0, 0, 1}), 0.0f);
  EXPECT_EQ(seen(*light, {0, 0, 2}, {0, 0, -1}), 0.0f);
  EXPECT_FALSE(light->sample_towards({0, 0, 2}, {0.5f, 0.5f}, test_wavelengths()));
  EXPECT_EQ(light->pdf_towards({0, 0, 2}, {0, 0, 1}, {}, {}), 0.0f);
}

TEST_F(PortalLight, TransformsTurnTheSkyAndNotThePortal) {
  const LightPtr light = make(kPortal + "\"string filename\" \"smooth.exr\"", "Rotate 90 1 0 0");
  const LightPtr open = make("\"string filename\" \"smooth.exr\"", "Rotate 90 1 0 0");
  TestRandom random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3f to(2 * random.next() - 1, random.next() - 0.5f, 1.5f);
    const float a = seen(*light, {0, 0, 0}, to), b = seen(*open, {0, 0, 0}, to);
    // Both are constant per pixel, with pixels of different shapes.
    EXPECT_NEAR(a, b, 0.07f * b);
  }
}

TEST_F(PortalLight, DirectionsFollowTheirDensity) {
  const LightPtr light = make(kPortal + "\"string filename\" \"pixels.exr\"", "Rotate 20 1 1 0");
  for (const Vec3f& from : {Vec3f(0, 0, 0), Vec3f(0.3f, 0.2f, 1.2f), Vec3f(-3, 1, 0.9f)}) {
    // Bins are parts of the portal.
    constexpr int kBins = 20, kCount = 100000, kSub = 16;
    std::vector<double> observed(kBins * kBins), expected(kBins * kBins);
    TestRandom random(4);
    for (int i = 0; i < kCount; ++i) {
      const auto s = light->sample_towards(from, random.next2(), test_wavelengths());
      ASSERT_TRUE(s);
      const Vec3f at = from + s->wi * ((1.5f - from.z) / s->wi.z);
      const int x = static_cast<int>((at.x + 1) / 2 * kBins);
      const int y = static_cast<int>((at.y + 0.5f) * kBins);
      ++observed[std::clamp(y, 0, kBins - 1) * kBins + std::clamp(x, 0, kBins - 1)];
    }
    for (int y = 0; y < kBins * kSub; ++y)
      for (int x = 0; x < kBins * kSub; ++x) {
        const Vec3f at((static_cast<float>(x) + 0.5f) / (kBins * kSub) * 2 - 1,
                       (static_cast<float>(y) + 0.5f) / (kBins * kSub) - 0.5f, 1.5f);
        const Vec3f d = at - from;
        const double l = length(d);
        expected[y / kSub * kBins + x / kSub] +=
            light->pdf_towards(from, normalize(d), {}, {}) * d.z / (l * l * l);
      }
    double total = 0;
    for (double& e : expected) total += e *= 2.0 / sqr(kBins * kSub);
    // Borders of the map's pixels cross the bins.
    EXPECT_NEAR(total, 1.0, 5e-3);
    for (double& e : expected) e *= kCount / total;
    EXPECT_GT(chi_square_test(observed, expected), 1e-4) << from;
  }
}

TEST_F(PortalLight, SampledDensityIsTheDensityAsked) {
  const LightPtr light = make(kPortal + "\"string filename\" \"pixels.exr\"");
  TestRandom random(5);
  int same = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3f from(4 * random.next() - 2, 4 * random.next() - 2, 1.4f * random.next());
    const auto s = light->sample_towards(from, random.next2(), test_wavelengths());
    ASSERT_TRUE(s);
    const float pdf = light->pdf_towards(from, s->wi, {}, {});
    same += std::abs(pdf - s->pdf_w) < 1e-4f * s->pdf_w &&
            light->radiance_at_infinity(from, s->wi, test_wavelengths())[0] == s->radiance[0];
  }
  // At edges of pixels and of the portal, rounding decides.
  EXPECT_GE(same, kCount - 4);
}

TEST_F(PortalLight, AUniformSkyIsALampOfThePortalsShape) {
  // A window under a uniform sky lights like a rectangle of that radiance.
  const LightPtr light = make(kPortal);
  const double radiance = seen(*light, {0, 0, 0}, {0, 0, 1});
  const double white = seen(*make(""), {0, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(radiance, white, 3e-3 * white);
  const double a = 1 / 1.5, b = 0.5 / 1.5;
  const double corner = (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                         b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b))) /
                        (2 * kPi);
  EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, {0, 0, 1}, 40000), 4 * corner * kPi * radiance));
  EXPECT_TRUE(agrees(emitted_flux(*light, 40000), kPi * 2 * radiance));
}

TEST_F(PortalLight, PowerForChoosingIsTheFluxThroughThePortal) {
  for (const char* source : {"", "\"string filename\" \"smooth.exr\""}) {
    const LightPtr light = make(kPortal + source, "Rotate 30 1 2 3");
    TestRandom random(6);
    Mean mean;
    for (int i = 0; i < 40000; ++i) {
      const auto lambda = SampledWavelengths::sample_visible(random.next());
      const Vec2f u = random.next2();
      const auto e = light->sample_emission(u, random.next2(), lambda);
      ASSERT_TRUE(e);
      mean.add(e->radiance.average() * e->cos_theta / (e->pdf_a * e->pdf_w));
    }
    EXPECT_TRUE(agrees(mean, light->power(), 3e-3 * light->power())) << source;
  }
}

TEST_F(PortalLight, RaysStartOnThePortalAndComeFromBehind) {
  const LightPtr light = make(kPortal + "\"string filename\" \"pixels.exr\"");
  TestRandom random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec2f u = random.next2();
    const auto e = light->sample_emission(u, random.next2(), test_wavelengths());
    ASSERT_TRUE(e);
    EXPECT_TRUE(e->from_behind);
    EXPECT_LT(e->ray.d.z, 0.0f);
    EXPECT_NEAR(e->ray.o.z, 1.5f, 1e-6f);
    EXPECT_TRUE(std::abs(e->ray.o.x) <= 1 && std::abs(e->ray.o.y) <= 0.5f);
    // The sky in the direction the ray came from.
    const Vec3f to = e->ray.o + e->ray.d;
    if (e->cos_theta > 0.01f) {
      EXPECT_GT(light->radiance_at_infinity(to, -e->ray.d, test_wavelengths())[0], 0.0f);
    }
  }
}

TEST_F(PortalLight, ColoursThatAreNoRgbAreConverted) {
  Diagnostics d;
  lights_of("LightSource \"infinite\" \"blackbody L\" 4000 " + kPortal, ".", &d);
  ASSERT_EQ(d.warnings().size(), 1u);
  EXPECT_NE(d.warnings()[0].message.find("rgb"), std::string::npos);
  // An rgb colour is the same with and without a portal.
  const LightPtr portal = make("\"rgb L\" [3 2 1] \"float scale\" 2 " + kPortal);
  const LightPtr open = make("\"rgb L\" [3 2 1] \"float scale\" 2");
  const float expected = seen(*open, {0, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(seen(*portal, {0, 0, 0}, {0, 0, 1}), expected, 5e-3f * expected);
}

}  // namespace
}  // namespace nephroid::testing_light
