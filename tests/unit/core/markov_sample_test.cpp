// Small steps are symmetric, a rejected proposal leaves no trace, and numbers mutated lazily equal
// those mutated at once.
#include "core/markov_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace nephroid {
namespace {

float origin(int stream, int dimension) {
  return bits_to_unit_float(static_cast<uint32_t>(hash_combine(77, stream, dimension) >> 32));
}

/// Signed distance from a to b on the ring of length 1, in [-1/2, 1/2).
double around(float a, float b) {
  const double d = double{b} - double{a};
  return d - std::floor(d + 0.5);
}

TEST(MarkovSample, SmallStepsAreSymmetricOnTheRing) {
  // From any start, the edge included, steps go up as often as down. Distances both ways are
  // distributed alike: uniformly in the logarithm.
  const SmallStep step;
  constexpr int kSteps = 1 << 16, kCells = 16;
  for (const float start : {0.0f, 0.001f, 0.5f, 0.9999f, kOneMinusEpsilon}) {
    int up[kCells] = {}, down[kCells] = {};
    for (int i = 0; i < kSteps; ++i) {
      const float to = after_small_step(start, step, static_cast<uint32_t>(mix_bits(i + 1) >> 32));
      ASSERT_GE(to, 0.0f);
      ASSERT_LT(to, 1.0f);
      const double d = around(start, to);
      const double u =
          std::log(step.longest / std::abs(d)) / std::log(step.longest / step.shortest);
      ASSERT_GT(u, -1e-3);
      ASSERT_LT(u, 1 + 1e-3);
      const int cell = std::clamp(static_cast<int>(u * kCells), 0, kCells - 1);
      (d > 0 ? up : down)[cell] += 1;
    }
    double chi_square = 0;
    const double expected = kSteps / (2.0 * kCells);
    for (int c = 0; c < kCells; ++c)
      chi_square += (std::pow(up[c] - expected, 2) + std::pow(down[c] - expected, 2)) / expected;
    EXPECT_LT(chi_square, 79.5) << "31 degrees of freedom, level 4e-6, start " << start;
  }
}

TEST(MarkovSample, StepsThereAndBackHaveTheSameDensity) {
  // Counts of steps from cell i of a ring to cell j: a symmetric table.
  constexpr int kCells = 100, kSteps = 1 << 19;
  std::vector<int> from_to(kCells * kCells, 0);
  for (int i = 0; i < kSteps; ++i) {
    const float a = bits_to_unit_float(static_cast<uint32_t>(hash_combine(1, i) >> 32));
    const float b = after_small_step(a, {}, static_cast<uint32_t>(hash_combine(2, i) >> 32));
    from_to[static_cast<size_t>(static_cast<int>(a * kCells) * kCells +
                                static_cast<int>(b * kCells))] += 1;
  }
  double chi_square = 0;
  int pairs = 0;
  for (size_t i = 0; i < kCells; ++i)
    for (size_t j = 0; j < i; ++j) {
      const double there = from_to[i * kCells + j], back = from_to[j * kCells + i];
      if (there + back < 10) continue;
      chi_square += (there - back) * (there - back) / (there + back);
      ++pairs;
    }
  EXPECT_GE(pairs, kCells) << "neighbours, across the seam too";
  EXPECT_GT(from_to[kCells - 1], 0) << "the seam";
  EXPECT_LT(chi_square, pairs + 4.5 * std::sqrt(2.0 * pairs) + 14);
}

/// All numbers of the streams and dimensions under test.
std::vector<float> all_numbers(MarkovSample& sample) {
  std::vector<float> all;
  for (int s = 0; s < MarkovSample::kStreams; ++s)
    for (const int d : {0, 1, 2, 7, 300}) all.push_back(sample.stream(s).number(d));
  return all;
}

TEST(MarkovSample, ARejectedProposalLeavesNoTrace) {
  MarkovSample sample({});
  sample.start(origin, 5);
  std::vector<float> now = all_numbers(sample);
  int large = 0, small = 0, accepted = 0;
  for (int i = 0; i < 200; ++i) {
    (sample.propose(0.3f) ? large : small) += 1;
    const std::vector<float> proposed = all_numbers(sample);
    EXPECT_EQ(proposed, all_numbers(sample)) << "the same number for the same dimension";
    for (size_t k = 0; k < now.size(); ++k) EXPECT_NE(proposed[k], now[k]);
    if (sample.decision() < 0.5f) {
      sample.accept();
      now = proposed;
      ++accepted;
    } else {
      sample.reject();
    }
    EXPECT_EQ(all_numbers(sample), now) << "proposal " << i;
  }
  EXPECT_GT(large, 30);
  EXPECT_GT(small, 100);
  EXPECT_GT(accepted, 60);
}

TEST(MarkovSample, LazyIsTheSameAsEager) {
  // One sample is asked for all numbers of every proposal, the other for few.
  MarkovSample eager({}), lazy({});
  eager.start(origin, 9);
  lazy.start(origin, 9);
  for (int i = 0; i < 400; ++i) {
    ASSERT_EQ(eager.propose(0.1f), lazy.propose(0.1f));
    all_numbers(eager);
    for (int s = 0; s < MarkovSample::kStreams; ++s)
      if (mix_bits(uint64_t(i) * 3 + uint64_t(s) + 1) % 3 == 0) {
        EXPECT_EQ(lazy.stream(s).number(2), eager.stream(s).number(2)) << i;
      }
    const bool accept = eager.decision() < 0.6f;
    accept ? eager.accept() : eager.reject();
    accept ? lazy.accept() : lazy.reject();
    if (i % 40 == 39) {
      EXPECT_EQ(all_numbers(lazy), all_numbers(eager)) << i;
    }
  }
}

TEST(MarkovSample, StartsAnewWithNothingOfTheOldChain) {
  MarkovSample used({}), fresh({});
  used.start([](int, int) { return 0.25f; }, 3);
  for (int i = 0; i < 10; ++i) {
    used.propose(0.5f);
    all_numbers(used);
    used.accept();
  }
  used.start(origin, 4);
  fresh.start(origin, 4);
  EXPECT_EQ(all_numbers(used), all_numbers(fresh));
  used.propose(0.5f);
  fresh.propose(0.5f);
  EXPECT_EQ(all_numbers(used), all_numbers(fresh));
}

}  // namespace
}  // namespace nephroid
