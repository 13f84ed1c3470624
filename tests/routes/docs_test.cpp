// Runs docs/routes.md: every route set in it compiles, every word has the owner and layers beside
// it, and every message is exactly the program's.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/errors.h"
#include "integrator/presets/estimator_table.h"
#include "integrator/presets/route_presets.h"
#include "route/compile.h"
#include "routes/oracle_routes.h"
#include "source_directory.h"

namespace nephroid {
namespace {

/// Lines between ```KIND and ```.
struct Block {
  std::string kind;
  int line = 0;
  std::vector<std::string> lines;
};

std::string page() {
  std::ifstream in(testing_support::source_directory() + "/docs/routes.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<Block> blocks() {
  std::istringstream in(page());
  std::vector<Block> all;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.rfind("```", 0) == 0) {
      inside = !inside;
      if (inside) all.push_back({line.substr(3), number, {}});
    } else if (inside) {
      all.back().lines.push_back(line);
    }
  }
  return all;
}

/// The value of `option 'VALUE'` or `option "VALUE"` as a shell would pass it. Empty if the line is
/// not that option.
std::optional<std::string> value_of(const std::string& line, const std::string& option) {
  if (line.rfind(option + " ", 0) != 0) return {};
  const std::string value = line.substr(option.size() + 1);
  const char quote = value[0];
  if (quote != '\'' && quote != '"') return value;
  const std::string inside = value.substr(1, value.size() - 2);
  EXPECT_EQ(value.back(), quote) << line;
  EXPECT_EQ(inside.find_first_of(quote == '"' ? "\"$`\\!" : "'"), std::string::npos)
      << "a shell would not hand this over as it is: " << line;
  return inside;
}

struct Options {
  std::vector<RouteDefinition> routes;
  std::vector<AovDefinition> aovs;
};

/// Reads the lines that are options. Returns the rest as one text.
std::string read_options(const std::vector<std::string>& lines, Options& options) {
  std::string rest;
  for (const std::string& line : lines) {
    if (const auto route = value_of(line, "--route")) {
      options.routes.push_back(parse_route(*route, estimator_traits()));
    } else if (const auto aov = value_of(line, "--aov")) {
      options.aovs.push_back(parse_aov(*aov));
    } else if (const auto preset = value_of(line, "--routes")) {
      const auto routes = route_preset(*preset);
      if (!routes) throw UsageError("there is no preset " + *preset);
      options.routes.insert(options.routes.end(), routes->begin(), routes->end());
    } else {
      rest += line + "\n";
    }
  }
  return rest;
}

RouteCompilation compile_block(const Block& block) {
  Options options;
  const std::string file = read_options(block.lines, options);
  if (file.find_first_not_of(" \n") != std::string::npos)
    for (const RouteDefinition& route : parse_route_file(file, estimator_traits(), "docs.routes"))
      options.routes.push_back(route);
  return compile_routes(options.routes, options.aovs);
}

std::vector<std::string> columns_of(const std::string& row) {
  std::vector<std::string> columns(1);
  for (const char c : row) {
    if (c == '|')
      columns.emplace_back();
    else
      columns.back() += c;
  }
  for (std::string& column : columns) {
    column.erase(0, column.find_first_not_of(' '));
    column.erase(column.find_last_not_of(' ') + 1);
  }
  return columns;
}

/// "PATH | ROUTE | LAYERS | WHY", without the third column if there are no AOVs. Checks all lights
/// but those of media, or those of media as well if the word says M.
/// those of media as well if the word says M.
void check_row(const Routes& routes, const std::string& row) {
  SCOPED_TRACE(row);
  const std::vector<std::string> columns = columns_of(row);
  ASSERT_GE(columns.size(), 2u);
  const oracle::OracleRoutes reader({}, {}, routes.labels());
  const std::vector<oracle::Path> paths = reader.paths_of(columns[0]);
  ASSERT_FALSE(paths.empty()) << "this is not a path";
  const oracle::Alphabet& alphabet = reader.alphabet();
  int compared = 0;
  for (const oracle::Path& path : paths) {
    const LightKind kind = alphabet.light_kind(path.light);
    if (kind == LightKind::kMedium && columns[0].back() != 'M') continue;
    EyeState state = routes.start();
    for (const int e : path.events)
      state = routes.next(
          state, event_symbol(alphabet.event_kind(e), static_cast<Label>(alphabet.event_label(e))));
    const Part part = routes.owner(
        state, light_symbol(kind, static_cast<Label>(alphabet.light_label(path.light))));
    ASSERT_NE(part, kNoPart) << reader.text(path);
    const PartMeaning& meaning = routes.parts()[part];
    EXPECT_EQ(routes.definitions()[size_t(meaning.route)].name, columns[1]) << reader.text(path);
    std::string layers;
    for (const int aov : meaning.aovs)
      layers += (layers.empty() ? "" : " ") + routes.aovs()[size_t(aov)].name;
    if (!routes.aovs().empty()) {
      ASSERT_GE(columns.size(), 3u);
      EXPECT_EQ(layers, columns[2]) << reader.text(path);
    }
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

TEST(Documentation, EveryExampleHolds) {
  int sets = 0, rows = 0;
  std::optional<Routes> routes;
  for (const Block& block : blocks()) {
    SCOPED_TRACE("docs/routes.md:" + std::to_string(block.line));
    if (block.kind == "routes") {
      ++sets;
      try {
        routes = checked_routes(compile_block(block), false);
      } catch (const Error& error) {
        FAIL() << error.what();
      }
    } else if (block.kind == "words") {
      ASSERT_TRUE(routes);
      for (const std::string& row : block.lines) check_row(*routes, row);
      rows += static_cast<int>(block.lines.size());
    } else {
      EXPECT_TRUE(block.kind == "error" || block.kind == "warning" || block.kind == "ebnf")
          << "a block of kind '" << block.kind << "' is not run";
    }
  }
  EXPECT_GE(sets, 15);
  EXPECT_GE(rows, 50);
}

/// The program's messages on the routes of a block: the error, or each warning.
std::vector<std::string> messages_of(const std::vector<std::string>& lines) {
  Options options;
  std::vector<std::string> messages;
  try {
    read_options(lines, options);
    const RouteCompilation compilation = compile_routes(options.routes, options.aovs);
    checked_routes(compilation, false);
    for (const RouteFinding& f : compilation.findings) messages.push_back(f.message + "\n");
  } catch (const Error& error) {
    messages = {std::string(error.what()) + "\n"};
  }
  return messages;
}

TEST(Documentation, EveryMessageIsSaid) {
  int messages = 0;
  for (const Block& block : blocks()) {
    if (block.kind != "error" && block.kind != "warning") continue;
    SCOPED_TRACE("docs/routes.md:" + std::to_string(block.line));
    // Options come first, then the message, which may quote an option on an indented line.
    std::vector<std::string> options;
    std::string expected;
    for (const std::string& line : block.lines) {
      if (line.rfind("--", 0) == 0 && line.find(": column") == std::string::npos &&
          expected.empty())
        options.push_back(line);
      else
        expected += line + "\n";
    }
    const std::vector<std::string> said = messages_of(options);
    if (block.kind == "error") {
      EXPECT_EQ(said, std::vector<std::string>{expected});
    } else {
      EXPECT_NE(std::find(said.begin(), said.end(), expected), said.end())
          << expected << "is not among\n"
          << ::testing::PrintToString(said);
    }
    ++messages;
  }
  EXPECT_GE(messages, 10);
}

TEST(Documentation, NamesAllPresetsAndEstimators) {
  const std::string text = page();
  const auto in_table = [](std::string code) {
    for (size_t i = 0; (i = code.find('|', i)) != std::string::npos; i += 2) code.insert(i, "\\");
    return "`" + code + "`";
  };
  for (const RoutePreset& preset : route_presets()) {
    const size_t row =
        text.find("\n| `" + std::string(preset.name) + "` |", text.find("### Ready-made sets"));
    ASSERT_NE(row, std::string::npos) << preset.name;
    const std::string line = text.substr(row + 1, text.find('\n', row + 1) - row);
    for (const char* route : preset.routes)
      EXPECT_NE(line.find(in_table(route)), std::string::npos) << preset.name << ": " << route;
  }
  for (const EstimatorTraits* estimator : estimator_traits())
    EXPECT_NE(text.find("\n| `" + std::string(estimator->name) + "` |"), std::string::npos)
        << estimator->name;
}

}  // namespace
}  // namespace nephroid
