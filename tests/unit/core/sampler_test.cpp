// Random numbers: stratified, uniform, decorrelated, and pure functions of their key.
#include "core/sampler.h"

#include <gtest/gtest.h>

#include <set>

namespace nephroid {
namespace {

TEST(Sampler, EveryDimensionIsStratified) {
  for (int d = 0; d < kSobolDimensions; ++d) {
    std::set<int> cells;
    for (uint32_t i = 0; i < 64; ++i) {
      const SobolPoint point(i);
      PathSampler s(point, 42);
      s.start_dimension(d);
      cells.insert(static_cast<int>(s.get_1d() * 64));
    }
    EXPECT_EQ(cells.size(), 64u) << "dimension " << d;
  }
}

TEST(Sampler, FirstTwoDimensionsAreANet) {
  for (uint64_t seed = 0; seed < 20; ++seed)
    for (int columns_log2 = 0; columns_log2 <= 6; ++columns_log2) {
      std::set<int> cells;
      for (uint32_t i = 0; i < 64; ++i) {
        const SobolPoint point(i);
        PathSampler s(point, seed);
        const Vec2f u = s.get_2d();
        const int columns = 1 << columns_log2, rows = 64 >> columns_log2;
        cells.insert(static_cast<int>(u.x * static_cast<float>(columns)) * rows +
                     static_cast<int>(u.y * static_cast<float>(rows)));
      }
      EXPECT_EQ(cells.size(), 64u);
    }
}

TEST(Sampler, SecondDimensionIsThatOfSobol) {
  for (uint32_t i = 0; i < 5000; ++i)
    for (const uint32_t index : {i, i * 2654435761u}) {
      const SobolPoint point(index, 2);
      ASSERT_EQ(point.reversed(0), index);
      ASSERT_EQ(point.reversed(1), sobol_second_reversed(index)) << index;
    }
}

TEST(PaddedPoint, EachDecisionIsANetOverAnyRunOfSamples) {
  for (const int decision : {0, 2, 14, 17, 400})
    for (const uint32_t first : {0u, 64u, 64u * 77u})
      for (const int samples_log2 : {2, 4, 6})
        for (int columns_log2 = 0; columns_log2 <= samples_log2; ++columns_log2) {
          std::set<int> cells, numbers;
          const int samples = 1 << samples_log2, columns = 1 << columns_log2,
                    rows = samples >> columns_log2;
          for (int i = 0; i < samples; ++i) {
            PathSampler s(PaddedPoint{first + static_cast<uint32_t>(i)}, 5);
            s.start_dimension(decision);
            const Vec2f u = s.get_2d();
            cells.insert(static_cast<int>(u.x * static_cast<float>(columns)) * rows +
                         static_cast<int>(u.y * static_cast<float>(rows)));
            s.start_dimension(decision);
            numbers.insert(static_cast<int>(s.get_1d() * static_cast<float>(samples)));
          }
          EXPECT_EQ(cells.size(), static_cast<size_t>(samples)) << decision << ' ' << first;
          EXPECT_EQ(numbers.size(), static_cast<size_t>(samples)) << decision << ' ' << first;
        }
}

// The streams of a pixel's paths at one dimension.
TEST(PathSampler, StreamsAreEvenlySpreadOverThePoints) {
  for (const int dimension : {0, 3, 300}) {
    std::set<int> first, second;
    for (uint32_t i = 0; i < 16; ++i) {
      const SobolPoint point(32 + i);
      PathSampler stream = PathSampler(point, 5).stream(dimension);
      const Vec2f u = stream.get_2d(), v = stream.get_2d();
      first.insert(static_cast<int>(u.x * 4) * 4 + static_cast<int>(u.y * 4));
      second.insert(static_cast<int>(v.x * 4) * 4 + static_cast<int>(v.y * 4));
    }
    EXPECT_EQ(first.size(), 16u);
    EXPECT_EQ(second.size(), 16u);
  }
  const SobolPoint point(3);
  const PathSampler of_pixel(point, 5), of_another(point, 6);
  EXPECT_NE(of_pixel.stream(2).get_1d(), of_pixel.stream(3).get_1d());
  EXPECT_NE(of_pixel.stream(2).get_1d(), of_another.stream(2).get_1d());
}

TEST(PaddedPoint, DecisionsHaveNothingToDoWithEachOther) {
  // Pairs of numbers of two decisions, over sixteen samples of many pixels. Each of 4 x 4 cells
  // gets its share, and a pixel hits as many cells as by chance. Sobol' dimensions 2 and 13 would
  // hit 4 of the 16.
  for (const auto& [a, b] : {std::pair{0, 2}, {2, 13}, {4, 7}, {1, 0}, {3, 200}}) {
    std::array<int, 16> histogram{};
    double cells = 0;
    constexpr int kPixels = 4000, kSamples = 16;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      std::set<size_t> hit;
      for (uint32_t i = 0; i < kSamples; ++i) {
        PathSampler s(PaddedPoint{i}, hash_combine(9, pixel));
        s.start_dimension(a);
        const int x = static_cast<int>(4 * s.get_1d());
        s.start_dimension(b);
        const size_t cell = static_cast<size_t>(4 * x + static_cast<int>(4 * s.get_1d()));
        hit.insert(cell);
        ++histogram[cell];
      }
      cells += static_cast<double>(hit.size()) / kPixels;
    }
    // Both numbers are stratified, so counts per cell vary less than by chance: five standard
    // errors of chance are ample.
    for (const int n : histogram) EXPECT_NEAR(n, kPixels, 5 * std::sqrt(kPixels)) << a << ' ' << b;
    // By chance, four points in each row and column hit about eleven cells.
    EXPECT_NEAR(cells, 10.9, 0.3) << a << ' ' << b;
  }
}

TEST(PaddedPoint, UniformOverSeedsAtEveryIndex) {
  for (const int d : {0, 1, 7, 300})
    for (const uint32_t i : {0u, 1u, 77u}) {
      std::array<int, 64> first{}, second{};
      constexpr int kSeeds = 1 << 16;
      for (int seed = 0; seed < kSeeds; ++seed) {
        PathSampler s(PaddedPoint{i}, static_cast<uint64_t>(seed));
        s.start_dimension(d);
        const Vec2f u = s.get_2d();
        ++first[static_cast<size_t>(u.x * 64)];
        ++second[static_cast<size_t>(u.y * 64)];
      }
      for (const auto& histogram : {first, second}) {
        double chi2 = 0;
        for (const int n : histogram) chi2 += sqr(n - kSeeds / 64.0) / (kSeeds / 64.0);
        EXPECT_LT(chi2, 124.8) << "dimension " << d << " index " << i;
      }
    }
}

TEST(Sampler, UniformOverSeedsAtEveryIndex) {
  // At a fixed index and dimension the scramble alone must make the number uniform. Chi-square with
  // 63 degrees of freedom; 124.8 is the quantile for 1e-5.
  for (const int d : {0, 1, 7, 30, 200, 300})
    for (const uint32_t i : {0u, 1u, 77u}) {
      const SobolPoint point(i);
      std::array<int, 64> histogram{};
      constexpr int kSeeds = 1 << 16;
      for (int seed = 0; seed < kSeeds; ++seed) {
        PathSampler s(point, static_cast<uint64_t>(seed));
        s.start_dimension(d);
        ++histogram[static_cast<size_t>(s.get_1d() * 64)];
      }
      double chi2 = 0;
      for (const int n : histogram) chi2 += sqr(n - kSeeds / 64.0) / (kSeeds / 64.0);
      EXPECT_LT(chi2, 124.8) << "dimension " << d << " index " << i;
    }
}

TEST(Sampler, PixelsAreNotCorrelated) {
  // Correlation of neighbouring seeds at the same index has the standard error 1/sqrt(n).
  double sum = 0;
  constexpr int kPairs = 20000;
  const SobolPoint point(5);
  for (int k = 0; k < kPairs; ++k) {
    PathSampler a(point, hash_combine(1, static_cast<uint64_t>(k)));
    PathSampler b(point, hash_combine(1, static_cast<uint64_t>(k + 1)));
    sum += (a.get_1d() - 0.5) * (b.get_1d() - 0.5) * 12;
  }
  EXPECT_LT(std::abs(sum / kPairs), 4.5 / std::sqrt(kPairs));
}

TEST(Sampler, ValuesBelongToTheirDimension) {
  const SobolPoint point(9);
  PathSampler a(point, 3), b(point, 3);
  for (int i = 0; i < 10; ++i) a.get_1d();
  b.start_dimension(10);
  EXPECT_EQ(a.get_1d(), b.get_1d());
}

TEST(Sampler, ScramblePreservesElementaryIntervals) {
  // Numbers with equal first k bits keep them equal under Owen scrambling.
  for (uint32_t seed = 1; seed < 200; ++seed) {
    const uint32_t a = owen_scramble_reversed(reverse_bits(0xabcd0000u), seed * 2654435761u);
    const uint32_t b = owen_scramble_reversed(reverse_bits(0xabcdffffu), seed * 2654435761u);
    EXPECT_EQ(a >> 16, b >> 16);
    EXPECT_NE(a, b);
  }
}

}  // namespace
}  // namespace nephroid
