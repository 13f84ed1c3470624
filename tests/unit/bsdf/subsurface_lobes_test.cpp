// The two ends of subsurface scattering: density and energy of the exit, and what the boundary
// reflects and transmits. The tests of all families cover the boundary as well.
#include <gtest/gtest.h>

#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/normalized_fresnel.h"
#include "scene/bsdf/subsurface_interface.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

constexpr EventClass kD = EventClass::kDiffuse, kG = EventClass::kGlossy,
                     kS = EventClass::kSpecular;
const Vec3f kUp(0, 0, 1);

TEST(NormalizedFresnel, SamplesFollowTheDensity) {
  constexpr int kBins = 12, kCount = 40000;
  const NormalizedFresnelBsdf bsdf(1.4f);
  std::vector<double> observed(kBins * kBins, 0.0), expected(kBins * kBins, 0.0);
  TestRandom random(3);
  for (int i = 0; i < kCount; ++i) {
    const auto s =
        bsdf.sample(kUp, 0.5f, random.next2(), TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->event, kD);
    EXPECT_FALSE(s->delta || s->transmitted || s->subsurface);
    const BsdfEval e = bsdf.eval(kUp, s->wi, TransportMode::kRadiance, kD, ClassMask::kDiffuse);
    EXPECT_FLOAT_EQ(e.pdf_w, s->pdf_w);
    EXPECT_FLOAT_EQ(e.f[3], s->f[3]);
    const int z = std::min(kBins - 1, static_cast<int>(s->wi.z * kBins));
    const int p = std::clamp(
        static_cast<int>((std::atan2(s->wi.y, s->wi.x) / kPi + 1.0f) * 0.5f * kBins), 0, kBins - 1);
    observed[static_cast<size_t>(z * kBins + p)] += 1.0;
  }
  const auto density = [&](const Vec3f& w) {
    return static_cast<double>(
        bsdf.eval(kUp, w, TransportMode::kRadiance, kD, ClassMask::kAll).pdf_w);
  };
  for (int z = 0; z < kBins; ++z)
    for (int p = 0; p < kBins; ++p)
      expected[static_cast<size_t>(z * kBins + p)] =
          kCount * integrate_cell(density, z / double{kBins}, (z + 1) / double{kBins},
                                  2 * M_PI * p / kBins, 2 * M_PI * (p + 1) / kBins, 1e-6);
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST(NormalizedFresnel, AllLightLeavesAndTheModesDifferByEtaSquared) {
  for (const float eta : {0.8f, 1.0f, 1.33f, 1.5f, 1.9f}) {
    const NormalizedFresnelBsdf bsdf(eta);
    const double out = integrate_range(
        [&](const Vec3f& w) {
          return bsdf.eval(kUp, w, TransportMode::kImportance, kD, ClassMask::kAll).f[0] *
                 static_cast<double>(w.z);
        },
        0.0, 1.0, 1e-4);
    // The scale is a fitted moment.
    EXPECT_NEAR(out, 1.0, 0.006) << eta;
    const Vec3f w = direction_at(33.0f);
    EXPECT_FLOAT_EQ(
        bsdf.eval(kUp, w, TransportMode::kRadiance, kD, ClassMask::kAll).f[0],
        eta * eta * bsdf.eval(kUp, w, TransportMode::kImportance, kD, ClassMask::kAll).f[0]);
    EXPECT_TRUE(bsdf.eval(kUp, -w, TransportMode::kRadiance, kD, ClassMask::kAll).f.is_black());
    EXPECT_TRUE(bsdf.eval(kUp, w, TransportMode::kRadiance, kS, ClassMask::kAll).f.is_black());
    EXPECT_FALSE(
        bsdf.sample(kUp, 0.5f, {0.3f, 0.4f}, TransportMode::kRadiance, ClassMask::kSpecular));
  }
}

struct Energy {
  Mean reflected, entered;
};

Energy energy_of(const Bsdf& bsdf, const Vec3f& wo, TransportMode mode, ClassMask among) {
  Energy e;
  TestRandom random(41);
  for (int i = 0; i < 40000; ++i) {
    const float uc = random.next();
    const auto s = bsdf.sample(wo, uc, random.next2(), mode, among);
    const double w = s ? s->f[4] * std::abs(s->wi.z) / s->pdf_w : 0.0;
    e.reflected.add(s && !s->subsurface ? w : 0.0);
    e.entered.add(s && s->subsurface ? w : 0.0);
  }
  return e;
}

void expect_same(const Mean& a, const Mean& b, const std::string& what) {
  EXPECT_NEAR(a.mean(), b.mean(), 5.0 * std::hypot(a.error(), b.error()) + 1e-5) << what;
}

TEST(SubsurfaceInterface, LetsInWhatADielectricLetsThrough) {
  for (const float alpha : {0.0f, 0.03f, 0.3f}) {
    const DielectricInterface boundary{1.4f, TrowbridgeReitz(alpha, alpha)};
    const SubsurfaceInterfaceBsdf bsdf(boundary, 0.05f);
    const EventClass reflection = alpha > 0.1f ? kG : kS;
    EXPECT_EQ(bsdf.classes(), ClassMask::kDiffuse | mask_of(reflection));
    for (const float angle : {10.0f, 60.0f, 80.0f}) {
      const Vec3f wo = direction_at(angle);
      for (const TransportMode mode : {TransportMode::kRadiance, TransportMode::kImportance}) {
        Mean reflected, entered;
        TestRandom random(43);
        for (int i = 0; i < 40000; ++i) {
          const float uc = random.next();
          const auto s = boundary.sample(wo, uc, random.next2(), mode, BoundaryPart::kBoth);
          reflected.add(s && !s->transmitted ? s->weight : 0.0f);
          entered.add(s && s->transmitted ? s->weight : 0.0f);
        }
        const std::string what = "alpha " + std::to_string(alpha) + " at " + std::to_string(angle);
        const Energy all = energy_of(bsdf, wo, mode, ClassMask::kAll);
        expect_same(all.reflected, reflected, what);
        expect_same(all.entered, entered, what);
        const Energy mirrored = energy_of(bsdf, wo, mode, mask_of(reflection));
        const Energy only_d = energy_of(bsdf, wo, mode, ClassMask::kDiffuse);
        expect_same(mirrored.reflected, reflected, what + ", reflection alone");
        EXPECT_EQ(mirrored.entered.sum, 0.0);
        expect_same(only_d.entered, entered, what + ", D alone");
        EXPECT_EQ(only_d.reflected.sum, 0.0);
        const ClassMask other = alpha > 0.1f ? ClassMask::kSpecular : ClassMask::kGlossy;
        EXPECT_EQ(energy_of(bsdf, wo, mode, other).reflected.sum, 0.0);
      }
    }
  }
}

TEST(SubsurfaceInterface, EntryAndExitTogetherAreReciprocal) {
  // (1 - F) at one end times (1 - F) / (c pi) at the other: the same both ways and in both modes.
  const float eta = 1.4f;
  const SubsurfaceInterfaceBsdf entry({eta, TrowbridgeReitz()}, 0.05f);
  const NormalizedFresnelBsdf exit(eta);
  const auto both = [&](const Vec3f& wo, const Vec3f& wi, TransportMode mode) {
    const auto s = entry.sample(wo, 0.999f, {0.5f, 0.5f}, mode, ClassMask::kDiffuse);
    EXPECT_TRUE(s && s->subsurface);
    const float in = s->f[0] * std::abs(s->wi.z) / s->pdf_w;
    return in * exit.eval(kUp, wi, mode, kD, ClassMask::kAll).f[0];
  };
  for (const float a : {5.0f, 40.0f, 85.0f})
    for (const float b : {20.0f, 70.0f}) {
      const Vec3f wa = direction_at(a), wb = direction_at(b, 2.0f);
      const float value = both(wa, wb, TransportMode::kRadiance);
      EXPECT_GT(value, 0.0f);
      EXPECT_NEAR(both(wb, wa, TransportMode::kImportance), value, 1e-5f * value);
      EXPECT_NEAR(both(wb, wa, TransportMode::kRadiance), value, 1e-5f * value);
    }
}

TEST(SubsurfaceInterface, SamplesSayWhatTheyAre) {
  const SubsurfaceInterfaceBsdf smooth({1.33f, TrowbridgeReitz()}, 0.05f);
  EXPECT_EQ(smooth.finite_classes(), ClassMask::kNone);
  const Vec3f wo = direction_at(50.0f);
  const float f = fresnel_dielectric(wo.z, 1.33f);
  const auto in =
      smooth.sample(wo, f + 0.01f, {0.2f, 0.3f}, TransportMode::kRadiance, ClassMask::kAll);
  ASSERT_TRUE(in);
  EXPECT_TRUE(in->subsurface && in->transmitted && in->delta);
  EXPECT_EQ(in->event, kD);
  EXPECT_EQ(in->eta, 1.0f);
  EXPECT_LT(in->wi.z, 0.0f);
  EXPECT_NEAR(in->pdf_w, 1.0f - f, 1e-6f);
  EXPECT_NEAR(in->f[0] * std::abs(in->wi.z) / in->pdf_w, 1.0f / sqr(1.33f), 1e-5f);
  const auto back =
      smooth.sample(wo, 0.5f * f, {0.2f, 0.3f}, TransportMode::kRadiance, ClassMask::kAll);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->event, kS);
  EXPECT_FALSE(back->subsurface);

  // Without a boundary all light enters.
  const SubsurfaceInterfaceBsdf open({1.0f, TrowbridgeReitz()}, 0.05f);
  EXPECT_EQ(open.classes(), ClassMask::kDiffuse);
  const auto s = open.sample(wo, 0.9f, {0.2f, 0.3f}, TransportMode::kRadiance, ClassMask::kDiffuse);
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->subsurface);
  EXPECT_FALSE(open.sample(wo, 0.1f, {0.2f, 0.3f}, TransportMode::kRadiance, ClassMask::kSpecular));
}

}  // namespace
}  // namespace nephroid::testing_bsdf
