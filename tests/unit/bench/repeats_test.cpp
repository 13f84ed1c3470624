// Runs that are repeated with other seeds.
#include "bench/repeats.h"

#include <algorithm>
#include <string>

#include "core/errors.h"
#include "unit/bench/bench_runs.h"

namespace nephroid {
namespace {

/// The small suite with one more member.
std::string suite_with(const std::string& member) {
  std::string suite = small_suite();
  return suite.insert(1, member + ", ");
}

TEST_F(BenchRuns, AreRepeatedWithOtherSeeds) {
  const BenchResults alone = run(small_suite());
  const BenchResults results = run(suite_with("\"repeat\": 3"));
  EXPECT_EQ(results.failures(), 0) << said_;
  ASSERT_EQ(results.scenes.at(0).runs.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const BenchRun& first = results.scenes[0].runs[i];
    EXPECT_TRUE(first.kept);
    EXPECT_EQ(run_to_json(first), run_to_json(alone.scenes.at(0).runs.at(i)));
    ASSERT_EQ(first.again.size(), 2u);
    for (size_t j = 0; j < 2; ++j) {
      EXPECT_EQ(first.again[j].seed, j + 1);
      EXPECT_EQ(first.again[j].integrator, first.integrator);
      EXPECT_NE(first.again[j].end().errors.rmse, first.end().errors.rmse);
    }
  }
  EXPECT_NE(file("results.json").find("errors_of_all"), std::string::npos);
  const std::string csv = file("runs.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
}

TEST_F(BenchRuns, TheCommandLineSaysHowOften) {
  options_.repeat = 2;
  EXPECT_EQ(run(suite_with("\"repeat\": 3")).scenes.at(0).runs.at(0).again.size(), 1u);
}

// With the reference's seed a run would be compared with its own samples.
TEST_F(BenchRuns, DoNotTakeTheSeedOfTheReference) {
  std::string suite = suite_with("\"repeat\": 4");
  const std::string passes = "\"passes\": 6}";
  suite.replace(suite.find(passes), passes.size(), "\"passes\": 6, \"seed\": 2}");
  const BenchResults results = run(suite);
  for (const BenchRun& run : results.scenes.at(0).runs) {
    ASSERT_EQ(run.again.size(), 3u);
    EXPECT_EQ(run.again[0].seed, 1u);
    EXPECT_EQ(run.again[1].seed, 3u);
    EXPECT_EQ(run.again[2].seed, 4u);
  }
}

TEST_F(BenchRuns, WhatFailsIsNotRepeated) {
  // The reference has another size, so the run fails.
  std::string suite = small_suite(R"(, {"name": "small", "file": ")" + kRoom +
                                  R"(", "resolution": [4, 4], "reference": {"file": ")" +
                                  run(small_suite()).scenes.at(0).reference.picture + "\"}}");
  suite.insert(1, "\"repeat\": 3, ");
  const BenchResults results = run(suite);
  ASSERT_EQ(results.scenes.size(), 2u);
  for (const BenchRun& run : results.scenes[1].runs) {
    EXPECT_NE(run.failure, "");
    EXPECT_TRUE(run.again.empty());
  }
  for (const BenchRun& run : results.scenes[0].runs) EXPECT_EQ(run.again.size(), 2u);
  EXPECT_EQ(results.failures(), 2);
}

TEST(Repeats, OfASuiteAreBetweenOneAndAThousand) {
  for (const char* wrong : {"0", "1001", "1.5", "\"many\""})
    EXPECT_THROW(parse_suite(suite_with(std::string("\"repeat\": ") + wrong), "s.json"), UsageError)
        << wrong;
}

}  // namespace
}  // namespace nephroid
