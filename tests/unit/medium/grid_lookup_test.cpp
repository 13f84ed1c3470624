// Grid values between and beyond the samples: known results for pbrt-v4's convention.
#include "scene/medium/sampled_grid.h"
#include "scene/texture/noise.h"
#include "unit/medium/medium_fixture.h"

namespace nephroid::testing_medium {
namespace {

const auto kSame = [](float x) { return x; };
/// A constant spectrum of value 1.
const std::string kOne = "\"spectrum sigma_a\" [ 200 1 900 1 ] ";

TEST(SampledGrid, SamplesLieInTheMiddleOfCells) {
  const SampledGrid<float> grid({1, 3, 5, 11}, {2, 2, 1});
  EXPECT_EQ(grid.lookup({0.25f, 0.25f, 0.5f}, kSame), 1);
  EXPECT_EQ(grid.lookup({0.75f, 0.25f, 0.5f}, kSame), 3);
  EXPECT_EQ(grid.lookup({0.25f, 0.75f, 0.5f}, kSame), 5);
  EXPECT_EQ(grid.lookup({0.75f, 0.75f, 0.5f}, kSame), 11);
  EXPECT_EQ(grid.lookup({0.5f, 0.25f, 0.5f}, kSame), 2);
  EXPECT_EQ(grid.lookup({0.5f, 0.5f, 0.5f}, kSame), 5);
  // Halfway to the neighbours beyond the walls, which are 0.
  EXPECT_EQ(grid.lookup({0, 0.25f, 0.5f}, kSame), 0.5f);
  EXPECT_EQ(grid.lookup({0.25f, 0.25f, 0}, kSame), 0.5f);
  EXPECT_EQ(grid.lookup({0, 0, 0}, kSame), 0.125f);
  EXPECT_EQ(grid.lookup({-0.25f, 0.25f, 0.5f}, kSame), 0);
  EXPECT_EQ(grid.lookup({1.25f, 0.25f, 0.5f}, kSame), 0);
}

TEST(SampledGrid, ReproducesLinearFunctionsInside) {
  const std::array<int, 3> n = {4, 6, 5};
  const auto f = [](const Vec3f& p) { return 2 + p.x - 3 * p.y * p.z + p.x * p.y; };
  std::vector<float> values;
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x)
        values.push_back(f({(float(x) + 0.5f) / float(n[0]), (float(y) + 0.5f) / float(n[1]),
                            (float(z) + 0.5f) / float(n[2])}));
  const SampledGrid<float> grid(values, n);
  TestRandom random(1);
  for (int i = 0; i < 1000; ++i) {
    Vec3f p(random.next(), random.next(), random.next());
    for (int a = 0; a < 3; ++a) {
      const float half = 0.5f / float(n[a]);
      p[a] = std::clamp(p[a], half, 1 - half);
    }
    ASSERT_NEAR(grid.lookup(p, kSame), f(p), 1e-5f);
  }
}

TEST(SampledGrid, MaximumBoundsEveryLookupInABox) {
  std::vector<float> values;
  TestRandom random(2);
  for (int i = 0; i < 3 * 4 * 5; ++i) values.push_back(random.next());
  const SampledGrid<float> grid(values, {3, 4, 5});
  for (int i = 0; i < 200; ++i) {
    Vec3f lo(random.next(), random.next(), random.next()), hi(0, 0, 0);
    for (int a = 0; a < 3; ++a) hi[a] = lo[a] + (1 - lo[a]) * random.next();
    const float most = grid.max_value(lo, hi, kSame);
    for (int k = 0; k < 50; ++k) {
      Vec3f p(0, 0, 0);
      for (int a = 0; a < 3; ++a) p[a] = lo[a] + (hi[a] - lo[a]) * random.next();
      ASSERT_LE(grid.lookup(p, kSame), most * (1 + 1e-6f));
    }
  }
  EXPECT_EQ(grid.max_value({0, 0, 0}, {1, 1, 1}, kSame),
            *std::max_element(values.begin(), values.end()));
}

TEST(UniformGrid, DensityScalesBothCoefficients) {
  const MediumPtr m =
      medium_of("uniformgrid",
                "\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 3 2 1 ] \"float scale\" 2 "
                "\"float density\" [ 1 4 ] \"integer nx\" 2 \"float g\" 0.3 "
                "\"point3 p0\" [ 5 1 0 ] \"point3 p1\" [ 1 0 1 ]",
                "Scale 2 1 1");
  const MediumPtr one = medium_of(
      "homogeneous", "\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 3 2 1 ] \"float scale\" 2");
  const auto lambda = test_wavelengths();
  // The box is 2 <= x <= 10 in world space; coefficients are per unit of world length.
  for (const auto& [x, density] : {std::pair(4.0f, 1.0f), {8.0f, 4.0f}, {6.0f, 2.5f}}) {
    const MediumProperties p = m->at({x, 0.5f, 0.5f}, lambda), q = one->at({0, 0, 0}, lambda);
    for (int i = 0; i < kSpectrumSamples; ++i) {
      EXPECT_NEAR(p.sigma_a[i], density * q.sigma_a[i], 1e-5f);
      EXPECT_NEAR(p.sigma_s[i], density * q.sigma_s[i], 1e-5f);
    }
    EXPECT_EQ(p.phase.g(), 0.3f);
    EXPECT_EQ(p.le[0], 0);
  }
  EXPECT_FALSE(m->is_emissive() || m->is_purely_absorbing() || m->uniform_extinction(lambda));
}

TEST(UniformGrid, EmitsLeOverItsLuminanceTimesLescale) {
  const auto lambda = test_wavelengths();
  const std::string parameters = kOne + "\"integer nx\" 2 \"float density\" [ 1 1 ] ";
  const std::string le = "\"spectrum Le\" [ 200 7 900 7 ] ";
  const MediumPtr scaled = medium_of("uniformgrid", parameters + le + "\"float Lescale\" [ 2 5 ]");
  EXPECT_TRUE(scaled->is_emissive());
  EXPECT_NEAR(scaled->at({0.25f, 0.5f, 0.5f}, lambda).le[3], 2 / kCieYIntegral, 1e-6f);
  EXPECT_NEAR(scaled->at({0.75f, 0.5f, 0.5f}, lambda).le[3], 5 / kCieYIntegral, 1e-6f);
  // Without "Lescale" there is a single sample in the middle of the box.
  const MediumPtr plain = medium_of("uniformgrid", parameters + le);
  EXPECT_NEAR(plain->at({0.5f, 0.5f, 0.5f}, lambda).le[3], 1 / kCieYIntegral, 1e-7f);
  EXPECT_NEAR(plain->at({0.25f, 0.5f, 0.5f}, lambda).le[3], 0.75f / kCieYIntegral, 1e-7f);
  EXPECT_FALSE(medium_of("uniformgrid", parameters)->is_emissive());
}

TEST(UniformGrid, TemperaturesAreBlackBodiesWithAMaximumOfOne) {
  const auto lambda = test_wavelengths();
  const MediumPtr m = medium_of(
      "uniformgrid", kOne +
                         "\"integer nx\" 2 \"float density\" [ 1 1 ] "
                         "\"float temperature\" [ 10 40 ] \"float Lescale\" [ 3 3 ] "
                         "\"float temperatureoffset\" 9.5 \"float temperaturescale\" 100 ");
  EXPECT_TRUE(m->is_emissive());
  // (40 - 9.5) * 100 = 3050 K. At (10 - 9.5) * 100 = 50 K nothing is emitted.
  const SampledSpectrum hot = m->at({0.75f, 0.5f, 0.5f}, lambda).le;
  const SpectrumPtr planck = blackbody_spectrum(3050);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    EXPECT_NEAR(hot[i], 3 * (*planck)(lambda.lambda(i)), 1e-5f);
    EXPECT_GT(hot[i], 0);
  }
  EXPECT_TRUE(m->at({0.25f, 0.5f, 0.5f}, lambda).le.is_black());
  // The old name of the offset.
  const MediumPtr cutoff = medium_of(
      "uniformgrid", kOne +
                         "\"integer nx\" 2 \"float density\" [ 1 1 ] "
                         "\"float temperature\" [ 10 40 ] \"float Lescale\" [ 3 3 ] "
                         "\"float temperaturecutoff\" 9.5 \"float temperaturescale\" 100 ");
  EXPECT_EQ(cutoff->at({0.75f, 0.5f, 0.5f}, lambda).le, hot);
}

TEST(RgbGrid, SamplesAreTheSpectraOfTheirColours) {
  const MediumPtr m = medium_of("rgbgrid",
                                "\"integer ny\" 2 \"rgb sigma_a\" [ 0.1 0.5 2 1 1 1 ] "
                                "\"rgb Le\" [ 1 2 3 0 0 0 ] \"float Lescale\" 4 \"float scale\" 2");
  const auto lambda = test_wavelengths();
  const RgbColorSpace& srgb = RgbColorSpace::srgb();
  const SpectrumPtr a = rgb_unbounded_spectrum(srgb, {0.1f, 0.5f, 2});
  const SpectrumPtr le = rgb_illuminant_spectrum(srgb, {1, 2, 3});
  const MediumProperties p = m->at({0.5f, 0.25f, 0.5f}, lambda);
  const MediumProperties middle = m->at({0.5f, 0.5f, 0.5f}, lambda);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    EXPECT_NEAR(p.sigma_a[i], 2 * a->sample(lambda)[i], 1e-5f);
    EXPECT_NEAR(middle.sigma_a[i], a->sample(lambda)[i] + 1, 1e-5f);
    // Without a grid the coefficient is 1 up to the walls.
    EXPECT_EQ(m->at({0, 0, 0}, lambda).sigma_s[i], 2);
    EXPECT_NEAR(p.le[i], 4 * le->sample(lambda)[i], 1e-5f * p.le[i]);
  }
  EXPECT_TRUE(m->is_emissive());
  EXPECT_FALSE(m->is_purely_absorbing());
  EXPECT_TRUE(medium_of("rgbgrid", "\"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ]")
                  ->is_purely_absorbing());
}

TEST(Cloud, IsFullBelowEmptyAboveAndTheNoiseInBetween) {
  const auto lambda = test_wavelengths();
  const auto density_at = [&](const std::string& parameters, const Vec3f& p) {
    return medium_of("cloud", kOne + parameters)->at(p, lambda).sigma_a[0];
  };
  EXPECT_EQ(density_at("", {0.3f, -0.1f, 0.2f}), 1);
  EXPECT_EQ(density_at("", {0.3f, 1, 0.2f}), 0);
  // Without wisps: the octaves, computed by hand.
  const MediumPtr smooth = medium_of(
      "cloud", kOne + "\"float wispiness\" 0 \"float frequency\" 4 \"float density\" 0.9");
  TestRandom random(9);
  int between = 0;
  for (int n = 0; n < 200; ++n) {
    const Vec3f p(random.next(), random.next(), random.next());
    double sum = 0, scale = 1, weight = 0.5;
    for (int i = 0; i < 5; ++i, scale *= 1.99, weight /= 2)
      sum += weight * noise(p * 4 * static_cast<float>(scale));
    const double body = std::clamp((1 - p.y) * 4.5 * 0.9 * sum, 0.0, 1.0);
    const double expected = std::min(body + 2 * std::max(0.0, 0.5 - p.y), 1.0);
    ASSERT_NEAR(smooth->at(p, lambda).sigma_a[0], expected, 2e-5);
    between += body > 0 && expected < 1;
  }
  EXPECT_GT(between, 30);
  // The cloud is defined in medium space, not relative to the box.
  EXPECT_EQ(density_at("\"point3 p0\" [ 0 -1 0 ] \"point3 p1\" [ 2 3 2 ]", {1.5f, 2, 1.5f}), 0);
  EXPECT_FALSE(medium_of("cloud", "")->is_emissive());
}

TEST(Homogeneous, CoefficientsEmissionAndPresets) {
  const auto lambda = test_wavelengths();
  const MediumPtr plain = medium_of("homogeneous", "");
  EXPECT_EQ((*plain->uniform_extinction(lambda))[0], 2);  // 1 + 1
  const MediumPtr m =
      medium_of("homogeneous",
                "\"spectrum sigma_a\" [ 300 2 900 2 ] \"spectrum sigma_s\" [ 300 0 900 0 ] "
                "\"float scale\" 3 \"rgb Le\" [ 2 2 2 ] \"float Lescale\" 5 \"float g\" -0.4");
  const MediumProperties p = m->at({1e6f, 0, 0}, lambda);
  EXPECT_EQ(p.sigma_a[0], 6);
  EXPECT_TRUE(p.sigma_s.is_black() && m->is_purely_absorbing() && m->is_emissive());
  EXPECT_EQ(p.phase.g(), -0.4f);
  // The rgb value is kept: the luminance is that of the illuminant.
  const Spectrum& white = RgbColorSpace::srgb().illuminant();
  const float expected = 5 * 2 * white.sample(lambda)[2] / spectrum_to_photometric(white);
  EXPECT_NEAR(p.le[2], expected, 1e-4f * expected);

  const MediumPtr skin = medium_of("homogeneous", "\"string preset\" \"Skin1\" \"float scale\" 2");
  const SpectrumPtr s = rgb_unbounded_spectrum(RgbColorSpace::srgb(), {0.74f, 0.88f, 1.01f});
  EXPECT_NEAR(skin->at({0, 0, 0}, lambda).sigma_s[1], 2 * s->sample(lambda)[1], 0.01f);
}

}  // namespace
}  // namespace nephroid::testing_medium
