// Image textures: lookups, wrap modes, encodings and channels, against hand-computed values.
#include <cstdio>
#include <numeric>

#include "scene/texture/image_file.h"
#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

Image grey(int width, int height, std::vector<float> values) {
  return Image(width, height, 1, Image::Floats(std::move(values)), RgbColorSpace::srgb());
}

TEST(Image, BilinearPassesThroughPixelCentres) {
  const Image image = grey(2, 2, {0, 1, 2, 4});
  EXPECT_FLOAT_EQ(image.bilinear_float({0.25f, 0.25f}, WrapMode::kClamp), 0.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({0.75f, 0.25f}, WrapMode::kClamp), 1.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({0.25f, 0.75f}, WrapMode::kClamp), 2.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({0.5f, 0.5f}, WrapMode::kClamp), 1.75f);
  EXPECT_FLOAT_EQ(image.bilinear_float({0.375f, 0.25f}, WrapMode::kClamp), 0.25f);
}

TEST(Image, WrapsAtItsEdges) {
  const Image image = grey(2, 2, {0, 1, 2, 4});
  // At the left edge half of the weight is outside.
  EXPECT_FLOAT_EQ(image.bilinear_float({0.0f, 0.25f}, WrapMode::kClamp), 0.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({0.0f, 0.25f}, WrapMode::kRepeat), 0.5f);
  EXPECT_FLOAT_EQ(image.bilinear_float({1.0f, 0.25f}, WrapMode::kBlack), 0.5f);
  EXPECT_FLOAT_EQ(image.bilinear_float({1.0f, 0.75f}, WrapMode::kRepeat), 3.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({-3.0f, 0.25f}, WrapMode::kRepeat), 0.5f);
  EXPECT_FLOAT_EQ(image.bilinear_float({-3.0f, 0.25f}, WrapMode::kBlack), 0.0f);
  EXPECT_FLOAT_EQ(image.nearest_float({1.75f, 0.75f}, WrapMode::kRepeat), 4.0f);
  EXPECT_FLOAT_EQ(image.nearest_float({1.75f, 0.75f}, WrapMode::kBlack), 0.0f);
  EXPECT_FLOAT_EQ(image.nearest_float({1.75f, -5.0f}, WrapMode::kClamp), 1.0f);
}

TEST(Image, OctahedralWrapMirrorsEachEdgeAtItsMiddle) {
  std::vector<float> values(16);
  std::iota(values.begin(), values.end(), 0.0f);
  const Image image = grey(4, 4, values);
  const auto texel = [&](int x, int y) { return image.texel(x, y, WrapMode::kOctahedralSphere).r; };
  EXPECT_EQ(texel(-1, 0), 12.0f);
  EXPECT_EQ(texel(-1, 1), 8.0f);
  EXPECT_EQ(texel(4, 0), 15.0f);
  EXPECT_EQ(texel(0, -1), 3.0f);
  EXPECT_EQ(texel(1, 4), 14.0f);
  // All four corners of the square are one point of the sphere.
  EXPECT_EQ(texel(-1, -1), 15.0f);
}

TEST(Image, RepeatKeepsItsDigitsFarAway) {
  const Image image = grey(2, 1, {0, 1});
  EXPECT_NEAR(image.bilinear_float({1024.5f, 0.5f}, WrapMode::kRepeat), 0.5f, 1e-6f);
  EXPECT_TRUE(std::isfinite(image.bilinear_float({1e30f, -1e30f}, WrapMode::kRepeat)));
  EXPECT_TRUE(std::isfinite(image.bilinear_float({1e30f, -1e30f}, WrapMode::kClamp)));
}

TEST(ColorEncoding, Parses) {
  EXPECT_EQ(ColorEncoding::parse("linear"), ColorEncoding::linear());
  EXPECT_EQ(ColorEncoding::parse("sRGB"), ColorEncoding::srgb());
  EXPECT_FLOAT_EQ(ColorEncoding::parse("gamma 2.2")->decode(0.5f), std::pow(0.5f, 2.2f));
  for (const char* bad : {"", "srgb", "gamma", "gamma x", "gamma 0", "gamma -1", "gamma 2 2"})
    EXPECT_FALSE(ColorEncoding::parse(bad)) << bad;
}

class ImageTexture : public ::testing::Test {
 protected:
  std::string map(const std::string& type, const std::string& file,
                  const std::string& rest = "") const {
    return "Texture \"t\" \"" + type + "\" \"imagemap\" \"string filename\" \"" + file + "\" " +
           rest;
  }
  Textures make(const std::string& text) const { return Textures(text, scratch.path().string()); }
  std::string error(const std::string& text) const {
    return error_of(text, scratch.path().string());
  }
  ScratchDirectory scratch;
};

TEST_F(ImageTexture, FirstRowIsAtTheTopOfV) {
  write_image<float>(scratch.file("a.exr"), 1, 2, 1, OIIO::TypeDesc::FLOAT, {10, 20});
  const Textures t = make(map("float", "a.exr", "\"string filter\" \"point\""));
  EXPECT_EQ(t.value("t", 0.5f, 0.9f), 10.0f);
  EXPECT_EQ(t.value("t", 0.5f, 0.1f), 20.0f);
}

TEST_F(ImageTexture, ScalesThenInverts) {
  write_image<float>(scratch.file("a.exr"), 1, 1, 1, OIIO::TypeDesc::FLOAT, {0.25f});
  EXPECT_FLOAT_EQ(
      make(map("float", "a.exr", "\"float scale\" 2 \"bool invert\" true")).value("t", 0.5f, 0.5f),
      0.5f);
  EXPECT_FLOAT_EQ(
      make(map("float", "a.exr", "\"float scale\" 8 \"bool invert\" true")).value("t", 0.5f, 0.5f),
      0.0f);
}

TEST_F(ImageTexture, BytesAreSrgbUnlessTheSceneSaysOtherwise) {
  for (const char* name : {"a.png", "a.tga"})
    write_image<uint8_t>(scratch.file(name), 1, 1, 1, OIIO::TypeDesc::UINT8, {100});
  const double stored = 100.0 / 255.0;
  EXPECT_NEAR(make(map("float", "a.png")).value("t", 0, 0), srgb_to_linear(stored), 1e-6);
  EXPECT_NEAR(make(map("float", "a.png", "\"string encoding\" \"linear\"")).value("t", 0, 0),
              stored, 1e-6);
  EXPECT_NEAR(make(map("float", "a.png", "\"string encoding\" \"gamma 3\"")).value("t", 0, 0),
              std::pow(stored, 3.0), 1e-6);
  // As in pbrt-v4 only PNG files use "encoding", but here there is a warning.
  const Textures tga = make(map("float", "a.tga", "\"string encoding\" \"linear\""));
  EXPECT_NEAR(tga.value("t", 0, 0), srgb_to_linear(stored), 1e-6);
  EXPECT_NE(tga.warnings().find("PNG images only"), std::string::npos);
}

TEST_F(ImageTexture, SixteenBitsAreDecodedAndFloatsAreLinear) {
  write_image<uint16_t>(scratch.file("a.png"), 1, 1, 1, OIIO::TypeDesc::UINT16, {30000});
  // Half has 11 bits.
  const double expected = srgb_to_linear(30000.0 / 65535.0);
  EXPECT_NEAR(make(map("float", "a.png")).value("t", 0, 0), expected, expected / 2048);
  write_image<float>(scratch.file("f.exr"), 1, 1, 3, OIIO::TypeDesc::FLOAT, {0.5f, 2, 4});
  write_image<float>(scratch.file("f.hdr"), 1, 1, 3, OIIO::TypeDesc::FLOAT, {0.5f, 2, 4});
  write_image<Imath::half>(scratch.file("h.exr"), 1, 1, 3, OIIO::TypeDesc::HALF,
                           {Imath::half(0.5f), Imath::half(2.0f), Imath::half(4.0f)});
  for (const char* name : {"f.exr", "f.hdr", "h.exr"})
    EXPECT_FLOAT_EQ(make(map("float", name)).value("t", 0, 0), 6.5f / 3) << name;
}

TEST_F(ImageTexture, PfmRowsRunUpwards) {
  // The format stores the bottom row first. A negative scale means little-endian.
  FILE* f = std::fopen(scratch.file("a.pfm").c_str(), "wb");
  std::fputs("Pf\n1 2\n-1.0\n", f);
  const float rows[2] = {3, 7};
  std::fwrite(rows, sizeof(float), 2, f);
  std::fclose(f);
  const Textures t = make(map("float", "a.pfm", "\"string filter\" \"point\""));
  EXPECT_EQ(t.value("t", 0.5f, 0.1f), 3.0f);
  EXPECT_EQ(t.value("t", 0.5f, 0.9f), 7.0f);
}

TEST_F(ImageTexture, FloatPicksGreyMeanOrAlpha) {
  const auto v = [&](const std::string& name) { return make(map("float", name)).value("t", 0, 0); };
  write_image<float>(scratch.file("rgb.exr"), 1, 1, 3, OIIO::TypeDesc::FLOAT, {1, 2, 6});
  EXPECT_FLOAT_EQ(v("rgb.exr"), 3.0f);
  write_image<float>(scratch.file("rgba.exr"), 1, 1, 4, OIIO::TypeDesc::FLOAT, {1, 2, 6, 0.25f});
  EXPECT_FLOAT_EQ(v("rgba.exr"), 0.25f);
  // An alpha of 1 everywhere counts as none.
  write_image<float>(scratch.file("opaque.exr"), 1, 1, 4, OIIO::TypeDesc::FLOAT, {1, 2, 6, 1});
  EXPECT_FLOAT_EQ(v("opaque.exr"), 3.0f);
  // Grey with alpha is grey.
  write_image<uint8_t>(scratch.file("ya.png"), 1, 1, 2, OIIO::TypeDesc::UINT8, {255, 10});
  EXPECT_FLOAT_EQ(v("ya.png"), 1.0f);
  EXPECT_FLOAT_EQ(make(map("float", "ya.png", R"("string channel" "a" "string encoding" "linear")"))
                      .value("t", 0, 0),
                  10.0f / 255.0f);
}

TEST_F(ImageTexture, ColoursAreNotMultipliedByAlpha) {
  write_image<uint8_t>(scratch.file("a.png"), 1, 1, 4, OIIO::TypeDesc::UINT8, {255, 255, 255, 51});
  EXPECT_NEAR(make(map("spectrum", "a.png")).level("t", 0, 0), 1.0f, 2e-3f);
}

TEST_F(ImageTexture, ColoursBecomeSpectraOfTheKindAskedFor) {
  write_image<float>(scratch.file("a.exr"), 1, 1, 3, OIIO::TypeDesc::FLOAT, {0.8f, 0.3f, 0.1f});
  const Textures t = make(map("spectrum", "a.exr"));
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const Rgb rgb{0.8f, 0.3f, 0.1f};
  const SpectrumPtr expected[] = {rgb_albedo_spectrum(space, rgb),
                                  rgb_unbounded_spectrum(space, rgb),
                                  rgb_illuminant_spectrum(space, rgb)};
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.37f);
  for (int kind = 0; kind < 3; ++kind) {
    const SampledSpectrum got =
        t.spectrum("t", static_cast<SpectrumKind>(kind))->eval(TextureContext(), lambda);
    const SampledSpectrum want = expected[kind]->sample(lambda);
    for (int i = 0; i < kSpectrumSamples; ++i)
      EXPECT_NEAR(got[i], want[i], 1e-5f * std::max(1.0f, want[i])) << kind;
  }
}

TEST_F(ImageTexture, ReflectancesAreClampedAndEmissionsAreNot) {
  write_image<float>(scratch.file("a.exr"), 1, 1, 3, OIIO::TypeDesc::FLOAT, {5, 5, 5});
  const Textures t = make(map("spectrum", "a.exr"));
  EXPECT_NEAR(t.level("t", 0, 0, SpectrumKind::kAlbedo), 1.0f, 1e-3f);
  EXPECT_NEAR(t.level("t", 0, 0, SpectrumKind::kUnbounded), 5.0f, 1e-2f);
}

TEST_F(ImageTexture, ReadsTheColourSpaceOfAnExr) {
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::FLOAT);
  const float primaries[8] = {.708f, .292f, .17f, .797f, .131f, .046f, .3127f, .329f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), primaries);
  const float values[3] = {0.5f, 0.4f, 0.3f};
  const auto out = OIIO::ImageOutput::create(scratch.file("a.exr"));
  ASSERT_TRUE(out->open(scratch.file("a.exr"), spec));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values));
  out->close();
  EXPECT_EQ(read_image(scratch.file("a.exr"), {}, {})->color_space().name(), "rec2020");
}

TEST_F(ImageTexture, ImagesAreSharedByPathAndEncoding) {
  write_image<uint8_t>(scratch.file("a.png"), 2, 2, 1, OIIO::TypeDesc::UINT8, {1, 2, 3, 4});
  ImageCache cache;
  const std::string path = scratch.file("a.png");
  EXPECT_EQ(cache.get(path, {}, {}), cache.get(path, {}, {}));
  EXPECT_NE(cache.get(path, {}, {}), cache.get(path, ColorEncoding::linear(), {}));
  EXPECT_EQ(cache.get(path, {}, {})->memory(), 4u);
}

TEST_F(ImageTexture, ErrorsAreLocated) {
  EXPECT_EQ(error(map("float", "missing.png")).find("t.pbrt:2:"), 0u);
  write_image<uint8_t>(scratch.file("a.png"), 1, 1, 1, OIIO::TypeDesc::UINT8, {1});
  EXPECT_NE(error(map("float", "a.png", "\"string wrap\" \"around\"")).find("unknown wrap mode"),
            std::string::npos);
  EXPECT_NE(
      error(map("float", "a.png", "\"string filter\" \"cubic\"")).find("unknown texture filter"),
      std::string::npos);
  EXPECT_NE(error(map("float", "a.png", "\"string encoding\" \"foo\"")).find("unknown encoding"),
            std::string::npos);
  EXPECT_NE(error("Texture \"t\" \"float\" \"imagemap\"").find("no \"filename\""),
            std::string::npos);
  // A file that is not an image.
  FILE* f = std::fopen(scratch.file("text.png").c_str(), "w");
  std::fputs("not a picture", f);
  std::fclose(f);
  EXPECT_EQ(error(map("float", "text.png")).find("t.pbrt:2:"), 0u);
}

}  // namespace
}  // namespace nephroid::testing_texture
