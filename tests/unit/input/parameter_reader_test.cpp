// Every parameter type: spellings, values with and without brackets, and errors.
#include "input/parameter_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::parse_warnings;

std::vector<Parameter> parameters_in(const std::string& text) {
  SceneFiles files;
  TokenStream tokens(files);
  tokens.open_text(text, "f");
  Diagnostics diagnostics;
  return read_parameters(tokens, "rec2020", diagnostics);
}
Parameter read_one(const std::string& text) {
  const std::vector<Parameter> parameters = parameters_in(text);
  EXPECT_EQ(parameters.size(), 1u) << text;
  return parameters.at(0);
}
std::string error_in(const std::string& text) {
  return error_of([&] { parameters_in(text); });
}

using Numbers = std::vector<double>;
using Strings = std::vector<std::string>;
using Bools = std::vector<bool>;

TEST(ParameterReader, ReadsNumbers) {
  struct Case {
    const char* text;
    const char* type;
    Numbers numbers;
  };
  const Case cases[] = {
      {"\"float a\" 1.5", "float", {1.5}},
      {"\"float a\" [ 1.5 ]", "float", {1.5}},
      {"\"float a\" [1 2 .5 1. +5 1e-3]", "float", {1, 2, 0.5, 1, 5, 1e-3}},
      {"\"integer a\" 7", "integer", {7}},
      {"\"integer a\" [-2147483648 2147483647 1.0 1e3]",
       "integer",
       {-2147483648.0, 2147483647.0, 1, 1000}},
      {"\"point2 a\" [1 2 3 4]", "point2", {1, 2, 3, 4}},
      {"\"vector2 a\" [1 2]", "vector2", {1, 2}},
      {"\"point3 a\" [1 2 3]", "point3", {1, 2, 3}},
      {"\"point a\" [1 2 3]", "point3", {1, 2, 3}},
      {"\"vector3 a\" [1 2 3]", "vector3", {1, 2, 3}},
      {"\"vector a\" [1 2 3]", "vector3", {1, 2, 3}},
      {"\"normal a\" [1 2 3]", "normal", {1, 2, 3}},
      {"\"normal3 a\" [1 2 3 4 5 6]", "normal", {1, 2, 3, 4, 5, 6}},
      {"\"rgb a\" [.1 .2 .3]", "rgb", {0.1, 0.2, 0.3}},
      {"\"blackbody a\" 6500", "blackbody", {6500}},
      {"\"spectrum a\" [400 .5 700 1]", "spectrum", {400, 0.5, 700, 1}},
      {"\" \t float \t a  \" 1", "float", {1}},
  };
  for (const Case& c : cases) {
    const Parameter p = read_one(c.text);
    EXPECT_EQ(p.name, "a") << c.text;
    EXPECT_EQ(p.type, c.type) << c.text;
    EXPECT_EQ(p.numbers, c.numbers) << c.text;
    EXPECT_TRUE(p.strings.empty() && p.bools.empty()) << c.text;
    EXPECT_EQ(p.where.to_string(), "f:1:1") << c.text;
    EXPECT_EQ(p.color_space, "rec2020") << c.text;
    EXPECT_FALSE(p.used) << c.text;
  }
  EXPECT_TRUE(std::signbit(read_one("\"float a\" -0").numbers[0]));
}

TEST(ParameterReader, ReadsStrings) {
  EXPECT_EQ(read_one("\"string a\" \"x y\"").strings, Strings({"x y"}));
  EXPECT_EQ(read_one("\"string a\" [\"x\" \"y\\\"z\" \"\"]").strings, Strings({"x", "y\"z", ""}));
  EXPECT_EQ(read_one("\"string a\" \"true\"").strings, Strings({"true"}));
  EXPECT_EQ(read_one("\"texture a\" [ \"wood\" ]").strings, Strings({"wood"}));
  EXPECT_EQ(read_one("\"texture a\" \"wood\"").type, "texture");
  EXPECT_EQ(read_one("\"spectrum a\" \"metal-Ag-k\"").strings, Strings({"metal-Ag-k"}));
  EXPECT_EQ(read_one("\"spectrum a\" [ \"a.spd\" ]").strings, Strings({"a.spd"}));
}

TEST(ParameterReader, ReadsBoolsWithAndWithoutQuotes) {
  EXPECT_EQ(read_one("\"bool a\" true").bools, Bools({true}));
  EXPECT_EQ(read_one("\"bool a\" \"false\"").bools, Bools({false}));
  EXPECT_EQ(read_one("\"bool a\" [ \"true\" false ]").bools, Bools({true, false}));
}

TEST(ParameterReader, ReadsListsUpToTheNextWord) {
  const std::vector<Parameter> p =
      parameters_in("\"float a\" 1 # comment\n \"string b\" [\"c\"]\nShape \"x\"");
  ASSERT_EQ(p.size(), 2u);
  EXPECT_EQ(p[1].name, "b");
  EXPECT_EQ(p[1].where.to_string(), "f:2:2");
  EXPECT_TRUE(parameters_in("").empty());
  EXPECT_TRUE(parameters_in("Shape").empty());
}

TEST(ParameterReader, TheLastOfTwoCounts) {
  const std::vector<Parameter> p = parameters_in("\"float a\" 1 \"float b\" 2 \"integer a\" 3");
  ASSERT_EQ(p.size(), 2u);
  EXPECT_EQ(p[0].name, "b");
  EXPECT_EQ(p[1].type, "integer");
  EXPECT_EQ(parse_warnings("Film \"rgb\"\n  \"float a\" 1\n  \"float a\" 2\nWorldBegin"),
            "t.pbrt:3:3: parameter \"a\" is given twice, the last one counts\n");
}

TEST(ParameterReader, RefusesBadDeclarations) {
  const std::string list =
      "expected one of: integer, float, point2, vector2, point3, vector3, normal, rgb, blackbody, "
      "spectrum, bool, string, texture";
  EXPECT_EQ(error_in(" \"colour a\" 1"),
            "f:1:2: parameter \"a\" has the unknown type \"colour\", " + list);
  EXPECT_EQ(error_in("\"float\" 1"),
            "f:1:1: \"float\" declares no parameter, expected \"type name\"");
  EXPECT_EQ(error_in("\"\" 1"), "f:1:1: \"\" declares no parameter, expected \"type name\"");
  EXPECT_EQ(error_in("\"float a b\" 1"),
            "f:1:1: \"float a b\" declares no parameter, expected \"type name\"");
}

TEST(ParameterReader, RefusesValuesOfAnotherKind) {
  EXPECT_EQ(error_in("\"float a\" [ 1 \"x\" ]"),
            "f:1:15: parameter \"a\" has type \"float\", expected a number, found \"x\"");
  EXPECT_EQ(error_in("\"float a\" true"),
            "f:1:11: expected a number (parameter \"a\" has type \"float\"), found \"true\"");
  EXPECT_EQ(error_in("\"float a\" 1#2"),
            "f:1:11: expected a number (parameter \"a\" has type \"float\"), found \"1#2\"");
  EXPECT_EQ(error_in("\"integer a\" \"1\""),
            "f:1:13: parameter \"a\" has type \"integer\", expected an integer, found \"1\"");
  EXPECT_EQ(
      error_in("\"string a\" 1"),
      "f:1:12: parameter \"a\" has type \"string\", expected a string in quotes, found \"1\"");
  EXPECT_EQ(error_in("\"texture a\" wood"),
            "f:1:13: parameter \"a\" has type \"texture\", expected a string in quotes, "
            "found \"wood\"");
  EXPECT_EQ(error_in("\"bool a\" 1"),
            "f:1:10: parameter \"a\" has type \"bool\", expected true or false, found \"1\"");
  EXPECT_EQ(error_in("\"bool a\" \"yes\""),
            "f:1:10: parameter \"a\" has type \"bool\", expected true or false, found \"yes\"");
  EXPECT_EQ(error_in("\"spectrum a\" [\"x\" \"y\"]"),
            "f:1:19: parameter \"a\" has type \"spectrum\", expected either numbers or one name, "
            "found \"y\"");
  EXPECT_EQ(error_in("\"spectrum a\" [400 \"y\"]"),
            "f:1:19: parameter \"a\" has type \"spectrum\", expected either numbers or one name, "
            "found \"y\"");
  EXPECT_EQ(error_in("\"spectrum a\" [\"y\" 400]"),
            "f:1:19: parameter \"a\" has type \"spectrum\", expected either numbers or one name, "
            "found \"400\"");
  EXPECT_EQ(error_in("\"float a\" ]"),
            "f:1:11: parameter \"a\" has type \"float\", expected a number, found ']'");
}

TEST(ParameterReader, RefusesNumbersThatDoNotFit) {
  EXPECT_EQ(error_in("\"integer a\" [1 1.5]"),
            "f:1:16: parameter \"a\" has type \"integer\", but \"1.5\" is not an integer");
  EXPECT_EQ(
      error_in("\"integer a\" 2147483648"),
      "f:1:13: parameter \"a\" has type \"integer\", but \"2147483648\" does not fit a 32-bit "
      "integer");
  EXPECT_EQ(
      error_in("\"float a\" -1e39"),
      "f:1:11: parameter \"a\" has type \"float\", but \"-1e39\" does not fit a 32-bit float");
  for (const std::string bad : {"nan", "inf", "-infinity", "1e999"}) {
    EXPECT_EQ(error_in("\"float a\" " + bad),
              "f:1:11: \"" + bad +
                  "\" is not a finite number, expected a number (parameter \"a\" has type "
                  "\"float\")");
  }
}

TEST(ParameterReader, RefusesWrongCounts) {
  const auto count_error = [](const std::string& type, int found, int expected) {
    return "f:1:1: parameter \"a\" has type \"" + type + "\" and " + std::to_string(found) +
           (found == 1 ? " number" : " numbers") + ", expected a multiple of " +
           std::to_string(expected);
  };
  EXPECT_EQ(error_in("\"point2 a\" [1 2 3]"), count_error("point2", 3, 2));
  EXPECT_EQ(error_in("\"vector2 a\" 1"), count_error("vector2", 1, 2));
  EXPECT_EQ(error_in("\"point3 a\" [1 2 3 4]"), count_error("point3", 4, 3));
  EXPECT_EQ(error_in("\"vector3 a\" [1 2]"), count_error("vector3", 2, 3));
  EXPECT_EQ(error_in("\"normal3 a\" [1 2]"), count_error("normal", 2, 3));
  EXPECT_EQ(error_in("\"rgb a\" 1"), count_error("rgb", 1, 3));
  EXPECT_EQ(error_in("\"spectrum a\" [400 1 500]"), count_error("spectrum", 3, 2));
  EXPECT_EQ(error_in("\"float a\" [ ]"),
            "f:1:1: parameter \"a\" has type \"float\", but no values");
  EXPECT_EQ(error_in("\"float a\""), "f:1:1: parameter \"a\" has type \"float\", but no values");
}

TEST(ParameterReader, RefusesBadBrackets) {
  EXPECT_EQ(error_in("\"float a\" [1 [2] ]"),
            "f:1:14: '[' inside of '[ ]', expected a value or ']'");
  EXPECT_EQ(error_in("\"float a\"\n [1 2"),
            "f:2:2: this '[' is not closed before the end of the file");
  EXPECT_EQ(error_in("\"float a\" [1\nShape"),
            "f:2:1: expected a number (parameter \"a\" has type \"float\"), found \"Shape\"");
}

}  // namespace
}  // namespace nephroid
