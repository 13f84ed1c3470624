// Ranges of passes: contents, unions, gaps, and text.
#include "session/checkpoint/pass_ranges.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace nephroid {
namespace {

constexpr uint32_t kLast = std::numeric_limits<uint32_t>::max() - 1;

PassRanges ranges(const std::string& text) {
  const auto parsed = PassRanges::parse(text);
  EXPECT_TRUE(parsed) << text;
  return parsed.value_or(PassRanges());
}

TEST(PassRanges, JoinWhatIsNextToEachOther) {
  PassRanges r;
  for (const uint32_t pass : {4u, 0u, 2u, 1u, 9u}) r.add(pass);
  EXPECT_EQ(r.text(), "0..2,4..4,9..9");
  EXPECT_EQ(r.count(), 5u);
  r.add(ranges("3..3,5..8"));
  EXPECT_EQ(r.text(), "0..9");
  EXPECT_EQ(ranges("0..4294967294").count(), (uint64_t{1} << 32) - 1);
  EXPECT_EQ(ranges("0..9,20..29").count({5, 21}), 7u);
  EXPECT_EQ(ranges("0..9").count({20, 29}), 0u);
  EXPECT_EQ(ranges("").text(), "");
  EXPECT_TRUE(ranges("").empty());
}

TEST(PassRanges, TellWhatIsMissing) {
  const PassRanges r = ranges("2..3,7..8");
  EXPECT_EQ(r.first_missing(0), 0u);
  EXPECT_EQ(r.first_missing(2), 4u);
  EXPECT_EQ(r.first_missing(7), 9u);
  EXPECT_EQ(r.first_missing(20), 20u);
  EXPECT_EQ(ranges("0..4294967294").first_missing(5), kLast + 1);
  EXPECT_TRUE(r.contains(8));
  EXPECT_FALSE(r.contains(9));
}

TEST(PassRanges, TellWhatTwoHave) {
  EXPECT_EQ(ranges("0..9,20..29").overlap(ranges("25..40")), (PassRange{25, 29}));
  EXPECT_FALSE(ranges("0..9,20..29").overlap(ranges("10..19,30..4294967294")));
  EXPECT_EQ(ranges("5..4294967294").overlap(ranges("4294967294..4294967294")),
            (PassRange{kLast, kLast}));
}

// All pairs of small sets, compared bit by bit.
TEST(PassRanges, TellWhatTwoHaveHoweverTheyLie) {
  for (uint32_t a = 0; a < 128; ++a)
    for (uint32_t b = 0; b < 128; ++b) {
      PassRanges first, second;
      for (uint32_t bit = 0; bit < 7; ++bit) {
        if (a >> bit & 1) first.add(bit);
        if (b >> bit & 1) second.add(bit);
      }
      const auto both = first.overlap(second);
      ASSERT_EQ(both.has_value(), (a & b) != 0) << a << ' ' << b;
      if (!both) continue;
      const auto lowest = static_cast<uint32_t>(std::countr_zero(a & b));
      ASSERT_EQ(both->first, lowest) << a << ' ' << b;
      ASSERT_EQ(both->last, lowest + static_cast<uint32_t>(std::countr_one((a & b) >> lowest)) - 1);
    }
}

TEST(PassRanges, RefuseOtherText) {
  for (const char* text : {"1", "1..", "..1", "2..1", "0..3,3..4", "4..5,0..1", "0..1,", ",0..1",
                           "0..4294967295", "0..1 ", "a..b", "-1..2", "0..4294967296", "0..1;2..3"})
    EXPECT_FALSE(PassRanges::parse(text)) << text;
}

}  // namespace
}  // namespace nephroid
