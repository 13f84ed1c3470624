// Large numbers and memory sizes in readable form.
#include "session/report/short_number.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(ShortNumber, HasThreeDigitsAndTheLetterOfTheThousands) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(12), "12");
  EXPECT_EQ(short_number(999), "999");
  EXPECT_EQ(short_number(1000), "1 k");
  EXPECT_EQ(short_number(1234567), "1.23 M");
  EXPECT_EQ(short_number(-2.5e9), "-2.5 G");
  EXPECT_EQ(short_number(999999), "1 M");
  EXPECT_EQ(short_number(1.2345e16), "12345 T");
}

TEST(ShortCount, HasANounInTheRightNumber) {
  EXPECT_EQ(short_count(0, "photon"), "0 photons");
  EXPECT_EQ(short_count(1, "photon"), "1 photon");
  EXPECT_EQ(short_count(1.5, "path"), "1.5 paths");
  EXPECT_EQ(short_count(1000, "photon"), "1 k photons");
}

TEST(ShortBytes, GoesByPowersOf1024) {
  EXPECT_EQ(short_bytes(0), "0 B");
  EXPECT_EQ(short_bytes(999), "999 B");
  EXPECT_EQ(short_bytes(1023), "0.999 KiB");
  EXPECT_EQ(short_bytes(1024), "1 KiB");
  EXPECT_EQ(short_bytes(1.5 * (1 << 20)), "1.5 MiB");
  EXPECT_EQ(short_bytes(1023.0 * (1 << 20)), "0.999 GiB");
  EXPECT_EQ(short_bytes(1e18), "909495 TiB");
}

}  // namespace
}  // namespace nephroid
