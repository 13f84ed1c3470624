// Directions predicted from photons: samples follow the densities of lobes and mixture, and a map
// favours the casters of the nearest records.
#include "transport/guided_direction.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "photon/forecast_map.h"
#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid {
namespace {

using namespace testing_bsdf;

ForecastLobes some_lobes() {
  ForecastLobes lobes;
  lobes.add(direction_at(30, 1.0f), 0.3f);
  lobes.add(direction_at(70, -2.0f), 0.6f);
  lobes.add(direction_at(100, 0.5f), 0.9f);
  return lobes;
}

/// Counts directions in cells of the sphere and compares them with a density.
class SphereCells {
 public:
  static constexpr int kZ = 12, kPhi = 16;
  void add(const Vec3f& w) {
    const int z = std::clamp(static_cast<int>((w.z + 1.0f) * 0.5f * kZ), 0, kZ - 1);
    const float turn = std::atan2(w.y, w.x) / kPi + 1.0f;
    observed_[static_cast<size_t>(
        z * kPhi + std::clamp(static_cast<int>(turn * 0.5f * kPhi), 0, kPhi - 1))] += 1;
  }
  void miss() { observed_.back() += 1; }
  double p_value(const SphereFunction& density, int count) const {
    std::vector<double> expected;
    double total = 0;
    for (int z = 0; z < kZ; ++z)
      for (int p = 0; p < kPhi; ++p) {
        const double mass =
            integrate_cell(density, -1 + 2.0 * z / kZ, -1 + 2.0 * (z + 1) / kZ,
                           -M_PI + 2 * M_PI * p / kPhi, -M_PI + 2 * M_PI * (p + 1) / kPhi, 3e-6);
        expected.push_back(mass * count);
        total += mass;
      }
    expected.push_back(std::max(0.0, 1 - total) * count);
    return chi_square_test(observed_, expected);
  }

 private:
  std::vector<double> observed_ = std::vector<double>(kZ * kPhi + 1, 0.0);
};

constexpr int kSamples = 200000;
constexpr double kLevel = 1e-3;

TEST(ForecastLobes, AreADensityThatSamplesFollow) {
  const ForecastLobes lobes = some_lobes();
  const SphereFunction density = [&](const Vec3f& w) {
    return static_cast<double>(lobes.pdf_w(w));
  };
  EXPECT_NEAR(integrate_range(density, -1, 1, 1e-5), 1, 1e-4);
  SphereCells cells;
  TestRandom random(1);
  for (int i = 0; i < kSamples; ++i) {
    float uc = random.next();
    cells.add(lobes.sample(uc, random.next2()));
    ASSERT_TRUE(uc >= 0 && uc < 1) << uc;
  }
  EXPECT_GT(cells.p_value(density, kSamples), kLevel);
}

TEST(ForecastLobes, AreExactWhereTheyAreNarrow) {
  ForecastLobes lobes;
  const Vec3f axis = normalize(Vec3f(0.3f, -0.5f, 0.8f));
  lobes.add(axis, 0.0f);  // the narrowest width, a hundredth of a radian
  // In rings around the axis that cos(theta) cannot distinguish from 1.
  const double k = 1e4;
  TestRandom random(2);
  std::vector<double> observed(6, 0.0), expected;
  const double rings[] = {0.25, 0.5, 1.0, 2.0, 4.0};
  for (int i = 0; i < kSamples; ++i) {
    float uc = random.next();
    const Vec3f w = lobes.sample(uc, random.next2());
    const double t = 0.5 * k * static_cast<double>(length_squared(w - axis));
    ++observed[static_cast<size_t>(std::upper_bound(rings, rings + 5, t) - rings)];
    ASSERT_NEAR(static_cast<double>(lobes.pdf_w(w)), k / (2 * M_PI) * std::exp(-t),
                1e-3 * k / (2 * M_PI));
  }
  double below = 0;
  for (const double ring : rings) {
    expected.push_back(kSamples * (1 - std::exp(-ring) - below));
    below = 1 - std::exp(-ring);
  }
  expected.push_back(kSamples * (1 - below));
  EXPECT_GT(chi_square_test(observed, expected), kLevel);
}

// [T3], for every class of a BSDF, in a shading frame other than world space.
TEST(GuidedDirection, IsADensityThatSamplesFollow) {
  const Frame shading = Frame::from_z(normalize(Vec3f(0.2f, -0.3f, 0.9f)));
  const ForecastLobes lobes = some_lobes();
  struct Question {
    BsdfCase bsdf;
    TransportMode mode = TransportMode::kRadiance;
    ClassMask among = ClassMask::kAll;
  };
  const std::vector<Question> asked = {
      {coated_diffuse_case(1.5f, 0.3f, 0.01f, 0.7f)},
      {coated_diffuse_case(1.5f, 0.02f, 0.01f, 0.7f)},
      {coated_diffuse_case(1.5f, 0.3f, 0.01f, 0.7f), TransportMode::kImportance,
       ClassMask::kDiffuse},
      {conductor_case(0.3f, 0.2f)},
      {dielectric_case(1.5f, 0.3f, 0.3f)},
      {dielectric_case(1.5f, 0.3f, 0.3f), TransportMode::kImportance},
      {conductor_case(0, 0)}};
  int questions = 0;
  for (const Question& question : asked) {
    const TransportMode mode = question.mode;
    const ClassMask among = question.among;
    BsdfArena arena;
    const Bsdf& bsdf = *question.bsdf.make(arena);
    const Vec3f wo = direction_at(40);
    const GuidedDirection mixture(bsdf, shading, wo, mode, among, lobes);
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(bsdf.finite_classes() & among, c)) continue;
      ++questions;
      const auto pdf = [&](const Vec3f& wi) {
        return mixture.pdf_w(wi, c, bsdf.eval(wo, wi, mode, c, among).pdf_w);
      };
      SphereCells cells;
      TestRandom random(static_cast<uint64_t>(questions));
      for (int i = 0; i < kSamples; ++i) {
        const float uc = random.next();
        float gain = 0;
        const auto s = mixture.sample(uc, random.next2(), gain);
        if (!s || s->delta || s->event != c) {
          cells.miss();
          continue;
        }
        cells.add(s->wi);
        const BsdfEval e = bsdf.eval(wo, s->wi, mode, c, among);
        ASSERT_NEAR(s->pdf_w, pdf(s->wi), 1e-3f * s->pdf_w) << question.bsdf.name;
        ASSERT_NEAR(gain, s->pdf_w / e.pdf_w, 2e-3f * gain) << question.bsdf.name;
        ASSERT_NEAR(s->f[0], e.f[0], 1e-3f * e.f[0] + 1e-6f) << question.bsdf.name;
      }
      EXPECT_GT(
          cells.p_value([&](const Vec3f& w) { return static_cast<double>(pdf(w)); }, kSamples),
          kLevel / 8)
          << question.bsdf.name << ", class " << static_cast<int>(c);
    }
  }
  EXPECT_GE(questions, 7);
}

// Russian roulette omits the factor of refraction for guided directions as well.
TEST(GuidedDirection, ScalesByRefractionAsTheBsdfDoes) {
  BsdfArena arena;
  const float eta = 1.5f;
  const Bsdf& glass = *dielectric_case(eta, 0.3f, 0.3f).make(arena);
  const Frame frame;
  const ForecastLobes lobes = some_lobes();
  for (const float angle : {40.0f, 140.0f}) {
    const Vec3f wo = direction_at(angle);
    const GuidedDirection mixture(glass, frame, wo, TransportMode::kRadiance, ClassMask::kAll,
                                  lobes);
    TestRandom random(5);
    int transmitted = 0, reflected = 0;
    for (int i = 0; i < 4000; ++i) {
      // Numbers below one half choose a lobe of the forecast.
      const float uc = 0.5f * random.next();
      float gain = 0;
      const auto s = mixture.sample(uc, random.next2(), gain);
      if (!s) continue;
      ++(s->transmitted ? transmitted : reflected);
      ASSERT_FLOAT_EQ(s->eta, !s->transmitted ? 1.0f : wo.z > 0 ? eta : 1 / eta);
    }
    EXPECT_GT(transmitted, 50) << angle;
    EXPECT_GT(reflected, 50) << angle;
  }
}

TEST(GuidedDirection, WithoutAForecastIsTheBsdf) {
  BsdfArena arena;
  const BsdfCase coated = coated_diffuse_case(1.5f, 0.3f, 0.01f, 0.7f);  // keeps its table
  const Bsdf& bsdf = *coated.make(arena);
  const Vec3f wo = direction_at(40);
  const ForecastLobes none;
  const Frame frame;
  const GuidedDirection mixture(bsdf, frame, wo, TransportMode::kRadiance, ClassMask::kAll, none);
  TestRandom random(3);
  for (int i = 0; i < 1000; ++i) {
    const float uc = random.next();
    const Vec2f u = random.next2();
    float gain = 0;
    const auto a = mixture.sample(uc, u, gain),
               b = bsdf.sample(wo, uc, u, TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_EQ(a->wi.x, b->wi.x);
    EXPECT_EQ(a->pdf_w, b->pdf_w);
    EXPECT_EQ(a->event, b->event);
    EXPECT_EQ(gain, 1);
  }
}

TEST(ForecastMap, LooksTowardsTheCastersOfTheNearest) {
  TestRandom random(4);
  std::vector<CausticRecord> records;
  const Vec3f left(-3, 0, 2), right(3, 0, 2);
  for (int i = 0; i < 1000; ++i) {
    const Vec2f u = random.next2();
    const Vec3f p(8 * u.x - 4, u.y, 0);
    records.push_back({p, p.x < 0 ? left : right});
  }
  const ForecastMap map(records);
  for (int i = 0; i < 100; ++i) {
    const Vec2f u = random.next2();
    const Vec3f p(8 * u.x - 4, u.y, 0.05f);
    std::vector<CausticRecord> by_distance = records;
    std::sort(by_distance.begin(), by_distance.end(), [&](const auto& a, const auto& b) {
      return length_squared(a.p - p) < length_squared(b.p - p);
    });
    by_distance.resize(ForecastLobes::kMaxLobes);
    const float reach = length(by_distance.back().p - p);
    ForecastLobes expected;
    for (const CausticRecord& record : by_distance) {
      const float distance = length(record.caster - p);
      const Vec3f axis = (record.caster - p) / distance;
      std::vector<float> gaps;  // the first one is to the axis itself
      for (const CausticRecord& other : by_distance)
        gaps.push_back(length(normalize(other.caster - p) - axis));
      std::sort(gaps.begin(), gaps.end());
      expected.add(axis, std::max(0.5f * reach / distance, std::min(gaps[2], 0.5f)));
    }
    const ForecastLobes found = map.lobes_at(p);
    ASSERT_EQ(found.count(), ForecastLobes::kMaxLobes);
    for (const Vec3f& w : {normalize(left - p), normalize(right - p), Vec3f(0, 0, 1)})
      EXPECT_NEAR(found.pdf_w(w), expected.pdf_w(w), 1e-4f * (1 + expected.pdf_w(w)));
  }
}

TEST(ForecastMap, SaysNothingWhereItKnowsNothing) {
  EXPECT_TRUE(ForecastMap().lobes_at({0, 0, 0}).empty());
  const CausticRecord record{{0, 0, 0}, {0, 0, 1}};
  for (const size_t count : {size_t{1}, size_t{15}, size_t{16}}) {
    const ForecastMap few(std::vector<CausticRecord>(count, record));
    EXPECT_EQ(few.foretells(), count == 16);
    EXPECT_EQ(few.lobes_at({0.1f, 0, 0}).empty(), !few.foretells()) << count;
  }
  const ForecastMap map(std::vector<CausticRecord>(100, record));
  EXPECT_FALSE(map.lobes_at({0.1f, 0, 0}).empty());
  EXPECT_TRUE(map.lobes_at({50, 0, 0}).empty()) << "all records are far away";
}

}  // namespace
}  // namespace nephroid
