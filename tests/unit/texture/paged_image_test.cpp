// Paged images: their pixels equal those of images read whole, bit for bit, for all kinds of files,
// and memory is bounded.
#include <cstdio>
#include <filesystem>
#include <thread>

#include "core/sampler.h"
#include "scene/texture/image_file.h"
#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

constexpr WrapMode kWraps[] = {WrapMode::kRepeat, WrapMode::kBlack, WrapMode::kClamp,
                               WrapMode::kOctahedralSphere};

float unit_number(uint64_t i) {
  return bits_to_unit_float(static_cast<uint32_t>(hash_combine(17, i) >> 32));
}

bool same(const Rgb& a, const Rgb& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// Number of lookups, of all kinds, that differ between two images.
int differences(const Image& a, const Image& b, int lookups, uint64_t seed) {
  int different = 0;
  for (int i = 0; i < lookups; ++i) {
    const uint64_t n = (seed * 1000003 + static_cast<uint64_t>(i)) * 4;
    const WrapMode wrap = kWraps[i % 4];
    const Vec2f st(3 * unit_number(n) - 1, 3 * unit_number(n + 1) - 1);
    const int x = std::min(a.width() - 1, int(unit_number(n + 2) * float(a.width())));
    const int y = std::min(a.height() - 1, int(unit_number(n + 3) * float(a.height())));
    different += same(a.bilinear(st, wrap), b.bilinear(st, wrap)) ? 0 : 1;
    different += same(a.nearest(st, wrap), b.nearest(st, wrap)) ? 0 : 1;
    different += a.bilinear_float(st, wrap) == b.bilinear_float(st, wrap) ? 0 : 1;
    different += a.nearest_float(st, wrap) == b.nearest_float(st, wrap) ? 0 : 1;
    different += a.value(x, y, a.channels() - 1) == b.value(x, y, b.channels() - 1) ? 0 : 1;
  }
  return different;
}

class PagedImage : public ::testing::Test {
 protected:
  template <class T>
  std::vector<T> noise_values(int count, double scale) const {
    std::vector<T> values(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i)
      values[static_cast<size_t>(i)] =
          static_cast<T>(static_cast<float>(scale * unit_number(static_cast<uint64_t>(i) + 99)));
    return values;
  }
  /// Compares a paged image with the same image read whole.
  void expect_same(const std::string& name, int channels,
                   std::optional<ColorEncoding> encoding = {}) {
    ImageCache paged(0);
    const std::string path = scratch.file(name);
    const ImagePtr a = paged.get(path, encoding, {}), b = read_image(path, encoding, {});
    EXPECT_EQ(a->memory(), 0u) << name;
    EXPECT_EQ(a->channels(), channels) << name;
    EXPECT_EQ(b->channels(), channels) << name;
    EXPECT_EQ(a->width(), b->width());
    EXPECT_EQ(a->height(), b->height());
    EXPECT_EQ(&a->color_space(), &b->color_space());
    EXPECT_EQ(differences(*a, *b, 400, 1), 0) << name;
  }
  ScratchDirectory scratch;
};

TEST_F(PagedImage, BytesAndShortsAreThoseOfTheWholeImage) {
  const int w = 131, h = 97;
  write_image<uint8_t>(scratch.file("rgb.png"), w, h, 3, OIIO::TypeDesc::UINT8,
                       noise_values<uint8_t>(w * h * 3, 255));
  write_image<uint8_t>(scratch.file("rgba.png"), w, h, 4, OIIO::TypeDesc::UINT8,
                       noise_values<uint8_t>(w * h * 4, 255));
  write_image<uint8_t>(scratch.file("grey.tga"), w, h, 1, OIIO::TypeDesc::UINT8,
                       noise_values<uint8_t>(w * h, 255));
  write_image<uint16_t>(scratch.file("short.png"), w, h, 3, OIIO::TypeDesc::UINT16,
                        noise_values<uint16_t>(w * h * 3, 65535));
  write_image<uint8_t>(scratch.file("ya.png"), w, h, 2, OIIO::TypeDesc::UINT8,
                       noise_values<uint8_t>(w * h * 2, 255));
  expect_same("rgb.png", 3);
  expect_same("rgb.png", 3, ColorEncoding::linear());
  expect_same("rgba.png", 4);
  expect_same("grey.tga", 1);
  expect_same("short.png", 3);
  expect_same("ya.png", 2);
}

TEST_F(PagedImage, FloatsAreThoseOfTheWholeImage) {
  const int w = 100, h = 70;
  write_image<float>(scratch.file("f.exr"), w, h, 3, OIIO::TypeDesc::FLOAT,
                     noise_values<float>(w * h * 3, 50));
  write_image<Imath::half>(scratch.file("h.exr"), w, h, 4, OIIO::TypeDesc::HALF,
                           noise_values<Imath::half>(w * h * 4, 50));
  write_image<float>(scratch.file("f.hdr"), w, h, 3, OIIO::TypeDesc::FLOAT,
                     noise_values<float>(w * h * 3, 50));
  expect_same("f.exr", 3);
  expect_same("h.exr", 4);
  expect_same("f.hdr", 3);
}

TEST_F(PagedImage, AnAlphaOfOneEverywhereIsNone) {
  const int w = 80, h = 130;
  std::vector<uint8_t> values = noise_values<uint8_t>(w * h * 4, 255);
  for (size_t i = 3; i < values.size(); i += 4) values[i] = 255;
  write_image<uint8_t>(scratch.file("opaque.png"), w, h, 4, OIIO::TypeDesc::UINT8, values);
  expect_same("opaque.png", 3);
  // Also if only the last pixel is not opaque.
  values.back() = 254;
  write_image<uint8_t>(scratch.file("almost.png"), w, h, 4, OIIO::TypeDesc::UINT8, values);
  expect_same("almost.png", 4);
  for (size_t i = 1; i < values.size(); i += 2) values[i] = 255;
  write_image<uint8_t>(scratch.file("grey.png"), 2 * w, h, 2, OIIO::TypeDesc::UINT8, values);
  expect_same("grey.png", 1);
}

TEST_F(PagedImage, TilesAndDataWindowsAreTakenAsTheyAre) {
  OIIO::ImageSpec spec(150, 90, 4, OIIO::TypeDesc::FLOAT);
  spec.tile_width = spec.tile_height = 32;
  spec.x = -7;
  spec.y = 13;
  spec.full_width = 300;
  const std::vector<float> values = noise_values<float>(150 * 90 * 4, 2);
  const auto out = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(out->open(scratch.file("tiled.exr"), spec)) << out->geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
  out->close();
  expect_same("tiled.exr", 4);
}

/// A picture of 2048 by 2048 pixels in tiles: 24 MiB in memory.
void write_large(const std::string& path) {
  constexpr int kSide = 2048;
  OIIO::ImageSpec spec(kSide, kSide, 3, OIIO::TypeDesc::HALF);
  spec.tile_width = spec.tile_height = 64;
  spec.attribute("compression", "none");
  std::vector<Imath::half> values(size_t{kSide} * kSide * 3);
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = Imath::half(static_cast<float>((i * 2654435761u) % 2039));
  const auto out = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(out->open(path, spec)) << out->geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::HALF, values.data())) << out->geterror();
  out->close();
}

TEST_F(PagedImage, ManyThreadsSeeTheSameInBoundedMemory) {
  const std::string path = scratch.file("large.exr");
  write_large(path);
  const ImagePtr whole = read_image(path, {}, {});
  constexpr uint64_t kTiles = 4 << 20;  // tiles get a quarter of the cache
  ImageCache cache(4 * kTiles);
  const ImagePtr paged = cache.get(path, {}, {});
  EXPECT_EQ(paged->memory(), 0u);
  std::array<int, 4> different{};
  std::array<uint64_t, 4> most{};
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (uint64_t round = 0; round < 5; ++round) {
        different[t] += differences(*whole, *paged, 100, 1 + 5 * t + round);
        most[t] = std::max(most[t], cache.memory());
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (size_t t = 0; t < 4; ++t) {
    EXPECT_EQ(different[t], 0);
    // Each thread may hold a few tiles more.
    EXPECT_LT(most[t], kTiles + 4 * 4 * 64 * 64 * 6);
    EXPECT_GT(most[t], kTiles / 2);
  }
}

TEST_F(PagedImage, WhatFitsIsReadWholeAndCountsTogether) {
  for (const char* name : {"a.png", "b.png", "c.png"})
    write_image<uint8_t>(scratch.file(name), 100, 100, 1, OIIO::TypeDesc::UINT8,
                         noise_values<uint8_t>(10000, 255));
  // Three quarters of the limit have room for two of them.
  ImageCache cache(30000);
  EXPECT_EQ(cache.get(scratch.file("a.png"), {}, {})->memory(), 10000u);
  EXPECT_EQ(cache.get(scratch.file("b.png"), {}, {})->memory(), 10000u);
  EXPECT_EQ(cache.get(scratch.file("c.png"), {}, {})->memory(), 0u);
  EXPECT_GT(cache.memory(), 20000u);  // and the tiles at the third one's corners
}

TEST_F(PagedImage, TexturesLookTheSameWithAndWithoutMemory) {
  write_image<uint8_t>(scratch.file("a.png"), 64, 64, 3, OIIO::TypeDesc::UINT8,
                       noise_values<uint8_t>(64 * 64 * 3, 255));
  Diagnostics diagnostics;
  const SceneDescription scene = parse_pbrt_string(
      "WorldBegin Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"", "t.pbrt",
      scratch.path().string(), diagnostics);
  const TextureLibrary with(scene, diagnostics), without(scene, diagnostics, 0);
  const auto texture = [&](const TextureLibrary& library) {
    return library.spectrum_texture(Textures::reference("t"), "x", SpectrumKind::kAlbedo);
  };
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.4f);
  TextureContext context;
  for (uint64_t i = 0; i < 100; ++i) {
    context.uv = {2 * unit_number(2 * i), 2 * unit_number(2 * i + 1)};
    const SampledSpectrum a = texture(with)->eval(context, lambda);
    const SampledSpectrum b = texture(without)->eval(context, lambda);
    for (int k = 0; k < kSpectrumSamples; ++k) EXPECT_EQ(a[k], b[k]);
  }
}

TEST_F(PagedImage, FaultyFilesAreErrorsAtTheirPlace) {
  const SourceLocation where{std::make_shared<const std::string>("t.pbrt"), 4, 2};
  ImageCache cache(0);
  try {
    cache.get(scratch.file("missing.png"), {}, where);
    ADD_FAILURE();
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()).find("t.pbrt:4:2"), 0u) << e.what();
  }
  // A truncated file is detected when it is opened.
  write_image<float>(scratch.file("cut.exr"), 64, 256, 1, OIIO::TypeDesc::FLOAT,
                     noise_values<float>(64 * 256, 1));
  std::filesystem::resize_file(scratch.file("cut.exr"), 20000);
  try {
    cache.get(scratch.file("cut.exr"), {}, where);
    ADD_FAILURE();
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()).find("t.pbrt:4:2"), 0u) << e.what();
  }
}

}  // namespace
}  // namespace nephroid::testing_texture
