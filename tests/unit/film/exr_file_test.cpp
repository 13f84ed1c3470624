// A picture as a file: rows are read back, layers are as narrow as their values allow, and a failed
// write leaves the old file.
#include "film/exr_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "core/errors.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

/// Taller than the rows written at a time.
Picture some_picture() {
  Picture picture;
  picture.full_width = 100;
  picture.full_height = 200;
  picture.window = {5, 7, 42, 157};
  picture.channels = {"R", "G", "B", "a.R", "a.G", "a.B", "bias.Y"};
  picture.pixels.resize(static_cast<size_t>(picture.window.area()) * picture.channels.size());
  std::iota(picture.pixels.begin(), picture.pixels.end(), 0.0f);
  picture.color_space = RgbColorSpace::find("rec2020");
  picture.metadata = {{"nephroid:passes", "0..7"}};
  return picture;
}

TEST(ReadPicture, SaysThatAFileIsNoPicture) {
  const ScratchDirectory directory;
  const std::string path = directory.file("notes.txt");
  std::ofstream(path) << "no picture";
  try {
    read_picture(path);
    ADD_FAILURE() << "was read";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("no picture in a format that the program knows"),
              std::string::npos)
        << error.what();
  }
}

TEST(ExrFile, ComesBackBitForBit) {
  const ScratchDirectory directory;
  const Picture wanted = some_picture();
  write_exr(directory.file("a.exr"), wanted);
  const Picture read = read_picture(directory.file("a.exr"));
  EXPECT_EQ(read.channels, wanted.channels);
  EXPECT_EQ(read.pixels, wanted.pixels);
  EXPECT_EQ(read.window, wanted.window);
  EXPECT_EQ(read.full_width, wanted.full_width);
  EXPECT_EQ(read.color_space, wanted.color_space);
  EXPECT_EQ(value_of(read.metadata, "nephroid:passes"), "0..7");
  const PictureHead head = read_picture_head(directory.file("a.exr"));
  EXPECT_EQ(head.channels, wanted.channels);
  EXPECT_EQ(head.window, wanted.window);
}

/// The picture read back, with a layer `a` of the value beside R G B of 1/3 and a bias of 1/3.
Picture with_layer(float value) {
  const ScratchDirectory directory;
  PictureHead head = some_picture();
  const std::vector<bool> may_be_half = {false, false, false, true, true, true, true};
  write_exr(directory.file("a.exr"), head, may_be_half, [&](int, float* row) {
    for (int x = 0; x < head.width(); ++x)
      for (size_t c = 0; c < 7; ++c) *row++ = c >= 3 && c < 6 ? value : 1 / 3.0f;
  });
  return read_picture(directory.file("a.exr"));
}

TEST(ExrFile, LayersAreNarrowWhereTheirValuesFit) {
  const float third = 1 / 3.0f;
  const Picture fits = with_layer(third);
  EXPECT_EQ(fits.pixels[0], third);
  EXPECT_NE(fits.pixels[3], third);
  EXPECT_NEAR(fits.pixels[3], third, third / 2048);
  EXPECT_NE(fits.pixels[6], third);
  for (const float value : {70000.1f, -1e20f, 1.1e-5f}) {
    const Picture wide = with_layer(value);
    EXPECT_EQ(wide.pixels[0], third);
    EXPECT_EQ(wide.pixels[3], value) << "all digits";
    EXPECT_EQ(wide.pixels[5], value);
    EXPECT_NE(wide.pixels[6], third) << "other layers stay narrow";
  }
  EXPECT_EQ(with_layer(0).pixels[3], 0.0f);
  EXPECT_EQ(with_layer(65504).pixels[3], 65504.0f);
}

// Tests various first bytes for which the disk has no room. The offset table is written last.
TEST(ExrFile, AFullDiskIsAnErrorAndTheOldFileStays) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  write_exr(path, some_picture());
  const auto size = static_cast<rlim_t>(std::filesystem::file_size(path));
  const auto before = std::filesystem::last_write_time(path);
  struct rlimit old {};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t room : {rlim_t{0}, rlim_t{100}, rlim_t{3000}, size / 2, size - 1}) {
    const struct rlimit limited { room, old.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limited);
    EXPECT_THROW(write_exr(path, some_picture()), IoError) << room;
    setrlimit(RLIMIT_FSIZE, &old);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(std::filesystem::last_write_time(path), before);
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 1u);
}

// Wide pictures have large blocks, so fewer blocks are held.
TEST(ExrFile, TheEncoderHoldsNoMoreThanItMay) {
  constexpr size_t kChannels = 40;
  for (const int threads : {1, 8}) {
    limit_image_threads(threads);
    for (const int width : {100, 1000, 4000, 5000, 12000, 20000}) {
      EXPECT_LE(encoder_bytes(width, kChannels), kMaxEncoderBytes) << width;
      EXPECT_GE(encoder_bytes(width, kChannels), 16u * width * kChannels * 4) << width;
    }
  }
  // Eight threads: 4 blocks at once, for at most 4 threads.
  EXPECT_LT(encoder_bytes(5000, kChannels), 5 * encoder_bytes(1000, kChannels));
  EXPECT_LE(encoder_bytes(100000, kChannels), 5u * 16 * 100000 * kChannels * 4);
  limit_image_threads(0);
}

TEST(ExrFile, LeavesTheOldFileWhereItCannotWrite) {
  const ScratchDirectory directory;
  EXPECT_THROW(write_exr(directory.file("nowhere/a.exr"), some_picture()), IoError);
}

}  // namespace
}  // namespace nephroid
