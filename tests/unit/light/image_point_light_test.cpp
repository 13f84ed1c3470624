// Projection and goniometric lights: the position of each image pixel, the emission, and sampled
// directions.
#include "core/equal_area_map.h"
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

class ImagePointLight : public ::testing::Test {
 protected:
  LightPtr make(const std::string& light, const std::string& before = "") const {
    return light_of(before + "\nLightSource " + light, {}, scratch.path().string());
  }
  /// A grey image, row by row.
  void write(const std::string& name, int width, const std::vector<float>& values) const {
    std::vector<float> rgb;
    for (const float v : values) rgb.insert(rgb.end(), {v, v, v});
    write_square(scratch.file(name), width, rgb);
  }
  /// Intensity into a direction at the first wavelength.
  static float intensity(const Light& light, const Vec3f& w) {
    const auto s = light.sample_towards(w, {0.5f, 0.5f}, test_wavelengths());
    return s ? s->radiance[0] * dot(w, w) : 0.0f;
  }
  /// Intensity of a grey pixel of value 1.
  static float unit() {
    const Spectrum& white = RgbColorSpace::srgb().illuminant();
    return white.sample(test_wavelengths())[0] / spectrum_to_photometric(white);
  }

  ScratchDirectory scratch;
};

TEST_F(ImagePointLight, AProjectedImageStandsUpright) {
  write("a.exr", 2, {1, 2, 3, 4});
  const LightPtr light = make("\"projection\" \"string filename\" \"a.exr\" \"float fov\" 90");
  EXPECT_TRUE(light->is_delta());
  const float d = 0.9f;
  EXPECT_NEAR(intensity(*light, {-d, d, 1}) / unit(), 1, 4e-3);
  EXPECT_NEAR(intensity(*light, {d, d, 1}) / unit(), 2, 8e-3);
  EXPECT_NEAR(intensity(*light, {-d, -d, 1}) / unit(), 3, 12e-3);
  EXPECT_NEAR(intensity(*light, {d, -d, 1}) / unit(), 4, 16e-3);
  EXPECT_EQ(intensity(*light, {1.01f, 0, 1}), 0.0f);
  EXPECT_EQ(intensity(*light, {0, -1.01f, 1}), 0.0f);
  EXPECT_EQ(intensity(*light, {0.1f, 0.1f, -1}), 0.0f);
}

TEST_F(ImagePointLight, TheShorterSideHasTheAngle) {
  write("wide.exr", 4, {1, 1, 1, 1, 1, 1, 1, 1});
  write("high.exr", 1, {1, 1});
  const LightPtr wide = make("\"projection\" \"string filename\" \"wide.exr\" \"float fov\" 60");
  const LightPtr high = make("\"projection\" \"string filename\" \"high.exr\" \"float fov\" 60");
  const float t = std::tan(kPi / 6);
  for (const float s : {0.99f, 1.01f}) {
    EXPECT_EQ(intensity(*wide, {0, s * t, 1}) > 0, s < 1);
    EXPECT_EQ(intensity(*wide, {2 * s * t, 0, 1}) > 0, s < 1);
    EXPECT_EQ(intensity(*high, {s * t, 0, 1}) > 0, s < 1);
    EXPECT_EQ(intensity(*high, {0, 2 * s * t, 1}) > 0, s < 1);
  }
}

TEST_F(ImagePointLight, AnImageOnAWallIsAsBrightAsThePixels) {
  // A wall at z = 2 that faces the light: irradiance is I cos^3 / 4.
  write("a.exr", 1, {1});
  const LightPtr light = make("\"projection\" \"string filename\" \"a.exr\" \"float scale\" 5");
  const Vec3f p(0.6f, -0.9f, 2);
  const Mean e = irradiance(*light, p, {0, 0, -1}, 1);
  const double cosine = 2 / length(p);
  EXPECT_NEAR(e.mean(), 5 * unit() * cosine * cosine * cosine / 4, 4e-3 * e.mean());
}

TEST_F(ImagePointLight, ProjectedDirectionsFollowThePixels) {
  constexpr int kWidth = 6, kHeight = 4;
  std::vector<float> values;
  for (int i = 0; i < kWidth * kHeight; ++i) values.push_back(static_cast<float>(i % 5));
  write("a.exr", kWidth, values);
  const LightPtr light = make("\"projection\" \"string filename\" \"a.exr\" \"float fov\" 100");
  const double half_y = std::tan(50 * kPi / 180), half_x = half_y * kWidth / kHeight;
  constexpr int kCount = 200000;
  std::vector<double> observed(values.size()), expected(values.size());
  Mean solid_angle;
  TestRandom random(5);
  for (int i = 0; i < kCount; ++i) {
    const auto e = light->sample_emission({0, 0}, random.next2(), test_wavelengths());
    ASSERT_TRUE(e);
    const Vec3f w = e->ray.d;
    const int x = static_cast<int>((w.x / w.z / half_x + 1) / 2 * kWidth);
    const int y = static_cast<int>((1 - w.y / w.z / half_y) / 2 * kHeight);
    ++observed[std::clamp(y, 0, kHeight - 1) * kWidth + std::clamp(x, 0, kWidth - 1)];
    solid_angle.add(1 / e->pdf_w);
    EXPECT_NEAR(intensity(*light, w), e->radiance[0], 1e-5f * e->radiance[0]);
  }
  // Power of a pixel: its value times the solid angle at its centre. Also the exact solid angle of
  // all pixels that are not black.
  double total = 0, seen = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto at = [&](double i, double j) {
        const double px = (2 * i / kWidth - 1) * half_x, py = (2 * j / kHeight - 1) * half_y;
        return std::pow(1 + px * px + py * py, -1.5);
      };
      expected[y * kWidth + x] = values[y * kWidth + x] * at(x + 0.5, y + 0.5);
      total += expected[y * kWidth + x];
      constexpr int kSub = 20;
      for (int k = 0; k < kSub * kSub && values[y * kWidth + x] > 0; ++k)
        seen += at(x + (k % kSub + 0.5) / kSub, y + (k / kSub + 0.5) / kSub) / (kSub * kSub);
    }
  for (double& e : expected) e *= kCount / total;
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
  EXPECT_TRUE(agrees(solid_angle, seen * 4 * half_x * half_y / kWidth / kHeight, 1e-4));
}

TEST_F(ImagePointLight, TheDiagramsPoleIsY) {
  constexpr int kSize = 8;
  std::vector<float> values;
  for (int i = 0; i < kSize * kSize; ++i) values.push_back(1.0f + static_cast<float>(i));
  write("a.exr", kSize, values);
  const LightPtr light =
      make("\"goniometric\" \"string filename\" \"a.exr\" \"spectrum I\" " + kWhite);
  TestRandom random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec2f st = random.next2();
    const Vec3f w = equal_area_square_to_sphere(st);
    const Vec2f cell = st * static_cast<float>(kSize);
    const float edge = std::min({cell.x - std::floor(cell.x), std::ceil(cell.x) - cell.x,
                                 cell.y - std::floor(cell.y), std::ceil(cell.y) - cell.y});
    if (edge < 1e-3f) continue;
    const float value = values[static_cast<int>(cell.y) * kSize + static_cast<int>(cell.x)];
    // The map's z is the light's y.
    EXPECT_NEAR(intensity(*light, {w.x, w.z, w.y}), value * kUnit, 1e-5f * value * kUnit);
  }
}

TEST_F(ImagePointLight, DiagramDirectionsFollowThePixels) {
  constexpr int kSize = 8;
  std::vector<float> values;
  for (int i = 0; i < kSize * kSize; ++i) values.push_back(static_cast<float>(i % 7));
  write("a.exr", kSize, values);
  const LightPtr light =
      make("\"goniometric\" \"string filename\" \"a.exr\" \"spectrum I\" " + kWhite);
  double total = 0;
  for (const float v : values) total += v;
  constexpr int kCount = 200000;
  std::vector<double> observed(values.size()), expected(values.size());
  TestRandom random(6);
  for (int i = 0; i < kCount; ++i) {
    const auto e = light->sample_emission({0, 0}, random.next2(), test_wavelengths());
    ASSERT_TRUE(e);
    const Vec2f st = equal_area_sphere_to_square({e->ray.d.x, e->ray.d.z, e->ray.d.y});
    const int pixel = std::min(static_cast<int>(st.y * kSize), kSize - 1) * kSize +
                      std::min(static_cast<int>(st.x * kSize), kSize - 1);
    ++observed[pixel];
    // The density is intensity divided by flux.
    EXPECT_NEAR(e->pdf_w, e->radiance[0] / kUnit / (4 * kPi * total / (kSize * kSize)), 1e-5);
  }
  for (size_t i = 0; i < values.size(); ++i) expected[i] = kCount * values[i] / total;
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST_F(ImagePointLight, PowerForChoosingIsWhatIsEmitted) {
  // Each pixel counts with the solid angle at its centre, so pixels must be small.
  std::vector<float> values;
  for (int i = 0; i < 32 * 16; ++i) values.push_back(static_cast<float>(i / 3 % 5));
  write("a.exr", 32, values);
  write("b.exr", 2, {0, 1, 2, 3});
  for (const char* text : {"\"projection\" \"string filename\" \"a.exr\" \"float scale\" 3",
                           "\"goniometric\" \"string filename\" \"b.exr\" \"float scale\" 3"}) {
    const LightPtr light = make(text);
    TestRandom random(7);
    Mean mean;
    for (int i = 0; i < 20000; ++i) {
      // Wavelengths follow the density over which power() averages.
      const auto lambda = SampledWavelengths::sample_visible(random.next());
      const auto e = light->sample_emission({0, 0}, random.next2(), lambda);
      mean.add(e ? e->radiance.average() / e->pdf_w : 0.0);
    }
    EXPECT_TRUE(agrees(mean, light->power(), 2e-3 * light->power())) << text;
    const auto bounds = light->bounds();
    ASSERT_TRUE(bounds);
    EXPECT_GT(bounds->power, 0.0f);
  }
}

TEST_F(ImagePointLight, BoundsHoldAllThatIsLit) {
  write("wide.exr", 4, std::vector<float>(8, 1.0f));
  for (const char* before : {"Rotate 70 1 2 3 Scale 2 2 2", "Rotate 70 1 2 3 Scale 1 2 0.5"}) {
    const LightPtr light =
        make("\"projection\" \"string filename\" \"wide.exr\" \"float fov\" 70", before);
    const auto b = light->bounds();
    ASSERT_TRUE(b);
    TestRandom random(8);
    for (int i = 0; i < 5000; ++i) {
      const Vec3f w = square_to_sphere(random.next2());
      if (intensity(*light, w) > 0) {
        EXPECT_GE(dot(w, b->axis), b->cos_theta_o - 1e-5f) << before;
      }
    }
  }
}

TEST_F(ImagePointLight, BlackImagesSendNothing) {
  write("black.exr", 2, {0, 0, 0, 0});
  for (const char* text : {"\"projection\" \"string filename\" \"black.exr\" \"float power\" 3",
                           "\"goniometric\" \"string filename\" \"black.exr\" \"float power\" 3"}) {
    const LightPtr light = make(text);
    EXPECT_EQ(light->power(), 0.0f);
    EXPECT_EQ(intensity(*light, {0, 0, 1}), 0.0f);
    EXPECT_FALSE(light->sample_emission({0.5f, 0.5f}, {0.5f, 0.5f}, test_wavelengths()));
  }
}

}  // namespace
}  // namespace nephroid::testing_light
