// Suite files: what is understood, and where each message points.
#include "bench/suite.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bench/json_text.h"
#include "core/errors.h"
#include "source_directory.h"

namespace nephroid {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_suite(text, "dir/s.json");
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

constexpr const char* kWhole = R"({
  "name": "small", "title": "A suite", "description": "Of two.", "time": "1.5m",
  "integrators": [
    {"name": "mixed", "integrator": "mixed", "options": {"alpha": 0.7, "radius": "2"},
     "outliers": "reject"},
    {"name": "split", "routes": "doidge2012", "seed": 18446744073709551615},
    {"name": "own", "route": ["caustic = C D S+ L : photons", "rest = .* : path"]}
  ],
  "scenes": [
    {"name": "cup", "file": "../cup.pbrt", "resolution": [16, 9], "exposure": 0.5,
     "reference": {"integrator": "path", "passes": 7, "options": {"max-depth": 9}},
     "integrators": ["mixed", "own"], "options": {"max-depth": "5"}, "passes": 3,
     "energy": {"caustic_light": "C D S+ L"}, "layer": {"seen": "C D L"},
     "region": {"floor": [0, 1, 0.5, 1]}},
    {"name": "room", "file": "/abs/room.pbrt", "reference": {"file": "room.exr"}}
  ],
  "claims": [
    {"text": "a", "metric": "rmse", "smaller": "mixed", "than": ["own", "split"], "factor": 0.5},
    {"text": "b", "metric": "slope", "of": "own", "between": [-0.6, -0.2], "over": "emitted"},
    {"text": "c", "metric": "relmse", "same": "own", "as": "mixed", "factor": 1.2,
     "at": "emitted", "scenes": ["cup"]},
    {"text": "d", "metric": "flip", "smaller": "own", "than": "mixed", "region": "floor",
     "scenes": ["cup"]},
    {"text": "e", "metric": "relmse", "smaller": "own", "than": "mixed", "layer": "seen",
     "scenes": ["cup"], "at": "time"}
  ]
})";

TEST(Suite, EverythingIsUnderstood) {
  const BenchSuite suite = parse_suite(kWhole, "dir/s.json");
  EXPECT_EQ(suite.name, "small");
  EXPECT_EQ(suite.title, "A suite");
  EXPECT_EQ(suite.limit.seconds, 90);
  ASSERT_EQ(suite.integrators.size(), 3u);
  EXPECT_EQ(suite.integrators[0].options, (SettingList{{"alpha", "0.7"}, {"radius", "2"}}));
  EXPECT_TRUE(suite.integrators[0].reject_outliers);
  EXPECT_FALSE(suite.integrators[1].reject_outliers);
  EXPECT_EQ(suite.integrators[1].seed, 18446744073709551615ull);
  EXPECT_EQ(suite.integrators[2].routes.routes.size(), 2u);
  ASSERT_EQ(suite.scenes.size(), 2u);
  const BenchScene& cup = suite.scenes[0];
  EXPECT_EQ(cup.file, "cup.pbrt");
  EXPECT_EQ(cup.title, "cup");
  EXPECT_EQ(cup.width, 16);
  EXPECT_EQ(cup.height, 9);
  EXPECT_EQ(cup.exposure, 0.5f);
  EXPECT_EQ(cup.limit.passes, 3u);
  EXPECT_EQ(cup.reference.limit.passes, 7u);
  EXPECT_NE(cup.reference.integrator.seed, suite.integrators[0].seed);
  EXPECT_EQ(cup.integrators, (std::vector<std::string>{"mixed", "own"}));
  EXPECT_EQ(cup.energy[0].name, "caustic_light");
  EXPECT_EQ(cup.regions[0].y0, 0.5f);
  EXPECT_EQ(suite.scenes[1].file, "/abs/room.pbrt");
  EXPECT_EQ(suite.scenes[1].reference.file, "dir/room.exr");
  EXPECT_EQ(suite.scenes[1].integrators.size(), 3u);
  EXPECT_EQ(cup.layers[0].expression, "C D L");
  ASSERT_EQ(suite.claims.size(), 5u);
  EXPECT_EQ(suite.claims[0].others.size(), 2u);
  EXPECT_EQ(suite.claims[1].form, BenchClaim::Form::kBetween);
  EXPECT_EQ(suite.claims[1].over, BenchAxis::kEmitted);
  EXPECT_EQ(*suite.claims[2].at_equal, BenchAxis::kEmitted);
  EXPECT_EQ(suite.claims[3].region, "floor");
  EXPECT_EQ(suite.claims[4].layer, "seen");
}

/// A suite with a replaced part, and where a message about it should point.
struct WrongSuite {
  const char *old_part, *new_part;
  const char* at;  ///< the text at the place, as it first occurs
  const char* message;
};

/// "dir/s.json:line:column: " of an offset.
std::string place_in(const std::string& text, size_t offset) {
  size_t line = 1, begin = 0;
  for (size_t i = 0; i < offset; ++i)
    if (text[i] == '\n') {
      ++line;
      begin = i + 1;
    }
  return "dir/s.json:" + std::to_string(line) + ":" + std::to_string(offset - begin + 1) + ": ";
}

TEST(Suite, ErrorsPointAtTheirPlace) {
  const WrongSuite cases[] = {
      {"\"title\"", "\"titel\"", "\"titel\"", "unknown key \"titel\" in a suite, expected one of:"},
      {"\"A suite\"", "[1]", "[1]", "\"title\" is a list, expected a string"},
      {"\"1.5m\"", "\"soon\"", "\"soon\"", "\"time\": 'soon' is not valid, expected a duration"},
      {"\"time\": \"1.5m\"", "\"passes\": 1.5", "1.5", "\"passes\" is 1.5, expected a whole"},
      {"\"time\": \"1.5m\"", "\"time\": \"1s\", \"passes\": 11", "11",
       "\"time\" and \"passes\" both say when to stop"},
      {"\"small\"", "\"a/b\"", "\"a/b\"", "\"a/b\" is not valid as a name"},
      {"0.7", "7", "7, \"rad", "-D alpha: '7' is not valid, expected"},
      {"\"alpha\"", "\"alfa\"", "0.7", "-D: unknown key 'alfa', expected one"},
      {"\"integrator\": \"mixed\"", "\"integrator\": \"magic\"", "\"magic\"", ""},
      {"\"reject\"", "\"maybe\"", "\"maybe\"", "\"outliers\" is \"maybe\", expected"},
      {"\"doidge2012\"", "\"nowhere\"", "\"nowhere\"", "--routes: 'nowhere' is neither a preset"},
      {"\"own\", \"route\"", "\"split\", \"route\"", "\"split\", \"route\"",
       "the name \"split\" is taken"},
      {"caustic = C", "caustic C", "\"caustic C", ""},
      {", \"route\"", ", \"integrator\": \"path\", \"route\"", "{\"name\": \"own\"",
       "an integrator needs exactly one of"},
      {"[16, 9]", "[16, 9.5]", "9.5", "a side of \"resolution\" is not whole"},
      {"[16, 9]", "[16]", "[16]", "\"resolution\" is not valid, expected [width, height]"},
      {"\"passes\": 7, ", "", "{\"integrator\": \"path\"", "a reference that is rendered needs"},
      {"[\"mixed\", \"own\"]", "[\"mixed\", \"mine\"]", "\"mine\"", "unknown integrator \"mine\""},
      {"[0, 1, 0.5, 1]", "[0, 1, 1, 0.5]", "[0, 1, 1", "region \"floor\" is not valid"},
      {"\"reference\": {\"file\": \"room.exr\"}", "\"title\": \"\"", "{\"name\": \"room\"",
       "a scene has no \"reference\", expected one"},
      {"\"room.exr\"}", "\"room.exr\", \"seed\": 3}", "{\"file\": \"room.exr\"",
       "a reference from a \"file\" is not rendered"},
      {"\"metric\": \"rmse\"", "\"metric\": \"beauty\"", "\"beauty\"",
       "unknown metric \"beauty\", expected one of: rmse, relmse"},
      {"\"than\": [\"own\"", "\"than\": [\"owl\"", "\"owl\"", "unknown integrator \"owl\""},
      {"\"smaller\": \"mixed\", ", "", "{\"text\": \"a\"", "a claim needs exactly one of"},
      {"[-0.6, -0.2]", "[-0.2, -0.6]", "-0.6", "\"between\" is -0.6, expected a number from -0.2"},
      {"\"same\": \"own\"", "\"same\": \"split\"", "\"cup\"]}",
       "scene \"cup\" has no integrator \"split\""},
      {"\"region\": \"floor\",", "\"region\": \"roof\",", "\"cup\"]},\n    {\"text\": \"e\"",
       "scene \"cup\" has no region \"roof\""},
      {"\"metric\": \"flip\"", "\"metric\": \"memory\"", "\"floor\",", "\"region\" does not fit"},
      // Of a rendered reference, of the runs, and of the shares.
      {"{\"caustic_light\"", "{\"diffuse\"", "\"diffuse\"",
       "the name \"diffuse\" is taken by a route of reference, expected another one"},
      {"{\"seen\"", "{\"caustic\"", "\"caustic\": \"C D L",
       "the name \"caustic\" is taken by a route of mixed"},
      {"{\"seen\"", "{\"caustic_light\"", "\"caustic_light\": \"C D L",
       "the name \"caustic_light\" is taken by \"energy\""},
      {"C D L", "C D (L", "\"C D (L", ""},
      {"\"layer\": \"seen\"", "\"layer\": \"lost\"", "\"cup\"], \"at\"",
       "scene \"cup\" has no layer \"lost\""},
      {"\"metric\": \"relmse\", \"smaller\"", "\"metric\": \"rays\", \"smaller\"", "\"seen\",",
       "\"layer\" does not fit"},
      {"\"metric\": \"rmse\", \"smaller\"", "\"metric\": \"slope\", \"smaller\"",
       "\"slope\", \"smaller\"", "slopes are not compared"},
      {"\"over\": \"emitted\"", "\"factor\": 2", "\"factor\": 2",
       "unknown key \"factor\" in a claim of this form"},
  };
  for (const WrongSuite& wrong : cases) {
    std::string text = kWhole;
    const size_t replaced = text.find(wrong.old_part);
    ASSERT_NE(replaced, std::string::npos) << wrong.old_part;
    text.replace(replaced, std::string(wrong.old_part).size(), wrong.new_part);
    const size_t at = text.find(wrong.at);
    ASSERT_NE(at, std::string::npos) << wrong.at;
    const std::string expected = place_in(text, at) + wrong.message;
    const std::string error = error_of(text);
    EXPECT_EQ(error.substr(0, expected.size()), expected) << error;
  }
}

TEST(Suite, NotAnObject) {
  EXPECT_EQ(error_of("[]"), "dir/s.json:1:1: a suite is a list, expected an object");
  EXPECT_NE(error_of(R"({"name": "x", "integrators": []})").find("\"integrators\" is empty"),
            std::string::npos);
}

TEST(Suite, MissingFile) {
  EXPECT_THROW(read_suite("/nowhere/suite.json"), IoError);
}

JsonValue json(const std::string& text) {
  return parse_json(text, "f");
}

std::string json_error(const std::string& text) {
  try {
    json(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

TEST(JsonText, PlacesOfValues) {
  const JsonValue root =
      json("{\"a\\\\\": [1, -2.5e1,\n  true, null, \"q\\\"\\\\\"],\n \"b\": {}}");
  ASSERT_EQ(root.members.size(), 2u);
  EXPECT_EQ(root.members[0].key, "a\\");
  EXPECT_EQ(root.members[0].where.column, 2);
  const std::vector<JsonValue>& items = root.members[0].value.items;
  ASSERT_EQ(items.size(), 5u);
  const int places[5][2] = {{1, 10}, {1, 13}, {2, 3}, {2, 9}, {2, 15}};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(items[i].where.line, places[i][0]) << i;
    EXPECT_EQ(items[i].where.column, places[i][1]) << i;
  }
  EXPECT_EQ(items[1].number, -25);
  EXPECT_EQ(items[1].text, "-2.5e1");
  EXPECT_EQ(items[4].text, "q\"\\");
  EXPECT_EQ(root.members[1].value.where.line, 3);
  EXPECT_EQ(json(" 12").where.column, 2);
  EXPECT_EQ(json("12").text, "12");
}

TEST(JsonText, Errors) {
  EXPECT_EQ(json_error("{\"a\": 1,\n \"a\": 2}").rfind("f:2:2: \"a\" is given twice", 0), 0u);
  EXPECT_EQ(json_error("[1, 2").rfind("f:1:6: the file ends", 0), 0u) << json_error("[1, 2");
  EXPECT_EQ(json_error("").rfind("f:1:1: the file ends", 0), 0u) << json_error("");
  EXPECT_EQ(json_error("[1,\n x]").rfind("f:2:2: 'x' does not belong here", 0), 0u)
      << json_error("[1,\n x]");
  EXPECT_NE(json_error(std::string(100, '[')).find("nested too deeply"), std::string::npos);
}

TEST(OwnSuites, AreUnderstoodAndNameScenesThatAreThere) {
  size_t suites = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(testing_support::source_directory() + "/bench")) {
    if (entry.path().extension() != ".json") continue;
    ++suites;
    const BenchSuite suite = read_suite(entry.path().string());
    for (const BenchScene& scene : suite.scenes)
      EXPECT_TRUE(std::filesystem::exists(scene.file)) << scene.file;
  }
  EXPECT_GE(suites, 3u);
}

}  // namespace
}  // namespace nephroid
