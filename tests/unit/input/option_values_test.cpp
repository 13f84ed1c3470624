// Option texts that are valid, and those that must be refused.
#include "input/option_values.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "core/errors.h"

namespace nephroid {
namespace {

/// Each text must be refused with a message that names the option and the text.
template <class Parser>
void expect_refused(const Parser& parse, std::initializer_list<const char*> texts) {
  for (const char* text : texts) {
    try {
      parse("--option", text);
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind("--option: '" + std::string(text) + "'", 0), 0u) << message;
      EXPECT_NE(message.find("expected"), std::string::npos) << message;
      EXPECT_EQ(error.status(), ExitStatus::kUsage);
    }
  }
}

TEST(OptionValues, Durations) {
  EXPECT_EQ(parse_duration("--time", "60s"), 60);
  EXPECT_EQ(parse_duration("--time", "90"), 90);
  EXPECT_EQ(parse_duration("--time", "5m"), 300);
  EXPECT_EQ(parse_duration("--time", "1h"), 3600);
  EXPECT_EQ(parse_duration("--time", "1.5h"), 5400);
  EXPECT_EQ(parse_duration("--time", "0.25s"), 0.25);
  expect_refused(parse_duration,
                 {"", "s", "0", "0s", "-1s", "5d", "5 s", "5ms", "nan", "infs", "1e999s", "m5"});
}

TEST(OptionValues, MomentsAreSecondsOrFractionsOfThem) {
  const auto seconds = [](const std::string& option, const std::string& text) {
    return parse_seconds(option, text, 100);
  };
  EXPECT_EQ(seconds("--at", "0"), 0);
  EXPECT_EQ(seconds("--at", "2.5s"), 2.5);
  EXPECT_EQ(seconds("--at", "1/48s"), 1 / 48.0);
  EXPECT_EQ(seconds("--at", "3/2"), 1.5);
  expect_refused(seconds, {"", "s", "-1", "101s", "1/", "/2", "1/0", "1/-2", "1/2/3", "nan", "inf",
                           "1e999", "5m"});
}

TEST(OptionValues, Passes) {
  using Range = std::pair<uint32_t, uint32_t>;
  EXPECT_EQ(parse_passes("--passes", "1"), (Range{0, 0}));
  EXPECT_EQ(parse_passes("--passes", "64"), (Range{0, 63}));
  EXPECT_EQ(parse_passes("--passes", "3..3"), (Range{3, 3}));
  EXPECT_EQ(parse_passes("--passes", "16..31"), (Range{16, 31}));
  expect_refused(parse_passes, {"", "0", "-1", "1.5", "x", "..", "1..", "..2", "3..2", "1...2",
                                "1..2..3", "4294967296", "0..4294967295", " 1"});
}

TEST(OptionValues, Resolution) {
  EXPECT_EQ(parse_resolution("--resolution", "640x360"), (std::pair{640, 360}));
  EXPECT_EQ(parse_resolution("--resolution", "1x65536"), (std::pair{1, 65536}));
  expect_refused(parse_resolution, {"", "640", "x", "640x", "x360", "0x10", "10x0", "-4x4",
                                    "640X360", "640x360x2", "65537x1", "64.5x64"});
}

TEST(OptionValues, Crop) {
  const auto crop = parse_crop("--crop", "0,0.5,0.25,1");
  EXPECT_EQ(crop[0], 0.0f);
  EXPECT_EQ(crop[1], 0.5f);
  EXPECT_EQ(crop[2], 0.25f);
  EXPECT_EQ(crop[3], 1.0f);
  expect_refused(parse_crop, {"", "0,1,0", "0,1,0,1,0", "0,1,0,1.01", "-0.1,1,0,1", "0.5,0.5,0,1",
                              "0,1,0.6,0.4", "0 1 0 1", "0,1,0,", "nan,1,0,1"});
}

TEST(OptionValues, Integers) {
  EXPECT_EQ(parse_integer("-t", "4", 1, 8), 4);
  EXPECT_EQ(parse_integer("-t", "-3", -5, 8), -3);
  const auto one_to_eight = [](const std::string& option, const std::string& text) {
    return parse_integer(option, text, 1, 8);
  };
  expect_refused(one_to_eight, {"", "0", "9", "1.0", "four", "4 ", "99999999999999999999"});
}

TEST(OptionValues, Ranges) {
  using Range = std::pair<float, float>;
  EXPECT_EQ(parse_range("-D", "0.5", 0, 1), (Range{0.5f, 0.5f}));
  EXPECT_EQ(parse_range("-D", "0.25..0.75", 0, 1), (Range{0.25f, 0.75f}));
  EXPECT_EQ(parse_range("-D", "0..1", 0, 1), (Range{0.0f, 1.0f}));
  EXPECT_EQ(parse_range("-D", "1..1", 0, 1), (Range{1.0f, 1.0f}));
  const auto in_unit = [](const std::string& option, const std::string& text) {
    return parse_range(option, text, 0, 1);
  };
  expect_refused(in_unit, {"", "..", "0.5..", "..0.5", "0.7..0.3", "-0.1..0.5", "0.5..1.01", "2",
                           "0.1..0.2..0.3", "0.1-0.2", "0.1.0.2", "nan", "0..nan", "0..inf", "x"});
}

TEST(OptionValues, Seeds) {
  EXPECT_EQ(parse_seed("--seed", "0"), 0u);
  EXPECT_EQ(parse_seed("--seed", "18446744073709551615"), std::numeric_limits<uint64_t>::max());
  expect_refused(parse_seed, {"", "-1", "18446744073709551616", "0x10", "1.5"});
}

TEST(OptionValues, Numbers) {
  EXPECT_EQ(parse_number("-D", "0.5", 0, 1, true), 0.5);
  EXPECT_EQ(parse_number("-D", "0", 0, 1, false), 0.0);
  EXPECT_EQ(parse_number("-D", "1", 0, 1, true), 1.0);
  const auto open = [](const std::string& option, const std::string& text) {
    return parse_number(option, text, 0, 1, true);
  };
  expect_refused(open, {"", "0", "-0.1", "1.01", "inf", "nan", "0,5", "0.5x"});
}

}  // namespace
}  // namespace nephroid
