// Single lobes with known results: Fresnel terms, the facet distribution, mirrors, panes and the
// energy of rough glass.
#include <gtest/gtest.h>

#include <complex>

#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

TEST(Fresnel, DielectricKnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(-1.0f, 1.5f), 0.04f, 1e-6f);
  EXPECT_EQ(fresnel_dielectric(-0.5f, 1.5f), 1.0f);  // beyond the critical angle
  EXPECT_NEAR(fresnel_dielectric(0.0f, 1.5f), 1.0f, 1e-6f);
  // At Brewster's angle only one polarisation is reflected.
  const float brewster = std::cos(std::atan(1.5f));
  EXPECT_NEAR(fresnel_dielectric(brewster, 1.5f), 0.5f * sqr((1 - 2.25f) / (1 + 2.25f)), 1e-5f);
  // Equal from both sides of one ray.
  const float c = 0.6f, inside = std::sqrt(1 - (1 - c * c) / 2.25f);
  EXPECT_NEAR(fresnel_dielectric(c, 1.5f), fresnel_dielectric(-inside, 1.5f), 1e-6f);
}

TEST(Fresnel, ConductorMatchesComplexArithmetic) {
  using Complex = std::complex<double>;
  const SampledSpectrum eta = ramp(0.1f, 2.5f), k = ramp(5.0f, 0.3f);
  for (const float c : {0.01f, 0.2f, 0.5f, 0.9f, 1.0f}) {
    const SampledSpectrum r = fresnel_conductor(c, eta, k);
    for (int i = 0; i < kSpectrumSamples; ++i) {
      const Complex n(eta[i], k[i]);
      const Complex t = std::sqrt(1.0 - (1.0 - double(c) * c) / (n * n));
      const Complex parallel = (n * double(c) - t) / (n * double(c) + t);
      const Complex across = (double(c) - n * t) / (double(c) + n * t);
      EXPECT_NEAR(r[i], 0.5 * (std::norm(parallel) + std::norm(across)), 2e-5);
    }
  }
  const SampledSpectrum dielectric =
      fresnel_conductor(0.4f, SampledSpectrum(1.5f), SampledSpectrum());
  EXPECT_NEAR(dielectric[0], fresnel_dielectric(0.4f, 1.5f), 1e-5f);
}

TEST(TrowbridgeReitzFacets, ProjectedAreaIsOne) {
  for (const auto& [ax, ay] : {std::pair{0.05f, 0.05f}, {0.3f, 0.3f}, {0.1f, 0.8f}, {1.0f, 1.0f}}) {
    const TrowbridgeReitz facets(ax, ay);
    const double area = integrate_range(
        [&](const Vec3f& m) { return static_cast<double>(facets.d(m) * m.z); }, 0, 1, 1e-4);
    EXPECT_NEAR(area, 1.0, 1e-3);
    for (const float angle : {0.0f, 60.0f, 85.0f}) {
      const Vec3f w = direction_at(angle);
      const double visible = integrate_range(
          [&](const Vec3f& m) {
            return dot(w, m) > 0 ? static_cast<double>(facets.visible_pdf_w(w, m)) : 0.0;
          },
          0, 1, 1e-4);
      EXPECT_NEAR(visible, 1.0, 2e-3) << ax << " " << ay << " " << angle;
    }
  }
}

TEST(TrowbridgeReitzFacets, AlphaLimits) {
  EXPECT_TRUE(TrowbridgeReitz(9e-4f, 1e-5f).smooth());
  EXPECT_FALSE(TrowbridgeReitz(1e-3f, 0.0f).smooth());
  EXPECT_FLOAT_EQ(TrowbridgeReitz(1e-3f, 0.0f).alpha_y(), 1e-4f);
  EXPECT_FLOAT_EQ(TrowbridgeReitz::roughness_to_alpha(0.25f), 0.5f);
  EXPECT_EQ(TrowbridgeReitz(0.05f, 0.01f).event_class(0.05f), EventClass::kSpecular);
  EXPECT_EQ(TrowbridgeReitz(0.01f, 0.051f).event_class(0.05f), EventClass::kGlossy);
}

TEST(Mirrors, BothWaysOfSmoothGlassAreThoseOfItsSamples) {
  const DielectricBsdf glass({1.5f, {}}, 0.05f);
  TestRandom random(5);
  int pairs = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
    for (const TransportMode mode : {TransportMode::kRadiance, TransportMode::kImportance}) {
      const auto both = glass.delta_pair(wo, mode);
      // Inside, all light beyond the critical angle is reflected.
      EXPECT_EQ(both.has_value(), wo.z > 0 || wo.z < -std::sqrt(1 - 1 / 2.25f)) << wo.z;
      if (!both) continue;
      ++pairs;
      EXPECT_NEAR((*both)[0].pdf_w + (*both)[1].pdf_w, 1.0f, 1e-6f);
      const auto s = glass.sample(wo, random.next(), {0, 0}, mode, ClassMask::kAll);
      const BsdfSample& same = (*both)[s->transmitted ? 1 : 0];
      EXPECT_EQ(same.wi, s->wi);
      EXPECT_EQ(same.f[0], s->f[0]);
      EXPECT_EQ(same.pdf_w, s->pdf_w);
      EXPECT_EQ(same.eta, s->eta);
    }
  }
  EXPECT_GT(pairs, 2000);
  const Vec3f wo = spherical(0.7, 1.0);
  EXPECT_FALSE(DielectricBsdf({1.0f, {}}, 0.05f).delta_pair(wo, TransportMode::kRadiance));
  EXPECT_FALSE(
      DielectricBsdf({1.5f, {0.01f, 0.01f}}, 0.05f).delta_pair(wo, TransportMode::kRadiance));
  EXPECT_FALSE(ThinDielectricBsdf(SampledSpectrum(1.5f)).delta_pair(wo, TransportMode::kRadiance));
}

TEST(Mirrors, SmoothGlassLosesNothing) {
  const DielectricBsdf glass({1.5f, {}}, 0.05f);
  TestRandom random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
    const auto s =
        glass.sample(wo, random.next(), {0, 0}, TransportMode::kImportance, ClassMask::kAll);
    ASSERT_TRUE(s && s->delta);
    EXPECT_NEAR(s->f[0] * std::abs(s->wi.z) / s->pdf_w, 1.0f, 1e-5f);
    // Snell's law in the plane of incidence.
    const float ratio = s->transmitted ? (wo.z > 0 ? 1.5f : 1 / 1.5f) : 1.0f;
    EXPECT_NEAR(s->wi.x * ratio, -wo.x, 1e-5f);
    EXPECT_NEAR(s->wi.y * ratio, -wo.y, 1e-5f);
  }
}

TEST(Mirrors, EqualIndicesLetLightPass) {
  for (const float alpha : {0.0f, 0.5f}) {
    const DielectricBsdf nothing({1.0f, {alpha, alpha}}, 0.05f);
    const Vec3f wo = direction_at(60);
    for (const ClassMask among : {ClassMask::kDiffuse, ClassMask::kAll}) {
      const auto s = nothing.sample(wo, 0.3f, {0.2f, 0.8f}, TransportMode::kRadiance, among);
      ASSERT_TRUE(s);
      EXPECT_TRUE(s->straight_through && s->delta && s->transmitted);
      EXPECT_EQ(s->wi, -wo);
      EXPECT_FLOAT_EQ(s->f[3] * std::abs(s->wi.z) / s->pdf_w, 1.0f);
    }
  }
}

TEST(Mirrors, PaneAddsUpItsReflections) {
  const ThinDielectricBsdf pane(ramp(1.5f, 1.3f));
  const Vec3f wo = direction_at(50);
  for (int lane : {0, kSpectrumSamples - 1}) {
    const double r = fresnel_dielectric(wo.z, lane == 0 ? 1.5f : 1.3f);
    double sum = r, inside = (1 - r) * (1 - r) * r;
    for (int i = 0; i < 50; ++i, inside *= r * r) sum += inside;
    EXPECT_NEAR(ThinDielectricBsdf::pane_reflectance(wo.z, ramp(1.5f, 1.3f))[lane], sum, 1e-6);
    const auto up = pane.sample(wo, 0.0f, {}, TransportMode::kRadiance, ClassMask::kAll);
    const auto through = pane.sample(wo, 0.99f, {}, TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_TRUE(up && through);
    EXPECT_FALSE(up->straight_through);
    EXPECT_TRUE(through->straight_through && through->transmitted);
    EXPECT_EQ(through->wi, -wo);
    EXPECT_NEAR(up->f[lane] * wo.z + through->f[lane] * wo.z, 1.0, 1e-5);
    EXPECT_NEAR(up->f[lane] * wo.z, sum, 1e-6);
  }
  const auto only = pane.sample(wo, 0.0f, {}, TransportMode::kRadiance, ClassMask::kDiffuse);
  ASSERT_TRUE(only && only->straight_through);
  EXPECT_FLOAT_EQ(only->pdf_w, 1.0f);
}

TEST(RoughGlass, EnergyOfSamplesMatchesQuadrature) {
  for (const auto& [eta, alpha] : {std::pair{1.5f, 0.2f}, {1.5f, 0.7f}, {0.7f, 0.4f}}) {
    const DielectricBsdf glass({eta, {alpha, alpha}}, 0.05f);
    for (const float angle : {20.0f, 70.0f, 140.0f}) {
      const Vec3f wo = direction_at(angle);
      const double exact = integrate_range(
          [&](const Vec3f& wi) {
            return static_cast<double>(
                glass.eval(wo, wi, TransportMode::kImportance, EventClass::kGlossy, ClassMask::kAll)
                    .f[0] *
                std::abs(wi.z));
          },
          -1, 1, 1e-4);
      Mean sampled;
      TestRandom random(31);
      for (int i = 0; i < 50000; ++i) {
        const float uc = random.next();
        const auto s =
            glass.sample(wo, uc, random.next2(), TransportMode::kImportance, ClassMask::kAll);
        sampled.add(s ? s->f[0] * std::abs(s->wi.z) / s->pdf_w : 0.0);
      }
      EXPECT_NEAR(sampled.mean(), exact, 5.0 * sampled.error() + 2e-4) << eta << alpha << angle;
      EXPECT_LE(exact, 1.0 + 1e-4);
      EXPECT_GT(exact, 0.5);
    }
  }
}

TEST(Classes, FollowTheThreshold) {
  const auto classes_of = [](float alpha) {
    return ConductorBsdf(metal(alpha, alpha), 0.05f).classes();
  };
  EXPECT_EQ(classes_of(0.0f), ClassMask::kSpecular);
  EXPECT_EQ(classes_of(0.05f), ClassMask::kSpecular);
  EXPECT_EQ(classes_of(0.06f), ClassMask::kGlossy);
  const auto coated = [](float coat_alpha, float base_alpha, float albedo) {
    return CoatedBsdf<ConductorSurface>(make_coat(1.5f, coat_alpha, coat_alpha, 0.01f, albedo),
                                        metal(base_alpha, base_alpha), 0.05f)
        .classes();
  };
  EXPECT_EQ(coated(0.0f, 0.0f, 0.0f), ClassMask::kSpecular);
  EXPECT_EQ(coated(0.04f, 0.0f, 0.0f), ClassMask::kSpecular);
  EXPECT_EQ(coated(0.0f, 0.2f, 0.0f), ClassMask::kGlossy | ClassMask::kSpecular);
  EXPECT_EQ(coated(0.2f, 0.0f, 0.0f), ClassMask::kGlossy);
  EXPECT_EQ(coated(0.2f, 0.3f, 0.0f), ClassMask::kGlossy);
  EXPECT_EQ(coated(0.0f, 0.0f, 0.5f), ClassMask::kDiffuse | ClassMask::kSpecular);
  EXPECT_EQ(coated(0.2f, 0.0f, 0.5f), ClassMask::kRough);
  const auto varnished = [](float coat_alpha) {
    const CoatTable table({1.5f, {coat_alpha, coat_alpha}}, 0.01f, 10);
    const ClassMask closed = CoatedDiffuseBsdf(&table, ramp(0.5f, 0.5f), 0.05f).classes();
    const Coat coat = make_coat(1.5f, coat_alpha, coat_alpha, 0.01f, 0);
    EXPECT_EQ(CoatedBsdf<LambertSurface>(coat, {ramp(0.5f, 0.5f)}, 0.05f).classes(), closed);
    return closed;
  };
  EXPECT_EQ(varnished(0.0f), ClassMask::kDiffuse | ClassMask::kSpecular);
  EXPECT_EQ(varnished(0.05f), ClassMask::kDiffuse | ClassMask::kSpecular);
  EXPECT_EQ(varnished(0.2f), ClassMask::kRough);
}

TEST(Classes, TheThresholdMovesLobesAndChangesNoLight) {
  const DielectricInterface boundary{1.5f, TrowbridgeReitz(0.05f, 0.2f)};
  const CoatTable table({1.5f, {0.1f, 0.1f}}, 0.01f, 10);
  const Coat coat = make_coat(1.5f, 0.1f, 0.2f, 0.05f, 0.0f);
  const Coat fog = make_coat(1.5f, 0.1f, 0.2f, 0.05f, 0.5f);
  const LambertSurface grey{ramp(0.5f, 0.2f)};
  using Maker = std::function<const Bsdf*(BsdfArena&, float)>;
  const std::pair<const char*, Maker> kBsdfs[] = {
      {"metal", [&](BsdfArena& a, float t) { return a.make<ConductorBsdf>(metal(0.1f, 0.2f), t); }},
      {"glass", [&](BsdfArena& a, float t) { return a.make<DielectricBsdf>(boundary, t); }},
      {"subsurface",
       [&](BsdfArena& a, float t) { return a.make<SubsurfaceInterfaceBsdf>(boundary, t); }},
      {"varnish", [&](BsdfArena& a,
                      float t) { return a.make<CoatedDiffuseBsdf>(&table, grey.reflectance, t); }},
      {"coated lambert",
       [&](BsdfArena& a, float t) { return a.make<CoatedBsdf<LambertSurface>>(coat, grey, t); }},
      {"coated metal",
       [&](BsdfArena& a, float t) {
         return a.make<CoatedBsdf<ConductorSurface>>(coat, metal(0.15f, 0.3f), t);
       }},
      {"coated metal, medium", [&](BsdfArena& a, float t) {
         return a.make<CoatedBsdf<ConductorSurface>>(fog, metal(0.15f, 0.3f), t);
       }}};
  const auto all_of = [](const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi) {
    BsdfEval sum;
    for (const EventClass c : kSurfaceClasses) {
      const BsdfEval e = bsdf.eval(wo, wi, TransportMode::kRadiance, c, ClassMask::kAll);
      sum.f += e.f;
      sum.pdf_w += e.pdf_w;
    }
    return sum;
  };
  for (const auto& [name, make] : kBsdfs) {
    BsdfArena first, second;
    const Bsdf& glossy = *make(first, 0.01f);
    const Bsdf& specular = *make(second, 0.25f);
    EXPECT_NE(glossy.classes(), specular.classes()) << name;
    TestRandom random(37);
    int lit = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      const float uc = random.next();
      const Vec2f u = random.next2();
      const auto s = glossy.sample(wo, uc, u, TransportMode::kRadiance, ClassMask::kAll);
      const auto t = specular.sample(wo, uc, u, TransportMode::kRadiance, ClassMask::kAll);
      ASSERT_EQ(s.has_value(), t.has_value()) << name;
      if (!s) continue;
      EXPECT_EQ(s->wi, t->wi) << name;
      const BsdfEval a = all_of(glossy, wo, s->wi), b = all_of(specular, wo, s->wi);
      for (int k = 0; k < kSpectrumSamples; ++k)
        EXPECT_NEAR(a.f[k], b.f[k], 1e-5f * a.f[k]) << name;
      EXPECT_NEAR(a.pdf_w, b.pdf_w, 1e-5f * a.pdf_w) << name;
      lit += a.f[0] > 0.0f;
    }
    EXPECT_GT(lit, 15) << name;
  }
}

}  // namespace
}  // namespace nephroid::testing_bsdf
