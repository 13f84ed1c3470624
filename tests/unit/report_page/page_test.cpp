// The report page of suites with pictures of a few pixels.
#include "report_page/page.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"
#include "report_page/svg_plot.h"
#include "unit/bench/bench_runs.h"

namespace nephroid {
namespace {

class Pages : public BenchRuns {
 protected:
  /// The page of the results of run().
  std::string page() {
    write_report(scratch_.file("out/results.json"), scratch_.file("page.html"));
    return text_of_file(scratch_.file("page.html")).value_or("");
  }
  bool shows(const std::string& text) { return page().find(text) != std::string::npos; }
};

/// Names of unbalanced tags, empty if there are none. Style and script are skipped.
std::string unbalanced(const std::string& html) {
  std::vector<std::string> open;
  for (size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    if (html[at + 1] == '!') continue;
    const size_t end = html.find('>', at);
    const bool closes = html[at + 1] == '/';
    const size_t begin = at + (closes ? 2 : 1);
    const std::string name = html.substr(begin, html.find_first_of(" \n/>", begin) - begin);
    if (closes) {
      if (open.empty() || open.back() != name) return name;
      open.pop_back();
    } else if (html[end - 1] != '/') {
      open.push_back(name);
      if (name == "style" || name == "script") at = html.find("</" + name, at) - 1;
    }
  }
  return open.empty() ? "" : open.back();
}

TEST_F(Pages, TheReportStandsByItself) {
  run(small_suite());
  const std::string html = page();
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_NE(html.find("<h1>Tiny &lt;suite&gt;</h1>"), std::string::npos);
  EXPECT_NE(html.find("<p>Two &amp; three.</p>"), std::string::npos);
  // The page loads nothing from outside, neither by tags nor by style.
  for (const char* fetching : {"http:", "https:", "src=\"/", "@import", "url(", "<link"})
    EXPECT_EQ(html.find(fetching), std::string::npos) << fetching;
  for (size_t at = html.find("src=\""); at != std::string::npos; at = html.find("src=\"", at + 1))
    EXPECT_EQ(html.compare(at, 26, "src=\"data:image/png;base64"), 0);
  for (size_t at = html.find("href=\""); at != std::string::npos; at = html.find("href=\"", at + 1))
    EXPECT_EQ(html[at + 6], '#');
  // Reference, two runs, two error maps, and the two sides of the slider.
  size_t pictures = 0;
  for (size_t at = html.find("<img"); at != std::string::npos; at = html.find("<img", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 7u);
}

TEST_F(Pages, ShowTheReferenceRepetitionsAndFailures) {
  std::string suite = small_suite(R"(, {"name": "lost", "file": "/nowhere/s.pbrt",
                                       "reference": {"integrator": "path", "passes": 1}})");
  suite.insert(1, "\"repeat\": 3, ");
  run(suite);
  EXPECT_TRUE(shows("rendered with path, 6 passes in "));
  EXPECT_TRUE(shows("(3 renders: "));
  EXPECT_TRUE(shows("/nowhere/s.pbrt"));
  EXPECT_TRUE(shows("1 part of this benchmark failed"));
  EXPECT_FALSE(shows("stopped before its end"));
  signals_.stop.store(SIGTERM);
  run(suite);
  EXPECT_TRUE(shows("stopped before its end"));
}

TEST_F(Pages, SayWhichPictureIsMissing) {
  const BenchResults results = run(small_suite());
  std::filesystem::remove(results.scenes.at(0).runs.at(1).picture);
  EXPECT_TRUE(shows("room-mixed-"));
  EXPECT_EQ(page().find("<img"), std::string::npos);
}

// Results and their pictures move together.
TEST_F(Pages, FindPicturesBesideTheResults) {
  run(small_suite());
  const std::string before = page();
  std::filesystem::rename(scratch_.file("out"), scratch_.file("moved"));
  write_report(scratch_.file("moved/results.json"), scratch_.file("page.html"));
  EXPECT_EQ(text_of_file(scratch_.file("page.html")), before);
}

TEST_F(Pages, NeedResults) {
  EXPECT_THROW(write_report(scratch_.file("none.json"), scratch_.file("page.html")), IoError);
  write_text(scratch_.file("suite.json"), small_suite());
  EXPECT_THROW(write_report(scratch_.file("suite.json"), scratch_.file("page.html")), UsageError);
  EXPECT_FALSE(std::filesystem::exists(scratch_.file("page.html")));
}

TEST(Plot, TicksOfFewAndOfManyDecades) {
  const auto labels = [](double low, double high) {
    std::vector<double> values;
    for (const LogTick& tick : log_ticks(low, high))
      if (tick.labelled) values.push_back(tick.value);
    return values;
  };
  EXPECT_EQ(labels(1, 1000), (std::vector<double>{1, 10, 100, 1000}));
  EXPECT_EQ(labels(1.5, 25), (std::vector<double>{2, 5, 10, 20}));
  EXPECT_EQ(labels(21, 49), (std::vector<double>{30, 40}));
}

}  // namespace
}  // namespace nephroid
