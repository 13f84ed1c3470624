// Majorants: segments of a ray are contiguous, cover exactly the part inside, and bound the
// extinction there.
#include "scene/medium/medium_space.h"
#include "scene/medium/sampled_grid.h"
#include "unit/medium/medium_fixture.h"

namespace nephroid::testing_medium {
namespace {

std::vector<MajorantSegment> segments_of(MajorantIterator iterator) {
  std::vector<MajorantSegment> segments;
  while (const auto s = iterator.next()) {
    segments.push_back(*s);
    if (segments.size() > 1000) break;
  }
  return segments;
}

TEST(MajorantIterator, PiecesAreContiguousAndBruteForceAgrees) {
  constexpr int kResolution[3] = {5, 1, 8};
  std::vector<float> scales;
  TestRandom random(1);
  for (int i = 0; i < 5 * 1 * 8; ++i) scales.push_back(static_cast<float>(i + 1));
  const MediumSpace cube(Mat44d(), {0, 0, 0}, {1, 1, 1});
  int inside = 0;
  for (int n = 0; n < 3000; ++n) {
    Ray ray = random_ray(random, {0.5f, 0.5f, 0.5f}, 2);
    // Some starts and walls on the cell lattice.
    if (n % 5 == 0)
      for (int i = 0; i < 3; ++i)
        ray.o[i] = std::round(ray.o[i] * static_cast<float>(kResolution[i])) /
                   static_cast<float>(kResolution[i]);
    const float t_max = n % 3 == 0 ? random.next() * 2 : kInfinity;
    const auto r = cube.overlap(ray, t_max);
    if (!r) continue;
    ++inside;
    const auto segments = segments_of(
        {r->o, r->d, r->t_min, r->t_max, SampledSpectrum(1.0f), scales.data(), kResolution});
    ASSERT_FALSE(segments.empty());
    ASSERT_EQ(segments.front().t_min, r->t_min);
    ASSERT_EQ(segments.back().t_max, r->t_max);
    for (size_t i = 0; i < segments.size(); ++i) {
      ASSERT_LT(segments[i].t_min, segments[i].t_max);
      if (i > 0) {
        ASSERT_EQ(segments[i].t_min, segments[i - 1].t_max);
      }
      // The cell of a point well inside the segment, computed directly.
      for (const double f : {0.01, 0.5, 0.99}) {
        const double t = segments[i].t_min + f * (double(segments[i].t_max) - segments[i].t_min);
        int cell[3];
        bool clear = true;
        for (int a = 0; a < 3; ++a) {
          const double x = (r->o[a] + t * r->d[a]) * kResolution[a];
          cell[a] = std::clamp(static_cast<int>(std::floor(x)), 0, kResolution[a] - 1);
          clear &= std::abs(x - std::round(x)) > 1e-4;
        }
        if (!clear) continue;
        const float expected = scales[static_cast<size_t>(cell[0] + 5 * (cell[1] + cell[2]))];
        ASSERT_EQ(segments[i].sigma_maj[0], expected) << n << " " << i << " " << f;
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(MajorantIterator, NeighboursWithOneMajorantAreOnePiece) {
  const int resolution[3] = {8, 8, 8};
  std::vector<float> scales(512, 2.0f);
  const auto segments = segments_of(
      {{-1, 0.3, 0.4}, {1, 0.1, 0}, 1, 2, SampledSpectrum(3.0f), scales.data(), resolution});
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].sigma_maj[0], 6.0f);
}

TEST(MajorantIterator, EmptyAndSingle) {
  EXPECT_FALSE(MajorantIterator().next());
  const auto segments = segments_of(MajorantIterator({1, kInfinity, SampledSpectrum(2.0f)}));
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].t_min, 1);
  EXPECT_EQ(segments[0].t_max, kInfinity);
  EXPECT_TRUE(segments_of(MajorantIterator({2, 1, SampledSpectrum(2.0f)})).empty());
}

TEST(Majorants, BoundTheExtinctionAndCoverAllOfIt) {
  for (const MediumCase& c : medium_cases()) {
    TestRandom random(11);
    int met = 0;
    for (int n = 0; n < 400; ++n) {
      const Ray ray = random_ray(random, c.center, c.radius);
      const auto lambda = SampledWavelengths::sample_visible(random.next());
      const float t_max = n % 2 ? kInfinity : c.radius * random.next();
      const auto segments = segments_of(c.medium->majorants(ray, t_max, lambda));
      // The majorant bounds the extinction inside its segment.
      for (const MajorantSegment& s : segments) {
        const float end = std::min(s.t_max, s.t_min + 10 * c.radius);
        for (int i = 0; i < 20; ++i) {
          const float t = s.t_min + (end - s.t_min) * random.next();
          const MediumProperties m = c.medium->at(ray.o + ray.d * t, lambda);
          for (int k = 0; k < kSpectrumSamples; ++k)
            ASSERT_LE(m.sigma_a[k] + m.sigma_s[k], s.sigma_maj[k] * (1 + 1e-6f)) << c.name;
          met += m.sigma_s[0] > 0;
        }
        ASSERT_LE(s.t_max, t_max);
      }
    }
    EXPECT_GT(met, 500) << c.name;
  }
}

TEST(MediumSpace, CutsRaysExactlyAndSurvivesAnything) {
  Diagnostics diagnostics;
  const auto scene = parse_pbrt_string(kUneven + "\n" + named("uniformgrid", "") + "\nWorldBegin",
                                       "t", ".", diagnostics);
  const MediumSpace space(scene.media[0].transform.start, {-1, -2, -1}, {1, 2, 1.5});
  TestRandom random(5);
  int met = 0;
  for (int n = 0; n < 1000; ++n) {
    const Ray ray = random_ray(random, {1, -2, 0.5f}, 10);
    const auto r = space.overlap(ray, kInfinity);
    for (int i = 0; i < 50; ++i) {
      const float t = 20 * random.next();
      const Vec3f p = space.to_cube(ray.o + ray.d * t);
      float outside = -kInfinity;  // distance to the box, in its widths
      for (int a = 0; a < 3; ++a) outside = std::max({outside, -p[a], p[a] - 1});
      if (std::abs(outside) < 1e-4f) continue;
      ASSERT_EQ(outside < 0, r && t >= r->t_min && t < r->t_max);
    }
    met += r.has_value();
  }
  EXPECT_GT(met, 300);

  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float big = std::numeric_limits<float>::max();
  for (const float x : {nan, kInfinity, -kInfinity, big, -big, 1e30f}) {
    EXPECT_FALSE(space.overlap({{x, 0, 0}, {0, 0, 1}, kInfinity, 0}, kInfinity)) << x;
    const auto r = space.overlap({{1, -2, 0.5f}, {x, 0, 1}, kInfinity, 0}, kInfinity);
    EXPECT_EQ(r.has_value(), std::isfinite(x)) << x;
  }
  EXPECT_FALSE(space.overlap({{1, -2, 0.5f}, {0, 0, 1}, kInfinity, 0}, 0));
  EXPECT_FALSE(space.overlap({{1, -2, 0.5f}, {0, 0, 1}, kInfinity, 0}, nan));
}

TEST(Majorants, HugeCoordinatesGiveFiniteNumbers) {
  for (const MediumCase& c : medium_cases())
    for (const float x : {1e30f, -1e38f, kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
      const MediumProperties m = c.medium->at({x, 0.5f, x}, test_wavelengths());
      EXPECT_TRUE(m.sigma_a.is_finite() && m.sigma_s.is_finite() && m.le.is_finite()) << c.name;
    }
}

}  // namespace
}  // namespace nephroid::testing_medium
