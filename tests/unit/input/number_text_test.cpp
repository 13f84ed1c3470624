// Every spelling of a number in scene files, and texts that are no number.
#include "input/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace nephroid {
namespace {

TEST(NumberText, ReadsAllSpellings) {
  const std::pair<const char*, double> cases[] = {{"0", 0},
                                                  {"1", 1},
                                                  {"1.", 1},
                                                  {".5", 0.5},
                                                  {"-.5", -0.5},
                                                  {"+5", 5},
                                                  {"+.25", 0.25},
                                                  {"1e-3", 1e-3},
                                                  {"1E3", 1000},
                                                  {"1.5e+2", 150},
                                                  {"-1e2", -100},
                                                  {"000123", 123},
                                                  {"0.1", 0.1},
                                                  {"1e308", 1e308},
                                                  {"4.5e-324", 4.9e-324},
                                                  {"3.14159265358979", 3.14159265358979}};
  for (const auto& [text, expected] : cases) {
    const std::optional<double> value = parse_number(text);
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(*value, expected) << text;
  }
}

TEST(NumberText, KeepsTheSignOfZero) {
  EXPECT_TRUE(std::signbit(*parse_number("-0")));
  EXPECT_FALSE(std::signbit(*parse_number("+0")));
}

TEST(NumberText, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "+", "-", ".", "e5", "1e", "1e+", "abc", "1x", "1,5", "0x10", "+-1",
                           "++1", "-+1", "1 ", " 1", "1.2.3"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(NumberText, PassesOnWhatIsNotFinite) {
  EXPECT_TRUE(std::isinf(*parse_number("1e999")));
  EXPECT_TRUE(std::isinf(*parse_number("-inf")));
  EXPECT_TRUE(std::isnan(*parse_number("nan")));
}

// For any digits before the exponent, and any number of them.
TEST(NumberText, RoundsWhatNoDoubleHolds) {
  const std::string zeros(400, '0');
  const std::string huge[] = {"1e309",
                              "179769313486231580793e289",
                              "1" + zeros,
                              "1" + zeros + ".5",
                              "0.001e400",
                              "1" + zeros + "e-5",
                              "1e99999999999999999999",
                              "+1e+999"};
  const std::string tiny[] = {"1e-400",
                              "2e-324",
                              "0." + zeros + "1",
                              "1" + zeros + "e-800",
                              "0." + zeros + "1e9",
                              "1e-99999999999999999999",
                              "1000E-999"};
  for (const std::string& text : huge) {
    EXPECT_EQ(parse_number(text), HUGE_VAL) << text;
    if (text[0] != '+') {
      EXPECT_EQ(parse_number("-" + text), -HUGE_VAL) << text;
    }
  }
  for (const std::string& text : tiny) {
    EXPECT_EQ(parse_number(text), 0.0) << text;
    EXPECT_TRUE(std::signbit(*parse_number("-" + text))) << text;
  }
  EXPECT_FALSE(parse_number("1e999x"));
}

TEST(NumberText, ReadsIntegersOnly) {
  EXPECT_EQ(parse_integer("42"), 42);
  EXPECT_EQ(parse_integer("+42"), 42);
  EXPECT_EQ(parse_integer("-7"), -7);
  EXPECT_EQ(parse_integer("4294967295"), 4294967295LL);
  for (const char* text : {"", "+", "1.0", "1e3", "x", "99999999999999999999"})
    EXPECT_FALSE(parse_integer(text)) << text;
}

}  // namespace
}  // namespace nephroid
