// Noise, its sums and their textures, against hand-computed values and known properties: zeros,
// means, smoothness.
#include <array>
#include <cmath>

#include "scene/texture/noise.h"
#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

/// Points evenly spread over a cube of side `side` (Roberts' additive recurrence).
Vec3f spread_point(int i, double side) {
  const std::array<double, 3> step = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  const auto at = [&](size_t k) {
    return static_cast<float>(side * std::fmod(0.5 + (i + 1) * step[k], 1.0));
  };
  return {at(0), at(1), at(2)};
}

TEST(Noise, VanishesOnTheLattice) {
  for (int x = -3; x < 4; ++x)
    for (int y = -300; y < 300; y += 97)
      for (int z = 0; z < 3; ++z)
        EXPECT_EQ(noise(Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z))),
                  0.0f);
}

TEST(Noise, HasTheKnownGradients) {
  // Near a lattice point the noise is the gradient there times the offset. For the origin: p[0] =
  // 151, p[151] = 17, p[17] = 36, and 36 mod 16 = 4 is the edge (1, 0, 1).
  const float e = 1e-3f;
  EXPECT_NEAR(noise(Vec3f(e, 0, 0)) / e, 1.0f, 1e-3f);
  EXPECT_NEAR(noise(Vec3f(0, e, 0)) / e, 0.0f, 1e-3f);
  EXPECT_NEAR(noise(Vec3f(0, 0, e)) / e, 1.0f, 1e-3f);
  EXPECT_NEAR(noise(Vec3f(-e, 0, 0)) / -e, 1.0f, 1e-3f);
}

TEST(Noise, AgreesWithSumsOverCornersByHand) {
  // In the middle of the first cell all eight weights are 1/8. The hashes of its corners (x first)
  // are 4 6 12 0 7 4 14 3. Gradient times offset, 1, -1, 0, -1, 0 ..., adds up to -1.
  EXPECT_FLOAT_EQ(noise(Vec3f(0.5f, 0.5f, 0.5f)), -0.125f);
  // Elsewhere: the same sum in double precision, with the twelve edges as vectors and products as
  // weights.
  EXPECT_NEAR(noise(Vec3f(0.25f, 1.75f, 2.5f)), 0.124623775, 1e-6);
  EXPECT_NEAR(noise(Vec3f(1.5f, 2.8f, 0.5f)), 0.569592, 1e-6);
  EXPECT_NEAR(noise(Vec3f(-3.2f, 77.4f, 255.9f)), -3.62754e-5, 1e-5);
}

TEST(Noise, RepeatsAfter256AndIsNotTheSameInBetween) {
  int different = 0;
  for (int i = 0; i < 64; ++i) {
    // Multiples of 1/64 are exact at 256.
    Vec3f p = spread_point(i, 8.0);
    for (int k = 0; k < 3; ++k) p[k] = std::floor(p[k] * 64.0f) / 64.0f;
    EXPECT_EQ(noise(p), noise(p + Vec3f(256, -256, 512)));
    different += noise(p) != noise(p + Vec3f(128, 0, 0)) ? 1 : 0;
  }
  EXPECT_GT(different, 48);
}

TEST(Noise, IsSmoothAcrossCells) {
  // First derivatives on both sides of a lattice plane agree: differences are of the order of the
  // step, so there is no kink.
  const float h = 1.0f / 256;
  for (int i = 0; i < 200; ++i) {
    Vec3f p = spread_point(i, 16.0);
    p.x = std::floor(p.x);
    const float left = (noise(p) - noise(p - Vec3f(h, 0, 0))) / h;
    const float right = (noise(p + Vec3f(h, 0, 0)) - noise(p)) / h;
    EXPECT_NEAR(left, right, 10 * h) << i;
  }
}

TEST(Noise, HasMeanZeroAndStaysBounded) {
  double sum = 0, squares = 0;
  float largest = 0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const float v = noise(spread_point(i, 256.0));
    sum += v;
    squares += double(v) * v;
    largest = std::max(largest, std::abs(v));
  }
  // Over a whole period the mean is 0, up to the permutation's randomness (a few in a thousand).
  EXPECT_NEAR(sum / count, 0.0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / count), 0.27, 0.02);
  EXPECT_LT(largest, 1.1f);
  EXPECT_GT(largest, 0.7f);
}

TEST(Noise, IsFiniteEverywhere) {
  for (const float far : {1e9f, 1e20f, 3e38f})
    EXPECT_TRUE(std::isfinite(noise(Vec3f(far, -far, 0.5f * far)))) << far;
}

TEST(FractalNoise, IsTheSumOfItsOctaves) {
  const Vec3f p(0.3f, 1.7f, -2.9f);
  EXPECT_EQ(fractal_noise(p, {}, 0.5f, 0), 0.0f);
  EXPECT_EQ(fractal_noise(p, {}, 0.5f, 1), noise(p));
  float sum = 0, absolute = 0;
  float f = 1, o = 1;
  for (int i = 0; i < 3; ++i, f *= 1.99f, o *= 0.6f) {
    sum += o * noise(p * f);
    absolute += o * std::abs(noise(p * f));
  }
  EXPECT_NEAR(fractal_noise(p, {}, 0.6f, 3), sum, 1e-6f);
  // Turbulence has a faded octave of weight 0.2 after the three.
  EXPECT_NEAR(turbulence(p, {}, 0.6f, 3), absolute + 0.2f * 0.6f * 0.6f * 0.6f, 1e-6f);
}

TEST(FractalNoise, LosesOctavesToTheFootprint) {
  const Vec3f p(0.3f, 1.7f, -2.9f);
  const auto footprint = [](float length) {
    return NoiseFootprint{Vec3f(0, length, 0), Vec3f(0.5f * length, 0, 0)};
  };
  // A footprint of 2^-3 leaves two octaves of eight, a footprint of one unit none.
  EXPECT_NEAR(fractal_noise(p, footprint(0.125f), 0.5f, 8), fractal_noise(p, {}, 0.5f, 2), 1e-6f);
  EXPECT_EQ(fractal_noise(p, footprint(1.0f), 0.5f, 8), 0.0f);
  EXPECT_EQ(fractal_noise(p, footprint(1e-6f), 0.5f, 8), fractal_noise(p, {}, 0.5f, 8));
  // Turbulence replaces lost octaves by their means: 0.2 (1 + 1 + 1/2 + 1/4 + ... + 1/128).
  EXPECT_NEAR(turbulence(p, footprint(1.0f), 0.5f, 8), 0.2 * (1 + 2 - 1.0 / 128), 1e-5);
  // Halfway between two numbers of octaves, the next octave counts half.
  const float half_way = 0.125f / std::sqrt(2.0f);
  EXPECT_NEAR(fractal_noise(p, footprint(half_way), 0.5f, 8),
              0.5f * (fractal_noise(p, {}, 0.5f, 2) + fractal_noise(p, {}, 0.5f, 3)), 1e-5f);
}

TEST(FbmTexture, IsNoiseInTheFrameOfItsDirective) {
  const Textures t(
      "AttributeBegin Scale 2 2 2 Translate 1 0 0\n"
      "Texture \"a\" \"float\" \"fbm\" \"integer octaves\" 3 \"float roughness\" 0.7\n"
      "Texture \"w\" \"float\" \"wrinkled\" \"integer octaves\" 4 AttributeEnd\n"
      "Texture \"d\" \"float\" \"fbm\" Texture \"e\" \"float\" \"wrinkled\"");
  const Vec3f p(0.7f, 3.1f, -1.3f), local(0.35f - 1.0f, 1.55f, -0.65f);
  EXPECT_NEAR(t.value("a", 0, 0, p), fractal_noise(local, {}, 0.7f, 3), 1e-5f);
  EXPECT_NEAR(t.value("w", 0, 0, p), turbulence(local, {}, 0.5f, 4), 1e-5f);
  EXPECT_EQ(t.value("d", 0, 0, p), fractal_noise(p, {}, 0.5f, 8));
  EXPECT_EQ(t.value("e", 0, 0, p), turbulence(p, {}, 0.5f, 8));
}

TEST(FbmTexture, WantsAPossibleNumberOfOctaves) {
  for (const char* bad : {"-1", "65"})
    EXPECT_NE(error_of(std::string("Texture \"a\" \"float\" \"fbm\" \"integer octaves\" ") + bad)
                  .find("expected 0 to 64"),
              std::string::npos);
  const Textures t("Texture \"a\" \"float\" \"fbm\" \"integer octaves\" 64");
  EXPECT_TRUE(std::isfinite(t.value("a", 0, 0, Vec3f(1e6f, 1e-3f, 0.2f))));
}

TEST(WindyTexture, IsWavesTimesWind) {
  const Textures t("Texture \"a\" \"float\" \"windy\"");
  for (int i = 0; i < 20; ++i) {
    const Vec3f p = spread_point(i, 50.0);
    const float wind = std::abs(fractal_noise(p * 0.1f, {}, 0.5f, 3));
    EXPECT_NEAR(t.value("a", 0, 0, p), wind * fractal_noise(p, {}, 0.5f, 6), 1e-6f);
  }
}

SampledSpectrum marble_at(const Textures& t, const Vec3f& p, SpectrumKind kind) {
  TextureContext context;
  context.p = p;
  return t.spectrum("m", kind)->eval(context, SampledWavelengths::sample_visible(0.3f));
}

TEST(MarbleTexture, HasTheColoursOfItsSpline) {
  // Without variation the layers depend on y alone: sin(y) = 1 is the end of the spline, whose
  // control points are four colours.
  const Textures t("Texture \"m\" \"spectrum\" \"marble\" \"float variation\" 0 \"float scale\" 2");
  const auto expect = [&](float y, const Rgb& colour) {
    const SampledSpectrum want = rgb_albedo_spectrum(RgbColorSpace::srgb(), colour)
                                     ->sample(SampledWavelengths::sample_visible(0.3f));
    for (const SpectrumKind kind :
         {SpectrumKind::kAlbedo, SpectrumKind::kUnbounded, SpectrumKind::kIlluminant}) {
      const SampledSpectrum got = marble_at(t, Vec3f(7, y, 3), kind);
      for (int i = 0; i < kSpectrumSamples; ++i) EXPECT_NEAR(got[i], want[i], 2e-3f) << y;
    }
  };
  const float half_pi = 0.5f * kPi;
  expect(half_pi / 2, {.87f, .87f, .9f});   // sin = 1: the last control point
  expect(-half_pi / 2, {.87f, .87f, .9f});  // sin = -1: the first one
  // sin = 0 starts the segment of points 3 to 6.
  expect(1e-4f, {.75f, .75f, .75f});
  // sin = 0.5 is the middle of the segment of points 4 to 7: (c4 + 3 c5 + 3 c6 + c7) / 8.
  expect(kPi / 12, {1.5f * (.6f + 6 * .58f + .2f) / 8, 1.5f * (.59f + 6 * .58f + .2f) / 8,
                    1.5f * (.58f + 6 * .6f + .33f) / 8});
}

TEST(MarbleTexture, NoiseMovesItsLayers) {
  const Textures t("Texture \"m\" \"spectrum\" \"marble\"");
  const Textures still("Texture \"m\" \"spectrum\" \"marble\" \"float variation\" 0");
  const Vec3f p(0.4f, 0.3f, 0.8f);
  const float moved = p.y + 0.2f * fractal_noise(p, {}, 0.5f, 8);
  const SampledSpectrum a = marble_at(t, p, SpectrumKind::kAlbedo);
  const SampledSpectrum b = marble_at(still, Vec3f(0, moved, 0), SpectrumKind::kAlbedo);
  for (int i = 0; i < kSpectrumSamples; ++i) EXPECT_NEAR(a[i], b[i], 1e-5f);
}

}  // namespace
}  // namespace nephroid::testing_texture
