// Markov chains over known functions: how long chains stay where, and that the sum of a pass is
// unbiased, however short its chains and few its paths.
#include "integrator/metropolis/markov_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr int kCells = 16;

/// Two bright places that small steps do not connect, with black between them and different
/// colours. The integral over each cell has a closed form.
Rgb light_at(double x) {
  if (x < 0.25) return {static_cast<float>(8 * x), 1, 0};
  if (x >= 0.5 && x < 0.5625) return {0, 40, static_cast<float>(640 * (x - 0.5))};
  if (x >= 0.75) return {0.2f, 0.2f, 0.2f};
  return {0, 0, 0};
}
double brightness_at(double x) {
  const Rgb c = light_at(x);
  return (double{c.r} + double{c.g} + double{c.b}) / 3;
}
/// Mean over cell i by the midpoint rule, exact for functions linear within a cell.
Rgb light_of_cell(int i) {
  return light_at((i + 0.5) / kCells);
}

class Toy : public PathFunction {
 public:
  void evaluate(MarkovSample& numbers, FoundLight& found) override {
    const float x = numbers.stream(0).number(0);
    // An unused random number, and a second route whose light is mirrored.
    numbers.stream(1).number(static_cast<int>(x * 10));
    ++found.rays;
    found.add(Vec2f(x * kCells, 0.5f), 0, light_at(double{x}) * kCells);
    found.add(Vec2f(kCells * (1 - x), 0.5f), 1, light_at(double{x}) * (0.5f * kCells));
  }
};
std::unique_ptr<PathFunction> make_toy() {
  return std::make_unique<Toy>();
}

Film film_of_cells() {
  FilmSettings settings;
  settings.width = kCells;
  settings.height = 1;
  settings.crop = {0, 0, kCells, 1};
  settings.color_space = &RgbColorSpace::srgb();
  FilmLayout layout;
  layout.routes = {"there", "mirrored"};
  layout.parts = {{0, {}}, {1, {}}};
  layout.groups = {0, 0};
  return Film(settings, layout);
}
std::unique_ptr<Scene> empty_scene() {
  return scene_from_text(R"(Camera "perspective" PixelFilter "box" WorldBegin)");
}
FilmArea area_of_cells(const PixelFilter& filter) {
  return FilmArea({0, 0, kCells, 1}, filter);
}

TEST(MarkovChain, StaysWhereItIsBrightInProportion) {
  // Every 64th state of long chains: almost independent, for a chi-square test over cells.
  ChainSettings settings;
  settings.large_step = 0.4f;
  double expected[kCells] = {}, total = 0;
  for (int i = 0; i < kCells; ++i) total += expected[i] = brightness_at((i + 0.5) / kCells);
  constexpr int kSamples = 20000;
  int found[kCells] = {};
  Toy toy;
  const auto scene = empty_scene();
  const FilmImportance importance(area_of_cells(*scene->filter));
  MarkovChain chain([](int, int) { return 0.1f; }, 21, settings, importance, toy);
  for (int n = 0; n < kSamples; ++n) {
    for (int i = 0; i < 64; ++i) {
      chain.propose();
      EXPECT_GE(chain.acceptance(), 0);
      EXPECT_LE(chain.acceptance(), 1);
      chain.decide();
    }
    ASSERT_FALSE(chain.current().splats.empty()) << "no chain stays where it is black";
    const float x = chain.current().splats[0].film.x;
    found[std::clamp(static_cast<int>(x), 0, kCells - 1)] += 1;
  }
  double chi_square = 0;
  int cells = 0;
  for (int i = 0; i < kCells; ++i) {
    if (expected[i] == 0) {
      EXPECT_EQ(found[i], 0) << "cell " << i;
      continue;
    }
    const double e = kSamples * expected[i] / total;
    chi_square += (found[i] - e) * (found[i] - e) / e;
    ++cells;
  }
  ASSERT_EQ(cells, 9);
  EXPECT_LT(chi_square, 39.4) << "8 degrees of freedom, level 4e-6";
}

struct PassCase {
  const char* name;
  ChainSettings settings;
  double balance = 1;
  bool importance = false;  ///< uses a wrong importance, learned from paths that see little
};

class ChainPasses : public ::testing::TestWithParam<PassCase> {};

TEST_P(ChainPasses, HaveNoBias) {
  const auto scene = empty_scene();
  const PixelFilter& filter = *scene->filter;
  ChainPilot pilot{FilmImportance(area_of_cells(filter)), {}, GetParam().balance};
  if (GetParam().importance) {
    pilot.importance.record({1, 0.5f}, 3);
    pilot.importance.record({9, 0.5f}, 1);
    pilot.importance.learn();
    EXPECT_GT(pilot.importance.at({15, 0.5f}), 5 * pilot.importance.at({1, 0.5f}));
  }
  constexpr int kSeeds = 32;
  // The same number of paths for any size of pass.
  const auto passes_of_seed = static_cast<uint32_t>(std::max<int64_t>(
      400, 120000 / (GetParam().settings.bootstrap +
                     GetParam().settings.chains * GetParam().settings.mutations)));
  std::atomic<uint64_t> paths{0}, large{0}, small{0};
  const SeedValues values = values_over_seeds(kSeeds, 0, [&](uint64_t seed) {
    ChainStatistics statistics;
    Film film = film_of_cells();
    SplatBuffer buffer(film, 0, filter);
    for (uint32_t pass = 0; pass < passes_of_seed; ++pass) {
      render_chains({seed, pass}, GetParam().settings, pilot, make_toy, buffer, statistics);
      buffer.finish(1);
      film.add_estimates(0, 1);
    }
    paths += statistics.paths;
    large += statistics.large;
    small += statistics.small;
    std::vector<double> cells;
    for (const int route : {0, 1})
      for (int i = 0; i < kCells; ++i) {
        const Rgb v = film.route_value(route, i, 0);
        cells.push_back((double{v.r} + double{v.g} + double{v.b}) / 3);
      }
    return cells;
  });
  for (int i = 0; i < kCells; ++i) {
    const Rgb cell = light_of_cell(i);
    const double expected = (double{cell.r} + double{cell.g} + double{cell.b}) / 3;
    const Estimate a = estimate_of(values[static_cast<size_t>(i)]);
    const Estimate b = estimate_of(values[static_cast<size_t>(2 * kCells - 1 - i)]);
    EXPECT_NEAR(a.mean, expected, kT31 * a.error + 1e-6) << "cell " << i;
    EXPECT_NEAR(b.mean, expected / 2, kT31 * b.error + 1e-6) << "cell " << i;
    EXPECT_LE(a.error, max_error(0.06 * expected)) << "too noisy to tell";
  }
  const ChainSettings& s = GetParam().settings;
  const auto passes = static_cast<uint64_t>(kSeeds) * passes_of_seed;
  EXPECT_EQ(paths, passes * static_cast<uint64_t>(s.bootstrap + s.chains * s.mutations));
  EXPECT_EQ(large + small, passes * static_cast<uint64_t>(s.chains * s.mutations));
  EXPECT_NEAR(static_cast<double>(large) / static_cast<double>(large + small),
              static_cast<double>(s.large_step), 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, ChainPasses,
    ::testing::Values(PassCase{"usual", {64, 4, 64, 0.3f, {}}, 1},
                      PassCase{"small_bootstrap", {2, 3, 50, 0.3f, {}}, 1},
                      PassCase{"one_path_one_chain", {1, 1, 100, 0.3f, {}}, 1},
                      PassCase{"few_mutations", {64, 64, 2, 0.3f, {}}, 1},
                      PassCase{"nearly_no_large_steps", {128, 32, 8, 0.001f, {}}, 1},
                      PassCase{"only_large_steps", {16, 4, 64, 1.0f, {}}, 1},
                      PassCase{"importance", {64, 4, 64, 0.3f, {}}, 1, true},
                      PassCase{"balance_too_low", {32, 4, 64, 0.3f, {}}, 0.01},
                      PassCase{"balance_too_high", {32, 4, 64, 0.3f, {}}, 100},
                      PassCase{"no_balance", {32, 4, 64, 0.3f, {}}, 0}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(MarkovChain, ThePilotMakesTheFilmEquallyBright) {
  const auto scene = empty_scene();
  const FilmArea area = area_of_cells(*scene->filter);
  constexpr int kPaths = 1 << 14;
  const ChainPilot pilot = look_around(3, kPaths, area, 1, make_toy);
  // The importance that all paths would give.
  FilmImportance all(area);
  constexpr int kAll = 1 << 18;
  double mean = 0;
  for (int i = 0; i < kAll; ++i) {
    const double x = (i + 0.5) / kAll, b = brightness_at(x) * kCells;
    all.record({static_cast<float>(x) * kCells, 0.5f}, b);
    all.record({static_cast<float>(1 - x) * kCells, 0.5f}, b / 2);
  }
  all.learn();
  for (int i = 0; i < kAll; ++i) {
    const double x = (i + 0.5) / kAll, b = brightness_at(x) * kCells;
    mean += b / kAll *
            (static_cast<double>(all.at({static_cast<float>(x) * kCells, 0.5f})) +
             static_cast<double>(all.at({static_cast<float>(1 - x) * kCells, 0.5f})) / 2);
  }
  // The importance is 1/(b + 0.05) for brightness b of mean 1: no error of b is amplified. A cell's
  // paths are at most 26 times as bright as the mean. With n paths its share has a standard
  // deviation below sqrt(26/n); seed 3 must stay within 4.5 of them.
  const double noise = 4.5 * std::sqrt(26.0 / kPaths);
  for (int i = 0; i < kCells; ++i) {
    const Vec2f place(static_cast<float>(i) + 0.5f, 0.5f);
    EXPECT_NEAR(pilot.importance.at(place) / all.at(place), 1, noise) << "cell " << i;
  }
  EXPECT_NEAR(pilot.balance / mean, 1, noise);
  ASSERT_EQ(pilot.kinds.size(), 1u);
  EXPECT_GT(pilot.kinds[0], sqr(pilot.balance)) << "a mean of squares";
  const ChainPilot again = look_around(3, kPaths, area, 1, make_toy);
  EXPECT_EQ(again.balance, pilot.balance);
  // With a converged importance, bright cells are visited less than in proportion to brightness.
  const auto weight = [&](int i) { return all.at({static_cast<float>(i) + 0.5f, 0.5f}); };
  EXPECT_GT(weight(6), weight(8)) << "black, with the bright place at a distance";
  EXPECT_GT(weight(13), weight(8)) << "dim";
}

TEST(MarkovChain, LightThatIsNotFiniteIsCountedAndLeftOut) {
  FoundLight found;
  found.add({0, 0}, 0, {1, kInfinity, 0});
  found.add({0, 0}, 0, {1, std::nanf(""), 0});
  found.add({0, 0}, 0, {0, 0, 0});
  EXPECT_EQ(found.bad.size(), 2u);
  EXPECT_TRUE(found.splats.empty());
  const auto scene = empty_scene();
  const FilmImportance importance(area_of_cells(*scene->filter));
  EXPECT_EQ(found.target(importance), 0);
  found.add({0, 0}, 1, {-1, 0.5f, 0.5f});
  EXPECT_GT(found.target(importance), 0) << "a colour whose components add up to nothing";
}

}  // namespace
}  // namespace nephroid
