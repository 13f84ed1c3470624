// The small picture that a page shows first.
#include "view/first_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "view/answers.h"
#include "view/comparisons.h"

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

/// A render that has news every 0.6 s, and with the last of them a picture if it has one. Then it
/// has no more news, as when the program ends.
class SlowRender final : public ViewSource {
 public:
  SlowRender(uint64_t news, bool has_picture) : last_(news), has_picture_(has_picture) {}
  LiveState state() const override {
    LiveState state;
    state.status = LiveStatus::kRendering;
    return state;
  }
  uint64_t wait_for_news(uint64_t seen, double longest) const override {
    ++waits_;
    if (news_ == last_) return seen;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(longest, kSeconds)));
    return longest < kSeconds ? seen : ++news_;
  }
  int waits() const { return waits_; }
  std::optional<PictureFrame> picture() override {
    if (news_ < last_ || !has_picture_) return std::nullopt;
    return striped(4, 3, {0, 0, 4, 3});
  }
  std::optional<std::string> frame(const std::vector<std::string>&, uint64_t, uint64_t) override {
    return std::nullopt;
  }
  ProbedPixel probe(int, int) override { return {}; }
  Picture colors(const LayerGains&) override { return {}; }
  void write(const std::string&) override {}

 private:
  static constexpr double kSeconds = 0.6;
  mutable uint64_t news_ = 0;
  mutable int waits_ = 0;
  uint64_t last_;
  bool has_picture_;
};

Answer first_answer(SlowRender& render) {
  Comparisons comparisons;
  return Answers(render, comparisons, "").first_picture({}, {});
}

Picture decoded(const PictureFrame& frame) {
  const std::vector<uint8_t> png = first_picture_png(frame);
  const std::string path = ::testing::TempDir() + "nephroid-first-picture.png";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  Picture picture = read_picture(path);
  std::filesystem::remove(path);
  return picture;
}

uint8_t byte_at(const Picture& picture, int x, int y) {
  return encode_srgb8(picture.pixels[3 * static_cast<size_t>(y * picture.width() + x)]);
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

TEST(FirstPicture, ThatComesLateIsWaitedFor) {
  SlowRender render(3, true);
  const Answer late = first_answer(render);
  EXPECT_EQ(late.status, 200);
  EXPECT_EQ(late.body.substr(1, 3), "PNG");
}

TEST(FirstPicture, IsNotWaitedForWhenTheProgramEnds) {
  SlowRender render(0, false);
  EXPECT_EQ(first_answer(render).status, 204);
  EXPECT_EQ(render.waits(), 1);
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
