// Bilerp, dots, directionmix and products of images with constants, against their formulas.
#include <cmath>

#include "scene/texture/noise.h"
#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

TEST(BilerpTexture, InterpolatesBetweenItsCorners) {
  const Textures t(
      "Texture \"a\" \"float\" \"bilerp\" \"float v00\" 1 \"float v10\" 2 \"float v01\" 4 "
      "\"float v11\" 8 \"float uscale\" 2 Texture \"d\" \"float\" \"bilerp\"");
  EXPECT_FLOAT_EQ(t.value("a", 0, 0), 1);
  EXPECT_FLOAT_EQ(t.value("a", 0.5f, 0), 2);
  EXPECT_FLOAT_EQ(t.value("a", 0, 1), 4);
  EXPECT_FLOAT_EQ(t.value("a", 0.5f, 1), 8);
  EXPECT_FLOAT_EQ(t.value("a", 0.25f, 0.25f), 0.75f * 1.5f + 0.25f * 6);
  // The interpolation continues beyond the square.
  EXPECT_FLOAT_EQ(t.value("a", 1, 0), 3);
  // The defaults rise from 0 to 1 with t.
  EXPECT_FLOAT_EQ(t.value("d", 0.3f, 0.7f), 0.7f);
}

TEST(BilerpTexture, InterpolatesSpectra) {
  const Textures t(
      "Texture \"a\" \"spectrum\" \"bilerp\" \"rgb v00\" [.2 .2 .2] \"rgb v10\" [.4 .4 .4] "
      "\"spectrum v01\" [300 .6 800 .6] \"rgb v11\" [1 1 1]"
      "Texture \"d\" \"spectrum\" \"bilerp\"");
  for (const SpectrumKind kind : {SpectrumKind::kAlbedo, SpectrumKind::kUnbounded}) {
    EXPECT_NEAR(t.level("a", 0, 0, kind), 0.2f, 1e-3f);
    EXPECT_NEAR(t.level("a", 1, 0, kind), 0.4f, 1e-3f);
    EXPECT_NEAR(t.level("a", 0, 1, kind), 0.6f, 1e-3f);
    EXPECT_NEAR(t.level("a", 1, 1, kind), 1.0f, 1e-3f);
    EXPECT_NEAR(t.level("a", 0.5f, 0.5f, kind), 0.55f, 1e-3f);
  }
  EXPECT_NEAR(t.level("d", 0.3f, 0.7f), 0.7f, 1e-6f);
  EXPECT_EQ(error_of("Texture \"a\" \"spectrum\" \"bilerp\" \"rgb v10\" [1 1]").find("t.pbrt:2:"),
            0u);
}

TEST(DotsTexture, AboutHalfOfTheCellsHaveADiscOfTheKnownArea) {
  const Textures t("Texture \"a\" \"float\" \"dots\" \"float inside\" 0 \"float outside\" 1");
  const int cells = 40, samples = 20;
  int dots = 0;
  double covered = 0, expected = 0;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      int hits = 0;
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i)
          hits += t.value("a", float(x) - 0.5f + (float(i) + 0.5f) / samples,
                          float(y) - 0.5f + (float(j) + 0.5f) / samples) > 0.5f
                      ? 1
                      : 0;
      const double area = double(hits) / (samples * samples);
      // A whole disc or none: shifted discs stay inside their cell.
      if (hits > 0) {
        EXPECT_NEAR(area, kPi * 0.35 * 0.35, 0.02) << x << " " << y;
      }
      dots += hits > 0 ? 1 : 0;
      covered += area;
      const bool wanted = noise(Vec3f(float(x) + 0.5f, float(y) + 0.5f, 0.5f)) > 0;
      EXPECT_EQ(hits > 0, wanted);
      expected += wanted ? kPi * 0.35 * 0.35 : 0;
    }
  }
  EXPECT_NEAR(covered, expected, 0.002 * expected);
  // Noise at the centres of cells is as often positive as negative (and sometimes 0).
  EXPECT_GT(dots, 0.3 * cells * cells);
  EXPECT_LT(dots, 0.6 * cells * cells);
}

TEST(DotsTexture, ShowsWhatPbrtShows) {
  // (1,0) has a dot, because the noise at (1.5, 0.5, 0.5) is positive. As in pbrt-v4, discs show
  // the parameter "outside". Half a cell from the centre there is never a disc.
  int x = 0;
  while (!(noise(Vec3f(float(x) + 0.5f, 0.5f, 0.5f)) > 0)) ++x;
  const Textures t(
      "Texture \"a\" \"float\" \"dots\" \"float inside\" 3 \"float outside\" 5 "
      "Texture \"d\" \"float\" \"dots\" "
      "Texture \"s\" \"spectrum\" \"dots\" \"rgb inside\" [.3 .3 .3] \"rgb outside\" [.5 .5 .5]");
  EXPECT_EQ(t.value("a", float(x), 0), 5.0f);
  EXPECT_EQ(t.value("a", float(x) + 0.5f, 0.5f), 3.0f);
  EXPECT_EQ(t.value("d", float(x), 0), 0.0f);
  EXPECT_EQ(t.value("d", float(x) + 0.5f, 0.5f), 1.0f);
  EXPECT_NEAR(t.level("s", float(x), 0), 0.5f, 1e-3f);
  EXPECT_NEAR(t.level("s", float(x) + 0.5f, 0.5f), 0.3f, 1e-3f);
}

TEST(DirectionMixTexture, FollowsTheCosine) {
  const Textures t(
      "AttributeBegin Rotate 90 1 0 0\n"  // y becomes z
      "Texture \"a\" \"float\" \"directionmix\" \"float tex1\" 10 \"float tex2\" 20\n"
      "Texture \"s\" \"spectrum\" \"directionmix\" \"vector3 dir\" [0 -3 0]\n"
      "AttributeEnd");
  for (int degrees = 0; degrees <= 180; degrees += 15) {
    const float angle = float(degrees) * kPi / 180.0f;
    TextureContext context;
    context.n = Vec3f(std::sin(angle), 0, std::cos(angle));
    const float w = std::abs(std::cos(angle));
    EXPECT_NEAR(t.number("a")->eval(context), 10 * w + 20 * (1 - w), 1e-4f) << degrees;
    // The defaults are 0 where the surface faces the direction and 1 where it is perpendicular.
    const SampledSpectrum s =
        t.spectrum("s")->eval(context, SampledWavelengths::sample_visible(0.3f));
    EXPECT_NEAR(s.average(), 1 - w, 1e-5f) << degrees;
  }
}

TEST(DirectionMixTexture, LooksAtTheGeometricNormal) {
  SurfaceInteraction hit;
  hit.p = Vec3f(0, 0, 0);
  hit.uv = Vec2f(0, 0);
  hit.ng = Vec3f(0, 1, 0);
  hit.shading = Frame::from_z(Vec3f(1, 0, 0));
  const Textures t("Texture \"a\" \"float\" \"directionmix\" \"float tex1\" 10 \"float tex2\" 20");
  EXPECT_EQ(t.number("a")->eval(TextureContext(hit)), 10.0f);
}

TEST(DirectionMixTexture, WantsADirection) {
  EXPECT_EQ(error_of("Texture \"a\" \"float\" \"directionmix\" \"vector3 dir\" [0 0 0]")
                .find("t.pbrt:2:"),
            0u);
}

TEST(TextureTable, TellsWhatAClassCannotDo) {
  EXPECT_NE(error_of("Texture \"a\" \"float\" \"ptex\"").find("no Ptex library"),
            std::string::npos);
  EXPECT_NE(error_of("Texture \"a\" \"spectrum\" \"fbm\"").find("float values only"),
            std::string::npos);
  EXPECT_NE(error_of("Texture \"a\" \"float\" \"marble\"").find("spectrum values only"),
            std::string::npos);
  EXPECT_NE(error_of("Texture \"a\" \"float\" \"plaid\"").find("unknown texture class \"plaid\""),
            std::string::npos);
}

class ScaledImage : public ::testing::Test {
 protected:
  Textures make(const std::string& text) const { return Textures(text, scratch.path().string()); }
  ScratchDirectory scratch;
};

TEST_F(ScaledImage, AConstantScaleMultipliesWhatIsStored) {
  write_image<float>(scratch.file("a.exr"), 1, 1, 1, OIIO::TypeDesc::FLOAT, {0.3f});
  const std::string image =
      "\"imagemap\" \"string filename\" \"a.exr\" \"float scale\" 2 \"bool invert\" true\n";
  const Textures t = make(
      "Texture \"i\" \"float\" " + image +
      "Texture \"a\" \"float\" \"scale\" \"texture tex\" \"i\" \"float scale\" .5\n"
      "Texture \"b\" \"float\" \"scale\" \"float tex\" .5 \"texture scale\" \"i\"\n"
      "Texture \"v\" \"float\" \"bilerp\" \"float v00\" .5 \"float v01\" .5 \"float v10\" .5"
      " \"float v11\" .5\n"
      "Texture \"c\" \"float\" \"scale\" \"texture tex\" \"i\" \"texture scale\" \"v\"\n"
      "Texture \"I\" \"spectrum\" " +
      image + "Texture \"A\" \"spectrum\" \"scale\" \"texture tex\" \"I\" \"float scale\" .5\n");
  EXPECT_FLOAT_EQ(t.value("i", 0, 0), 0.4f);
  EXPECT_FLOAT_EQ(t.value("a", 0, 0), 0.7f);
  EXPECT_FLOAT_EQ(t.value("b", 0, 0), 0.7f);
  // A varying scale multiplies the result.
  EXPECT_FLOAT_EQ(t.value("c", 0, 0), 0.2f);
  EXPECT_NEAR(t.level("A", 0, 0), 0.7f, 1e-3f);
}

TEST_F(ScaledImage, ReflectancesAreClampedAfterTheScale) {
  write_image<float>(scratch.file("a.exr"), 1, 1, 1, OIIO::TypeDesc::FLOAT, {4.0f});
  const Textures t = make(
      "Texture \"I\" \"spectrum\" \"imagemap\" \"string filename\" \"a.exr\"\n"
      "Texture \"A\" \"spectrum\" \"scale\" \"texture tex\" \"I\" \"float scale\" .125\n");
  EXPECT_NEAR(t.level("A", 0, 0), 0.5f, 1e-3f);
}

TEST_F(ScaledImage, ThePointFilterTakesTheFirstChannel) {
  write_image<float>(scratch.file("a.exr"), 1, 1, 3, OIIO::TypeDesc::FLOAT, {1, 2, 6});
  const Textures t = make(
      "Texture \"p\" \"float\" \"imagemap\" \"string filename\" \"a.exr\" \"string filter\" "
      "\"point\"");
  EXPECT_EQ(t.value("p", 0, 0), 1.0f);
}

}  // namespace
}  // namespace nephroid::testing_texture
