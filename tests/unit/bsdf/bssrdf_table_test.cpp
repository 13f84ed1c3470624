// Subsurface profiles: splines, Fresnel moments, beam diffusion against theory and an independent
// program, and sampling of radii.
#include "scene/bsdf/bssrdf_table.h"

#include <gtest/gtest.h>

#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/fresnel_moments.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

/// Simpson's rule with 2n intervals.
template <class F>
double simpson(double a, double b, int n, F&& f) {
  const double h = (b - a) / (2 * n);
  double sum = f(a) + f(b);
  for (int i = 1; i < 2 * n; ++i) sum += f(a + i * h) * (i % 2 ? 4.0 : 2.0);
  return sum * h / 3.0;
}

const std::vector<float> kNodes{-1.0f, 0.5f, 0.75f, 2.0f, 5.0f, 5.5f};

TEST(CatmullRom, PassesThroughItsPointsAndReproducesLines) {
  std::vector<float> line, curve;
  for (const float x : kNodes) {
    line.push_back(3.0f * x - 1.0f);
    curve.push_back(std::sin(x));
  }
  for (size_t i = 0; i < kNodes.size(); ++i) {
    const auto w = spline_value(kNodes, kNodes[i]);
    ASSERT_TRUE(w);
    EXPECT_NEAR(w->of([&](int k) { return curve[static_cast<size_t>(k)]; }), curve[i], 1e-6f);
  }
  for (float x = -1.0f; x <= 5.5f; x += 0.093f) {
    const auto w = spline_value(kNodes, x);
    ASSERT_TRUE(w);
    EXPECT_NEAR(w->of([&](int k) { return line[static_cast<size_t>(k)]; }), 3.0f * x - 1.0f, 1e-5f);
  }
  EXPECT_FALSE(spline_value(kNodes, -1.001f));
  EXPECT_FALSE(spline_value(kNodes, 5.501f));
  EXPECT_FALSE(spline_value(kNodes, std::nanf("")));
}

TEST(CatmullRom, IntegralIsThatOfTheValue) {
  const std::vector<float> f{0.2f, 1.0f, -0.5f, 0.7f, 3.0f, 2.0f};
  std::vector<float> cumulative(f.size());
  const float total = spline_integrate(kNodes, f, cumulative);
  EXPECT_EQ(total, cumulative.back());
  const auto value = [&](int k) { return f[static_cast<size_t>(k)]; };
  double sum = 0.0;
  for (size_t i = 0; i + 1 < kNodes.size(); ++i) {
    sum += simpson(kNodes[i], kNodes[i + 1], 4, [&](double x) {
      return spline_value(kNodes, static_cast<float>(x))->of(value);
    });
    EXPECT_NEAR(cumulative[i + 1], sum, 1e-5) << i;
    const double half = simpson(kNodes[i], 0.5 * (kNodes[i] + kNodes[i + 1]), 4, [&](double x) {
      return spline_value(kNodes, static_cast<float>(x))->of(value);
    });
    const SplineSegment segment(kNodes, static_cast<int>(i), value);
    EXPECT_NEAR(segment.integral(0.5f), half, 1e-5) << i;
    const float third = kNodes[i] + segment.width() / 3;
    EXPECT_NEAR(segment.value(1.0f / 3), spline_value(kNodes, third)->of(value), 1e-5) << i;
    EXPECT_NEAR(segment.derivative(0.4f), 50 * (segment.value(0.41f) - segment.value(0.39f)), 1e-2)
        << i;
  }
}

TEST(CatmullRom, InversionFindsTheValueAgain) {
  const std::vector<float> rising{0.0f, 0.3f, 0.35f, 1.0f, 1.2f, 4.0f};
  for (float v = 0.0f; v <= 4.0f; v += 0.057f) {
    const float x = spline_invert(kNodes, rising, v);
    EXPECT_NEAR(spline_value(kNodes, x)->of([&](int k) { return rising[static_cast<size_t>(k)]; }),
                v, 2e-5f);
  }
  EXPECT_EQ(spline_invert(kNodes, rising, -1.0f), kNodes.front());
  EXPECT_EQ(spline_invert(kNodes, rising, 9.0f), kNodes.back());
}

TEST(FresnelMoments, FollowTheIntegrals) {
  for (const double eta : {1.0 / 2.0, 1.0 / 1.5, 1.0 / 1.33, 1.1, 1.33, 1.5, 1.8}) {
    // Light inside a medium of index eta at its boundary to vacuum.
    const auto f = [&](double c) {
      return static_cast<double>(
          fresnel_dielectric(static_cast<float>(-c), static_cast<float>(eta)));
    };
    EXPECT_NEAR(fresnel_moment_1(eta), simpson(0, 1, 4000, [&](double c) { return f(c) * c; }),
                3e-3)
        << eta;
    EXPECT_NEAR(fresnel_moment_2(eta), simpson(0, 1, 4000, [&](double c) { return f(c) * c * c; }),
                3e-3)
        << eta;
  }
}

TEST(BeamDiffusion, SingleScatteringHasTheClosedForm) {
  // Isotropic scattering without a boundary: albedo/2 times the integral of mu/(1+mu).
  const double total = simpson(0.0, 40.0, 20000, [](double r) {
    return r > 0.0 ? 2 * M_PI * r * beam_diffusion_single(1.0, 0.0, 1.0, r) : 0.0;
  });
  EXPECT_NEAR(total, 0.5 * (1.0 - std::log(2.0)), 2e-3);
  EXPECT_DOUBLE_EQ(beam_diffusion_single(0.3, 0.2, 1.4, 0.7),
                   0.3 * beam_diffusion_single(1.0, 0.2, 1.4, 0.7));
}

TEST(BeamDiffusion, MultipleScatteringKnowsOnlyTheReducedCoefficients) {
  // Scattering with mean cosine g and albedo a equals isotropic scattering with a free path longer
  // by `stretch`.
  const double a = 0.9, g = 0.6, stretch = 1.0 / (1.0 - a * g);
  const double reduced = a * (1.0 - g) * stretch;
  for (const double r : {0.1, 1.0, 6.0})
    EXPECT_NEAR(beam_diffusion_multiple(a, g, 1.3, r),
                beam_diffusion_multiple(reduced, 0.0, 1.3, r / stretch) / (stretch * stretch),
                1e-12);
  EXPECT_EQ(beam_diffusion_multiple(0.0, 0.0, 1.3, 1.0), 0.0);
}

// Computed in double precision by a separate program, from the formulas of Habel et al. 2013.
struct Published {
  float g, eta;
  int albedo;
  float effective;
  float profile[3];  ///< at radii 1, 30 and 45
};
constexpr Published kPublished[] = {
    {0.0f, 1.33f, 1, 0.006078206f, {0.02184088f, 0.003352917f, 7.227207e-08f}},
    {0.0f, 1.33f, 30, 0.31669f, {0.2626247f, 0.1316204f, 0.002338113f}},
    {0.0f, 1.33f, 60, 0.710798f, {0.2866672f, 0.1754378f, 0.02142382f}},
    {0.0f, 1.33f, 99, 1.019343f, {0.2889195f, 0.1818036f, 0.03378857f}},
    {0.8f, 1.5f, 1, 0.0002992063f, {0.001212862f, 0.0001498127f, 3.533296e-09f}},
    {0.8f, 1.5f, 30, 0.05784524f, {0.01445222f, 0.009599768f, 0.002481893f}},
    {0.8f, 1.5f, 60, 0.3425189f, {0.01576382f, 0.01480088f, 0.01566448f}},
    {0.8f, 1.5f, 99, 0.8893269f, {0.01588819f, 0.01580109f, 0.02270256f}},
    {-0.3f, 1.0f, 30, 0.6337098f, {0.9770676f, 0.3503737f, 0.001172807f}},
    {-0.3f, 1.0f, 60, 0.9919581f, {1.065381f, 0.4355212f, 0.01208569f}},
};

TEST(BssrdfTable, HoldsTheProfilesOfAnotherProgram) {
  BssrdfTableCache tables;
  for (const Published& p : kPublished) {
    const auto table = tables.find_or_make(p.g, p.eta);
    EXPECT_EQ(table, tables.find_or_make(p.g, p.eta));
    EXPECT_NEAR(table->effective_albedos()[static_cast<size_t>(p.albedo)], p.effective,
                2e-5f * p.effective);
    const int radii[3] = {1, 30, 45};
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(table->profile(p.albedo, radii[k]), p.profile[k], 3e-5f * p.profile[k]);
  }
}

TEST(BssrdfTable, IsPositiveAndRisesWithTheAlbedo) {
  for (const auto& [g, eta] : {std::pair{0.0f, 1.33f}, {0.9f, 1.5f}, {-0.5f, 1.0f}, {0.0f, 0.8f}}) {
    const BssrdfTable table(g, eta);
    EXPECT_EQ(table.effective_albedos()[0], 0.0f);
    for (int a = 1; a < BssrdfTable::kAlbedos; ++a) {
      const size_t i = static_cast<size_t>(a);
      EXPECT_GT(table.albedos()[i], table.albedos()[i - 1]);
      EXPECT_GT(table.effective_albedos()[i], table.effective_albedos()[i - 1]);
      EXPECT_EQ(table.profile(a, 0), 0.0f);
      for (int r = 1; r < BssrdfTable::kRadii; ++r) EXPECT_GE(table.profile(a, r), 0.0f);
    }
    EXPECT_EQ(table.albedos().back(), 1.0f);
    for (float albedo = 0.02f; albedo < 1.0f; albedo += 0.07f) {
      const float seen = table.effective_albedo(table.albedo_weights(albedo));
      EXPECT_NEAR(table.invert_effective_albedo(seen), albedo, 1e-4f);
    }
    EXPECT_EQ(table.invert_effective_albedo(0.0f), 0.0f);
    EXPECT_EQ(table.invert_effective_albedo(2.0f), 1.0f);
  }
}

TEST(BssrdfTable, ProfilesBetweenAlbedosIntegrateToTheEffectiveAlbedo) {
  const BssrdfTable table(0.2f, 1.4f);
  for (const float albedo : {0.03f, 0.4f, 0.871f, 0.999f, 1.0f}) {
    const SplineWeights w = table.albedo_weights(albedo);
    double sum = 0.0;
    for (size_t k = 0; k + 1 < table.radii().size(); ++k)
      sum += simpson(table.radii()[k], table.radii()[k + 1], 4,
                     [&](double r) { return table.radial_density(w, static_cast<float>(r)); });
    EXPECT_NEAR(sum, table.effective_albedo(w), 1e-4 * sum) << albedo;
  }
  EXPECT_EQ(table.radial_density(table.albedo_weights(0.9f), 300.0f), 0.0f);
}

TEST(BssrdfTable, NearlyAllLightIsWithinReach) {
  for (const auto& [g, eta] : {std::pair{0.0f, 1.33f}, {0.7f, 1.5f}, {-0.5f, 1.1f}}) {
    const BssrdfTable table(g, eta);
    for (const float albedo : {0.001f, 0.03f, 0.2f, 0.5f, 0.871f, 0.99f, 0.9991f, 1.0f}) {
      const SplineWeights w = table.albedo_weights(albedo);
      const float reach = table.reach(w);
      ASSERT_GT(reach, 0);
      double within = 0.0;
      for (size_t k = 0; k + 1 < table.radii().size() && table.radii()[k] < reach; ++k)
        within += simpson(table.radii()[k], std::min(table.radii()[k + 1], reach), 8,
                          [&](double r) { return table.radial_density(w, static_cast<float>(r)); });
      const double share = within / static_cast<double>(table.effective_albedo(w));
      EXPECT_GT(share, 0.998) << g << " " << albedo;
      EXPECT_LT(share, 1.0001) << g << " " << albedo;
    }
  }
}

TEST(BssrdfTable, SampledRadiiFollowTheProfile) {
  const BssrdfTable table(0.0f, 1.33f);
  for (const float albedo : {0.1f, 0.83f, 0.9995f}) {
    const SplineWeights w = table.albedo_weights(albedo);
    constexpr int kCount = 40000;
    const size_t bins = table.radii().size() - 1;
    std::vector<double> observed(bins, 0.0), expected(bins, 0.0);
    for (size_t k = 0; k < bins; ++k)
      expected[k] = kCount / static_cast<double>(table.effective_albedo(w)) *
                    simpson(table.radii()[k], table.radii()[k + 1], 4, [&](double r) {
                      return table.radial_density(w, static_cast<float>(r));
                    });
    TestRandom random(5);
    float last = 0.0f;
    for (int i = 0; i < kCount; ++i) {
      const std::optional<float> r = table.sample_radius(w, random.next());
      ASSERT_TRUE(r);
      const std::optional<int> bin = spline_interval(table.radii(), *r);
      ASSERT_TRUE(bin);
      observed[static_cast<size_t>(*bin)] += 1.0;
    }
    EXPECT_GT(chi_square_test(observed, expected), 1e-4) << albedo;
    for (int i = 0; i < 1000; ++i) {
      const float r = *table.sample_radius(w, static_cast<float>(i) / 1000.0f);
      EXPECT_GE(r, last);
      last = r;
    }
  }
  EXPECT_FALSE(table.sample_radius(table.albedo_weights(0.0f), 0.5f));
}

}  // namespace
}  // namespace nephroid::testing_bsdf
