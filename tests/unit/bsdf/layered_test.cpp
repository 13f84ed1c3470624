// Coated surfaces against brute-force random walks without connections, closed forms or classes:
// light enters, bounces and leaves.
#include <gtest/gtest.h>

#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

constexpr int kCosineBins = 6;  // uniform steps in the cosine of wi

struct Left {
  Vec3f wi;
  SampledSpectrum weight;
};

/// One analogue path that entered the coat from wo. Empty if it is absorbed or longer than the
/// model allows.
template <class Base>
std::optional<Left> brute_force(const Coat& coat, const Base& base, const Vec3f& wo,
                                TestRandom& random) {
  const auto mode = TransportMode::kRadiance;
  const auto pick = [&](const Vec3f& w) {
    const float uc = random.next();
    return coat.boundary.sample(w, uc, random.next2(), mode, BoundaryPart::kBoth);
  };
  const auto entry = pick(wo);
  if (!entry || !entry->transmitted) return std::nullopt;
  SampledSpectrum beta(entry->weight);
  Vec3f w = entry->wi;
  float z = coat.thickness;
  for (int depth = 0; depth <= coat.max_depth; ++depth) {
    const float step = -std::log(1.0f - random.next()) * std::abs(w.z);
    const float to_border = w.z > 0 ? coat.thickness - z : z;
    if (step < to_border) {
      if (!coat.scatters || depth == coat.max_depth) return std::nullopt;
      z += w.z > 0 ? step : -step;
      beta *= coat.albedo;
      w = sample_henyey_greenstein(w, coat.g, random.next2());
    } else if (w.z > 0) {
      z = coat.thickness;
      const auto s = pick(-w);
      if (!s) return std::nullopt;
      beta *= s->weight;
      w = s->wi;
      if (s->transmitted) return Left{w, beta};
    } else {
      if (depth == coat.max_depth) return std::nullopt;
      z = 0.0f;
      const auto s = base.sample(-w, random.next2());
      if (!s) return std::nullopt;
      beta *= s->weight;
      w = s->wi;
    }
  }
  return std::nullopt;
}

struct Energies {
  Mean bins[kCosineBins];
  void add(float cosine, float weight) {
    const int b = std::min(kCosineBins - 1, static_cast<int>(cosine * kCosineBins));
    for (int i = 0; i < kCosineBins; ++i) bins[i].add(i == b ? weight : 0.0);
  }
  void add_nothing() {
    for (Mean& m : bins) m.add(0.0);
  }
};

constexpr int kLane = 1;

template <class Base>
Energies brute_force_energies(const Coat& coat, const Base& base, const Vec3f& wo, int count) {
  Energies e;
  TestRandom random(101);
  for (int i = 0; i < count; ++i) {
    const auto left = brute_force(coat, base, wo, random);
    if (left)
      e.add(left->wi.z, left->weight[kLane]);
    else
      e.add_nothing();
  }
  return e;
}

/// Energy per bin of a BSDF's samples, without the coat's own reflection.
Energies sampled_energies(const Bsdf& bsdf, const Coat& coat, const Vec3f& wo, int count) {
  Energies e;
  TestRandom random(202);
  for (int i = 0; i < count; ++i) {
    const float uc = random.next();
    const auto s = bsdf.sample(wo, uc, random.next2(), TransportMode::kRadiance, ClassMask::kAll);
    if (!s) {
      e.add_nothing();
      continue;
    }
    float f = s->f[kLane];
    if (s->delta)
      f -= coat.boundary.fresnel(wo) / s->wi.z;
    else if (!coat.boundary.smooth() && contains(bsdf.finite_classes(), s->event) &&
             s->event == coat.boundary.facets.event_class(kSpecularAlpha))
      f -= coat.boundary.evaluate(wo, s->wi, TransportMode::kRadiance, BoundaryPart::kReflection).f;
    e.add(s->wi.z, f * s->wi.z / s->pdf_w);
  }
  return e;
}

void expect_same(const Energies& a, const Energies& b, const std::string& what) {
  for (int i = 0; i < kCosineBins; ++i)
    EXPECT_NEAR(a.bins[i].mean(), b.bins[i].mean(),
                5.0 * std::hypot(a.bins[i].error(), b.bins[i].error()) + 1e-4)
        << what << ", bin " << i;
}

template <class Base>
void compare(const std::string& name, const Coat& coat, const Base& base) {
  // A single walk is far from normally distributed at grazing exits. The error bounds of this test
  // need the mean of several.
  Coat averaged = coat;
  averaged.walks = 8;
  const CoatedBsdf<Base> bsdf(averaged, base, kSpecularAlpha);
  for (const float angle : {10.0f, 65.0f}) {
    const Vec3f wo = direction_at(angle);
    expect_same(brute_force_energies(coat, base, wo, 150000),
                sampled_energies(bsdf, coat, wo, 60000), name + " at " + std::to_string(angle));
  }
}

TEST(Layered, WalkAgreesWithBruteForce) {
  const LambertSurface grey{ramp(0.9f, 0.6f)};
  compare("lambert, smooth coat", make_coat(1.5f, 0, 0, 0.1f, 0), grey);
  compare("lambert, anisotropic coat", make_coat(1.5f, 0.2f, 0.5f, 0.01f, 0), grey);
  compare("lambert, medium", make_coat(1.4f, 0.3f, 0.3f, 0.7f, 0.8f, 0.5f), grey);
  compare("lambert, smooth coat, medium", make_coat(1.4f, 0, 0, 0.7f, 0.8f, -0.3f), grey);
  compare("metal, smooth coat", make_coat(1.5f, 0, 0, 0.1f, 0), metal(0.3f, 0.3f));
  compare("metal, both rough", make_coat(1.5f, 0.3f, 0.3f, 0.1f, 0), metal(0.3f, 0.3f));
  compare("mirror, rough coat", make_coat(1.5f, 0.3f, 0.3f, 0.01f, 0), metal(0, 0));
  compare("metal, medium", make_coat(1.5f, 0.2f, 0.2f, 0.5f, 0.8f), metal(0.2f, 0.2f));
  compare("mirrors", make_coat(1.5f, 0, 0, 0.2f, 0), metal(0, 0));
  compare("mirrors, medium", make_coat(1.5f, 0, 0, 0.6f, 0.9f), metal(0, 0));
}

TEST(Layered, ClosedFormAgreesWithBruteForce) {
  const LambertSurface grey{ramp(0.95f, 0.8f)};
  for (const float alpha : {0.0f, 0.03f, 0.3f, 0.8f}) {
    for (const int max_depth : {1, 4, 10}) {
      Coat coat = make_coat(1.5f, alpha, alpha, 0.05f, 0);
      coat.max_depth = max_depth;
      const CoatTable table(coat.boundary, coat.thickness, max_depth);
      const CoatedDiffuseBsdf bsdf(&table, grey.reflectance, kSpecularAlpha);
      for (const float angle : {20.0f, 75.0f}) {
        const Vec3f wo = direction_at(angle);
        const Energies brute = brute_force_energies(coat, grey, wo, 100000);
        for (int b = 0; b < kCosineBins; ++b) {
          const double exact = integrate_range(
              [&](const Vec3f& wi) {
                const double f = bsdf.eval(wo, wi, TransportMode::kRadiance, EventClass::kDiffuse,
                                           ClassMask::kAll)
                                     .f[kLane];
                return f * wi.z;
              },
              static_cast<double>(b) / kCosineBins, (b + 1.0) / kCosineBins, 1e-4);
          EXPECT_NEAR(exact, brute.bins[b].mean(), 4.5 * brute.bins[b].error() + 2e-4)
              << "alpha " << alpha << ", depth " << max_depth << ", angle " << angle;
        }
      }
    }
  }
}

TEST(Layered, ClosedFormIsTheMeanOfTheWalk) {
  const LambertSurface grey{ramp(0.9f, 0.6f)};
  for (const float alpha : {0.0f, 0.2f, 0.6f}) {
    const Coat coat = make_coat(1.5f, alpha, alpha, 0.02f, 0);
    const CoatTable table(coat.boundary, coat.thickness, coat.max_depth);
    const CoatedDiffuseBsdf bsdf(&table, grey.reflectance, 1.0f);  // the coat is of class S
    for (const float o : {5.0f, 60.0f, 82.0f}) {
      for (const float i : {30.0f, 78.0f}) {
        const Vec3f wo = direction_at(o), wi = direction_at(i, 2.0f);
        for (const auto mode : {TransportMode::kRadiance, TransportMode::kImportance}) {
          const float exact =
              bsdf.eval(wo, wi, mode, EventClass::kDiffuse, ClassMask::kAll).f[kLane];
          Mean walk;
          WalkRandom random(77);
          for (int n = 0; n < 10000; ++n)
            walk.add(LayeredWalk<LambertSurface>(coat, grey, wi, mode).run(wo, random)[kLane]);
          // 2e-3: interpolation error of the table at grazing angles.
          EXPECT_NEAR(walk.mean(), exact, 5.0 * walk.error() + 2e-3 * exact) << alpha << o << i;
        }
      }
    }
  }
}

TEST(Layered, WalkIsReciprocalInTheMean) {
  const ConductorSurface base = metal(0.3f, 0.2f);
  const Coat coat = make_coat(1.5f, 0.4f, 0.4f, 0.3f, 0.7f, 0.2f);
  const Vec3f a = direction_at(20), b = direction_at(65, 2.5f);
  Mean forward, backward;
  WalkRandom random(5);
  for (int n = 0; n < 60000; ++n) {
    forward.add(LayeredWalk<ConductorSurface>(coat, base, b, TransportMode::kRadiance)
                    .run(a, random)[kLane]);
    backward.add(LayeredWalk<ConductorSurface>(coat, base, a, TransportMode::kImportance)
                     .run(b, random)[kLane]);
  }
  EXPECT_NEAR(forward.mean(), backward.mean(), 5.0 * std::hypot(forward.error(), backward.error()));
  EXPECT_GT(forward.mean(), 10.0 * forward.error());
}

TEST(Layered, AValueIsAFunctionOfTheDirections) {
  const CoatedBsdf<ConductorSurface> bsdf(make_coat(1.5f, .3f, .3f, .1f, .5f), metal(.2f, .2f),
                                          .05f);
  const Vec3f wo = direction_at(30), wi = direction_at(50, 3.0f);
  const auto first =
      bsdf.eval(wo, wi, TransportMode::kRadiance, EventClass::kDiffuse, ClassMask::kAll);
  const auto again =
      bsdf.eval(wo, wi, TransportMode::kRadiance, EventClass::kDiffuse, ClassMask::kAll);
  EXPECT_EQ(first.f, again.f);
  const auto below =
      bsdf.eval(-wo, -wi, TransportMode::kRadiance, EventClass::kDiffuse, ClassMask::kAll);
  EXPECT_EQ(first.f, below.f);  // both sides alike
}

TEST(Layered, InnerReflectanceMatchesAFineQuadrature) {
  // Values of a quadrature with 1024 cosines and 64 x 64 facets each; eta 1.5, gap 0.01.
  const std::pair<float, float> known[] = {
      {0.0f, 0.56738f}, {0.001f, 0.56736f}, {0.1f, 0.53358f}, {0.4f, 0.34089f}, {1.0f, 0.12732f}};
  for (const auto& [alpha, value] : known)
    EXPECT_NEAR(CoatTable({1.5f, {alpha, alpha}}, 0.01f, 10).inner_reflectance(), value, 4e-4f)
        << alpha;
}

TEST(Layered, SmoothCoatOverWhiteReturnsNearlyAllLight) {
  // Without absorption and with enough bounces, all light leaves.
  const CoatTable table({1.5f, {}}, 1e-30f, 2000);
  const CoatedDiffuseBsdf white(&table, SampledSpectrum(1.0f), 0.05f);
  for (const float angle : {0.0f, 45.0f, 80.0f})
    EXPECT_NEAR(white.albedo(direction_at(angle))[0], 1.0f, 2e-4f);
}

}  // namespace
}  // namespace nephroid::testing_bsdf
