// Hair: white fibres lose no light, absorption follows the paths inside the fibre, and scattering
// has the symmetries of a cylinder. Lobes lie where refraction sends them.
#include "scene/bsdf/hair.h"

#include <gtest/gtest.h>

#include "scene/bsdf/fresnel.h"
#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

constexpr TransportMode kMode = TransportMode::kRadiance;

HairBsdf hair(float h, float sigma, float beta_m, float beta_n, float tilt = 2.0f) {
  return HairBsdf(h, 1.55f, SampledSpectrum(sigma), HairShape(beta_m, beta_n, tilt));
}
/// Scattering function of the fibre: f times the cosine of the frame's normal.
double scattering(const HairBsdf& b, const Vec3f& wo, const Vec3f& wi) {
  return b.eval(wo, wi, kMode, EventClass::kDiffuse, ClassMask::kAll).f[0] *
         static_cast<double>(std::abs(wi.z));
}
/// Integral of the scattering function over all directions. The fibre's axis is the polar axis, so
/// that the parametrisation cuts no lobe.
double whole_sphere(const HairBsdf& b, const Vec3f& wo) {
  return integrate_range([&](const Vec3f& w) { return scattering(b, wo, Vec3f(w.z, w.x, w.y)); },
                         -1.0, 1.0, 1e-4);
}

TEST(Hair, WhiteFibresScatterAllLight) {
  for (const float beta_m : {0.04f, 0.1f, 0.3f, 0.8f})
    for (const float beta_n : {0.15f, 0.6f})
      for (const float h : {-0.9f, 0.2f})
        EXPECT_NEAR(whole_sphere(hair(h, 0.0f, beta_m, beta_n), direction_at(60.0f)), 1.0, 1e-3)
            << beta_m << " " << beta_n << " " << h;
}

TEST(Hair, NarrowLobesKeepTheirEnergyInSamples) {
  // These lobes are too narrow to integrate. Each sample of a white fibre weighs exactly 1, since
  // the attenuations add up to 1 and the value equals the density.
  for (const float beta : {0.01f, 0.03f, 1.0f}) {
    const HairBsdf b = hair(0.4f, 0.0f, beta, beta);
    TestRandom random(5);
    int missed = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      const float uc = random.next();
      const auto s = b.sample(wo, uc, random.next2(), kMode, ClassMask::kAll);
      if (!s) {
        ++missed;
        continue;
      }
      EXPECT_NEAR(s->f[0] * std::abs(s->wi.z) / s->pdf_w, 1.0f, 1e-4f);
    }
    EXPECT_LT(missed, 3);
  }
}

TEST(Hair, AbsorptionIsThatOfThePathsInside) {
  // Straight through the middle: reflection f, then chords of two radii between reflections.
  const float sigma = 0.3f, f = fresnel_dielectric(1.0f, 1.55f), t = std::exp(-2.0f * sigma);
  const float expected = f + (1 - f) * (1 - f) * t / (1 - f * t);
  const HairBsdf b = hair(0.0f, sigma, 0.4f, 0.4f);
  EXPECT_NEAR(b.albedo(Vec3f(0, 0, 1))[0], expected, 1e-5f);
  EXPECT_NEAR(whole_sphere(b, Vec3f(0, 0, 1)), expected, 1e-3);
  // For an inclined ray, Snell's law in three dimensions gives the chord.
  const Vec3f wo = normalize(Vec3f(0.6f, 0.0f, 0.8f));
  const float sin_t = 0.6f / 1.55f, cos_t = std::sqrt(1 - sin_t * sin_t);
  const float fi = fresnel_dielectric(0.8f, 1.55f), ti = std::exp(-2.0f * sigma / cos_t);
  EXPECT_NEAR(b.albedo(wo)[0], fi + (1 - fi) * (1 - fi) * ti / (1 - fi * ti), 1e-5f);
}

TEST(Hair, LobesStandWhereRefractionPutsThem) {
  // With narrow lobes each sample is close to its lobe's geometric direction. R: mirrored about the
  // cylinder's normal. TT: refracted twice by gamma_o - gamma_t.
  const float h = 0.6f, gamma_o = std::asin(h), gamma_t = std::asin(h / 1.55f);
  const HairBsdf b = hair(h, 0.0f, 0.02f, 0.02f, 0.0f);
  const Vec3f wo(0, 0, 1);
  const float f = fresnel_dielectric(std::cos(gamma_o), 1.55f);
  const auto azimuth_of = [&](float uc) {
    const auto s = b.sample(wo, uc, Vec2f(0.9f, 0.25f), kMode, ClassMask::kAll);
    EXPECT_TRUE(s);
    EXPECT_NEAR(s->wi.x, 0.0f, 0.05f);
    return std::remainder(std::atan2(s->wi.z, s->wi.y) - 0.5f * kPi, 2.0f * kPi);
  };
  EXPECT_NEAR(azimuth_of(0.5f * f), -2.0f * gamma_o, 0.01f);
  EXPECT_NEAR(std::abs(azimuth_of(f + 0.5f * (1 - f) * (1 - f))),
              kPi - 2.0f * std::abs(gamma_o - gamma_t), 0.01f);
}

TEST(Hair, TiltedScalesMoveTheReflectionTowardsTheRoot) {
  // Reflection off scales tilted by alpha is 2 alpha away from the mirror direction.
  const HairBsdf b = hair(0.0f, 50.0f, 0.02f, 0.3f, 3.0f);  // dark: only R
  const Vec3f wo(0, 0, 1);
  TestRandom random(3);
  Mean theta;
  for (int i = 0; i < 4000; ++i) {
    const float uc = random.next();
    const auto s = b.sample(wo, uc, random.next2(), kMode, ClassMask::kAll);
    ASSERT_TRUE(s);
    theta.add(std::asin(s->wi.x));
  }
  EXPECT_NEAR(theta.mean(), 2.0 * 3.0 * M_PI / 180.0, 5.0 * theta.error() + 1e-3);
}

TEST(Hair, HasTheSymmetriesOfACylinder) {
  TestRandom random(9);
  const auto turned = [](const Vec3f& w, double a) {
    return Vec3f(w.x, static_cast<float>(w.y * std::cos(a) - w.z * std::sin(a)),
                 static_cast<float>(w.y * std::sin(a) + w.z * std::cos(a)));
  };
  for (int i = 0; i < 300; ++i) {
    const float h = 1.9f * random.next() - 0.95f;
    const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
    const Vec3f wi = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
    const HairBsdf b = hair(h, 0.2f, 0.5f, 0.5f), mirrored = hair(-h, 0.2f, 0.5f, 0.5f);
    const HairBsdf reversed = hair(h, 0.2f, 0.5f, 0.5f, -2.0f);
    const double value = scattering(b, wo, wi);
    const double angle = 6.28 * random.next();
    EXPECT_NEAR(scattering(b, turned(wo, angle), turned(wi, angle)), value, 1e-3 * value);
    EXPECT_NEAR(scattering(mirrored, Vec3f(wo.x, -wo.y, wo.z), Vec3f(wi.x, -wi.y, wi.z)), value,
                1e-3 * value);
    // From the other end, the scales lean the other way.
    EXPECT_NEAR(scattering(reversed, Vec3f(-wo.x, wo.y, wo.z), Vec3f(-wi.x, wi.y, wi.z)), value,
                1e-3 * value);
    // Through the middle of the fibre and without tilt, scattering is reciprocal for directions of
    // equal inclination.
    const HairBsdf middle = hair(0.0f, 0.2f, 0.5f, 0.5f, 0.0f);
    const float c = std::sqrt(1.0f - wo.x * wo.x);
    const Vec3f same(wo.x, c * std::cos(wi.y), c * std::sin(wi.y));
    const double there = scattering(middle, wo, same);
    EXPECT_NEAR(scattering(middle, same, wo), there, 1e-3 * there);
  }
}

}  // namespace
}  // namespace nephroid::testing_bsdf
