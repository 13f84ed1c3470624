// Infinite lights with latitude-longitude maps: the position of each pixel, and samples, densities
// and radiance by the pixels' solid angles.
#include "core/equal_area_map.h"
#include "scene/light/sphere_map.h"
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

constexpr int kSkyWidth = 16, kSkyHeight = 8;

Vec3f at_angles(double theta, double phi) {
  return to_float(
      Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
}

/// Cosine of the polar angle at the upper edge of a row.
double cos_at_rim(int row) {
  return std::cos(double{kPi} * row / kSkyHeight);
}

/// A sky that is smooth across seam and poles.
float smooth_sky(const Vec3f& w) {
  return 2 + w.x + 0.5f * w.y + 0.3f * w.z;
}
std::vector<float> smooth_map(int width, int height) {
  const SphereMap map(width, height);
  std::vector<float> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      rgb.insert(
          rgb.end(), 3,
          smooth_sky(width == height ? map.direction({u, v}) : at_angles(v * kPi, u * 2 * kPi)));
    }
  return rgb;
}

TEST(SphereMap, LatitudeLongitudeRunsFromZDownAndFromXOverY) {
  const SphereMap map(kSkyWidth, kSkyHeight);
  EXPECT_EQ(map.pixel({0, 0, 1}).y, 0);
  EXPECT_EQ(map.pixel({0, 0, -1}).y, kSkyHeight - 1);
  EXPECT_EQ(map.pixel(at_angles(0.01, 2)), Vec2i(5, 0));
  EXPECT_EQ(map.pixel(at_angles(kPi - 0.01, 2)), Vec2i(5, kSkyHeight - 1));
  // Both sides of the seam at +x, and of the equator.
  EXPECT_EQ(map.pixel(at_angles(kPi / 2 - 0.01, 0.01)), Vec2i(0, kSkyHeight / 2 - 1));
  EXPECT_EQ(map.pixel(at_angles(kPi / 2 + 0.01, -0.01)), Vec2i(kSkyWidth - 1, kSkyHeight / 2));
  EXPECT_EQ(map.pixel(normalize(Vec3f(0.01f, 1, 0.01f))),
            Vec2i(kSkyWidth / 4 - 1, kSkyHeight / 2 - 1));
  EXPECT_EQ(map.pixel(normalize(Vec3f(-1, -0.01f, 0.01f))),
            Vec2i(kSkyWidth / 2, kSkyHeight / 2 - 1));
}

TEST(SphereMap, PixelsCoverTheirSolidAnglesUniformly) {
  const SphereMap map(kSkyWidth, kSkyHeight), octahedral(5, 5);
  double sum = 0;
  for (int y = 0; y < kSkyHeight; ++y) {
    const double share = (cos_at_rim(y) - cos_at_rim(y + 1)) / 2 * kSkyHeight;
    EXPECT_NEAR(map.relative_solid_angle(y), share, 1e-6);
    sum += map.relative_solid_angle(y);
  }
  EXPECT_NEAR(sum, kSkyHeight, 1e-6);
  EXPECT_EQ(octahedral.relative_solid_angle(3), 1.0f);
  TestRandom random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec2f u = random.next2();
    const Vec3f w = map.direction(u);
    EXPECT_NEAR(length(w), 1.0f, 1e-6f);
    // Uniform in z within the row.
    const int row = static_cast<int>(u.y * kSkyHeight);
    const Vec2f in_pixel(u.x * kSkyWidth - std::floor(u.x * kSkyWidth),
                         u.y * kSkyHeight - std::floor(u.y * kSkyHeight));
    EXPECT_NEAR(w.z, cos_at_rim(row) + in_pixel.y * (cos_at_rim(row + 1) - cos_at_rim(row)), 1e-5);
    if (std::min({in_pixel.x, in_pixel.y, 1 - in_pixel.x, 1 - in_pixel.y}) < 1e-4f) continue;
    EXPECT_EQ(map.pixel(w), Vec2i(static_cast<int>(u.x * kSkyWidth), row));
  }
}

TEST(SphereMap, BilinearGoesOnOverSeamAndPoles) {
  const int height = 64;
  const Image image(2 * height, height, 3, smooth_map(2 * height, height), RgbColorSpace::srgb());
  const SphereMap map(2 * height, height);
  TestRandom random(2);
  for (int i = 0; i < 4000; ++i) {
    const double theta = random.next() * (i % 2 ? 0.06 : kPi), phi = random.next() * 2 * kPi;
    const Vec3f w = at_angles(i % 4 == 1 ? kPi - theta : theta, i % 3 ? phi : 0.05 * (phi - kPi));
    EXPECT_NEAR(map.bilinear(image, w).r, smooth_sky(w), 1.5e-3f) << w;
  }
}

class LatitudeLongitudeLight : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < kSkyWidth * kSkyHeight; ++i) values.push_back(static_cast<float>(i % 7));
    values[1 * kSkyWidth + 4] = 200;
    values[7 * kSkyWidth + 15] = 300;
    std::vector<float> rgb;
    for (const float v : values) rgb.insert(rgb.end(), {v, v, v});
    write_square(scratch.file("sky.exr"), kSkyWidth, rgb);
  }
  LightPtr make(const std::string& before = "", const std::string& parameters = "",
                const SceneSphere& sphere = {}, const std::string& file = "sky.exr") const {
    return light_of(
        before + "\nLightSource \"infinite\" \"string filename\" \"" + file + "\" " + parameters,
        sphere, scratch.path().string());
  }
  static int pixel_of(const Vec3f& w) {
    const Vec2i pixel = SphereMap(kSkyWidth, kSkyHeight).pixel(w);
    return pixel.y * kSkyWidth + pixel.x;
  }
  static double solid_angle(int pixel) {
    const int y = pixel / kSkyWidth;
    return 2 * kPi / kSkyWidth * (cos_at_rim(y) - cos_at_rim(y + 1));
  }
  /// Integral of radiance over the sphere, in grey values.
  double total() const {
    double sum = 0;
    for (int i = 0; i < kSkyWidth * kSkyHeight; ++i) sum += values[i] * solid_angle(i);
    return sum;
  }
  /// Radiance of a grey pixel of value 1 at the first wavelength.
  static double unit() {
    const Spectrum& white = RgbColorSpace::srgb().illuminant();
    return white.sample(test_wavelengths())[0] / spectrum_to_photometric(white);
  }
  ScratchDirectory scratch;
  std::vector<float> values;
};

TEST_F(LatitudeLongitudeLight, DirectionsFollowWhatIsAboveTheAverage) {
  const LightPtr light = make();
  std::vector<double> observed(values.size()), expected(values.size());
  double sum = 0;
  for (int i = 0; i < kSkyWidth * kSkyHeight; ++i) {
    expected[i] = std::max(0.0, values[i] - total() / (4 * kPi)) * solid_angle(i);
    sum += expected[i];
  }
  TestRandom random(6);
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const auto s = light->sample_towards({0, 0, 0}, random.next2(), test_wavelengths());
    ASSERT_TRUE(s);
    ++observed[pixel_of(s->wi)];
  }
  for (double& e : expected) e *= kCount / sum;
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f w = square_to_sphere(random.next2());
    const double density = expected[pixel_of(w)] / kCount / solid_angle(pixel_of(w));
    EXPECT_NEAR(light->pdf_towards({0, 0, 0}, w, {}, {}), density, 1e-4 * density);
    const double value = values[pixel_of(w)] * unit();
    EXPECT_NEAR(light->radiance_at_infinity({0, 0, 0}, w, test_wavelengths())[0], value,
                3e-3 * value);
  }
}

TEST_F(LatitudeLongitudeLight, PhotonsFollowTheRadiance) {
  const LightPtr light = make("Rotate 40 1 2 3", "\"float scale\" 2", {{1, 2, 3}, 5});
  const double expected = 2 * unit() * total() * kPi * 25;
  // All photons carry the same, up to the polynomials of greys.
  const Mean flux = emitted_flux(*light, 4000);
  EXPECT_NEAR(flux.mean(), expected, 3e-3 * expected);
  EXPECT_LT(flux.error(), 1e-3 * expected);
  TestRandom random(9);
  int at_an_edge = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2f u = random.next2();
    const auto e = light->sample_emission(u, random.next2(), test_wavelengths());
    ASSERT_TRUE(e);
    const float asked = light->emission_pdf({}, e->ray.d).pdf_w;
    // A direction at the edge of a pixel may round into the next one.
    at_an_edge += std::abs(asked - e->pdf_w) > 1e-4f * e->pdf_w;
  }
  EXPECT_LE(at_an_edge, 3);
}

TEST_F(LatitudeLongitudeLight, DensityIntegratesToOneUnderAnyTransform) {
  for (const char* transform :
       {"", "Rotate 30 1 2 3", "Scale -1 1 1", "Scale 1 3 0.5 Rotate 20 1 1 0"}) {
    const LightPtr light = make(transform);
    double integral = 0;
    constexpr int kRows = 800;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kRows; ++x)
        integral += light->pdf_towards(
            {0, 0, 0},
            equal_area_square_to_sphere(
                {(static_cast<float>(x) + 0.5f) / kRows, (static_cast<float>(y) + 0.5f) / kRows}),
            {}, {});
    EXPECT_NEAR(integral * 4 * kPi / kRows / kRows, 1.0, 0.02) << transform;
  }
}

TEST_F(LatitudeLongitudeLight, IrradianceIsThatOfThePixels) {
  const LightPtr light = make();
  const Vec3f n = normalize(Vec3f(0.2f, -0.3f, 0.9f));
  double expected = 0;
  constexpr int kSub = 24;
  for (int y = 0; y < kSkyHeight * kSub; ++y)
    for (int x = 0; x < kSkyWidth * kSub; ++x) {
      const double theta = kPi * (y + 0.5) / (kSkyHeight * kSub);
      const Vec3f w = at_angles(theta, 2 * kPi * (x + 0.5) / (kSkyWidth * kSub));
      expected += values[y / kSub * kSkyWidth + x / kSub] * std::max(0.0f, dot(n, w)) *
                  std::sin(theta) * (kPi / (kSkyHeight * kSub)) * (2 * kPi / (kSkyWidth * kSub));
    }
  expected *= unit();
  const Mean got = irradiance(*light, {0, 0, 0}, n, 100000);
  EXPECT_NEAR(got.mean(), expected, 4.5 * got.error() + 4e-3 * expected);
}

TEST_F(LatitudeLongitudeLight, IsTheSkyOfTheOctahedralMap) {
  write_square(scratch.file("wide.exr"), 256, smooth_map(256, 128));
  write_square(scratch.file("square.exr"), 128, smooth_map(128, 128));
  for (const std::string parameters : {"", "\"float illuminance\" 50"}) {
    const LightPtr a = make("Rotate 20 1 1 0", parameters, {}, "wide.exr");
    const LightPtr b = make("Rotate 20 1 1 0", parameters, {}, "square.exr");
    EXPECT_NEAR(a->power(), b->power(), 1e-3f * b->power());
    TestRandom random(3);
    for (int i = 0; i < 500; ++i) {
      const Vec3f w = square_to_sphere(random.next2());
      const float expected = b->radiance_at_infinity({0, 0, 0}, w, test_wavelengths())[0];
      // Both are constant per pixel.
      EXPECT_NEAR(a->radiance_at_infinity({0, 0, 0}, w, test_wavelengths())[0], expected,
                  0.05f * expected);
    }
  }
}

TEST_F(LatitudeLongitudeLight, IsSeenThroughPortals) {
  write_square(scratch.file("wide.exr"), 128, smooth_map(128, 64));
  const LightPtr open = make("Rotate 90 1 0 0", "", {}, "wide.exr");
  const LightPtr portal =
      make("Rotate 90 1 0 0", "\"point3 portal\" [-1 -0.5 1.5  -1 0.5 1.5  1 0.5 1.5  1 -0.5 1.5]",
           {}, "wide.exr");
  TestRandom random(4);
  for (int i = 0; i < 500; ++i) {
    const Vec3f to = normalize(Vec3f(2 * random.next() - 1, random.next() - 0.5f, 1.5f));
    const float expected = open->radiance_at_infinity({0, 0, 0}, to, test_wavelengths())[0];
    EXPECT_NEAR(portal->radiance_at_infinity({0, 0, 0}, to, test_wavelengths())[0], expected,
                0.07f * expected);
  }
}

}  // namespace
}  // namespace nephroid::testing_light
