// The phase function: normalised, symmetric, sampled as evaluated, with mean cosine g.
#include "scene/medium/phase_function.h"

#include "unit/medium/medium_fixture.h"

namespace nephroid::testing_medium {
namespace {

using testing_bsdf::chi_square_test;
using testing_bsdf::integrate_range;
using testing_bsdf::sidak;
using testing_bsdf::spherical;

constexpr float kAllG[] = {-0.99f, -0.9f, -0.5f, -0.01f, 0, 1e-4f, 0.3f, 0.85f, 0.99f};

TEST(HenyeyGreenstein, IntegratesToOneAndHasMeanCosineG) {
  const Vec3f wo(0, 0, 1);
  for (const float g : kAllG) {
    const HenyeyGreenstein phase(g);
    double total = 0, cosine = 0;
    // Finer towards both poles.
    const double edges[] = {-1, -0.9999, -0.99, -0.9, 0, 0.9, 0.99, 0.9999, 1};
    for (int i = 0; i < 8; ++i) {
      total += integrate_range([&](const Vec3f& wi) { return phase.eval(wo, wi); }, edges[i],
                               edges[i + 1], 1e-6);
      cosine += integrate_range([&](const Vec3f& wi) { return -wi.z * phase.eval(wo, wi); },
                                edges[i], edges[i + 1], 1e-6);
    }
    EXPECT_NEAR(total, 1.0, 2e-5) << g;
    EXPECT_NEAR(cosine, g, 2e-5) << g;
  }
}

TEST(HenyeyGreenstein, SamplesFollowTheDensity) {
  constexpr int kZ = 24, kPhi = 16, kCount = 40000;
  for (const float g : kAllG) {
    const HenyeyGreenstein phase(g);
    const Vec3f wo = spherical(0.3, 1.1);
    const Frame frame = Frame::from_z(wo);
    // Cells of equal probability would test nothing: cells in the cosine grow from the peak.
    const auto edge = [&](int i) {
      const double s = double(i) / kZ;
      const double from_peak = std::abs(g) > 0.8f ? 2 * s * s * s : 2 * s;
      return g >= 0 ? -1 + from_peak : 1 - from_peak;
    };
    std::vector<double> expected, observed(kZ * kPhi, 0.0);
    for (int i = 0; i < kZ; ++i) {
      // The distribution function in closed form, with z = cos(wo, wi).
      const auto cdf = [&](double z) {
        if (std::abs(g) < 1e-3) return 0.5 * z;
        return -(1 - double(g) * g) / (2 * double(g)) / std::sqrt(1 + double(g) * g + 2 * g * z);
      };
      const double share = std::abs(cdf(edge(i + 1)) - cdf(edge(i)));
      for (int j = 0; j < kPhi; ++j) expected.push_back(kCount * share / kPhi);
    }
    TestRandom random(7);
    for (int n = 0; n < kCount; ++n) {
      const PhaseSample s = phase.sample(wo, random.next2());
      const Vec3f local = frame.to_local(s.wi);
      const double from_peak = g >= 0 ? 1 + local.z : 1 - local.z;
      const double step = std::abs(g) > 0.8f ? std::cbrt(0.5 * from_peak) : 0.5 * from_peak;
      const int i = std::clamp(static_cast<int>(step * kZ), 0, kZ - 1);
      const double phi = std::atan2(local.y, local.x) / (2 * M_PI);
      const int j = std::clamp(static_cast<int>((phi < 0 ? phi + 1 : phi) * kPhi), 0, kPhi - 1);
      observed[static_cast<size_t>(i * kPhi + j)] += 1;
    }
    EXPECT_GT(chi_square_test(observed, expected), sidak(1e-3, std::size(kAllG))) << g;
  }
}

TEST(HenyeyGreenstein, SampleTellsTheDensityThatEvalTells) {
  TestRandom random(3);
  for (const float g : kAllG) {
    const HenyeyGreenstein phase(g);
    for (int i = 0; i < 2000; ++i) {
      const Vec3f wo = square_to_sphere(random.next2());
      const PhaseSample s = phase.sample(wo, random.next2());
      ASSERT_NEAR(length(s.wi), 1.0f, 1e-6f);
      // Near the peak, rounding a direction changes the density by a percent.
      ASSERT_NEAR(phase.eval(wo, s.wi), s.pdf_w, (std::abs(g) > 0.9f ? 2e-3f : 2e-5f) * s.pdf_w)
          << g;
      ASSERT_EQ(phase.eval(wo, s.wi), phase.eval(s.wi, wo));
    }
  }
}

TEST(HenyeyGreenstein, CornersOfTheUnitSquareGiveFiniteDirections) {
  for (const float g : kAllG)
    for (const float x : {0.0f, kOneMinusEpsilon})
      for (const float y : {0.0f, kOneMinusEpsilon}) {
        const PhaseSample s = HenyeyGreenstein(g).sample({0, 0, -1}, {x, y});
        EXPECT_TRUE(is_finite(s.wi) && s.pdf_w > 0 && std::isfinite(s.pdf_w)) << g;
      }
}

TEST(HenyeyGreenstein, ForwardIsWherePbrtHasIt) {
  // g > 0 scatters towards dot(wo, wi) = -1, and small random numbers scatter forward.
  const HenyeyGreenstein forward(0.8f);
  const Vec3f wo(1, 0, 0);
  EXPECT_GT(forward.eval(wo, -wo), 100 * forward.eval(wo, wo));
  EXPECT_LT(dot(wo, forward.sample(wo, {0, 0}).wi), -0.999f);
  // Values beyond [-0.99, 0.99] are clamped.
  EXPECT_EQ(HenyeyGreenstein(1.0f).g(), 0.99f);
  EXPECT_EQ(HenyeyGreenstein(-1.0f).g(), -0.99f);
}

}  // namespace
}  // namespace nephroid::testing_medium
