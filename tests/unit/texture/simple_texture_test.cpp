// Constants, products, mixtures, checkerboards and mappings against hand-computed values, and the
// errors of a texture library.
#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

TEST(ConstantTexture, DefaultsToOneAndKnowsThatItIsConstant) {
  const Textures t(R"(Texture "a" "float" "constant"
                      Texture "b" "float" "constant" "float value" 0.25
                      Texture "c" "spectrum" "constant")");
  EXPECT_EQ(t.number("a")->constant(), 1.0f);
  EXPECT_EQ(t.number("b")->constant(), 0.25f);
  EXPECT_EQ(t.value("b", 0.3f, 0.9f), 0.25f);
  EXPECT_EQ(t.level("c", 0, 0), 1.0f);
  ASSERT_NE(t.spectrum("c")->constant(), nullptr);
}

TEST(ScaleTexture, MultipliesAndFoldsConstants) {
  const Textures t(R"(Texture "a" "float" "scale" "float tex" 0.5 "float scale" 3
                      Texture "b" "float" "checkerboard" "float tex1" 4 "float tex2" 2
                      Texture "c" "float" "scale" "texture tex" "b" "float scale" 0.5
                      Texture "d" "spectrum" "scale" "spectrum tex" [300 0.2 900 0.2]
                        "texture scale" "b"
                      Texture "e" "float" "scale")");
  EXPECT_EQ(t.number("a")->constant(), 1.5f);
  EXPECT_EQ(t.number("e")->constant(), 1.0f);
  EXPECT_FALSE(t.number("c")->constant());
  EXPECT_EQ(t.value("c", 0.5f, 0.5f), 2.0f);
  EXPECT_EQ(t.value("c", 1.5f, 0.5f), 1.0f);
  EXPECT_NEAR(t.level("d", 0.5f, 0.5f), 0.8f, 1e-5f);
}

TEST(MixTexture, InterpolatesWithPbrtDefaults) {
  const Textures t(R"(Texture "a" "float" "mix"
                      Texture "b" "float" "mix" "float tex1" 10 "float tex2" 20 "float amount" 0.25
                      Texture "amount" "float" "checkerboard"
                      Texture "c" "float" "mix" "float tex1" 10 "float tex2" 20
                        "texture amount" "amount"
                      Texture "d" "spectrum" "mix" "float amount" 0.25)");
  EXPECT_EQ(t.number("a")->constant(), 0.5f);
  EXPECT_EQ(t.number("b")->constant(), 12.5f);
  EXPECT_EQ(t.value("c", 0.5f, 0.5f), 20.0f);
  EXPECT_EQ(t.value("c", 0.5f, 1.5f), 10.0f);
  EXPECT_NEAR(t.level("d", 0, 0), 0.25f, 1e-6f);
}

TEST(CheckerboardTexture, HasUnitSquaresAlsoBelowZero) {
  const Textures t(R"(Texture "a" "float" "checkerboard"
                      Texture "b" "float" "checkerboard" "float uscale" 20 "float vscale" 10
                        "float udelta" 0.5)");
  EXPECT_EQ(t.value("a", 0.5f, 0.5f), 1.0f);
  EXPECT_EQ(t.value("a", -0.5f, 0.5f), 0.0f);
  EXPECT_EQ(t.value("a", -0.5f, -0.5f), 1.0f);
  EXPECT_EQ(t.value("a", -1.5f, 0.5f), 1.0f);
  EXPECT_EQ(t.value("a", 3.5f, 0.5f), 0.0f);
  // s = 20 u + 0.5, t = 10 v
  EXPECT_EQ(t.value("b", 0.02f, 0.05f), 1.0f);
  EXPECT_EQ(t.value("b", 0.03f, 0.05f), 0.0f);
  EXPECT_EQ(t.value("b", 0.03f, 0.15f), 1.0f);
}

TEST(CheckerboardTexture, HasCubesInTheFrameOfItsDirective) {
  const Textures t(R"(AttributeBegin
                      Translate 1 0 0
                      Scale 2 2 2
                      Texture "a" "float" "checkerboard" "integer dimension" 3
                      AttributeEnd)");
  // Cubes of side 2, starting at (1,0,0).
  EXPECT_EQ(t.value("a", 0, 0, {1.5f, 0.5f, 0.5f}), 1.0f);
  EXPECT_EQ(t.value("a", 0, 0, {0.5f, 0.5f, 0.5f}), 0.0f);
  EXPECT_EQ(t.value("a", 0, 0, {0.5f, -0.5f, 0.5f}), 1.0f);
  EXPECT_EQ(t.value("a", 0, 0, {0.5f, -0.5f, -0.5f}), 0.0f);
  EXPECT_EQ(t.value("a", 0, 0, {3.5f, 2.5f, 0.5f}), 1.0f);
  EXPECT_EQ(t.value("a", 0, 0, {3.5f, 2.5f, 2.5f}), 0.0f);
}

// Cells of 1/16 show where a mapping sends a point.
std::string board(const std::string& mapping) {
  return "Texture \"a\" \"float\" \"checkerboard\" \"string mapping\" \"" + mapping + "\"";
}

TEST(TextureMapping, PlanarProjectsOnTwoVectors) {
  const Textures t("Translate 0 0 5\n" + board("planar") +
                   R"("vector3 v1" [2 0 0] "vector3 v2" [0 0 3] "float udelta" 0.25)");
  // s = 2 x + 0.25, t = 3 (z - 5)
  EXPECT_EQ(t.value("a", 0, 0, {0.3f, 9, 5.3f}), 1.0f);
  EXPECT_EQ(t.value("a", 0, 0, {0.4f, 9, 5.3f}), 0.0f);
  EXPECT_EQ(t.value("a", 0, 0, {0.4f, 9, 5.4f}), 1.0f);
}

TEST(TextureMapping, CylindricalAndSphericalFollowPbrt) {
  // Observed through images that reveal (s, t): one row or column of four grey levels.
  const ScratchDirectory scratch;
  write_image<float>(scratch.file("row.exr"), 4, 1, 1, OIIO::TypeDesc::FLOAT, {0, 1, 2, 3});
  write_image<float>(scratch.file("column.exr"), 1, 4, 1, OIIO::TypeDesc::FLOAT, {0, 1, 2, 3});
  const auto image = [](const std::string& file, const std::string& mapping) {
    return "Texture \"" + mapping + file + "\" \"float\" \"imagemap\" \"string filename\" \"" +
           file + ".exr\" \"string filter\" \"point\" \"string mapping\" \"" + mapping + "\"\n";
  };
  const Textures t(image("row", "cylindrical") + image("row", "spherical") +
                       image("column", "spherical") + image("column", "cylindrical"),
                   scratch.path().string());
  const auto at = [](float degrees, float z = 0.0f) {
    return Vec3f(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), z);
  };
  // cylindrical: s = (pi + phi) / (2 pi) with phi in (-pi, pi], t = z
  EXPECT_EQ(t.value("cylindricalrow", 0, 0, at(-100)), 0.0f);
  EXPECT_EQ(t.value("cylindricalrow", 0, 0, at(-80)), 1.0f);
  EXPECT_EQ(t.value("cylindricalrow", 0, 0, at(80)), 2.0f);
  EXPECT_EQ(t.value("cylindricalrow", 0, 0, at(100)), 3.0f);
  EXPECT_EQ(t.value("cylindricalcolumn", 0, 0, at(0, 0.1f)), 3.0f);
  EXPECT_EQ(t.value("cylindricalcolumn", 0, 0, at(0, 0.9f)), 0.0f);
  // spherical: s = theta / pi, t = phi / (2 pi) with phi in [0, 2 pi)
  EXPECT_EQ(t.value("sphericalrow", 0, 0, {0.1f, 0, 1}), 0.0f);
  EXPECT_EQ(t.value("sphericalrow", 0, 0, {0.1f, 0, -1}), 3.0f);
  EXPECT_EQ(t.value("sphericalcolumn", 0, 0, at(10)), 3.0f);
  EXPECT_EQ(t.value("sphericalcolumn", 0, 0, at(-10)), 0.0f);
}

TEST(TextureLibrary, FindsParametersOfAllKinds) {
  const Textures t(R"(Texture "a" "spectrum" "constant" "rgb value" [4 4 4])");
  ParameterSet set;
  EXPECT_EQ(t.library.float_texture(set, "roughness"), nullptr);
  EXPECT_EQ(t.library.float_texture(set, "roughness", 0.5f)->constant(), 0.5f);
  EXPECT_EQ(t.library.spectrum_texture(set, "Kd", SpectrumKind::kAlbedo), nullptr);
  Parameter p;
  p.type = "float";
  p.name = "roughness";
  p.numbers = {0.75};
  set.list = {p};
  EXPECT_EQ(t.library.float_texture(set, "roughness", 0.5f)->constant(), 0.75f);
  EXPECT_THROW(t.library.spectrum_texture(set, "roughness", SpectrumKind::kAlbedo), SceneError);
}

TEST(TextureLibrary, KeepsThreeKindsOfASpectrumTextureApart) {
  // An rgb of 4 is a valid emission but no reflectance: using it as one gives a warning.
  const Textures t(R"(Texture "a" "spectrum" "constant" "rgb value" [4 4 4])");
  EXPECT_NEAR(t.level("a", 0, 0, SpectrumKind::kUnbounded), 4.0f, 1e-3f);
  EXPECT_THROW(t.spectrum("a", SpectrumKind::kAlbedo), SceneError);
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.1f);
  const SampledSpectrum emission =
      t.spectrum("a", SpectrumKind::kIlluminant)->eval(TextureContext(), lambda);
  const SampledSpectrum white = RgbColorSpace::srgb().illuminant().sample(lambda) * 4.0f;
  for (int i = 0; i < kSpectrumSamples; ++i) EXPECT_NEAR(emission[i], white[i], 1e-3f * white[i]);
}

TEST(TextureLibrary, ResolvesNamesInAnyOrder) {
  const Textures t(R"(Texture "a" "float" "scale" "texture tex" "b" "float scale" 2
                      Texture "b" "float" "constant" "float value" 3)");
  EXPECT_EQ(t.number("a")->constant(), 6.0f);
}

/// "t0", and `count` textures of one class, each made of the previous one.
std::string chain_of(int count, const std::string& values, const std::string& rest) {
  std::string text = "Texture \"t0\" \"" + values + "\" \"checkerboard\"\n";
  for (int i = 1; i <= count; ++i) {
    const std::string last = "\"t" + std::to_string(i - 1) + "\"";
    text += "Texture \"t" + std::to_string(i) + "\" \"" + values + "\" ";
    for (const char c : rest) text += c == '@' ? last : std::string(1, c);
    text += "\n";
  }
  return text;
}

TEST(TextureLibrary, BoundsWhatOneLookAsksFor) {
  const std::string one = "\"mix\" \"texture tex1\" @";
  const std::string both = one + " \"texture tex2\" @";
  const std::string itself = "\"scale\" \"texture tex\" @";
  for (const std::string values : {"float", "spectrum"}) {
    SCOPED_TRACE(values);
    EXPECT_EQ(error_of(chain_of(255, values, one)), "no error");
    EXPECT_NE(error_of(chain_of(256, values, one)).find("more than 256 levels deep"),
              std::string::npos);
    // 1, 3, 7, ... 8191 textures.
    EXPECT_EQ(error_of(chain_of(12, values, both)), "no error");
    EXPECT_NE(error_of(chain_of(13, values, both)).find("\"t13\" looks up more than 10000"),
              std::string::npos);
    EXPECT_EQ(error_of(chain_of(20000, values, itself)), "no error") << "each is the one before it";
  }
  std::string backwards;
  for (int i = 0; i < 20000; ++i)
    backwards += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\" \"t" +
                 std::to_string(i + 1) + "\"\n";
  backwards += "Texture \"t20000\" \"float\" \"constant\"";
  EXPECT_NE(error_of(backwards).find("more than 256 levels deep"), std::string::npos);
}

TEST(TextureLibrary, ErrorsNameThePlace) {
  EXPECT_EQ(error_of(R"(Texture "a" "float" "scale" "texture tex" "b")").find("t.pbrt:2:"), 0u);
  EXPECT_NE(error_of(R"(Texture "a" "float" "scale" "texture tex" "b")").find("named \"b\""),
            std::string::npos);
  EXPECT_NE(error_of(R"(Texture "a" "float" "scale" "texture tex" "b"
                        Texture "b" "float" "scale" "texture tex" "a")")
                .find("refers to itself"),
            std::string::npos);
  EXPECT_NE(error_of(R"(Texture "a" "float" "wood")").find("unknown texture class"),
            std::string::npos);
  EXPECT_NE(error_of(R"(Texture "a" "float" "constant" Texture "a" "float" "constant")")
                .find("already defined"),
            std::string::npos);
  EXPECT_NE(error_of(R"(Texture "a" "float" "checkerboard" "integer dimension" 4)").find("2 or 3"),
            std::string::npos);
  EXPECT_NE(error_of(R"(Texture "a" "float" "checkerboard" "string mapping" "cubic")")
                .find("unknown texture mapping"),
            std::string::npos);
  EXPECT_NE(error_of(R"(Texture "s" "spectrum" "constant"
                        Texture "a" "float" "scale" "texture tex" "s")")
                .find("expected a float one"),
            std::string::npos);
}

TEST(TextureLibrary, WarnsOfWhatNobodyReads) {
  const Textures t(R"(Texture "a" "float" "constant" "float valeu" 3)");
  EXPECT_NE(t.warnings().find("valeu"), std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing_texture
