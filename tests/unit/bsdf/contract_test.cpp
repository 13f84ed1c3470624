// Guarantees of the interface for every family: sample and eval agree, classes outside `among`
// never occur, both modes are adjoint, and nothing is NaN or creates energy.
#include <gtest/gtest.h>

#include <bit>

#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

constexpr TransportMode kModes[] = {TransportMode::kRadiance, TransportMode::kImportance};
constexpr ClassMask kMasks[] = {ClassMask::kNone,
                                ClassMask::kDiffuse,
                                ClassMask::kGlossy,
                                ClassMask::kSpecular,
                                ClassMask::kRough,
                                ClassMask::kDiffuse | ClassMask::kSpecular,
                                ClassMask::kGlossy | ClassMask::kSpecular,
                                ClassMask::kAll};

void expect_near(const SampledSpectrum& a, const SampledSpectrum& b, float relative,
                 const std::string& what, float absolute = 1e-30f) {
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_NEAR(a[i], b[i], relative * std::max(std::abs(a[i]), std::abs(b[i])) + absolute) << what;
}

TEST(BsdfContract, SampleAgreesWithEval) {
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    TestRandom random(7);
    for (int i = 0; i < 3000; ++i) {
      const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      const TransportMode mode = kModes[i % 2];
      const ClassMask among = kMasks[1 + i % 7];
      const float uc = random.next();
      const auto s = bsdf.sample(wo, uc, random.next2(), mode, among);
      if (!s) continue;
      EXPECT_NEAR(length(s->wi), 1.0f, 1e-5f) << c.name;
      EXPECT_GT(s->pdf_w, 0.0f) << c.name;
      EXPECT_EQ(s->transmitted, (s->wi.z > 0) != (wo.z > 0)) << c.name;
      if (!s->straight_through) {
        EXPECT_TRUE(contains(among & bsdf.classes(), s->event)) << c.name;
      }
      if (s->delta) continue;
      EXPECT_TRUE(contains(bsdf.finite_classes(), s->event)) << c.name;
      // eval() recovers the facet from rounded directions: its error is a few ulps divided by the
      // narrowest alpha, and larger at grazing angles.
      const float grazing = std::min(std::abs(wo.z), std::abs(s->wi.z));
      if (grazing < 0.02f) continue;
      const BsdfEval e = bsdf.eval(wo, s->wi, mode, s->event, among);
      EXPECT_NEAR(e.pdf_w, s->pdf_w, 2e-3f * s->pdf_w) << c.name << " uc " << uc;
      expect_near(e.f, s->f, 2e-3f, c.name);
    }
  }
}

// Sampling among all existing classes has the same density as sampling among all classes.
TEST(BsdfContract, OtherClassesThanThereAreMakeNoDifference) {
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    TestRandom random(13);
    for (int i = 0; i < 300; ++i) {
      const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      // Only its own samples hit a narrow lobe.
      const auto s =
          bsdf.sample(wo, random.next(), random.next2(), TransportMode::kRadiance, ClassMask::kAll);
      const Vec3f wi = s ? s->wi : spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      for (const EventClass e : kSurfaceClasses)
        for (const TransportMode mode : kModes)
          EXPECT_EQ(bsdf.eval(wo, wi, mode, e, bsdf.classes()).pdf_w,
                    bsdf.eval(wo, wi, mode, e, ClassMask::kAll).pdf_w)
              << c.name;
    }
  }
}

TEST(BsdfContract, ClassesOutsideTheMaskNeverAppear) {
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    TestRandom random(11);
    for (int i = 0; i < 1000; ++i) {
      const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      const Vec3f wi = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      for (const ClassMask among : kMasks) {
        for (const EventClass e : kSurfaceClasses) {
          if (contains(among & bsdf.finite_classes(), e)) continue;
          const BsdfEval v = bsdf.eval(wo, wi, TransportMode::kRadiance, e, among);
          EXPECT_TRUE(v.f.is_black() && v.pdf_w == 0.0f) << c.name;
        }
        if ((among & bsdf.classes()) != ClassMask::kNone) continue;
        const auto s =
            bsdf.sample(wo, random.next(), random.next2(), TransportMode::kRadiance, among);
        EXPECT_TRUE(!s || s->straight_through) << c.name;
      }
    }
    EXPECT_EQ(bsdf.finite_classes() & bsdf.classes(), bsdf.finite_classes()) << c.name;
  }
}

TEST(BsdfContract, RadianceAndImportanceAreAdjoint) {
  for (const BsdfCase& c : all_cases()) {
    // Stochastic ones are adjoint only in the mean: layered_test.cpp. Hair has its own symmetries.
    if (c.stochastic || !c.adjoint) continue;
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    TestRandom random(13);
    for (int i = 0; i < 2000; ++i) {
      const Vec3f a = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      const Vec3f b = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      if (std::min(std::abs(a.z), std::abs(b.z)) < 0.02f) continue;
      for (const EventClass e : kSurfaceClasses) {
        const auto radiance = bsdf.eval(a, b, TransportMode::kRadiance, e, ClassMask::kAll);
        const auto importance = bsdf.eval(b, a, TransportMode::kImportance, e, ClassMask::kAll);
        // Absolute tolerance: a few ulps of 1 - F near total reflection.
        expect_near(radiance.f, importance.f, 2e-3f, c.name, 1e-6f);
        const auto same_way = bsdf.eval(a, b, TransportMode::kImportance, e, ClassMask::kAll);
        if (c.reciprocal && (!c.refracts || same_hemisphere(a, b)))
          expect_near(radiance.f, same_way.f, 1e-6f, c.name);
      }
    }
  }
}

// eta_between() of a direction equals the eta of a sample in that direction.
TEST(BsdfContract, EtaOfADirectionIsThatOfASampleThere) {
  int refracted = 0;
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    TestRandom random(31);
    for (int i = 0; i < 500; ++i) {
      const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
      const float uc = random.next();
      const auto s = bsdf.sample(wo, uc, random.next2(), TransportMode::kRadiance, ClassMask::kAll);
      if (!s) continue;
      EXPECT_FLOAT_EQ(bsdf.eta_between(wo, s->wi), s->eta) << c.name;
      refracted += s->eta != 1.0f;
    }
  }
  EXPECT_GT(refracted, 100);
}

TEST(BsdfContract, RefractionScalesRadianceByTheSquareOfEta) {
  for (const float eta : {1.5f, 0.7f}) {
    for (const float alpha : {0.0f, 0.3f}) {
      const DielectricBsdf glass({eta, TrowbridgeReitz(alpha, alpha)}, 0.05f);
      TestRandom random(17);
      int refracted = 0;
      for (int i = 0; i < 500; ++i) {
        const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
        const float uc = random.next();
        const Vec2f u = random.next2();
        const auto r = glass.sample(wo, uc, u, TransportMode::kRadiance, ClassMask::kAll);
        const auto m = glass.sample(wo, uc, u, TransportMode::kImportance, ClassMask::kAll);
        ASSERT_EQ(r.has_value(), m.has_value());
        if (!r) continue;
        if (r->transmitted) {
          EXPECT_FLOAT_EQ(r->eta, wo.z > 0 ? eta : 1 / eta);
        }
        expect_near(r->f * sqr(r->eta), m->f, 1e-5f, "dielectric");
        refracted += r->transmitted;
      }
      EXPECT_GT(refracted, 50);
    }
  }
}

TEST(BsdfContract, NoEnergyIsCreated) {
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    for (const float angle : {3.0f, 50.0f, 84.0f, 120.0f}) {
      const Vec3f wo = direction_at(angle);
      TestRandom random(19);
      Mean energy;
      for (int i = 0; i < 20000; ++i) {
        const float uc = random.next();
        const auto s =
            bsdf.sample(wo, uc, random.next2(), TransportMode::kImportance, ClassMask::kAll);
        energy.add(s ? s->f[0] * std::abs(s->wi.z) / s->pdf_w : 0.0);
      }
      EXPECT_LT(energy.mean(), 1.0 + 1e-4 + 5.0 * energy.error()) << c.name << " at " << angle;
      EXPECT_GT(energy.mean(), 0.02) << c.name << " at " << angle;
    }
  }
}

TEST(BsdfContract, SamplingOneClassOrAllGivesTheSameEnergy) {
  int cases = 0;
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    if (std::popcount(static_cast<unsigned>(bsdf.classes())) < 2) continue;
    ++cases;
    const Vec3f wo = direction_at(40.0f);
    for (const EventClass e : kSurfaceClasses) {
      Mean alone, among_all;
      TestRandom random(23);
      for (int i = 0; i < 40000; ++i) {
        for (const ClassMask among : {mask_of(e), ClassMask::kAll}) {
          const float uc = random.next();
          const auto s = bsdf.sample(wo, uc, random.next2(), TransportMode::kRadiance, among);
          const double w = s && s->event == e ? s->f[2] * std::abs(s->wi.z) / s->pdf_w : 0.0;
          (among == ClassMask::kAll ? among_all : alone).add(w);
        }
      }
      const double error = std::hypot(alone.error(), among_all.error());
      EXPECT_NEAR(alone.mean(), among_all.mean(), 5.0 * error + 1e-5) << c.name;
    }
  }
  EXPECT_GE(cases, 8);
}

TEST(BsdfContract, NothingIsEverNan) {
  const float nasty[] = {0.0f, -0.0f, 1e-30f, -1e-30f, 1e-7f, 1e-4f, 1.0f, -1.0f, 0.999999f};
  for (const BsdfCase& c : all_cases()) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    TestRandom random(29);
    const auto direction = [&](int i) {
      const float z =
          i % 3 == 0 ? nasty[static_cast<int>(random.next() * 9)] : 2 * random.next() - 1;
      Vec3f w = spherical(z, i % 5 == 0 ? 0.0 : 6.28 * random.next());
      w.z = z;
      return w;
    };
    const int count = c.stochastic ? 10000 : 100000;
    for (int i = 0; i < count; ++i) {
      const Vec3f wo = direction(i);
      const Vec3f wi = i % 7 == 0    ? -wo
                       : i % 11 == 0 ? Vec3f(-wo.x, -wo.y, wo.z)
                                     : direction(i + 1);
      const TransportMode mode = kModes[i % 2];
      for (const EventClass e : kSurfaceClasses) {
        const BsdfEval v = bsdf.eval(wo, wi, mode, e, ClassMask::kAll);
        ASSERT_TRUE(v.f.is_finite() && std::isfinite(v.pdf_w) && v.pdf_w >= 0.0f) << c.name;
        ASSERT_LE((v.f * -1.0f).max_component(), 0.0f) << c.name;
        ASSERT_TRUE(v.pdf_w > 0.0f || v.f.is_black() || wi.z * wi.z < 1e-30f) << c.name;
      }
      const float u = i % 13 == 0 ? kOneMinusEpsilon : random.next();
      const float v = i % 17 == 0 ? 0.0f : i % 19 == 0 ? kOneMinusEpsilon : random.next();
      const auto s = bsdf.sample(wo, random.next(), {u, v}, mode, ClassMask::kAll);
      if (!s) continue;
      ASSERT_TRUE(s->f.is_finite() && is_finite(s->wi) && std::isfinite(s->pdf_w)) << c.name;
      ASSERT_NE(s->wi.z, 0.0f) << c.name;
      const SampledSpectrum weight = s->f * (std::abs(s->wi.z) / s->pdf_w);
      ASSERT_TRUE(weight.is_finite()) << c.name << wo.z;
      // Unless values are reciprocal, the cosine cancels only in radiance mode.
      if (!c.stochastic && (c.reciprocal || mode == TransportMode::kRadiance)) {
        ASSERT_LT(weight.max_component(), 10.0f) << c.name << wo.z;
      }
    }
    EXPECT_TRUE(bsdf.albedo(Vec3f(1, 0, 0)).is_finite()) << c.name;
  }
}

}  // namespace
}  // namespace nephroid::testing_bsdf
