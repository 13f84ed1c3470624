// The getters of ParameterSet: values, defaults, located errors, and unused parameters.
#include <gtest/gtest.h>

#include "input/format_rows.h"
#include "input/parameter_reader.h"
#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::error_of;

constexpr FormatParameter kOfSpheres[] = {
    {"float", "radius"},
    {"float", "zmin"},
    {"string", "scheme", "", "", "", Support::kNotNeeded},
    {"string", "hint", "", "", "it is only a hint", Support::kWarned},
};
constexpr FormatType kSphere = {"sphere", {kOfSpheres}};

ParameterSet set_of(const std::string& text) {
  SceneFiles files;
  TokenStream tokens(files);
  tokens.open_text(text, "scene.pbrt");
  Diagnostics diagnostics;
  ParameterSet set;
  set.list = read_parameters(tokens, "srgb", diagnostics);
  return set;
}

TEST(ParameterSet, GetsValues) {
  const ParameterSet set = set_of(
      "\"float f\" .5 \"integer i\" -3 \"bool b\" true \"string s\" \"x\" \"point3 p\" [1 2 3] "
      "\"vector v\" [4 5 6] \"float fs\" [1 2] \"integer is\" [3 4 5] \"point2 p2s\" [1 2 3 4] "
      "\"point p3s\" [1 2 3 4 5 6] \"vector3 vs\" [7 8 9] \"normal ns\" [0 0 1]");
  EXPECT_EQ(set.get_float("f", 9), 0.5f);
  EXPECT_EQ(set.get_int("i", 9), -3);
  EXPECT_EQ(set.get_bool("b", false), true);
  EXPECT_EQ(set.get_string("s", "y"), "x");
  EXPECT_EQ(set.get_point3("p"), Vec3f(1, 2, 3));
  EXPECT_EQ(set.get_vector3("v"), Vec3f(4, 5, 6));
  EXPECT_EQ(set.get_floats("fs"), std::vector<float>({1, 2}));
  EXPECT_EQ(set.get_ints("is"), std::vector<int>({3, 4, 5}));
  EXPECT_EQ(set.get_point2s("p2s"), std::vector<Vec2f>({Vec2f(1, 2), Vec2f(3, 4)}));
  EXPECT_EQ(set.get_point3s("p3s"), std::vector<Vec3f>({Vec3f(1, 2, 3), Vec3f(4, 5, 6)}));
  EXPECT_EQ(set.get_vector3s("vs"), std::vector<Vec3f>({Vec3f(7, 8, 9)}));
  EXPECT_EQ(set.get_normals("ns"), std::vector<Vec3f>({Vec3f(0, 0, 1)}));
  EXPECT_EQ(set.get_floats("f"), std::vector<float>({0.5f}));

  Diagnostics diagnostics;
  set.report_unused("shape \"sphere\"", kSphere, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(ParameterSet, GivesDefaultsForWhatIsAbsent) {
  const ParameterSet set;
  EXPECT_EQ(set.get_float("a", 2.5f), 2.5f);
  EXPECT_EQ(set.get_int("a", 7), 7);
  EXPECT_EQ(set.get_bool("a", true), true);
  EXPECT_EQ(set.get_string("a", "z"), "z");
  EXPECT_FALSE(set.get_point3("a"));
  EXPECT_FALSE(set.get_vector3("a"));
  EXPECT_TRUE(set.get_floats("a").empty());
  EXPECT_TRUE(set.get_ints("a").empty());
  EXPECT_TRUE(set.get_point2s("a").empty());
  EXPECT_TRUE(set.get_point3s("a").empty());
  EXPECT_TRUE(set.get_vector3s("a").empty());
  EXPECT_TRUE(set.get_normals("a").empty());
  EXPECT_EQ(set.find("a"), nullptr);
}

TEST(ParameterSet, FindsByTypeAndLeavesOthersAlone) {
  const ParameterSet set = set_of("\"rgb a\" [1 1 1]");
  EXPECT_EQ(set.find("a", {"texture", "float"}), nullptr);
  EXPECT_FALSE(set.list[0].used);
  EXPECT_EQ(set.find("a", {"texture", "rgb"}), &set.list[0]);
  EXPECT_TRUE(set.list[0].used);
}

TEST(ParameterSet, AWrongTypeIsALocatedError) {
  const ParameterSet set =
      set_of("\n    \"string radius\" \"5\" \"integer i\" 5 \"point3 p\" [1 2 3]");
  EXPECT_EQ(error_of([&] { set.get_float("radius", 1); }),
            "scene.pbrt:2:5: parameter \"radius\" has type \"string\", expected \"float\"");
  EXPECT_EQ(error_of([&] { set.get_float("i", 1); }),
            "scene.pbrt:2:25: parameter \"i\" has type \"integer\", expected \"float\"");
  EXPECT_EQ(error_of([&] { set.get_bool("i", true); }),
            "scene.pbrt:2:25: parameter \"i\" has type \"integer\", expected \"bool\"");
  EXPECT_EQ(error_of([&] { set.get_int("radius", 1); }),
            "scene.pbrt:2:5: parameter \"radius\" has type \"string\", expected \"integer\"");
  EXPECT_EQ(error_of([&] { set.get_string("i", ""); }),
            "scene.pbrt:2:25: parameter \"i\" has type \"integer\", expected \"string\"");
  EXPECT_EQ(error_of([&] { set.get_vector3("p"); }),
            "scene.pbrt:2:39: parameter \"p\" has type \"point3\", expected \"vector3\"");
  EXPECT_EQ(error_of([&] { set.get_point3("i"); }),
            "scene.pbrt:2:25: parameter \"i\" has type \"integer\", expected \"point3\"");
  EXPECT_EQ(error_of([&] { set.get_floats("i"); }),
            "scene.pbrt:2:25: parameter \"i\" has type \"integer\", expected \"float\"");
  EXPECT_EQ(error_of([&] { set.get_ints("p"); }),
            "scene.pbrt:2:39: parameter \"p\" has type \"point3\", expected \"integer\"");
  EXPECT_EQ(error_of([&] { set.get_point2s("p"); }),
            "scene.pbrt:2:39: parameter \"p\" has type \"point3\", expected \"point2\"");
  EXPECT_EQ(error_of([&] { set.get_normals("p"); }),
            "scene.pbrt:2:39: parameter \"p\" has type \"point3\", expected \"normal\"");
}

TEST(ParameterSet, AWrongCountIsALocatedError) {
  const ParameterSet set = set_of(
      "\"float f\" [1 2] \"integer i\" [1 2 3] \"bool b\" [true true] \"string s\" [\"a\" \"b\"]\n"
      "\"point3 p\" [1 2 3 4 5 6]");
  EXPECT_EQ(error_of([&] { set.get_float("f", 1); }),
            "scene.pbrt:1:1: parameter \"f\" has 2 values, expected 1");
  EXPECT_EQ(error_of([&] { set.get_int("i", 1); }),
            "scene.pbrt:1:17: parameter \"i\" has 3 values, expected 1");
  EXPECT_EQ(error_of([&] { set.get_bool("b", true); }),
            "scene.pbrt:1:37: parameter \"b\" has 2 values, expected 1");
  EXPECT_EQ(error_of([&] { set.get_string("s", ""); }),
            "scene.pbrt:1:58: parameter \"s\" has 2 values, expected 1");
  EXPECT_EQ(error_of([&] { set.get_point3("p"); }),
            "scene.pbrt:2:1: parameter \"p\" has 6 numbers, expected 3");
}

// The getters also check sets that do not come from the parser.
TEST(ParameterSet, ChecksSetsThatNoParserMade) {
  ParameterSet set;
  Parameter parameter;
  parameter.name = "a";
  parameter.type = "integer";
  parameter.numbers = {1.5};
  set.list = {parameter};
  EXPECT_EQ(error_of([&] { set.get_int("a", 0); }),
            "parameter \"a\" has a value that is not a 32-bit integer");
  set.list[0].numbers = {3e9};
  EXPECT_EQ(error_of([&] { set.get_ints("a"); }),
            "parameter \"a\" has a value that is not a 32-bit integer");
  set.list[0].numbers = {};
  EXPECT_EQ(error_of([&] { set.get_int("a", 0); }), "parameter \"a\" has 0 values, expected 1");
  set.list[0].type = "float";
  set.list[0].numbers = {1e300};
  EXPECT_EQ(error_of([&] { set.get_float("a", 0); }),
            "parameter \"a\" has a value that is not a finite float");
  set.list[0].type = "point3";
  set.list[0].numbers = {1, 2, 3, 4};
  EXPECT_EQ(error_of([&] { set.get_point3s("a"); }),
            "parameter \"a\" has 4 numbers, expected a multiple of 3");
}

TEST(ParameterSet, ReportsWhatNobodyAskedFor) {
  const ParameterSet set = set_of("\"float radius\" 1 \"float foo\" 2\n\"string bar\" \"x\"");
  set.get_float("radius", 1);
  Diagnostics diagnostics;
  set.report_unused("shape \"sphere\"", kSphere, diagnostics);
  const std::vector<Warning> warnings = diagnostics.warnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(located(warnings[0].where, warnings[0].message),
            "scene.pbrt:1:18: unknown parameter \"foo\" of shape \"sphere\", ignored");
  EXPECT_EQ(located(warnings[1].where, warnings[1].message),
            "scene.pbrt:2:1: unknown parameter \"bar\" of shape \"sphere\", ignored");
}

TEST(ParameterSet, SaysWhyAKnownParameterHasNoEffect) {
  const ParameterSet set =
      set_of("\"float zmin\" 1\n\"string scheme\" \"a\"\n\"string hint\" \"b\"\n\"float radus\" 1");
  Diagnostics diagnostics;
  set.report_unused("shape \"sphere\"", kSphere, diagnostics);
  std::string messages;
  for (const Warning& w : diagnostics.warnings()) messages += located(w.where, w.message) + "\n";
  EXPECT_EQ(
      messages,
      "scene.pbrt:1:1: parameter \"zmin\" of shape \"sphere\" has no effect together with the "
      "other parameters\n"
      "scene.pbrt:3:1: parameter \"hint\" of shape \"sphere\" is ignored: it is only a hint\n"
      "scene.pbrt:4:1: unknown parameter \"radus\" of shape \"sphere\", did you mean "
      "\"radius\"?\n");
}

TEST(ParameterSet, WritesDownWhatItIsAskedFor) {
  ParameterSet set = set_of("\"float radius\" 1");
  std::set<std::string> asked;
  set.asked = &asked;
  set.get_float("radius", 1);
  set.get_string("absent", "");
  set.find("other", {"float"});
  EXPECT_EQ(asked, std::set<std::string>({"radius", "absent", "other"}));
}

}  // namespace
}  // namespace nephroid
