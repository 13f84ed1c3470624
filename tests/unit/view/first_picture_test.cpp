// The small picture that a page shows first.
#include "view/first_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace nephroid {
namespace {

/// A frame whose pixels have the value of their column's parity, 0 or 1, in its window.
PictureFrame striped(int width, int height, const PixelBounds& window) {
  Picture picture;
  picture.full_width = width;
  picture.full_height = height;
  picture.window = window;
  picture.channels = {"R", "G", "B"};
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x)
      picture.pixels.insert(picture.pixels.end(), 3, static_cast<float>(x % 2));
  FrameInfo info;
  info.width = width;
  info.height = height;
  info.window = window;
  return {info, frame_layer(picture, "picture", "RGB", {"R", "G", "B"})};
}

Picture decoded(const PictureFrame& frame) {
  const std::vector<uint8_t> png = first_picture_png(frame);
  const std::string path = testing::TempDir() + "nephroid-first-picture.png";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  Picture picture = read_picture(path);
  std::filesystem::remove(path);
  return picture;
}

float byte_at(const Picture& picture, int x, int y) {
  return std::round(255 * picture.pixels[3 * static_cast<size_t>(y * picture.width() + x)]);
}

TEST(FirstPicture, SmallPicturesKeepTheirPixelsAndAreDarkOutsideOfTheWindow) {
  const Picture small = decoded(striped(4, 3, {1, 1, 4, 3}));
  ASSERT_EQ(small.width(), 4);
  ASSERT_EQ(small.height(), 3);
  EXPECT_EQ(byte_at(small, 2, 0), 9);
  EXPECT_EQ(byte_at(small, 0, 1), 9);
  EXPECT_EQ(byte_at(small, 1, 1), 255);
  EXPECT_EQ(byte_at(small, 2, 2), 0);
}

TEST(FirstPicture, LargeOnesAreMeansOfLinearValuesInSrgb) {
  const Picture small = decoded(striped(2 * kMaxFirstPictureEdge, 6, {0, 0, 1024, 6}));
  ASSERT_EQ(small.width(), kMaxFirstPictureEdge);
  ASSERT_EQ(small.height(), 3);
  EXPECT_EQ(byte_at(small, 100, 1), encode_srgb8(0.5f));
}

TEST(FirstPicture, WhatIsNotFiniteIsLeftOut) {
  PictureFrame frame = striped(2 * kMaxFirstPictureEdge, 6, {0, 0, 1024, 6});
  FrameLayer layer = *frame.picture;
  constexpr uint16_t kNan = 0x7e00, kInfinite = 0x7c00;
  layer.pixels[0] = kNan;           // of four pixels, one is dark instead of two
  layer.pixels[3 * 3] = kInfinite;  // one is bright instead of two
  frame.picture = std::make_shared<const FrameLayer>(layer);
  const Picture small = decoded(frame);
  EXPECT_EQ(byte_at(small, 0, 0), encode_srgb8(2 / 3.0f));
  EXPECT_EQ(byte_at(small, 1, 0), encode_srgb8(1 / 3.0f));
  EXPECT_EQ(byte_at(small, 2, 0), encode_srgb8(0.5f));
}

}  // namespace
}  // namespace nephroid
