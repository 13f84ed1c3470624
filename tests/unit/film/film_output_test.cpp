// Pictures written and read back: every channel, windows, metadata, the colour attribute and PNG
// codes.
#include "film/film_output.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/errors.h"
#include "unit/film/one_part.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

using testing_support::add_one;

FilmSettings cropped() {
  FilmSettings settings;
  settings.width = 10;
  settings.height = 8;
  settings.crop = {3, 2, 7, 7};
  return settings;
}

/// Different values in each pixel, route and pass.
Film filled_film(const FilmSettings& settings) {
  Film film(settings, FilmLayout::of_routes({"diffuse", "caustic"}));
  const PixelBounds& b = film.bounds();
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x) {
        const auto v = static_cast<float>(x + 10 * y + pass * pass);
        add_one(film, 0, x, y, {v, v * 0.5f, v * 0.25f});
        add_one(film, 1, x, y, {1 / v, 2 / v, 3 / v});
        film.add_features(x, y, {0.1f, 0.2f, 0.3f}, {0, v, 1}, v);
      }
    film.add_estimates(0, 1);
    film.add_estimates(1, 1);
    film.add_feature_estimates(1);
  }
  return film;
}

float pixel(const Picture& picture, int x, int y, const std::string& channel) {
  const int c = picture.find_channel(channel);
  EXPECT_GE(c, 0) << channel;
  const size_t at =
      static_cast<size_t>(y - picture.window.y0) * static_cast<size_t>(picture.width()) +
      static_cast<size_t>(x - picture.window.x0);
  return picture.pixels[at * picture.channels.size() + static_cast<size_t>(c)];
}

void expect_rgb(const Picture& picture, int x, int y, const std::string& layer, const Rgb& rgb) {
  EXPECT_EQ(pixel(picture, x, y, layer + "R"), rgb.r) << layer;
  EXPECT_EQ(pixel(picture, x, y, layer + "G"), rgb.g) << layer;
  EXPECT_EQ(pixel(picture, x, y, layer + "B"), rgb.b) << layer;
}

TEST(FilmOutput, TellsTheBiasOfWhatMerges) {
  FilmSettings settings;
  settings.width = 2;
  settings.height = 1;
  FilmLayout layout = FilmLayout::of_routes({"a"});
  layout.merges = {true};
  Film film(settings, layout);
  film.add_bias(0, std::vector<float>{0.5f, -1});
  film.add_estimates(0, 2);
  const Picture picture = film_picture(film, {});
  EXPECT_EQ(pixel(picture, 0, 0, "bias.Y"), 0.25f);
  EXPECT_EQ(pixel(picture, 1, 0, "bias.Y"), -0.5f);
}

TEST(FilmOutput, UnknownErrorsHaveNoLayer) {
  for (const bool gbuffer : {false, true}) {
    FilmSettings settings = cropped();
    settings.gbuffer = gbuffer;
    FilmLayout layout = FilmLayout::of_routes({"a"});
    const size_t all = film_picture(Film(settings, layout), {}).channels.size();
    layout.has_error = false;
    Film film(settings, layout);
    film.set_estimates(0, 1);
    const Picture picture = film_picture(film, {});
    EXPECT_EQ(picture.channels.size(), all - (gbuffer ? 9 : 3));
    for (const char* channel : {"stderr.R", "Variance.R", "RelativeVariance.R"})
      EXPECT_EQ(picture.find_channel(channel), -1) << channel;
    EXPECT_EQ(pixel(picture, 4, 3, "samples"), 1.0f);
  }
}

TEST(FilmOutput, ExrHoldsEveryLayerBitForBit) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.exr");
  const Film film = filled_film(cropped());
  write_film(path, film, {}, 1, LayerPrecision::kFloat);
  const Picture picture = read_picture(path);
  ASSERT_GE(picture.channels.size(), 3u);
  EXPECT_EQ(picture.channels[0], "R");
  EXPECT_EQ(picture.channels[1], "G");
  EXPECT_EQ(picture.channels[2], "B");
  EXPECT_EQ(picture.channels.size(), 3u + 6 + 3 + 3 + 1 + 3 + 1);
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      expect_rgb(picture, x, y, "", film.value(x, y));
      expect_rgb(picture, x, y, "diffuse.", film.route_value(0, x, y));
      expect_rgb(picture, x, y, "caustic.", film.route_value(1, x, y));
      expect_rgb(picture, x, y, "albedo.", film.albedo(x, y));
      expect_rgb(picture, x, y, "stderr.", film.standard_error(x, y));
      EXPECT_EQ(pixel(picture, x, y, "N.Y"), film.normal(x, y).y);
      EXPECT_EQ(pixel(picture, x, y, "N.Z"), film.normal(x, y).z);
      EXPECT_EQ(pixel(picture, x, y, "Z"), film.depth(x, y));
      EXPECT_EQ(pixel(picture, x, y, "samples"), 3.0f);
    }
  EXPECT_GT(film.standard_error(4, 4).r, 0.0f);
}

TEST(FilmOutput, LayersBesideThePictureAreInHalfPrecision) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.exr");
  Film film(cropped(), FilmLayout::of_routes({"all"}));
  add_one(film, 0, 4, 3, {1 / 3.0f, 2 / 3.0f, 1});
  film.add_features(4, 3, {1 / 3.0f, 0, 0}, {0, 0, 1}, 1000.1f);
  film.add_estimates(0, 1);
  film.add_feature_estimates(1);
  write_film(path, film, {}, 1);
  const Picture picture = read_picture(path);
  expect_rgb(picture, 4, 3, "", {1 / 3.0f, 2 / 3.0f, 1});
  EXPECT_EQ(pixel(picture, 4, 3, "Z"), 1000.1f);
  for (const char* channel : {"all.R", "albedo.R"}) {
    EXPECT_NE(pixel(picture, 4, 3, channel), 1 / 3.0f) << channel;
    EXPECT_NEAR(pixel(picture, 4, 3, channel), 1 / 3.0f, 1e-4) << channel;
  }
}

TEST(FilmOutput, WhatIsHeldHasALayer) {
  Film film(cropped(), FilmLayout::of_routes({"all"}));
  EXPECT_EQ(film_picture(film, {}).find_channel("outliers.R"), -1);
  EXPECT_EQ(film_picture(film, {}).find_channel("bias.Y"), -1);
  film.reject_outliers({{1.0f}, 8});
  add_one(film, 0, 4, 3, {10, 20, 30});
  film.add_estimates(0, 2);
  film.finish_pass();
  const Picture picture = film_picture(film, {});
  EXPECT_EQ(picture.channels.size(), 3u + 3 + 3 + 3 + 3 + 1 + 3 + 1);
  expect_rgb(picture, 4, 3, "", {0, 0, 0});
  expect_rgb(picture, 4, 3, "all.", {0, 0, 0});
  expect_rgb(picture, 4, 3, "outliers.", {5, 10, 15});
  expect_rgb(picture, 3, 3, "outliers.", {0, 0, 0});
  expect_rgb(picture, 4, 3, "albedo.", film.albedo(4, 3));
}

TEST(FilmOutput, OneLayerPerRouteAndAovAndTheLargestCount) {
  FilmLayout layout;
  layout.routes = {"diffuse", "caustic"};
  layout.aovs = {"key", "fill"};
  layout.groups = {0, 1};
  layout.parts = {{0, {0}}, {0, {1}}, {1, {0, 1}}};
  Film film(cropped(), layout);
  const Rgb values[] = {{1, 2, 3}, {10, 20, 30}};
  film.add(0, 4, 3, values);
  add_one(film, 1, 4, 3, {400, 800, 1200});
  film.add_estimates(0, 1);
  film.add_estimates(1, 4);
  const Picture picture = film_picture(film, {});
  EXPECT_EQ(picture.channels.size(), 3u + 6 + 6 + 3 + 3 + 1 + 3 + 1);
  expect_rgb(picture, 4, 3, "", {111, 222, 333});
  expect_rgb(picture, 4, 3, "diffuse.", {11, 22, 33});
  expect_rgb(picture, 4, 3, "caustic.", {100, 200, 300});
  expect_rgb(picture, 4, 3, "key.", {101, 202, 303});
  expect_rgb(picture, 4, 3, "fill.", {110, 220, 330});
  EXPECT_EQ(pixel(picture, 4, 3, "samples"), 4.0f);
}

TEST(FilmOutput, GbufferLayers) {
  FilmSettings settings = cropped();
  settings.gbuffer = true;
  Film film = filled_film(settings);
  SurfaceSample a, b;
  a.p = Vec3f(1, 2, 3);
  b.p = Vec3f(3, 2, 1);
  a.n = b.n = Vec3f(0, 0, -1);
  a.ns = Vec3f(1, 0, 0);
  b.ns = Vec3f(0, 1, 0);
  a.uv = Vec2f(0.25f, 0.5f);
  b.uv = Vec2f(0.75f, 0.5f);
  a.dzdx = -3;
  b.dzdx = -1;
  film.add_surface(4, 3, a);
  film.add_surface(4, 3, b);
  const Picture picture = film_picture(film, {});
  EXPECT_EQ(pixel(picture, 4, 3, "P.X"), 2.0f);
  EXPECT_EQ(pixel(picture, 4, 3, "P.Z"), 2.0f);
  EXPECT_EQ(pixel(picture, 4, 3, "N.Z"), -1.0f);
  EXPECT_NEAR(pixel(picture, 4, 3, "Ns.X"), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(pixel(picture, 4, 3, "Ns.Y"), std::sqrt(0.5), 1e-6);
  EXPECT_EQ(pixel(picture, 4, 3, "u"), 0.5f);
  EXPECT_EQ(pixel(picture, 4, 3, "v"), 0.5f);
  EXPECT_EQ(pixel(picture, 4, 3, "dzdx"), 2.0f);
  EXPECT_EQ(pixel(picture, 4, 3, "dzdy"), 0.0f);
  EXPECT_EQ(pixel(picture, 5, 3, "P.X"), 0.0f);
  EXPECT_EQ(pixel(picture, 4, 4, "Albedo.R"), film.albedo(4, 4).r);
  EXPECT_EQ(pixel(picture, 4, 4, "Z"), film.depth(4, 4));
  // With three estimates, the variance of one is three times that of their mean.
  const float error = film.standard_error(4, 4).r;
  EXPECT_GT(error, 0.0f);
  EXPECT_NEAR(pixel(picture, 4, 4, "Variance.R"), 3 * error * error, 1e-5f * error * error);
  EXPECT_NEAR(pixel(picture, 4, 4, "RelativeVariance.R"), 3 * error * error / film.value(4, 4).r,
              1e-5f);
  EXPECT_EQ(picture.find_channel("albedo.R"), -1);
}

TEST(FilmOutput, CropIsDataWindowInDisplayWindow) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.exr");
  write_film(path, filled_film(cropped()), {}, 1);
  const Picture picture = read_picture(path);
  EXPECT_EQ(picture.full_width, 10);
  EXPECT_EQ(picture.full_height, 8);
  EXPECT_EQ(picture.window.x0, 3);
  EXPECT_EQ(picture.window.y0, 2);
  EXPECT_EQ(picture.window.x1, 7);
  EXPECT_EQ(picture.window.y1, 7);
}

TEST(FilmOutput, MetadataSurvives) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.exr");
  const Metadata metadata = {{"nephroid:seed", "17"}, {"nephroid:options", "max-depth=5 radius=1"}};
  write_film(path, filled_film(cropped()), metadata, 1);
  const Picture picture = read_picture(path);
  for (const auto& entry : metadata)
    EXPECT_NE(std::find(picture.metadata.begin(), picture.metadata.end(), entry),
              picture.metadata.end())
        << entry.first;
}

/// The file's chromaticities; empty if it has none.
std::vector<float> stored_chromaticities(const std::string& path) {
  const auto in = OIIO::ImageInput::open(path);
  const auto* attribute = in->spec().find_attribute("chromaticities");
  if (attribute == nullptr) return {};
  const auto* values = static_cast<const float*>(attribute->data());
  return {values, values + 8};
}

TEST(FilmOutput, ChromaticitiesOfOtherSpacesAreStored) {
  const ScratchDirectory directory;
  FilmSettings settings = cropped();
  settings.color_space = RgbColorSpace::find("rec2020");
  ASSERT_NE(settings.color_space, nullptr);
  write_film(directory.file("wide.exr"), filled_film(settings), {}, 1);
  const std::vector<float> stored = stored_chromaticities(directory.file("wide.exr"));
  ASSERT_EQ(stored.size(), 8u);
  // ITU-R BT.2020: primaries have three digits; its white point D65 follows from the tables.
  const float expected[8] = {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f};
  for (size_t i = 0; i < 8; ++i) EXPECT_NEAR(stored[i], expected[i], 1e-3) << i;

  EXPECT_EQ(read_picture(directory.file("wide.exr")).color_space, settings.color_space);

  settings.color_space = &RgbColorSpace::srgb();
  write_film(directory.file("srgb.exr"), filled_film(settings), {}, 1);
  EXPECT_EQ(read_picture(directory.file("srgb.exr")).color_space, nullptr);
  EXPECT_TRUE(stored_chromaticities(directory.file("srgb.exr")).empty());
}

TEST(FilmOutput, SrgbCodes) {
  EXPECT_EQ(encode_srgb8(-1.0f), 0);
  EXPECT_EQ(encode_srgb8(std::nanf("")), 0);
  EXPECT_EQ(encode_srgb8(0.0f), 0);
  EXPECT_EQ(encode_srgb8(1.0f), 255);
  EXPECT_EQ(encode_srgb8(kInfinity), 255);
  EXPECT_EQ(encode_srgb8(0.002f), 7);  // 12.92 * 0.002 * 255 = 6.59
  EXPECT_EQ(encode_srgb8(0.5f), 188);  // 187.52
}

TEST(FilmOutput, PngHasTheExposedPicture) {
  const ScratchDirectory directory;
  Film film(cropped(), FilmLayout::of_routes({"all"}));
  add_one(film, 0, 3, 2, {0.25f, 0.125f, 5});
  film.add_estimates(0, 1);
  write_film(directory.file("out.exr"), film, {}, 2);
  const Picture png = read_picture(directory.file("out.png"));
  EXPECT_EQ(png.width(), 4);
  EXPECT_EQ(png.height(), 5);
  EXPECT_EQ(encode_srgb8(png.pixels[0]), 188);
  EXPECT_EQ(encode_srgb8(png.pixels[1]), 137);  // sRGB of 0.25: 136.96
  EXPECT_NEAR(png.pixels[1], 0.25f, 0.002f) << "read as linear light";
  EXPECT_FLOAT_EQ(png.pixels[2], 1.0f);
  EXPECT_FLOAT_EQ(png.pixels[3], 0.0f);
}

TEST(FilmOutput, AlphaOfAPngDoesNotChangeItsColours) {
  // One pixel: 255, 128, 0, alpha 128.
  constexpr std::array<unsigned char, 70> kPng = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
      0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xda, 0x63, 0xf8, 0xdf, 0xc0, 0xd0, 0x00, 0x00, 0x06, 0x01, 0x02, 0x00, 0xd2, 0x62,
      0x9d, 0x39, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const ScratchDirectory directory;
  const std::string path = directory.file("half.png");
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(kPng.data()), kPng.size());
  const Picture png = read_picture(path);
  ASSERT_EQ(png.pixels.size(), 4u);
  EXPECT_FLOAT_EQ(png.pixels[0], 1);
  EXPECT_EQ(encode_srgb8(png.pixels[1]), 128);
  EXPECT_NEAR(png.pixels[3], 128 / 255.0f, 1e-6f);
}

TEST(FilmOutput, PngOfAWideSpaceIsConverted) {
  FilmSettings settings = cropped();
  settings.color_space = RgbColorSpace::find("rec2020");
  Film film(settings, FilmLayout::of_routes({"all"}));
  add_one(film, 0, 3, 2, {1, 0, 0});  // outside sRGB: clipped to its red
  add_one(film, 0, 4, 2, {0.5f, 0.5f, 0.5f});
  film.add_estimates(0, 1);
  const std::vector<uint8_t> bytes = film_srgb8(film, 1);
  EXPECT_EQ(bytes[0], 255);
  EXPECT_EQ(bytes[1], 0);
  EXPECT_EQ(bytes[2], 0);
  for (size_t c = 3; c < 6; ++c) EXPECT_NEAR(bytes[c], 188, 1) << c;
}

TEST(FilmOutput, FailureNamesTheFileAndLeavesTheOldOne) {
  const ScratchDirectory directory;
  const Film film = filled_film(cropped());
  const std::string missing = directory.file("nowhere/out.exr");
  try {
    write_film(missing, film, {}, 1);
    FAIL() << "written into a directory that does not exist";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find(missing), std::string::npos);
  }
  std::filesystem::create_directory(directory.file("out.exr"));
  EXPECT_THROW(write_film(directory.file("out.exr"), film, {}, 1), IoError);
}

TEST(FilmOutput, ReadingFailsWithTheName) {
  const ScratchDirectory directory;
  std::ofstream(directory.file("text.exr")) << "this is no picture";
  for (const std::string name : {"text.exr", "absent.exr"}) {
    const std::string path = directory.file(name);
    try {
      read_picture(path);
      FAIL() << path;
    } catch (const IoError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path + ": cannot read: ", 0), 0u) << error.what();
    }
  }
}

TEST(FilmOutput, PngStandsBesideTheExr) {
  EXPECT_EQ(png_path_beside("a/b.c.exr"), "a/b.c.png");
  EXPECT_EQ(png_path_beside("plain.exr"), "plain.png");
}

}  // namespace
}  // namespace nephroid
