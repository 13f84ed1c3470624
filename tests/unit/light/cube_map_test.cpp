// Infinite lights with the six faces of a cube: the direction that each pixel shines from, RGBD
// images, and damaged cubes.
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

constexpr int kSide = 32;

/// The direction of a point of a face, by the corners that OpenGL's table gives it: the upper left
/// one, and the edges to the right and downwards.
Vec3f on_face(int face, float s, float t) {
  struct Frame {
    Vec3f corner, right, down;
  };
  const Frame frames[6] = {
      {{1, 1, 1}, {0, 0, -2}, {0, -2, 0}}, {{-1, 1, -1}, {0, 0, 2}, {0, -2, 0}},
      {{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}}, {{-1, -1, 1}, {2, 0, 0}, {0, 0, -2}},
      {{-1, 1, 1}, {2, 0, 0}, {0, -2, 0}}, {{1, 1, -1}, {-2, 0, 0}, {0, -2, 0}},
  };
  const Frame& f = frames[face];
  return normalize(f.corner + f.right * s + f.down * t);
}

/// A sky that is smooth across all edges.
float smooth(const Vec3f& w) {
  return 2 + w.x + 0.5f * w.y + 0.3f * w.z;
}

class CubeLight : public ::testing::Test {
 protected:
  CubeLight() {
    for (int face = 0; face < 6; ++face) {
      std::vector<float> rgb;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          rgb.insert(rgb.end(), 3, smooth(on_face(face, at(x), at(y))));
      write_square(scratch.file(std::to_string(face) + ".exr"), kSide, rgb);
    }
  }
  static float at(int pixel) { return (static_cast<float>(pixel) + 0.5f) / kSide; }
  LightPtr make(const std::string& before = "",
                const std::string& faces = R"("0.exr" "1.exr" "2.exr" "3.exr" "4.exr" "5.exr")",
                const std::string& more = "") const {
    return light_of(before + "\nLightSource \"infinite\" \"string faces\" [" + faces + "] " + more,
                    {}, scratch.path().string());
  }
  /// Grey value of the light in a direction.
  static double value(const Light& light, const Vec3f& w) {
    const Spectrum& white = RgbColorSpace::srgb().illuminant();
    const double unit = white.sample(test_wavelengths())[0] / spectrum_to_photometric(white);
    return light.radiance_at_infinity({0, 0, 0}, w, test_wavelengths())[0] / unit;
  }
  ScratchDirectory scratch;
};

TEST_F(CubeLight, ShinesAsItsFacesShow) {
  const LightPtr light = make();
  TestRandom random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec2f u = random.next2();
    const Vec3f w = on_face(i % 6, u.x, u.y);
    EXPECT_NEAR(value(*light, w), smooth(w), 0.06) << w.x << " " << w.y << " " << w.z;
  }
}

TEST_F(CubeLight, TurnsWithItsTransform) {
  // A quarter turn about y takes +z to +x.
  const LightPtr light = make("Rotate 90 0 1 0");
  EXPECT_NEAR(value(*light, {1, 0, 0}), smooth({0, 0, 1}), 0.05);
  EXPECT_NEAR(value(*light, {0, 0, 1}), smooth({-1, 0, 0}), 0.05);
  EXPECT_NEAR(
      value(*make("", R"("0.exr" "1.exr" "2.exr" "3.exr" "4.exr" "5.exr")", "\"float scale\" 3"),
            {1, 0, 0}),
      3 * smooth({1, 0, 0}), 0.15);
}

TEST_F(CubeLight, AlphaDividesTheColor) {
  OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto out = OIIO::ImageOutput::create(scratch.file("bright.png"));
  const uint8_t pixel[4] = {128, 128, 128, 51};
  ASSERT_TRUE(out && out->open(scratch.file("bright.png"), spec));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, pixel));
  out->close();
  std::string all;
  for (int i = 0; i < 6; ++i) all += "\"bright.png\" ";
  const double decoded = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(value(*make("", all), {0, 1, 0}), decoded * 5, 1e-3 * decoded * 5);
}

TEST_F(CubeLight, RefusesOtherCubes) {
  write_square(scratch.file("wide.exr"), 2, std::vector<float>(6, 1.0f));
  write_square(scratch.file("small.exr"), 1, std::vector<float>(3, 1.0f));
  const auto error = [&](const std::string& faces, const std::string& more = "") -> std::string {
    try {
      make("", faces, more);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  };
  const std::string five = R"("0.exr" "1.exr" "2.exr" "3.exr" "4.exr" )";
  const std::string six = five + R"("5.exr")";
  EXPECT_EQ(error(six), "");
  EXPECT_NE(error(five).find("\"faces\" has 5 names, expected 6 images"), std::string::npos);
  EXPECT_NE(error(five + "\"wide.exr\"").find("is 2 x 1, expected a square"), std::string::npos);
  EXPECT_NE(error(five + "\"small.exr\"").find("32 and 1 pixels a side"), std::string::npos);
  EXPECT_NE(error(five + "\"none.exr\"").find("none.exr"), std::string::npos);
  EXPECT_NE(error(six, "\"string filename\" \"0.exr\"").find("\"faces\" and \"filename\""),
            std::string::npos);
  EXPECT_NE(error(six, "\"rgb L\" [1 1 1]").find("both \"L\" and an image"), std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing_light
