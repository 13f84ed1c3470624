// EXR headers that must not reach the library, and those that may.
#include "input/exr_header.h"

#include <gtest/gtest.h>

#include <cstring>

#include "input/claimed_size.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::TemporaryDirectory;

std::string number(uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}
std::string text(const std::string& value) {
  return value + std::string(1, '\0');
}
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return text(name) + text(type) + number(static_cast<uint32_t>(value.size())) + value;
}
std::string box(int x0, int y0, int x1, int y1) {
  std::string bytes;
  for (const int c : {x0, y0, x1, y1}) bytes += number(static_cast<uint32_t>(c));
  return bytes;
}
const std::string kChannels = text("B") + std::string(16, 'x') + text("");
const std::string kSound =
    attribute("channels", "chlist", kChannels) + attribute("compression", "compression", "\3") +
    attribute("dataWindow", "box2i", box(-5, 0, 94, 49)) +
    attribute("displayWindow", "box2i", box(0, 0, 2000000000, 2000000000)) +
    attribute("comments", "string", "any length") + attribute("mine", "a type of my own", "123");

class ExrHeader : public ::testing::Test {
 protected:
  std::string fault(const std::string& attributes, uint32_t version = 2) {
    return fault_of(number(20000630) + number(version) + attributes);
  }
  std::string fault_of(const std::string& bytes) {
    return fault_of_exr_header(directory_.write("f.exr", bytes));
  }
  TemporaryDirectory directory_;
};

TEST_F(ExrHeader, WhatIsSoundOrOfAnotherFormatIsLetThrough) {
  EXPECT_EQ(fault(kSound + text("")), "");
  EXPECT_EQ(fault(kSound + text("") + kSound + text("") + text(""), 0x1002), "");
  EXPECT_EQ(fault_of("P6 1 1 255 abc"), "");
  EXPECT_EQ(fault_of(""), "");
  EXPECT_EQ(fault_of_exr_header(directory_.path("absent")), "");
}

TEST_F(ExrHeader, ClaimsBeyondTheFileAreFaults) {
  for (size_t cut = 8; cut < 8 + kSound.size(); ++cut)
    EXPECT_NE(fault_of((number(20000630) + number(2) + kSound).substr(0, cut)), "") << cut;
  EXPECT_NE(fault(text("long") + text("string") + number(0x7fffffff) + "abc" + text("")), "");
  EXPECT_NE(fault(text("negative") + text("string") + number(0xffffffff) + "abc" + text("")), "");
  EXPECT_NE(fault(attribute("dataWindow", "box2i", box(0, 0, 60000, 60000)) + text("")), "");
  EXPECT_NE(fault(attribute("dataWindow", "box2i", box(0, 0, 6000000, 7)) + text("")), "");
  // Also the second part.
  EXPECT_NE(
      fault(kSound + text("") + attribute("dataWindow", "box2i", box(0, 0, 60000, 60000)), 0x1002),
      "");
}

TEST_F(ExrHeader, TilesAndBlocksOfAllThreadsAreBoundedWithAllTheirChannels) {
  constexpr uint32_t kHalf = 1, kFloat = 2;
  const auto channels = [](int count, uint32_t type) {
    std::string list;
    for (int i = 0; i < count; ++i)
      list += text("C" + std::to_string(i)) + number(type) + std::string(12, 'x');
    return attribute("channels", "chlist", list + text(""));
  };
  const auto tiles = [](uint32_t width, uint32_t height) {
    return attribute("tiles", "tiledesc", number(width) + number(height) + '\0');
  };
  const auto window = [](int width, int height) {
    return attribute("dataWindow", "box2i", box(0, 0, width - 1, height - 1));
  };
  const std::string end = text(""), four = channels(4, kFloat), five = channels(5, kFloat);
  // Four channels of 16 MiB each make 64 MiB tiles: four are allowed, five are not.
  EXPECT_EQ(fault(four + window(4096, 4096) + tiles(2048, 2048) + end + std::string(32, 'x')), "");
  EXPECT_NE(fault(five + window(4096, 4096) + tiles(2048, 2048) + end + std::string(32, 'x')), "");
  EXPECT_NE(fault(tiles(2048, 2048) + five + end), "") << "in any order";
  EXPECT_EQ(fault(channels(8, kHalf) + tiles(2048, 2048) + end), "");
  EXPECT_NE(fault(channels(9, kHalf) + tiles(2048, 2048) + end), "");
  EXPECT_NE(fault(four + window(4096, 4096) + tiles(4096, 4096) + end), "");
  EXPECT_EQ(fault(four + window(4096, 4096) + tiles(4096, 4096) + end + std::string(1 << 23, 'x')),
            "")
      << "a file that is large enough";
  EXPECT_NE(fault(channels(1, kFloat) + tiles(0xffffffff, 0xffffffff) + end), "");
  EXPECT_EQ(fault(four + window(16384, 256) + end), "");
  EXPECT_NE(fault(five + window(16384, 256) + end), "");
  EXPECT_EQ(fault(channels(64, kFloat) + attribute("compression", "compression", "\3") +
                  window(16384, 256) + end),
            "")
      << "ZIP packs 16 rows together";
  EXPECT_NE(fault(five + window(16384, 256) + tiles(16384, 1) + end + std::string(2048, 'x')), "")
      << "tiles in a picture of rows";
  EXPECT_NE(fault(four + window(16384, 256) + end + five + window(16384, 256) + end + end, 0x1002),
            "")
      << "the second of two parts";
  EXPECT_EQ(fault(four + window(16384, 256) + end + four + window(16384, 256) + end + end, 0x1002),
            "");
  // Every tile has an offset of eight bytes.
  const std::string room(8 * 16, 'x'), one = channels(1, kFloat);
  EXPECT_EQ(fault(one + window(4, 4) + tiles(1, 1) + end + room), "");
  EXPECT_NE(fault(one + window(40, 40) + tiles(1, 1) + end + room), "");
  EXPECT_EQ(fault(one + window(40, 40) + tiles(0, 0) + end + room), "")
      << "the library's to refuse";
}

TEST_F(ExrHeader, DeepPartsAreFaults) {
  const std::string end = text("");
  EXPECT_EQ(fault(attribute("type", "string", "scanlineimage") + end), "");
  EXPECT_NE(fault(attribute("type", "string", "deepscanline") + end), "");
  EXPECT_NE(fault(attribute("type", "string", "deeptile") + end), "");
  EXPECT_EQ(fault(attribute("type", "string", "de") + end), "");
}

TEST_F(ExrHeader, SizesThatTheTypeDoesNotHaveAreFaults) {
  EXPECT_NE(fault(attribute("compression", "compression", "12") + text("")), "");
  EXPECT_NE(fault(attribute("channels", "chlist", kChannels + "more") + text("")), "");
  EXPECT_NE(fault(attribute("channels", "chlist", text("B") + std::string(16, 'x')) + text("")),
            "");
  EXPECT_NE(fault(attribute("preview", "preview", number(100) + number(100) + "abcd") + text("")),
            "");
  EXPECT_EQ(fault(attribute("preview", "preview", number(1) + number(1) + "abcd") + text("")), "");
}

TEST(ClaimedSize, IsComparedWithTheFile) {
  const TemporaryDirectory directory;
  const std::string small = directory.write("s", "12345678");
  EXPECT_TRUE(is_possible_size(uint64_t{64} << 20, small));
  EXPECT_FALSE(is_possible_size((uint64_t{64} << 20) + 65536, small));
  EXPECT_TRUE(is_possible_size(uint64_t{1} << 40, "/dev/null"));
  EXPECT_TRUE(is_possible_size(uint64_t{1} << 30, directory.write("l", std::string(1 << 14, 'x'))));
}

}  // namespace
}  // namespace nephroid
