// The measured BSDF against a known surface: values, densities, energy, symmetry, sides and
// non-reciprocal tables.
#include "scene/bsdf/measured.h"

#include <gtest/gtest.h>

#include "measured_ggx.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

using testing_measured::GgxSurface;
using testing_measured::tables_of;

GgxSurface isotropic(float alpha) {
  GgxSurface s;
  s.alpha_x = s.alpha_y = alpha;
  return s;
}
GgxSurface brushed(int symmetry) {
  GgxSurface s;
  s.alpha_x = 0.2f;
  s.alpha_y = 0.5f;
  s.symmetry = symmetry;
  s.azimuths = symmetry == 1 ? 17 : symmetry == 2 ? 9 : 5;
  s.polar = 9;
  s.normals = 48;
  s.nodes = 16;
  s.wavelengths = 2;
  return s;
}

const SampledWavelengths kLambda = SampledWavelengths::sample_visible(0.3f);

BsdfEval evaluate(const MeasuredBrdf& brdf, const Vec3f& wo, const Vec3f& wi) {
  return brdf.evaluate(wo, wi, brdf.places(kLambda));
}

/// Error of f against the known surface over sampled directions: the mean relative error, and the
/// share of directions above 5 %. In any table, directions around the last node above the horizon
/// are far off.
struct Errors {
  double mean = 0, outliers = 0;
};
Errors errors_against(const GgxSurface& surface, const MeasuredBrdf& brdf) {
  TestRandom random(5);
  Errors e;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3f wo = spherical(0.15 + 0.85 * random.next(), 6.28 * random.next());
    const Vec3f m = surface.facets().sample_visible(wo, random.next2());
    const Vec3f wi = normalize(m * (2 * dot(wo, m)) - wo);
    if (wi.z < 0.1f) continue;
    const int lane = i % kSpectrumSamples;
    const double known = surface.f(wo, wi, kLambda.lambda(lane));
    const double error = std::abs(evaluate(brdf, wo, wi).f[lane] / known - 1.0);
    e.mean += error / kCount;
    e.outliers += error > 0.05 ? 1.0 / kCount : 0.0;
  }
  return e;
}

void expect_close(const GgxSurface& surface) {
  const Errors e = errors_against(surface, MeasuredBrdf(tables_of(surface)));
  const bool isotropic = surface.azimuths <= 2;  // else the tables are coarse
  EXPECT_LT(e.mean, isotropic ? 0.01 : 0.025) << surface.alpha_x;
  EXPECT_LT(e.outliers, isotropic ? 0.04 : 0.12) << surface.alpha_x;
}

TEST(Measured, ReproducesAKnownSurface) {
  for (const float alpha : {0.15f, 0.4f, 0.9f}) expect_close(isotropic(alpha));
  expect_close(brushed(1));
}

TEST(Measured, FinerTablesComeCloser) {
  // Twice the nodes of a piecewise linear function: a quarter of the error.
  for (const GgxSurface& coarse : {isotropic(0.4f), brushed(1), brushed(4)}) {
    GgxSurface fine = coarse;
    fine.polar = 2 * coarse.polar - 1;
    fine.azimuths = 2 * coarse.azimuths - 1;
    fine.normals = 2 * coarse.normals;
    fine.nodes = 2 * coarse.nodes;
    const double before = errors_against(coarse, MeasuredBrdf(tables_of(coarse))).mean;
    const double after = errors_against(fine, MeasuredBrdf(tables_of(fine))).mean;
    EXPECT_LT(after, 0.4 * before) << coarse.alpha_x << " " << coarse.symmetry;
  }
}

TEST(Measured, DensityFollowsLight) {
  // Sampling is almost ideal: f cos / pdf varies only by the tint.
  for (const GgxSurface& surface : {isotropic(0.3f), brushed(1)}) {
    const MeasuredBrdf brdf(tables_of(surface));
    TestRandom random(9);
    for (const float angle : {10.0f, 50.0f, 75.0f}) {
      const Vec3f wo = direction_at(angle);
      Mean weight;
      for (int i = 0; i < 4000; ++i) {
        const auto s = brdf.sample(wo, random.next2(), brdf.places(kLambda));
        if (s) weight.add(s->f[0] * s->wi.z / s->pdf_w / GgxSurface::tint(kLambda.lambda(0)));
      }
      EXPECT_GT(weight.n, 3500);
      EXPECT_LT(weight.error() * std::sqrt(weight.n), 0.1 * weight.mean()) << angle;
    }
  }
}

TEST(Measured, DensityAndLostSamplesSumToOne) {
  // At grazing angles many facets reflect light into the surface. The density's integral lacks that
  // part; it is not spread over the rest.
  for (const GgxSurface& surface : {isotropic(0.8f), brushed(1)}) {
    const MeasuredBrdf brdf(tables_of(surface));
    for (const float angle : {0.0f, 60.0f, 85.0f}) {
      const Vec3f wo = direction_at(angle);
      const double integral = integrate_range(
          [&](const Vec3f& wi) { return static_cast<double>(evaluate(brdf, wo, wi).pdf_w); }, 0, 1,
          1e-3);
      TestRandom random(3);
      Mean kept;
      for (int i = 0; i < 20000; ++i)
        kept.add(brdf.sample(wo, random.next2(), brdf.places(kLambda)).has_value());
      EXPECT_NEAR(integral, kept.mean(), 4 * kept.error() + 3e-3) << angle;
      if (angle == 85.0f) {
        EXPECT_LT(kept.mean(), 0.995);
      }
    }
  }
}

TEST(Measured, ReflectsAsMuchAsTheKnownSurface) {
  for (const GgxSurface& surface : {isotropic(0.4f), brushed(1)}) {
    const MeasuredBrdf brdf(tables_of(surface));
    TestRandom random(11);
    for (const float angle : {5.0f, 45.0f, 70.0f}) {
      const Vec3f wo = direction_at(angle);
      Mean energy, known;
      for (int i = 0; i < 20000; ++i) {
        const Vec2f u = random.next2();
        const auto s = brdf.sample(wo, u, brdf.places(kLambda));
        energy.add(s ? s->f[4] * s->wi.z / s->pdf_w : 0.0);
        const Vec3f m = surface.facets().sample_visible(wo, u);
        const Vec3f wi = normalize(m * (2 * dot(wo, m)) - wo);
        known.add(wi.z > 0 ? surface.f(wo, wi, kLambda.lambda(4)) * wi.z /
                                 surface.facets().reflection_pdf_w(wo, m)
                           : 0.0);
      }
      EXPECT_NEAR(energy.mean(), known.mean(),
                  4 * std::hypot(energy.error(), known.error()) + 0.01 * known.mean());
      // The albedo serves denoising only, so a rough value is enough.
      EXPECT_NEAR(brdf.albedo(wo, brdf.places(kLambda))[4], known.mean(), 0.1 * known.mean());
    }
  }
}

TEST(Measured, WavelengthsBetweenAndBeyondTheTable) {
  GgxSurface surface = isotropic(0.4f);
  MeasuredTables tables = tables_of(surface);
  for (float& l : tables.wavelengths) l = 500.0f + (l - 360.0f) * 100.0f / 470.0f;
  const MeasuredBrdf brdf(std::move(tables));
  const Vec3f wo = direction_at(30), wi = direction_at(20, 3.0f);
  const BsdfEval e = evaluate(brdf, wo, wi);
  const float whole = surface.f(wo, wi, 360.0f) / GgxSurface::tint(360.0f);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    const float place = std::clamp((kLambda.lambda(i) - 500.0f) / 100.0f, 0.0f, 1.0f);
    EXPECT_NEAR(e.f[i], whole * lerp(place, 0.2f, 0.8f), 0.02f * whole);
  }
}

TEST(Measured, SymmetryStandsForTheMissingAzimuths) {
  for (const int symmetry : {2, 4}) {
    const GgxSurface surface = brushed(symmetry);
    const MeasuredBrdf part(tables_of(surface));
    expect_close(surface);
    TestRandom random(13);
    for (int i = 0; i < 1000; ++i) {
      const Vec3f wo = spherical(0.1 + 0.9 * random.next(), 6.28 * random.next());
      const Vec3f wi = spherical(0.1 + 0.9 * random.next(), 6.28 * random.next());
      // Exact symmetries: half a turn and, for quarter tables, mirroring.
      const auto same_as = [&](float x, float y) {
        const BsdfEval a = evaluate(part, wo, wi);
        const BsdfEval b = evaluate(part, {wo.x * x, wo.y * y, wo.z}, {wi.x * x, wi.y * y, wi.z});
        EXPECT_FLOAT_EQ(a.f[2], b.f[2]);
        EXPECT_FLOAT_EQ(a.pdf_w, b.pdf_w);
      };
      same_as(-1, -1);
      if (symmetry == 4) same_as(-1, 1);
      if (const auto s = part.sample(wo, random.next2(), part.places(kLambda))) {
        EXPECT_NEAR(evaluate(part, wo, s->wi).pdf_w, s->pdf_w, 5e-3f * s->pdf_w);
      }
    }
  }
}

TEST(Measured, BothSidesReflectAndNothingPasses) {
  const MeasuredBrdf brdf(tables_of(brushed(1)));
  const MeasuredBsdf bsdf(brdf, kLambda);
  const auto eval = [&](const Vec3f& wo, const Vec3f& wi) {
    return bsdf.eval(wo, wi, TransportMode::kRadiance, EventClass::kGlossy, ClassMask::kAll);
  };
  const Vec3f a = direction_at(40, 0.3f), b = direction_at(55, 2.0f);
  EXPECT_GT(eval(a, b).f[0], 0.0f);
  EXPECT_TRUE(eval(a, -b).f.is_black());
  EXPECT_EQ(eval(a, -b).pdf_w, 0.0f);
  EXPECT_EQ(eval(a, b).f[3], eval(-a, -b).f[3]);
  EXPECT_EQ(eval(a, b).pdf_w, eval(-a, -b).pdf_w);
  TestRandom random(17);
  for (int i = 0; i < 200; ++i) {
    const Vec2f u = random.next2();
    const auto s = bsdf.sample(-a, 0, u, TransportMode::kRadiance, ClassMask::kAll);
    if (!s) continue;
    EXPECT_LT(s->wi.z, 0.0f);
    EXPECT_FALSE(s->transmitted || s->delta);
    EXPECT_EQ(s->event, EventClass::kGlossy);
  }
}

TEST(Measured, BothModesUseTheValueTowardsTheEye) {
  // Non-reciprocal tables: twice as bright for grazing wo.
  MeasuredTables tables = tables_of(isotropic(0.5f));
  const size_t grid = tables.spectra.grid_size() * tables.wavelengths.size();
  for (size_t i = 0; i < tables.spectra.values.size(); ++i)
    if (i / grid > tables.theta.size() / 2) tables.spectra.values[i] *= 2.0f;
  const MeasuredBrdf brdf(std::move(tables));
  const MeasuredBsdf bsdf(brdf, kLambda);
  const Vec3f high = direction_at(20, 0.3f), low = direction_at(75, 2.0f);
  const auto f = [&](const Vec3f& wo, const Vec3f& wi, TransportMode mode) {
    return bsdf.eval(wo, wi, mode, EventClass::kGlossy, ClassMask::kAll).f[0];
  };
  EXPECT_NEAR(f(low, high, TransportMode::kRadiance) / f(high, low, TransportMode::kRadiance), 2.0f,
              0.1f);
  EXPECT_EQ(f(low, high, TransportMode::kRadiance), f(high, low, TransportMode::kImportance));
  EXPECT_EQ(f(high, low, TransportMode::kRadiance), f(low, high, TransportMode::kImportance));
}

TEST(Measured, ValuesMayAlreadyHoldTheCosineAlone) {
  MeasuredTables tables = tables_of(isotropic(0.5f));
  tables.values_are_ratios = false;
  const MeasuredBrdf brdf(tables);
  tables.values_are_ratios = true;
  const MeasuredBrdf ratios(std::move(tables));
  const GgxSurface surface = isotropic(0.5f);
  const Vec3f wo = direction_at(30), wi = direction_at(50, 3.0f);
  const TrowbridgeReitz t = surface.facets();
  const float p = t.reflection_pdf_w(wo, normalize(wo + wi));
  const float ratio = evaluate(brdf, wo, wi).f[0] * wi.z;
  EXPECT_NEAR(ratio * p, evaluate(ratios, wo, wi).f[0] * wi.z, 0.01f * ratio * p);
}

}  // namespace
}  // namespace nephroid::testing_bsdf
