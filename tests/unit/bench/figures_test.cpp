// Slopes and claims on synthetic curves, and stored results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/claims.h"
#include "bench/fit.h"
#include "bench/measure.h"
#include "bench/repeats.h"
#include "core/errors.h"

namespace nephroid {
namespace {

std::vector<CurvePoint> power_law(double exponent, double factor = 3) {
  std::vector<CurvePoint> points;
  for (double x = 1; x < 1000; x *= 1.3) points.push_back({x, factor * std::pow(x, exponent)});
  return points;
}

TEST(Fit, ExponentOfAPowerLaw) {
  EXPECT_NEAR(*log_slope(power_law(-0.5)), -0.5, 1e-12);
  EXPECT_NEAR(*log_slope(power_law(-1.0 / 3)), -1.0 / 3, 1e-12);
}

TEST(Fit, TheFirstHalfOfTheRunDoesNotCount) {
  std::vector<CurvePoint> points = power_law(-0.5);
  const double half = points.back().x / 2;
  for (CurvePoint& p : points)
    if (p.x < half * 0.999) p.y = 100;
  EXPECT_NEAR(*log_slope(points), -0.5, 1e-12);
}

TEST(Fit, LeastSquaresOfThreePoints) {
  // Logarithms (0,0), (1,2), (2,1): slope 1/2.
  const double e = std::exp(1.0);
  EXPECT_NEAR(*log_slope({{1, 1}, {e, e * e}, {e * e, e}}), 0.5, 1e-12);
}

TEST(Fit, TooLittleToTell) {
  EXPECT_FALSE(log_slope({{1, 1}, {2, 2}}));
  EXPECT_FALSE(log_slope({{1, 1}, {2, 0}, {3, -1}, {4, 4}}));
  EXPECT_FALSE(log_slope({{2, 1}, {2, 2}, {2, 3}}));
}

TEST(Fit, BetweenPoints) {
  const std::vector<CurvePoint> points = {{1, 8}, {4, 2}, {16, 2}};
  EXPECT_NEAR(*log_interpolate(points, 2), 4, 1e-12);
  EXPECT_EQ(*log_interpolate(points, 4), 2);
  EXPECT_NEAR(*log_interpolate(points, 9), 2, 1e-12);
  EXPECT_FALSE(log_interpolate(points, 0.5));
  EXPECT_FALSE(log_interpolate(points, 17));
}

TEST(Fit, TheLastOfPointsAtOnePlaceCounts) {
  // For example a photon map, which the first pass emits.
  const std::vector<CurvePoint> points = {{4, 8}, {4, 2}, {4, 1}};
  EXPECT_EQ(*log_interpolate(points, 4), 1);
  EXPECT_FALSE(log_interpolate(points, 3));
  EXPECT_FALSE(log_interpolate(points, 5));
}

/// Two integrators on one scene: after the same passes `fast` has half the error of `slow`, and has
/// emitted four times as many light paths.
BenchResults made_up(const std::string& claim) {
  BenchResults results;
  results.suite = parse_suite(R"({"name": "s", "passes": 1, "integrators": [
      {"name": "fast", "integrator": "mixed"}, {"name": "slow", "integrator": "path"}],
      "scenes": [{"name": "room", "file": "r.pbrt", "reference": {"file": "r.exr"},
                  "layer": {"seen": "C D L"}, "region": {"left": [0, 0.5, 0, 1]}}],
      "claims": [)" + claim + "]}",
                              "s.json");
  BenchSceneResult scene;
  scene.name = "room";
  for (const char* name : {"fast", "slow"}) {
    const bool fast = name[0] == 'f';
    BenchRun run;
    run.integrator = name;
    for (uint32_t passes = 1; passes <= 64; passes *= 2) {
      BenchErrors errors;
      errors.rmse = (fast ? 1 : 2) / std::sqrt(passes);
      errors.mean_error = fast ? -0.01 : 0.02;
      BenchErrors seen;
      seen.rmse = 3.0 / passes;
      run.points.push_back(
          {passes, passes * 0.5, passes * (fast ? 400u : 100u), errors, {{"seen", seen}}});
    }
    run.bytes = fast ? 1000 : 0;
    run.pixel_bytes = fast ? 300 : 0;
    run.first_pass_bytes = fast ? 800 : 0;
    run.regions = {{"left", {fast ? 0.5 : 0.4, 0, 0, 0, 0}}};
    scene.runs.push_back(run);
  }
  results.scenes.push_back(scene);
  return results;
}

BenchVerdict verdict_of(const std::string& claim) {
  return judge_claims(made_up("{\"text\": \"t\", " + claim + "}")).at(0);
}

struct ClaimCase {
  const char* claim;
  BenchVerdict::State state;
};

TEST(Claims, AreJudgedByTheirFigures) {
  using State = BenchVerdict::State;
  const ClaimCase cases[] = {
      {R"("metric": "rmse", "smaller": "fast", "than": "slow")", State::kHolds},
      {R"("metric": "rmse", "smaller": "fast", "than": "slow", "factor": 0.51)", State::kHolds},
      {R"("metric": "rmse", "smaller": "fast", "than": "slow", "factor": 0.49)", State::kFails},
      {R"("metric": "rmse", "smaller": "slow", "than": ["fast"])", State::kFails},
      {R"("metric": "rmse", "same": "fast", "as": "slow", "factor": 1.9)", State::kFails},
      {R"("metric": "rmse", "same": "fast", "as": "slow", "factor": 2.1)", State::kHolds},
      // After the same number of light paths the two are equal.
      {R"("metric": "rmse", "same": "fast", "as": "slow", "factor": 1.001, "at": "emitted")",
       State::kHolds},
      {R"("metric": "rmse", "same": "fast", "as": "slow", "factor": 1.9, "at": "passes")",
       State::kFails},
      {R"("metric": "mean_error", "smaller": "fast", "than": "slow")", State::kHolds},
      {R"("metric": "rmse", "smaller": "fast", "than": "slow", "region": "left")", State::kFails},
      {R"("metric": "slope", "of": "fast", "between": [-0.501, -0.499])", State::kHolds},
      {R"("metric": "slope", "of": "fast", "between": [-0.4, 0], "over": "time")", State::kFails},
      {R"("metric": "memory_growth", "of": "fast", "between": [1.25, 1.25])", State::kHolds},
      // In the layer, fast has emitted four times as much and is no better.
      {R"("metric": "rmse", "same": "fast", "as": "slow", "layer": "seen")", State::kHolds},
      {R"("metric": "rmse", "smaller": "slow", "than": "fast", "layer": "seen", "factor": 0.26,
          "at": "emitted")",
       State::kHolds},
      {R"("metric": "slope", "of": "fast", "between": [-1.01, -0.99], "layer": "seen")",
       State::kHolds},
      {R"("metric": "pixel_memory", "of": "fast", "between": [300, 300])", State::kHolds},
      // Without stored photons there is no memory to compare.
      {R"("metric": "memory", "of": "slow", "between": [0, 9])", State::kNotMeasured},
      {R"("metric": "passes", "of": "slow", "between": [64, 64])", State::kHolds},
  };
  for (const ClaimCase& c : cases) EXPECT_EQ(verdict_of(c.claim).state, c.state) << c.claim;
}

TEST(Claims, FiguresAreSaid) {
  const BenchVerdict verdict =
      verdict_of(R"("metric": "rmse", "smaller": "fast", "than": "slow", "factor": 0.4)");
  ASSERT_EQ(verdict.figures.size(), 1u);
  EXPECT_EQ(verdict.figures[0].scene, "room");
  EXPECT_EQ(verdict.figures[0].text,
            "RMSE: fast 0.125, slow 0.25, ratio 0.5 (at most 0.4 claimed)");
}

TEST(Claims, TheReferencesOwnErrorIsTakenOut) {
  EXPECT_NEAR(without_reference(0.5, 0.3), 0.4, 1e-12);
  EXPECT_NEAR(without_reference(0.3, 0.5), -0.4, 1e-12);
  BenchResults results =
      made_up(R"({"text": "t", "metric": "rmse", "smaller": "fast", "than": "slow"})");
  results.scenes[0].reference.own_error = 0.2;
  EXPECT_EQ(judge_claims(results).at(0).figures.at(0).text,
            "RMSE: fast 0.125, slow 0.25, ratio 0.5 (at most 1 claimed); without the reference's "
            "own error −0.156 and 0.15");
}

TEST(Claims, AMissingRunIsNotMeasured) {
  BenchResults results =
      made_up(R"({"text": "t", "metric": "rmse", "smaller": "fast", "than": "slow"})");
  results.scenes[0].runs[1].failure = "it broke";
  EXPECT_EQ(judge_claims(results).at(0).state, BenchVerdict::State::kNotMeasured);
  results.scenes.clear();
  EXPECT_EQ(judge_claims(results).at(0).state, BenchVerdict::State::kNotMeasured);
}

// A single render is random: the expected error counts.
TEST(Repeats, ErrorsAreThoseOfAllRenders) {
  BenchResults results =
      made_up(R"({"text": "t", "metric": "rmse", "smaller": "fast", "than": "slow"})");
  BenchRun& fast = results.scenes[0].runs[0];
  const double alone = fast.end().errors.rmse;
  EXPECT_EQ(errors_at_end(fast).rmse, alone);
  BenchRun again = fast, broken = fast;
  again.points.back().errors.rmse = 7 * alone;
  again.points.back().errors.mean_error = 0.03;
  again.regions[0].second.rmse = 1.5;
  broken.failure = "it broke";
  fast.again = {again, broken};
  EXPECT_NEAR(errors_at_end(fast).rmse, 5 * alone, 1e-12);
  EXPECT_NEAR(errors_at_end(fast).mean_error, 0.01, 1e-12);
  EXPECT_NEAR(region_errors(fast).at(0).second.rmse, std::sqrt((0.25 + 2.25) / 2), 1e-12);
  EXPECT_EQ(rmse_range(fast).least, alone);
  EXPECT_EQ(rmse_range(fast).most, 7 * alone);
  EXPECT_EQ(results.failures(), 1);
  // Its first run alone would be twice as good as `slow`.
  const BenchVerdict verdict = judge_claims(results).at(0);
  EXPECT_EQ(verdict.state, BenchVerdict::State::kFails);
  EXPECT_NE(verdict.figures.at(0).text.find("over 2 and 1 renders"), std::string::npos);
}

TEST(ResultFiles, ARunComesBackAsItWas) {
  BenchRun run = made_up("").scenes[0].runs[0];
  run.seed = 3;
  run.key = "0123456789abcdef";
  run.picture = "a \"b\".exr";
  run.energy = {{"caustic", 0.25}};
  run.notes = {"a note"};
  const auto back = run_from_json(run_to_json(run));
  ASSERT_TRUE(back);
  EXPECT_EQ(run_to_json(*back), run_to_json(run));
  EXPECT_EQ(back->points.size(), run.points.size());
  EXPECT_EQ(back->end().errors.rmse, run.end().errors.rmse);
  EXPECT_FALSE(run_from_json("{\"key\": 1}"));
  EXPECT_FALSE(run_from_json("half a fi"));
}

TEST(ResultFiles, FiguresThatAreNotFiniteAreReadBack) {
  BenchRun run;
  run.points.resize(1);
  run.points[0].errors.rmse = 0.5;
  run.points[0].errors.mean_error = std::numeric_limits<double>::infinity();
  const auto kept = run_from_json(run_to_json(run));
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->end().errors.rmse, 0.5);
  EXPECT_FALSE(std::isfinite(kept->end().errors.mean_error));
}

// A picture with an infinite standard error is kept like any other.
TEST(ResultFiles, AReferenceWhoseErrorIsNotFiniteIsReadBack) {
  BenchReferenceResult reference;
  reference.key = "0123456789abcdef";
  reference.passes = 7;
  reference.own_error = std::numeric_limits<double>::infinity();
  const auto kept = reference_from_json(reference_to_json(reference));
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->passes, 7u);
  ASSERT_TRUE(kept->own_error);
  EXPECT_FALSE(std::isfinite(*kept->own_error));
  reference.own_error = std::nullopt;
  EXPECT_FALSE(reference_from_json(reference_to_json(reference))->own_error);
}

TEST(ResultFiles, EveryCsvLineHasAllColumns) {
  BenchResults results = made_up("");
  results.scenes[0].runs[0].again = {results.scenes[0].runs[0]};
  results.scenes[0].runs[1].failure = "it broke";
  BenchSceneResult broken;
  broken.name = "lost";
  broken.failure = "no file";
  results.scenes.push_back(broken);
  for (const std::string& csv : {runs_csv(results), curves_csv(results)}) {
    const auto commas = [&](size_t begin, size_t end) {
      return std::count(csv.begin() + static_cast<std::ptrdiff_t>(begin),
                        csv.begin() + static_cast<std::ptrdiff_t>(end), ',');
    };
    const auto columns = commas(0, csv.find('\n'));
    for (size_t begin = 0; begin < csv.size(); begin = csv.find('\n', begin) + 1)
      EXPECT_EQ(commas(begin, csv.find('\n', begin)), columns) << csv.substr(begin, 80);
  }
}

TEST(Measure, ARegionHasThePixelsWhoseCentresItHas) {
  Picture picture;
  picture.channels = {"R", "G", "B"};
  picture.window = {0, 0, 4, 2};
  for (int i = 0; i < 8; ++i)
    for (int c = 0; c < 3; ++c) picture.pixels.push_back(static_cast<float>(i));
  const Picture right = part_of(picture, {"right", 0.5f, 1, 0.5f, 1});
  EXPECT_EQ(right.width(), 2);
  EXPECT_EQ(right.height(), 1);
  EXPECT_EQ(right.pixels, (std::vector<float>{6, 6, 6, 7, 7, 7}));
  EXPECT_EQ(part_of(picture, {"thin", 0.3f, 0.31f, 0, 0.1f}).pixels.size(), 3u);
}

}  // namespace
}  // namespace nephroid
