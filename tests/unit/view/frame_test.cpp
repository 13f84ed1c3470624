// Frames as the page gets them.
#include "view/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "film/film_output.h"
#include "unit/view/decoded_frame.h"
#include "view/frame_store.h"

namespace nephroid {
namespace {

using testing_support::decode;
using testing_support::DecodedFrame;

/// A film with one estimate a pixel: value(x, y) in R, G and B.
template <class Value>
Film film_with(int width, int height, const Value& value) {
  FilmSettings settings;
  settings.width = width;
  settings.height = height;
  Film film(settings, FilmLayout::of_routes({"all"}));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb color = value(x, y);
      film.add(0, x, y, std::span(&color, 1));
    }
  film.add_estimates(0, 1);
  return film;
}

const Rgb kGrey{0.5f, 0.5f, 0.5f};

TEST(Frame, TilesHoldTheirRowsOneAfterAnother) {
  // Two tiles side by side, the second one narrow.
  const Film film = film_with(70, 3, [](int x, int y) {
    return Rgb{static_cast<float>(x), static_cast<float>(y), 0.25f};
  });
  FrameStore store;
  EXPECT_EQ(store.update(film, {}, 0), 1u);
  const DecodedFrame frame = decode(*store.frame({"picture"}, 0, 0));
  EXPECT_EQ(frame.header["tiles"], (std::vector<int>{0, 1}));
  EXPECT_EQ(frame.header["window"], (std::vector<int>{0, 0, 70, 3}));
  ASSERT_EQ(frame.values.size(), 70u * 3 * 3);
  const float scale = frame.header["layers"][0]["scale"];
  EXPECT_EQ(frame.values[3 * 5] * scale, 5);             // first row of the first tile
  EXPECT_EQ(frame.values[3 * (2 * 64 + 7)] * scale, 7);  // third row
  EXPECT_EQ(frame.values[3 * (2 * 64 + 7) + 1] * scale, 2);
  EXPECT_EQ(frame.values[3 * (3 * 64 + 6 + 1)] * scale, 65);  // second row of the second tile
}

TEST(Frame, OnlyTilesThatChangedAreSent) {
  FrameStore store;
  const auto with_dot = [](float dot) {
    return film_with(130, 64, [dot](int x, int y) {
      return x == 100 && y == 10 ? Rgb{dot, dot, dot} : kGrey;
    });
  };
  store.update(with_dot(1), {}, 0);
  EXPECT_EQ(store.update(with_dot(2), {}, 0), 2u);
  EXPECT_EQ(decode(*store.frame({"picture"}, 0, 1)).header["tiles"], (std::vector<int>{1}));
  EXPECT_EQ(decode(*store.frame({"picture"}, 0, 0)).header["tiles"].size(), 3u);
  EXPECT_FALSE(store.frame({"picture"}, 0, 2).has_value());
  // A viewer of another generation knows nothing.
  EXPECT_EQ(decode(*store.frame({"picture"}, 7, 2)).header["tiles"].size(), 3u);
}

TEST(Frame, AnotherGenerationIsSentAsAWhole) {
  FrameStore store;
  const Film film = film_with(8, 8, [](int, int) { return kGrey; });
  store.update(film, {}, 0);
  FrameInfo next;
  next.generation = 1;
  store.update(film, next, 0);
  EXPECT_EQ(decode(*store.frame({"picture"}, 0, 1)).header["tiles"].size(), 1u);
}

TEST(Frame, BrightAndDimLayersKeepTheirDigits) {
  for (const float level : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
    const float value = 1.2345678f * level;
    const Film film = film_with(4, 4, [value](int, int) { return Rgb{value, value, value}; });
    FrameStore store;
    store.update(film, {}, 0);
    const DecodedFrame frame = decode(*store.frame({"picture"}, 0, 0));
    const float scale = frame.header["layers"][0]["scale"];
    EXPECT_NEAR(frame.values[0] * scale / value, 1, 1.0 / 2048) << level;
    EXPECT_EQ(std::exp2(std::round(std::log2(scale))), scale) << "no power of two";
  }
}

TEST(Frame, ABrightLampLeavesTheDarkPartsTheirDigits) {
  for (const float lamp : {7e4f, 1e9f, 3e38f}) {
    const Film film = film_with(4, 4, [lamp](int x, int) {
      return x == 0 ? Rgb{lamp, lamp, lamp} : Rgb{0.0123f, 0.0123f, 0.0123f};
    });
    FrameStore store;
    store.update(film, {}, 0);
    const DecodedFrame frame = decode(*store.frame({"picture"}, 0, 0));
    const float scale = frame.header["layers"][0]["scale"];
    EXPECT_NEAR(frame.values[3] * scale / 0.0123f, 1, 1.0 / 1024) << lamp;
    EXPECT_GT(frame.values[0] * scale, 6e4f) << lamp;
    EXPECT_TRUE(std::isfinite(frame.values[0]));
  }
}

TEST(Frame, ColoursAreThoseOfScreens) {
  FilmSettings settings;
  settings.width = settings.height = 1;
  settings.color_space = RgbColorSpace::find("rec2020");
  ASSERT_NE(settings.color_space, nullptr);
  Film film(settings, FilmLayout::of_routes({"all"}));
  const Rgb green{0, 1, 0};
  film.add(0, 0, 0, std::span(&green, 1));
  film.add_estimates(0, 1);
  FrameStore store;
  store.update(film, {}, 0);
  const DecodedFrame frame = decode(*store.frame({"picture"}, 0, 0));
  // The green of Rec. 2020 lies outside of sRGB.
  EXPECT_LT(frame.values[0], -0.5f);
  EXPECT_GT(frame.values[1], 1.1f);
}

TEST(Frame, LayersThatNobodyHasAskedForAreMadeOnRequest) {
  const Film film = film_with(4, 4, [](int, int) { return kGrey; });
  FrameStore store;
  store.update(film, {}, 0);
  EXPECT_TRUE(store.want({"picture"}, 0));
  EXPECT_FALSE(store.want({"picture", "all"}, 0));
  store.add(&film, 0, {"all"});
  EXPECT_TRUE(store.want({"all"}, 0));
  EXPECT_EQ(decode(*store.frame({"all"}, 0, 0)).header["layers"][0]["name"], "all");
  // From now on it is made with each picture, until the interest ends.
  store.update(film, {}, 1);
  EXPECT_TRUE(store.want({"all"}, 1));
  store.update(film, {}, 1000);
  EXPECT_FALSE(store.want({"all"}, 1000));
}

TEST(Frame, AFilmWithoutALayerLeavesItOut) {
  const Film film = film_with(4, 4, [](int, int) { return kGrey; });
  FrameStore store;
  store.update(film, {}, 0);
  store.add(&film, 0, {"caustic"});
  const DecodedFrame frame = decode(*store.frame({"picture", "caustic"}, 0, 0));
  EXPECT_EQ(frame.header["layers"].size(), 1u);
}

TEST(Frame, NotFiniteValuesOfAPictureStayWhatTheyAre) {
  Picture picture;
  picture.full_width = 4;
  picture.full_height = 1;
  picture.window = {0, 0, 4, 1};
  picture.channels = {"Z"};
  picture.pixels = {std::nanf(""), kInfinity, -kInfinity, 2};
  FrameInfo info;
  info.window = picture.window;
  const FrameLayerPtr layers[] = {frame_layer(picture, "Z", "Z", {"Z"})};
  const DecodedFrame frame = decode(encode_frame(info, layers, 0));
  EXPECT_TRUE(std::isnan(frame.values[0]));
  EXPECT_EQ(frame.values[1], kInfinity);
  EXPECT_EQ(frame.values[2], -kInfinity);
  EXPECT_EQ(frame.values[3] * layers[0]->scale, 2);
}

/// The film leaves such estimates out, and depths may be infinite.
TEST(Frame, EstimatesThatAreNotFiniteDoNoHarm) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const float strange[] = {kNan, kInfinite, -kInfinite, 3e38f, -3e38f, 1e-45f};
  Film film = film_with(6, 6, [&](int x, int y) {
    return Rgb{strange[x], strange[y], strange[(x + y) % 6]};
  });
  for (int x = 0; x < 6; ++x)
    film.add_features(x, x, {strange[x], 0, 1}, {strange[x], 0, 1}, strange[x]);
  film.add_feature_estimates(1);
  FrameStore store;
  store.update(film, {}, 0);
  std::vector<std::string> names;
  for (const FilmLayer& layer : film_layers(film)) names.push_back(layer.name);
  store.add(&film, 0, names);
  for (const std::string& name : names) {
    const DecodedFrame frame = decode(*store.frame({name}, 0, 0));
    ASSERT_EQ(frame.header["layers"].size(), 1u) << name;
    EXPECT_TRUE(std::isfinite(frame.header["layers"][0]["scale"].get<float>())) << name;
  }
  EXPECT_GT(film.bad_estimates(0).count, 0u);
  EXPECT_EQ(film_srgb8(film, 1).size(), 6u * 6 * 3);
}

}  // namespace
}  // namespace nephroid
