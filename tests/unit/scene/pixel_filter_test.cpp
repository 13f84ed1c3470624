// Every filter: sample weights have mean 1, and samples are distributed like the filter.
#include "scene/pixel_filter.h"

#include <gtest/gtest.h>

#include "core/sampler.h"

namespace nephroid {
namespace {

std::unique_ptr<PixelFilter> filter_named(const std::string& name) {
  DirectiveDescription d;
  d.type = name;
  Diagnostics diagnostics;
  return make_pixel_filter(d, diagnostics);
}

class Filters : public ::testing::TestWithParam<std::string> {};

TEST_P(Filters, WeightsAverageToOneAndFollowTheFilter) {
  const auto filter = filter_named(GetParam());
  constexpr int kN = 1 << 17, kBins = 16;
  double sum = 0, squares = 0;
  std::vector<double> bins(kBins, 0), bins2(kBins, 0);
  for (uint32_t i = 0; i < kN; ++i) {
    const SobolPoint point(i);
    PathSampler sampler(point, hash_combine(7, i));
    const PixelFilter::Sample s = filter->sample(sampler.get_2d());
    ASSERT_LE(std::abs(s.offset.x), filter->radius().x);
    sum += s.weight;
    squares += s.weight * s.weight;
    const int b = std::clamp(static_cast<int>((s.offset.x / filter->radius().x + 1) / 2 * kBins), 0,
                             kBins - 1);
    bins[b] += s.weight;
    bins2[b] += s.weight * s.weight;
  }
  const double error = std::sqrt((squares / kN - sqr(sum / kN)) / kN);
  EXPECT_NEAR(sum / kN, 1.0, 5 * error + 1e-4);
  // Expected share of each column: quadrature of the normalised filter.
  const Vec2f r = filter->radius();
  for (int b = 0; b < kBins; ++b) {
    double expected = 0;
    constexpr int kQ = 64;
    for (int i = 0; i < kQ; ++i)
      for (int j = 0; j < kQ * 4; ++j) {
        const float x =
            r.x * (2 * (static_cast<float>(b) + (static_cast<float>(i) + 0.5f) / kQ) / kBins - 1);
        const float y = r.y * (2 * (static_cast<float>(j) + 0.5f) / (kQ * 4) - 1);
        expected += filter->eval({x, y});
      }
    expected *= (2.0 * r.x / kBins / kQ) * (2.0 * r.y / (kQ * 4));
    const double bin_error = std::sqrt(std::max(bins2[b] / kN - sqr(bins[b] / kN), 0.0) / kN);
    EXPECT_NEAR(bins[b] / kN, expected, 5 * bin_error + 3e-4) << "column " << b;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Filters,
                         ::testing::Values("box", "triangle", "gaussian", "mitchell", "sinc"),
                         [](const auto& test) { return test.param; });

TEST(Filters, UnknownNameIsALocatedError) {
  EXPECT_THROW(filter_named("blurry"), SceneError);
}

}  // namespace
}  // namespace nephroid
