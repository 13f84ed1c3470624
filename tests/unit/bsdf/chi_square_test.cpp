// Samples follow the stated densities: chi-square for every family, per class and per set of
// classes, over the whole sphere. The density must integrate to the share of samples.
#include <gtest/gtest.h>

#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

constexpr int kZBins = 10, kPhiBins = 16;

struct Question {
  Vec3f wo;
  EventClass event;
  ClassMask among;
  TransportMode mode;
};

/// p-value of the samples of a class against its density. The last bin is the rest.
double p_value(const Bsdf& bsdf, const Question& q, int count, uint64_t seed) {
  std::vector<double> observed(kZBins * kPhiBins + 1, 0.0), expected(kZBins * kPhiBins + 1, 0.0);
  TestRandom random(seed);
  for (int i = 0; i < count; ++i) {
    const float uc = random.next();
    const auto s = bsdf.sample(q.wo, uc, random.next2(), q.mode, q.among);
    if (!s || s->delta || s->event != q.event) {
      observed.back() += 1.0;
      continue;
    }
    const int z = std::min(kZBins - 1, static_cast<int>((s->wi.z + 1.0f) * 0.5f * kZBins));
    const float phi = std::atan2(s->wi.y, s->wi.x);
    const int p =
        std::clamp(static_cast<int>((phi / kPi + 1.0f) * 0.5f * kPhiBins), 0, kPhiBins - 1);
    observed[z * kPhiBins + p] += 1.0;
  }
  const SphereFunction density = [&](const Vec3f& wi) {
    return static_cast<double>(bsdf.eval(q.wo, wi, q.mode, q.event, q.among).pdf_w);
  };
  double total = 0.0;
  for (int z = 0; z < kZBins; ++z) {
    for (int p = 0; p < kPhiBins; ++p) {
      const double mass = integrate_cell(
          density, -1.0 + 2.0 * z / kZBins, -1.0 + 2.0 * (z + 1) / kZBins,
          -M_PI + 2.0 * M_PI * p / kPhiBins, -M_PI + 2.0 * M_PI * (p + 1) / kPhiBins, 3e-6);
      expected[z * kPhiBins + p] = mass * count;
      total += mass;
    }
  }
  EXPECT_LT(total, 1.0 + 1e-3);
  expected.back() = std::max(0.0, 1.0 - total) * count;
  return chi_square_test(observed, expected);
}

std::vector<Question> questions(const BsdfCase& c, const Bsdf& bsdf) {
  std::vector<Question> list;
  std::vector<float> angles = c.stochastic   ? std::vector<float>{50.0f}
                              : c.few_angles ? std::vector<float>{45.0f, 125.0f}
                                             : std::vector<float>{4.0f, 45.0f, 80.0f, 125.0f};
  // From below at 125 degrees, glass of index 1.5 reflects all light.
  if (c.refracts) angles.push_back(160.0f);
  for (const float angle : angles) {
    for (const EventClass e : kSurfaceClasses) {
      if (!contains(bsdf.finite_classes(), e)) continue;
      const TransportMode mode =
          list.size() % 2 == 0 ? TransportMode::kRadiance : TransportMode::kImportance;
      list.push_back({direction_at(angle), e, ClassMask::kAll, mode});
      if (bsdf.classes() != mask_of(e)) list.push_back({direction_at(angle), e, mask_of(e), mode});
    }
  }
  return list;
}

void expect_that_samples_follow_the_density(const std::vector<BsdfCase>& cases) {
  struct Result {
    std::string what;
    double p;
  };
  std::vector<Result> results;
  for (const BsdfCase& c : cases) {
    BsdfArena arena;
    const Bsdf& bsdf = *c.make(arena);
    const int count = c.stochastic ? 40000 : c.few_angles ? 60000 : 100000;
    for (const Question& q : questions(c, bsdf)) {
      const double p = p_value(bsdf, q, count, results.size());
      results.push_back({c.name + ", wo.z " + std::to_string(q.wo.z) + ", class " +
                             std::to_string(static_cast<int>(q.event)) + ", among " +
                             std::to_string(static_cast<int>(q.among)),
                         p});
    }
  }
  ASSERT_GT(results.size(), 60u);
  const double level = sidak(0.01, static_cast<int>(results.size()));
  for (const Result& r : results) EXPECT_GT(r.p, level) << r.what;
}

TEST(BsdfChiSquare, SamplesFollowTheDensity) {
  expect_that_samples_follow_the_density(simple_cases());
}

// Apart, since the quick tier leaves it out.
TEST(PrincipledChiSquare, SamplesFollowTheDensity) {
  expect_that_samples_follow_the_density(principled_cases());
}

TEST(BsdfChiSquare, NoticesAWrongDensity) {
  // The test must be able to fail: samples of roughness 0.2 against the density of 0.22.
  class Wrong final : public Bsdf {
   public:
    ClassMask classes() const override { return ClassMask::kGlossy; }
    ClassMask finite_classes() const override { return ClassMask::kGlossy; }
    BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode m, EventClass c,
                  ClassMask a) const override {
      return stated_.eval(wo, wi, m, c, a);
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode m,
                                     ClassMask a) const override {
      return real_.sample(wo, uc, u, m, a);
    }
    SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

   private:
    ConductorBsdf stated_{metal(0.22f, 0.22f), 0.05f}, real_{metal(0.2f, 0.2f), 0.05f};
  } wrong;
  EXPECT_LT(
      p_value(wrong,
              {direction_at(45), EventClass::kGlossy, ClassMask::kAll, TransportMode::kRadiance},
              100000, 1),
      1e-6);
}

}  // namespace
}  // namespace nephroid::testing_bsdf
