// Metropolis estimators: kinds of paths are chosen with their stated probabilities, and statistics.
// tests/agreement/metropolis_test.cpp compares pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "integrator/metropolis/metropolis_options.h"
#include "integrator/metropolis/multiplexed.h"
#include "integrator/metropolis/primary_space.h"
#include "integrator/presets/integrator_table.h"
#include "metropolis_scene.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// Index of the estimator of a preset that runs Markov chains.
size_t chains_of(const EstimatorSet& set) {
  for (size_t i = 0; i < set.estimators.size(); ++i) {
    const Estimator* e = set.estimators[i].get();
    if (dynamic_cast<const Multiplexed*>(e) || dynamic_cast<const PrimarySpace*>(e)) return i;
  }
  throw std::logic_error("no chains");
}

EstimatorStatistics statistics_of(const std::string& text, const std::string& integrator,
                                  const IntegratorOptions& options, uint32_t passes) {
  const auto scene = scene_from_text(text);
  EstimatorSet set = make_integrator(integrator, options, *scene);
  Film film = film_for(*scene, set);
  for (uint32_t pass = 0; pass < passes; ++pass) set.render_pass({1, pass}, *scene, film);
  return set.statistics()[chains_of(set)];
}

/// The choice picks each kind as often as it states, for evenly spread numbers.
void expect_shares(const KindChoice& choice) {
  constexpr int kSide = 512;
  std::vector<int> found(choice.kinds(), 0);
  std::vector<double> expected(choice.kinds(), 0.0);
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec2f u((static_cast<float>(i % kSide) + 0.5f) / kSide,
                  (static_cast<float>(i / kSide) + 0.5f) / kSide);
    const KindChoice::Chosen c = choice.choose(u);
    ASSERT_GE(c.length, 0);
    ASSERT_LT(static_cast<size_t>(c.length), choice.lengths());
    ASSERT_GE(c.s, 0);
    ASSERT_LT(c.s, c.length == 0 ? 1 : c.length + 2);
    ASSERT_LT(c.kind, found.size());
    ASSERT_GT(c.probability, 0);
    found[c.kind] += 1;
    expected[c.kind] = double{c.probability} * kSide * kSide;
  }
  // A kind is a rectangle, whose sides are found to less than a point.
  for (size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 2.02 * kSide) << k;
}

/// The probability of a kind.
float share_of(const KindChoice& choice, int length, int s) {
  for (float x = 0.002f; x < 1; x += 0.004f)
    for (float y = 0.002f; y < 1; y += 0.004f)
      if (const auto c = choice.choose({x, y}); c.length == length && c.s == s)
        return c.probability;
  return 0;
}

TEST(KindChoice, ChoosesAsOftenAsItSays) {
  expect_shares(KindChoice(0));
  expect_shares(KindChoice(7));
  const KindChoice guess(4);
  EXPECT_EQ(guess.kinds(), 1u + 3 + 4 + 5 + 6);
  std::vector<double> squares(guess.kinds(), 0.0);
  expect_shares(KindChoice(guess, squares));
  squares = {0.2, 0, 5, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const KindChoice learned(guess, squares);
  expect_shares(learned);
  EXPECT_EQ(learned.kinds(), guess.kinds());
  EXPECT_GT(share_of(learned, 1, 1), share_of(guess, 1, 1)) << "what is bright is tried more often";
  EXPECT_GT(share_of(learned, 1, 1), 3 * share_of(learned, 1, 2)) << "by a technique that finds it";
  EXPECT_GT(share_of(learned, 4, 3), 0) << "what was not seen is still tried";
  EXPECT_EQ(KindChoice(1 << 30).lengths(), 1000u);
}

TEST(KindChoice, TriesWhatIsSeldomAndBrightMoreOftenThanItAddsLight) {
  // Two kinds have the same mean light, but one has it in a hundredth of its paths. Independent
  // paths have the least noise with probabilities proportional to rms light: ten to one.
  const KindChoice guess(1);
  const double p = double{share_of(guess, 1, 0)};
  ASSERT_EQ(guess.kinds(), 4u);
  const std::vector<double> squares = {0, p, 100 * p, 0};
  const KindChoice learned(guess, squares);
  const auto learned_of = [&](int s) {
    const double length_share = double{share_of(learned, 1, 2)} / (0.5 / 3);
    return double{share_of(learned, 1, s)} / length_share - 0.5 / 3;
  };
  EXPECT_NEAR(learned_of(1) / learned_of(0), 10, 1e-3);
}

TEST(Metropolis, CountsItsPathsAndSaysHowItWent) {
  for (const char* integrator : {"mlt", "pssmlt"}) {
    IntegratorOptions options;
    options.edit<MetropolisOptions>().mutations = 20;
    options.edit<MetropolisOptions>().chain_length = 100;
    options.edit<MetropolisOptions>().large_step = 0.25f;
    const EstimatorStatistics s = statistics_of(kHead + kFilm + kWorld, integrator, options, 2);
    // 2880 mutations are 29 chains of 100, plus a bootstrap a quarter as large.
    EXPECT_EQ(s.camera_paths, 2u * (2900 + 725)) << integrator;
    EXPECT_GT(s.rays, s.camera_paths / 2) << integrator;
    EXPECT_GT(s.splats, 1000u) << integrator;
    ASSERT_EQ(s.notes.size(), 1u) << integrator;
    EXPECT_NE(s.notes[0].find("of 1450 bootstrap paths"), std::string::npos) << s.notes[0];
  }
}

TEST(Metropolis, SaysThatItFoundNothing) {
  const EstimatorStatistics s = statistics_of(kHead + kFilm + R"(WorldBegin
      LightSource "point" "point3 from" [0 -5 0]
      Material "diffuse" Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6])",
                                              "pssmlt", {}, 1);
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_NE(s.notes[0].find("none of"), std::string::npos) << s.notes[0];
}

}  // namespace
}  // namespace nephroid
