// The principled surface against the families that it contains, and its promises: a white surface
// reflects all light, a coat darkens as a real one does.
#include "scene/bsdf/principled.h"

#include <gtest/gtest.h>

#include "scene/bsdf/principled_subsurface.h"
#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

using S = PrincipledSurface;

constexpr TransportMode kPrincipledModes[] = {TransportMode::kRadiance, TransportMode::kImportance};

void expect_same(const SampledSpectrum& a, const SampledSpectrum& b, const std::string& what) {
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_NEAR(a[i], b[i], 2e-4f * std::max(std::abs(a[i]), std::abs(b[i])) + 1e-6f) << what;
}

/// Same values, densities and samples for random directions.
void expect_same_bsdf(const Bsdf& a, const Bsdf& b, const std::string& what) {
  EXPECT_EQ(a.classes(), b.classes()) << what;
  EXPECT_EQ(a.finite_classes(), b.finite_classes()) << what;
  TestRandom random(41);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
    if (std::abs(wo.z) < 0.02f) continue;
    const TransportMode mode = kPrincipledModes[i % 2];
    const float uc = random.next();
    const Vec2f u = random.next2();
    const auto s = a.sample(wo, uc, u, mode, ClassMask::kAll);
    const auto t = b.sample(wo, uc, u, mode, ClassMask::kAll);
    ASSERT_EQ(s.has_value(), t.has_value()) << what;
    if (!s || std::abs(s->wi.z) < 0.02f) continue;
    EXPECT_LT(length(s->wi - t->wi), 1e-5f) << what;
    expect_same(s->f, t->f, what);
    EXPECT_NEAR(s->pdf_w, t->pdf_w, 1e-3f * s->pdf_w) << what;
    EXPECT_EQ(s->delta, t->delta) << what;
    EXPECT_EQ(s->event, t->event) << what;
    EXPECT_EQ(s->transmitted, t->transmitted) << what;
    EXPECT_EQ(s->straight_through, t->straight_through) << what;
    EXPECT_FLOAT_EQ(s->eta, t->eta) << what;
    for (const EventClass c : kSurfaceClasses) {
      const BsdfEval e = a.eval(wo, s->wi, mode, c, ClassMask::kAll);
      const BsdfEval f = b.eval(wo, s->wi, mode, c, ClassMask::kAll);
      for (int k = 0; k < kSpectrumSamples; ++k)
        EXPECT_NEAR(e.f[k], f.f[k], 2e-3f * f.f[k]) << what;
      EXPECT_NEAR(e.pdf_w, f.pdf_w, 2e-3f * f.pdf_w) << what;
    }
  }
}

TEST(PrincipledBsdf, OfTransmissionOnlyIsADielectric) {
  for (const float eta : {1.5f, 0.7f, 2.4f}) {
    for (const float alpha : {0.0f, 0.04f, 0.3f}) {
      BsdfArena arena;
      const Bsdf& glass = *make_principled_bsdf(arena, principled(alpha, [&](S& s) {
                                                  s.transmission = 1.0f;
                                                  s.ior = eta;
                                                }));
      const DielectricBsdf expected({eta, {alpha, alpha}}, kSpecularAlpha);
      const std::string what = "eta " + std::to_string(eta) + " alpha " + std::to_string(alpha);
      expect_same_bsdf(glass, expected, what);
      TestRandom random(43);
      for (int i = 0; i < 500; ++i) {
        const Vec3f wo = spherical(2.0 * random.next() - 1.0, 6.28 * random.next());
        const auto a = glass.delta_pair(wo, kPrincipledModes[i % 2]);
        const auto b = expected.delta_pair(wo, kPrincipledModes[i % 2]);
        ASSERT_EQ(a.has_value(), b.has_value()) << what;
        for (int k = 0; a && k < 2; ++k) {
          EXPECT_LT(length((*a)[k].wi - (*b)[k].wi), 1e-6f) << what;
          expect_same((*a)[k].f, (*b)[k].f, what);
          EXPECT_NEAR((*a)[k].pdf_w, (*b)[k].pdf_w, 1e-5f) << what;
        }
      }
    }
  }
}

TEST(PrincipledBsdf, WithoutSpecularItIsDiffuse) {
  for (const bool leaf : {false, true}) {
    BsdfArena arena;
    const Bsdf& matt = *make_principled_bsdf(arena, principled(0.09f, [&](S& s) {
                                               s.specular_weight = 0.0f;
                                               if (leaf) {
                                                 s.diffuse_transmission = 0.5f;
                                                 s.diffuse_transmission_color = ramp(0.9f, 0.1f);
                                               }
                                             }));
    if (leaf)
      expect_same_bsdf(matt, DiffuseTransmissionBsdf(ramp(0.45f, 0.2f), ramp(0.45f, 0.05f)),
                       "leaf");
    else
      expect_same_bsdf(matt, DiffuseBsdf(ramp(0.9f, 0.4f)), "diffuse");
  }
}

TEST(PrincipledBsdf, AThinSmoothWallIsAPane) {
  BsdfArena arena;
  const auto* wall =
      static_cast<const PrincipledBsdf*>(make_principled_bsdf(arena, principled(0.0f, [](S& s) {
                                                                s.transmission = 1.0f;
                                                                s.thin_walled = true;
                                                              })));
  const ThinDielectricBsdf pane(SampledSpectrum(1.5f));
  EXPECT_EQ(wall->classes(), ClassMask::kSpecular);
  EXPECT_FALSE(wall->delta_pair(direction_at(30), TransportMode::kRadiance));
  for (const float angle : {5.0f, 60.0f, 85.0f, 120.0f}) {
    const Vec3f wo = direction_at(angle);
    const SampledSpectrum r = ThinDielectricBsdf::pane_reflectance(wo.z, SampledSpectrum(1.5f));
    expect_same(wall->straight_transmittance(wo), SampledSpectrum(1.0f) - r, "straight");
    for (const ClassMask among : {ClassMask::kAll, ClassMask::kDiffuse, ClassMask::kNone}) {
      const auto through = wall->sample(wo, kOneMinusEpsilon, {}, TransportMode::kRadiance, among);
      const auto expected = pane.sample(wo, kOneMinusEpsilon, {}, TransportMode::kRadiance, among);
      ASSERT_TRUE(through && through->straight_through);
      EXPECT_EQ(through->wi, -wo);
      expect_same(through->f / through->pdf_w, expected->f / expected->pdf_w, "weight");
    }
    const auto up = wall->sample(wo, 0.0f, {}, TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_TRUE(up && up->delta && !up->transmitted);
    expect_same(up->f * std::abs(wo.z), r, "mirror");
  }
}

TEST(PrincipledBsdf, AnIndexOfOneLetsLightPass) {
  for (const bool thin : {false, true}) {
    BsdfArena arena;
    const Bsdf& nothing = *make_principled_bsdf(arena, principled(0.3f, [&](S& s) {
                                                  s.transmission = 1.0f;
                                                  s.ior = 1.0f;
                                                  s.thin_walled = thin;
                                                }));
    EXPECT_EQ(nothing.classes(), ClassMask::kNone);
    const auto s =
        nothing.sample(direction_at(50), 0.3f, {}, TransportMode::kRadiance, ClassMask::kDiffuse);
    ASSERT_TRUE(s && s->straight_through);
    EXPECT_FLOAT_EQ(s->f[2] * std::abs(s->wi.z) / s->pdf_w, 1.0f);
  }
}

/// Share of flux from wo that is scattered, by samples in importance mode. Light that goes below
/// counts as out again.
double furnace(const Bsdf& bsdf, const Vec3f& wo, double* error, int lane = 0) {
  TestRandom random(47);
  Mean energy;
  for (int i = 0; i < 40000; ++i) {
    const float uc = random.next();
    const auto s = bsdf.sample(wo, uc, random.next2(), TransportMode::kImportance, ClassMask::kAll);
    energy.add(s ? s->f[lane] * std::abs(s->wi.z) / s->pdf_w : 0.0);
  }
  *error = energy.error();
  return energy.mean();
}

S white(float alpha, const std::function<void(S&)>& change) {
  return principled(alpha, [&](S& s) {
    s.metal_color = s.diffuse_color = s.subsurface_color = SampledSpectrum(1.0f);
    change(s);
  });
}

struct White {
  const char* name;
  S surface;
  double least;  ///< share that must come back
};

std::vector<White> white_surfaces() {
  const auto coat = [](S& s, float alpha) {
    s.coat_weight = 1.0f;
    s.coat_facets = {alpha, alpha};
  };
  std::vector<White> list;
  for (const float alpha : {0.0f, 0.01f, 0.09f, 0.3f, 1.0f}) {
    list.push_back({"plastic", white(alpha, [](S&) {}), 0.99});
    list.push_back({"metal", white(alpha, [](S& s) { s.metalness = 1; }), 0.985});
    list.push_back({"leaf", white(alpha, [](S& s) { s.diffuse_transmission = 0.5f; }), 0.99});
    list.push_back({"skin", white(alpha, [](S& s) { s.subsurface = 0.6f; }), 0.99});
    list.push_back({"coated plastic", white(alpha, [&](S& s) { coat(s, 0.2f); }), 0.97});
    list.push_back({"coated metal",
                    white(alpha,
                          [&](S& s) {
                            s.metalness = 1;
                            coat(s, 0);
                          }),
                    0.9});
    list.push_back({"velvet", white(alpha, [](S& s) { s.fuzz_weight = 1; }), 0.9});
    list.push_back({"film", white(alpha, [](S& s) { s.film_weight = 1; }), 0.98});
    list.push_back({"wall",
                    white(alpha,
                          [](S& s) {
                            s.transmission = 1;
                            s.thin_walled = true;
                          }),
                    alpha > 0.5f   ? 0.3
                    : alpha > 0.2f ? 0.8
                                   : 0.9});
    list.push_back({"clay", white(alpha, [](S& s) { s.diffuse_roughness = 1; }), 0.97});
    list.push_back({"anisotropic",
                    white(alpha,
                          [&](S& s) {
                            s.facets = {alpha, 0.1f * alpha};
                            s.coat_weight = 0.5f;
                          }),
                    0.97});
    list.push_back({"half metal in glass",
                    white(alpha,
                          [](S& s) {
                            s.metalness = 0.5f;
                            s.transmission = 0.7f;
                          }),
                    0.8});
    list.push_back({"tinted glass",
                    white(alpha,
                          [&](S& s) {
                            s.transmission = 0.5f;
                            coat(s, 0.1f);
                          }),
                    0.5});
  }
  return list;
}

TEST(PrincipledBsdf, AWhiteSurfaceReflectsAllLightAndNoMore) {
  for (const White& w : white_surfaces()) {
    BsdfArena arena;
    const Bsdf& bsdf = *make_principled_bsdf(arena, w.surface);
    for (const float angle : {2.0f, 40.0f, 65.0f, 80.0f, 87.0f, 135.0f, 160.0f}) {
      double error;
      const double energy = furnace(bsdf, direction_at(angle), &error);
      const std::string what = std::string(w.name) + " alpha " +
                               std::to_string(w.surface.facets.alpha_x()) + " at " +
                               std::to_string(angle);
      EXPECT_LT(energy, 1.0 + 5.0 * error + 2e-3) << what;
      EXPECT_GT(energy, w.least - 5.0 * error) << what;
    }
  }
}

/// Share of flux from wo inside that is refracted, by the values over the other side.
double refracted(const Bsdf& bsdf, const Vec3f& wo) {
  return integrate_range(
      [&](const Vec3f& w) {
        const BsdfEval e =
            bsdf.eval(wo, w, TransportMode::kImportance, EventClass::kGlossy, ClassMask::kAll);
        return static_cast<double>(e.f[0] * w.z);
      },
      0, 1, 1e-4);
}

TEST(PrincipledBsdf, SamplesFromInsideRefractAsMuchAsTheValuesSay) {
  BsdfArena arena;
  const Bsdf& bsdf = *make_principled_bsdf(arena, principled(0.3f, [](S& s) {
                                             s.metalness = 0.5f;
                                             s.transmission = 1.0f;
                                             s.metal_color = SampledSpectrum(0.2f);
                                           }));
  for (const float angle : {150.0f, 160.0f, 178.0f}) {
    const Vec3f wo = direction_at(angle);
    TestRandom random(53);
    Mean energy;
    for (int i = 0; i < 40000; ++i) {
      const float uc = random.next();
      const auto s =
          bsdf.sample(wo, uc, random.next2(), TransportMode::kImportance, ClassMask::kAll);
      energy.add(s && s->transmitted ? s->f[0] * s->wi.z / s->pdf_w : 0.0);
    }
    EXPECT_NEAR(energy.mean(), refracted(bsdf, wo), 5.0 * energy.error() + 1e-3) << angle;
  }
}

TEST(PrincipledBsdf, ACoatDarkensAsARealOneDoes) {
  // Without absorption and with many reflections the closed form of "coateddiffuse" is exact.
  const CoatTable table({1.6f, {}}, 1e-6f, 1000);
  const CoatedDiffuseBsdf expected(&table, ramp(0.9f, 0.2f), kSpecularAlpha);
  BsdfArena arena;
  const Bsdf& coated = *make_principled_bsdf(arena, principled(0.09f, [](S& s) {
                                               s.diffuse_color = ramp(0.9f, 0.2f);
                                               s.specular_weight = 0.0f;
                                               s.coat_weight = 1.0f;
                                             }));
  EXPECT_EQ(coated.classes(), expected.classes());
  TestRandom random(51);
  for (int i = 0; i < 200; ++i) {
    const Vec3f wo = spherical(random.next(), 6.28 * random.next());
    const Vec3f wi = spherical(random.next(), 6.28 * random.next());
    const auto value = [&](const Bsdf& b) {
      return b.eval(wo, wi, TransportMode::kRadiance, EventClass::kDiffuse, ClassMask::kAll).f;
    };
    const SampledSpectrum a = value(coated), b = value(expected);
    for (int k = 0; k < kSpectrumSamples; ++k) EXPECT_NEAR(a[k], b[k], 0.01f * b[k]);
  }
}

TEST(PrincipledBsdf, LightBelowLeavesAsFromTheDiffuseLobe) {
  // Entering and leaving, with a white profile between them, is the diffuse lobe.
  const auto layered = [](float subsurface) {
    return principled(0.2f, [&](S& s) {
      s.diffuse_color = SampledSpectrum(1.0f);
      s.coat_weight = 0.7f;
      s.coat_darkening = 0.0f;
      s.coat_color = ramp(0.9f, 0.6f);
      s.fuzz_weight = 0.4f;
      s.fuzz_color = SampledSpectrum();
      s.subsurface = subsurface;
    });
  };
  BsdfArena arena, other;
  const Bsdf& skin = *make_principled_bsdf(arena, layered(1.0f));
  const Bsdf& paint = *make_principled_bsdf(other, layered(0.0f));
  const PrincipledLayers layers(&principled_tables(), layered(1.0f), nullptr);
  const PrincipledExitBsdf exit(&layers);
  const Vec3f wi = direction_at(35.0f, 2.0f);
  for (const float angle : {10.0f, 70.0f}) {
    const Vec3f wo = direction_at(angle);
    std::optional<BsdfSample> entry;
    for (int i = 0; i < 100 && !(entry && entry->subsurface); ++i)
      entry = skin.sample(wo, 0.01f * static_cast<float>(i), {0.5f, 0.5f}, TransportMode::kRadiance,
                          ClassMask::kDiffuse);
    ASSERT_TRUE(entry && entry->subsurface && entry->transmitted && entry->delta);
    const SampledSpectrum out = exit.eval(Vec3f(0, 0, 1), wi, TransportMode::kRadiance,
                                          EventClass::kDiffuse, ClassMask::kAll)
                                    .f;
    const SampledSpectrum whole =
        paint.eval(wo, wi, TransportMode::kRadiance, EventClass::kDiffuse, ClassMask::kAll).f;
    expect_same(entry->f * std::abs(entry->wi.z) * out, whole, "below");
  }
}

}  // namespace
}  // namespace nephroid::testing_bsdf
