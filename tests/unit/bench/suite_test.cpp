// Suite files: valid contents, and the location that each message names.
#include "bench/suite.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "bench/suite_fields.h"
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

/// A suite with one part replaced, and the location that its message must name.
struct WrongSuite {
  const char *old_part, *new_part;
  const char* pointer;
  const char* message;
};

TEST(Suite, ErrorsPointAtTheirPlace) {
  const WrongSuite cases[] = {
      {"\"title\"", "\"titel\"", "/titel", "unknown key \"titel\" in a suite, expected one of:"},
      {"\"A suite\"", "[1]", "/title", "\"title\" is a list, expected a string"},
      {"\"1.5m\"", "\"soon\"", "/time", "\"time\": 'soon' is not valid, expected a duration"},
      {"\"time\": \"1.5m\"", "\"passes\": 1.5", "/passes", "\"passes\" is 1.5, expected a whole"},
      {"\"time\": \"1.5m\"", "\"time\": \"1s\", \"passes\": 11", "/passes",
       "\"time\" and \"passes\" both say when to stop"},
      {"\"small\"", "\"a/b\"", "/name", "\"a/b\" is not valid as a name"},
      {"0.7", "7", "/integrators/0/options/alpha", "-D alpha: '7' is not valid, expected"},
      {"\"alpha\"", "\"alfa\"", "/integrators/0/options/alfa",
       "-D: unknown key 'alfa', expected one"},
      {"\"integrator\": \"mixed\"", "\"integrator\": \"magic\"", "/integrators/0/integrator", ""},
      {"\"reject\"", "\"maybe\"", "/integrators/0/outliers", "\"outliers\" is \"maybe\", expected"},
      {"\"doidge2012\"", "\"nowhere\"", "/integrators/1/routes",
       "--routes: 'nowhere' is neither a preset"},
      {"\"own\", \"route\"", "\"split\", \"route\"", "/integrators/2/name",
       "the name \"split\" is taken"},
      {"caustic = C", "caustic C", "/integrators/2/route/0", ""},
      {", \"route\"", ", \"integrator\": \"path\", \"route\"", "/integrators/2",
       "an integrator needs exactly one of"},
      {"[16, 9]", "[16, 9.5]", "/scenes/0/resolution/1", "a side of \"resolution\" is not whole"},
      {"[16, 9]", "[16]", "/scenes/0/resolution",
       "\"resolution\" is not valid, expected [width, height]"},
      {"\"passes\": 7, ", "", "/scenes/0/reference", "a reference without \"file\" has no limit"},
      {"[\"mixed\", \"own\"]", "[\"mixed\", \"mine\"]", "/scenes/0/integrators/1",
       "unknown integrator \"mine\""},
      {"[0, 1, 0.5, 1]", "[0, 1, 1, 0.5]", "/scenes/0/region/floor",
       "region \"floor\" is not valid"},
      {"\"reference\": {\"file\": \"room.exr\"}", "\"title\": \"\"", "/scenes/1",
       "a scene has no \"reference\", expected one"},
      {"\"room.exr\"}", "\"room.exr\", \"seed\": 3}", "/scenes/1/reference",
       "a reference has \"file\" and other keys"},
      {"\"metric\": \"rmse\"", "\"metric\": \"beauty\"", "/claims/0/metric",
       "unknown metric \"beauty\", expected one of: rmse, relmse"},
      {"\"than\": [\"own\"", "\"than\": [\"owl\"", "/claims/0/than/0",
       "unknown integrator \"owl\""},
      {"\"smaller\": \"mixed\", ", "", "/claims/0", "a claim needs exactly one of"},
      {"[-0.6, -0.2]", "[-0.2, -0.6]", "/claims/1/between/1",
       "\"between\" is -0.6, expected a number from -0.2"},
      {"\"same\": \"own\"", "\"same\": \"split\"", "/claims/2/scenes/0",
       "scene \"cup\" has no integrator \"split\""},
      {"\"region\": \"floor\",", "\"region\": \"roof\",", "/claims/3/scenes/0",
       "scene \"cup\" has no region \"roof\""},
      {"\"metric\": \"flip\"", "\"metric\": \"memory\"", "/claims/3/region",
       "\"region\" does not fit"},
      // Names taken by a rendered reference, by the runs, and by shares.
      {"{\"caustic_light\"", "{\"diffuse\"", "/scenes/0/energy/diffuse",
       "the name \"diffuse\" is taken by a route of reference, expected another one"},
      {"{\"seen\"", "{\"caustic\"", "/scenes/0/layer/caustic",
       "the name \"caustic\" is taken by a route of mixed"},
      {"{\"seen\"", "{\"caustic_light\"", "/scenes/0/layer/caustic_light",
       "the name \"caustic_light\" is also in \"energy\","},
      {"C D L", "C D (L", "/scenes/0/layer/seen", ""},
      {"\"layer\": \"seen\"", "\"layer\": \"lost\"", "/claims/4/scenes/0",
       "scene \"cup\" has no layer \"lost\""},
      {"\"metric\": \"relmse\", \"smaller\"", "\"metric\": \"rays\", \"smaller\"",
       "/claims/4/layer", "\"layer\" does not fit"},
      {"\"metric\": \"rmse\", \"smaller\"", "\"metric\": \"slope\", \"smaller\"",
       "/claims/0/metric", "the metric \"slope\" cannot be compared"},
      {"\"over\": \"emitted\"", "\"factor\": 2", "/claims/1/factor",
       "unknown key \"factor\" in a claim of this form"},
  };
  for (const WrongSuite& wrong : cases) {
    std::string text = kWhole;
    const size_t replaced = text.find(wrong.old_part);
    ASSERT_NE(replaced, std::string::npos) << wrong.old_part;
    text.replace(replaced, std::string(wrong.old_part).size(), wrong.new_part);
    const std::string expected = std::string("dir/s.json: ") + wrong.pointer + ": " + wrong.message;
    const std::string error = error_of(text);
    EXPECT_EQ(error.substr(0, expected.size()), expected) << error;
  }
}

TEST(Suite, NotAnObject) {
  EXPECT_EQ(error_of("[]"), "dir/s.json: a suite is a list, expected an object");
  EXPECT_NE(error_of(R"({"name": "x", "integrators": []})").find("\"integrators\" is empty"),
            std::string::npos);
}

TEST(Suite, MissingFile) {
  EXPECT_THROW(read_suite("/nowhere/suite.json"), IoError);
}

std::string json_error(const std::string& text) {
  try {
    parse_json(text, "f");
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

TEST(JsonText, PlacesOfValues) {
  const Json root = parse_json(R"({"a/b": [1, {"c~": true}], "d": "e"})", "f");
  const std::vector<JsonMember> members = JsonValue(root, "f").members();
  ASSERT_EQ(members.size(), 2u);
  EXPECT_EQ(members[0].key, "a/b");
  const std::vector<JsonValue> items = members[0].value.items();
  ASSERT_EQ(items.size(), 2u);
  const auto place = [](const JsonValue& value) {
    try {
      value.fail("wrong");
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(place(JsonValue(root, "f")), "f: wrong");
  EXPECT_EQ(place(members[1].value), "f: /d: wrong");
  EXPECT_EQ(place(items[0]), "f: /a~1b/0: wrong");
  EXPECT_EQ(place(*items[1].find("c~")), "f: /a~1b/1/c~0: wrong");
  EXPECT_FALSE(items[1].find("c"));
  EXPECT_TRUE(members[1].value.items().empty());
}

TEST(JsonText, Errors) {
  const std::pair<const char*, const char*> cases[] = {
      {"{\"a\": 1,\n \"a\": 2}", "f: \"a\" is twice in an object, expected once"},
      {"[1, 2", "f:1:6: the file ends"},
      {"", "f:1:1: the file ends"},
      {"[1,\n x]", "f:2:2: found 'x', expected JSON"},
      {"[1,\n  2] 3", "f:2:6: found '3'"},
      {"[\n\"a\n\"]", "f:2:3: found '\n'"},
      {"[1e999]", "f: [json.exception.out_of_range.406] number overflow"},
  };
  for (const auto& [text, message] : cases) {
    const std::string error = json_error(text);
    EXPECT_EQ(error.rfind(message, 0), 0u) << error;
  }
  // A key may recur in another object, and nesting has no limit.
  EXPECT_EQ(parse_json("[{\"a\": {\"a\": 1}}, {\"a\": 2}]", "f").size(), 2u);
  EXPECT_NE(json_error(std::string(1000000, '[')).find("the file ends"), std::string::npos);
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
