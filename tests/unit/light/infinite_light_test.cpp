// Infinite lights: the uniform one, the mapping of images to the sphere, and directions sampled
// from images.
#include <numeric>

#include "core/equal_area_map.h"
#include "scene/light/piecewise_constant_2d.h"
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

TEST(EqualAreaMap, GoesToTheSphereAndBack) {
  TestRandom random(1);
  for (int i = 0; i < 100000; ++i) {
    const Vec2f p = random.next2();
    const Vec3f w = equal_area_square_to_sphere(p);
    EXPECT_NEAR(length(w), 1.0f, 2e-6f);
    const Vec2f q = equal_area_sphere_to_square(w);
    EXPECT_NEAR(q.x, p.x, 2e-6f) << p.x << " " << p.y;
    EXPECT_NEAR(q.y, p.y, 2e-6f) << p.x << " " << p.y;
  }
}

TEST(EqualAreaMap, HasTheLayoutOfPbrt) {
  const auto near = [](const Vec3f& a, const Vec3f& b) { return length(a - b) < 1e-5f; };
  EXPECT_TRUE(near(equal_area_square_to_sphere({0.5f, 0.5f}), {0, 0, 1}));
  EXPECT_TRUE(near(equal_area_square_to_sphere({0, 0}), {0, 0, -1}));
  EXPECT_TRUE(near(equal_area_square_to_sphere({1, 0.5f}), {1, 0, 0}));
  EXPECT_TRUE(near(equal_area_square_to_sphere({0.5f, 1}), {0, 1, 0}));
  EXPECT_TRUE(near(equal_area_square_to_sphere({0.5f, 0}), {0, -1, 0}));
  // The map preserves area: uniform points are uniform on the sphere.
  TestRandom random(2);
  constexpr int kCount = 200000, kBins = 20;
  std::vector<double> observed(kBins * kBins),
      expected(kBins * kBins, kCount * 1.0 / kBins / kBins);
  for (int i = 0; i < kCount; ++i) {
    const Vec3f w = equal_area_square_to_sphere(random.next2());
    const int z = std::clamp(static_cast<int>((w.z + 1) / 2 * kBins), 0, kBins - 1);
    const double phi = std::atan2(w.y, w.x) / (2 * kPi) + 0.5;
    ++observed[z * kBins + std::clamp(static_cast<int>(phi * kBins), 0, kBins - 1)];
  }
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST(PiecewiseConstant2D, SamplesCellsByTheirWeights) {
  std::vector<float> weights = {0, 1, 2, 3, 0, 0, 0, 0, 5, 0, 0, 1e-3f};
  const PiecewiseConstant2D grid(weights, 4, 3);
  TestRandom random(3);
  constexpr int kCount = 100000;
  std::vector<double> observed(12), expected(12);
  const double total = 11.001;
  for (int i = 0; i < kCount; ++i) {
    const auto s = grid.sample(random.next2());
    ASSERT_TRUE(s);
    ++observed[s->y * 4 + s->x];
    EXPECT_EQ(static_cast<int>(s->point.x * 4), s->x);
    EXPECT_EQ(static_cast<int>(s->point.y * 3), s->y);
    EXPECT_NEAR(s->pdf, weights[s->y * 4 + s->x] / total * 12, 1e-5f);
  }
  for (int i = 0; i < 12; ++i) expected[i] = kCount * weights[i] / total;
  for (int i = 0; i < 12; ++i) EXPECT_EQ(observed[i] == 0, weights[i] == 0) << i;
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
  EXPECT_FALSE(PiecewiseConstant2D({0, 0, 0, 0}, 2, 2).sample({0.5f, 0.5f}));
  // The inverse of this mean overflows a float.
  const PiecewiseConstant2D faint({0, 4e-39f, 0, 0}, 2, 2);
  EXPECT_FALSE(faint.sample({0.5f, 0.5f}));
  EXPECT_EQ(faint.pdf(0, 0), 0);
  EXPECT_EQ(faint.mean(), 0);
}

TEST(UniformInfiniteLight, GivesPiAndItsPower) {
  const SceneSphere sphere{{1, 2, 3}, 5};
  const LightPtr light = light_of("LightSource \"infinite\" \"spectrum L\" " + kWhite, sphere);
  EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, {0, 0, 1}, 40000), kPi * kUnit));
  EXPECT_TRUE(agrees(emitted_flux(*light, 1000), 4 * kPi * kPi * 25 * kUnit));
  EXPECT_NEAR(light->power(), 4 * kPi * kPi * 25 * kUnit, 1e-3f * light->power());
  EXPECT_NEAR(light->radiance_at_infinity({0, 0, 0}, {0, 1, 0}, test_wavelengths())[0], kUnit,
              1e-6f * kUnit);
  const LightPtr bright = light_of(
      "LightSource \"infinite\" \"float illuminance\" 10 \"spectrum L\" " + kWhite, sphere);
  EXPECT_TRUE(agrees(irradiance(*bright, {0, 0, 0}, {0, 0, 1}, 40000), 10 * kUnit));
}

TEST(UniformInfiniteLight, RaysStartOutsideAndCrossTheScene) {
  const SceneSphere sphere{{100, 2, 3}, 5};
  const LightPtr light = light_of("LightSource \"infinite\"", sphere);
  TestRandom random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec2f u = random.next2();
    const auto e = light->sample_emission(u, random.next2(), test_wavelengths());
    ASSERT_TRUE(e);
    const Vec3f to_center = sphere.center - e->ray.o;
    EXPECT_GE(length(to_center), 5 * 0.99999f);
    EXPECT_NEAR(dot(to_center, e->ray.d), 5, 1e-4f);
    EXPECT_LE(length(to_center - e->ray.d * dot(to_center, e->ray.d)), 5 * 1.00001f);
  }
}

/// A map of 16 x 16 grey pixels, one of them 10 000 times brighter, and one half black.
class ImageInfiniteLight : public ::testing::Test {
 protected:
  static constexpr int kSize = 16;

  void SetUp() override {
    values.assign(kSize * kSize, 0.0f);
    for (int i = 0; i < kSize * kSize / 2; ++i) values[i] = 0.1f + static_cast<float>(i % 7);
    values[11 * kSize + 4] = 10000;
    std::vector<float> rgb;
    for (const float v : values) rgb.insert(rgb.end(), {v, v, v});
    write_square(scratch.file("sky.exr"), kSize, rgb);
  }
  LightPtr make(const std::string& before = "", const std::string& parameters = "",
                const SceneSphere& sphere = {}) const {
    return light_of(
        before + "\nLightSource \"infinite\" \"string filename\" \"sky.exr\" " + parameters, sphere,
        scratch.path().string());
  }
  static int pixel_of(const Vec3f& w) {
    const Vec2f st = equal_area_sphere_to_square(w) * static_cast<float>(kSize);
    return std::min(static_cast<int>(st.y), kSize - 1) * kSize +
           std::min(static_cast<int>(st.x), kSize - 1);
  }
  /// Radiance of a grey pixel of value 1 at the first wavelength.
  static double unit() {
    const Spectrum& white = RgbColorSpace::srgb().illuminant();
    return white.sample(test_wavelengths())[0] / spectrum_to_photometric(white);
  }
  static constexpr double kPixels = kSize * kSize;
  double total() const {
    double sum = 0;
    for (const float v : values) sum += v;
    return sum;
  }

  /// The target of light sampling: the part of each pixel above the average.
  std::vector<double> above_average() const {
    std::vector<double> above;
    for (const float v : values) above.push_back(std::max(0.0, v - total() / kPixels));
    return above;
  }

  ScratchDirectory scratch;
  std::vector<float> values;
};

double sum_of(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

TEST_F(ImageInfiniteLight, DirectionsFollowThePixels) {
  const LightPtr light = make();
  TestRandom random(6);
  constexpr int kCount = 400000;
  std::vector<double> observed(values.size()), expected(values.size());
  for (int i = 0; i < kCount; ++i) {
    const auto s = light->sample_towards({0, 0, 0}, random.next2(), test_wavelengths());
    ASSERT_TRUE(s);
    ++observed[pixel_of(s->wi)];
  }
  const std::vector<double> above = above_average();
  for (size_t i = 0; i < values.size(); ++i) expected[i] = kCount * above[i] / sum_of(above);
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST_F(ImageInfiniteLight, LeavesOutNothingInScenesWithFog) {
  const LightPtr light = make();
  const std::vector<double> above = above_average();
  const Vec3f dim = equal_area_square_to_sphere({1.5f / kSize, 0.5f / kSize});
  ASSERT_EQ(above[1], 0);
  EXPECT_EQ(light->pdf_towards({0, 0, 0}, dim, {}, {}), 0);
  light->leave_out_nothing();
  EXPECT_NEAR(light->pdf_towards({0, 0, 0}, dim, {}, {}), values[1] / total() * kPixels * kInv4Pi,
              1e-4 * values[1] / total() * kPixels);
}

TEST_F(ImageInfiniteLight, DensityAndRadianceAreThoseOfThePixel) {
  const LightPtr light = make();
  const std::vector<double> above = above_average();
  TestRandom random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f w = equal_area_square_to_sphere(random.next2());
    const float v = values[pixel_of(w)];
    const double density = above[pixel_of(w)] / sum_of(above) * kPixels / (4 * kPi);
    EXPECT_NEAR(light->pdf_towards({0, 0, 0}, w, {}, {}), density, 1e-5 * density);
    EXPECT_NEAR(light->radiance_at_infinity({0, 0, 0}, w, test_wavelengths())[0], v * unit(),
                3e-3 * v * unit());
  }
  for (int i = 0; i < 2000; ++i) {
    const auto s = light->sample_towards({0, 0, 0}, random.next2(), test_wavelengths());
    // A direction at the edge of a pixel may round into the next one.
    const Vec2f st = equal_area_sphere_to_square(s->wi) * static_cast<float>(kSize);
    const float edge = std::min({st.x - std::floor(st.x), std::ceil(st.x) - st.x,
                                 st.y - std::floor(st.y), std::ceil(st.y) - st.y});
    if (edge < 1e-4f) continue;
    EXPECT_EQ(light->pdf_towards({0, 0, 0}, s->wi, {}, {}), s->pdf_w);
    EXPECT_EQ(light->radiance_at_infinity({0, 0, 0}, s->wi, test_wavelengths())[0], s->radiance[0]);
  }
}

TEST_F(ImageInfiniteLight, EmitsItsPower) {
  const LightPtr light = make("", "\"float scale\" 2", {{1, 2, 3}, 5});
  const double expected = 2 * unit() * total() / kPixels * 4 * kPi * kPi * 25;
  // Polynomials of greys are accurate to a few thousandths.
  EXPECT_NEAR(emitted_flux(*light, 1000).mean(), expected, 3e-3 * expected);
}

TEST_F(ImageInfiniteLight, TurnsWithItsTransform) {
  const LightPtr plain = make(), turned = make("Rotate 90 1 0 0");
  // The rotation maps y to z.
  TestRandom random(8);
  int same = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3f w = equal_area_square_to_sphere(random.next2());
    same += plain->radiance_at_infinity({0, 0, 0}, w, test_wavelengths())[0] ==
            turned->radiance_at_infinity({0, 0, 0}, {w.x, -w.z, w.y}, test_wavelengths())[0];
  }
  EXPECT_GT(same, 995);
}

TEST_F(ImageInfiniteLight, DensityIntegratesToOneUnderAnyTransform) {
  for (const char* transform :
       {"", "Rotate 30 1 2 3", "Scale -1 1 1", "Scale 1 3 0.5 Rotate 20 1 1 0"}) {
    const LightPtr light = make(transform);
    // The light integrates subsamples of each pixel, this test the midpoints of a fine grid.
    double integral = 0;
    constexpr int kRows = 1200;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kRows; ++x) {
        const Vec3f w = equal_area_square_to_sphere(
            {(static_cast<float>(x) + 0.5f) / kRows, (static_cast<float>(y) + 0.5f) / kRows});
        integral += light->pdf_towards({0, 0, 0}, w, {}, {});
      }
    integral *= 4 * kPi / kRows / kRows;
    // The bright pixel contains 75 x 75 of the points (fewer where the map shrinks it): its border
    // limits the accuracy.
    EXPECT_NEAR(integral, 1.0, 0.03) << transform;
  }
}

TEST_F(ImageInfiniteLight, IrradianceIsThatOfThePixels) {
  const LightPtr light = make();
  const Vec3f n = normalize(Vec3f(0.2f, -0.3f, 0.9f));
  double expected = 0;
  constexpr int kSub = 16;
  for (int y = 0; y < kSize * kSub; ++y)
    for (int x = 0; x < kSize * kSub; ++x) {
      const Vec3f w = equal_area_square_to_sphere({(static_cast<float>(x) + 0.5f) / kSize / kSub,
                                                   (static_cast<float>(y) + 0.5f) / kSize / kSub});
      expected += values[(y / kSub) * kSize + x / kSub] * std::max(0.0f, dot(n, w));
    }
  expected *= unit() * 4 * kPi / (kSize * kSub) / (kSize * kSub);
  const Mean got = irradiance(*light, {0, 0, 0}, n, 100000);
  EXPECT_NEAR(got.mean(), expected, 4.5 * got.error() + 4e-3 * expected);
}

TEST_F(ImageInfiniteLight, IlluminanceIsThatOfTheUpperHalf) {
  const LightPtr light = make("", "\"float illuminance\" 50");
  // +z of the image's frame is up.
  const Mean got = irradiance(*light, {0, 0, 0}, {0, 0, 1}, 100000);
  // As in pbrt-v4 the solid angle is halved: the light is twice as bright as its illuminance says.
  EXPECT_NEAR(got.mean(), 2 * 50 * unit(), 4.5 * got.error() + 2e-2 * 100 * unit());
}

TEST_F(ImageInfiniteLight, RefusesImagesThatAreNoMaps) {
  write_square(scratch.file("wide.exr"), 3, std::vector<float>(9, 1.0f));
  write_square(scratch.file("hot.exr"), 1, {kInfinity, 1, 1});
  for (const char* file : {"wide.exr", "hot.exr"}) {
    try {
      light_of(std::string("LightSource \"infinite\" \"string filename\" \"") + file + "\"", {},
               scratch.path().string());
      FAIL() << file;
    } catch (const SceneError& e) {
      EXPECT_EQ(std::string(e.what()).find("t.pbrt:2:"), 0u) << e.what();
    }
  }
}

TEST_F(ImageInfiniteLight, BlackImagesSendNothing) {
  write_square(scratch.file("black.exr"), 2, std::vector<float>(12, 0.0f));
  const LightPtr light = light_of("LightSource \"infinite\" \"string filename\" \"black.exr\"", {},
                                  scratch.path().string());
  EXPECT_EQ(light->power(), 0.0f);
  EXPECT_FALSE(light->sample_towards({0, 0, 0}, {0.5f, 0.5f}, test_wavelengths()));
  EXPECT_EQ(light->pdf_towards({0, 0, 0}, {0, 0, 1}, {}, {}), 0.0f);
  EXPECT_TRUE(light->radiance_at_infinity({0, 0, 0}, {0, 0, 1}, test_wavelengths()).is_black());
}

}  // namespace
}  // namespace nephroid::testing_light
