// "power" is the emission of a light in lumens for any colour and image, measured by emitted rays.
// "illuminance" is the light that arrives.
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

class LightPower : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<float> rgb;
    for (int i = 0; i < 64; ++i)
      for (const int period : {5, 3, 7}) rgb.push_back(0.1f + static_cast<float>(i % period));
    write_square(scratch.file("a.exr"), 8, rgb);
    write_square(scratch.file("wide.exr"), 16, rgb);
  }

  ScratchDirectory scratch;
};

TEST_F(LightPower, OfLightsAtAPoint) {
  for (const std::string colour : {"", "\"blackbody I\" 3000 ", "\"rgb I\" [0.9 0.2 0.1] "})
    for (const std::string light : {"\"point\" ", "\"spot\" \"float coneangle\" 50 ",
                                    "\"goniometric\" \"string filename\" \"a.exr\" "}) {
      const LightPtr lamp = light_of(
          "Scale 2 2 2 LightSource " + light + colour + "\"float power\" 60 \"float scale\" 0.5",
          {}, scratch.path().string());
      const Mean flux = luminous_flux(*lamp, 40000);
      // "scale" and "power" multiply. The luminance of an rgb light is that of its illuminant.
      if (colour.find("rgb") == std::string::npos) {
        EXPECT_TRUE(agrees(flux, 30, 0.03)) << light << colour;
      } else {
        const double y = RgbColorSpace::srgb().to_xyz({0.9f, 0.2f, 0.1f}).y;
        EXPECT_TRUE(agrees(flux, 30 * y, 0.1 * y)) << light << colour;
      }
    }
}

TEST_F(LightPower, OfProjectedImages) {
  for (const char* image : {"a.exr", "wide.exr"}) {
    const LightPtr lamp =
        light_of(std::string("LightSource \"projection\" \"string filename\" \"") + image +
                     "\" \"float power\" 60 \"float fov\" 80",
                 {}, scratch.path().string());
    // As in pbrt-v4 each pixel counts with the solid angle at its centre: a few thousandths off
    // with so few pixels.
    EXPECT_TRUE(agrees(luminous_flux(*lamp, 40000), 60, 0.15)) << image;
  }
}

TEST_F(LightPower, OfShapes) {
  const ShapePtr disk = make_disk(Transform(), true, 2, 1.5f, 0, 360);
  for (const std::string sides : {"", "\"bool twosided\" true "}) {
    for (const std::string colour : {"", "\"blackbody L\" 3000 "})
      EXPECT_TRUE(
          agrees(luminous_flux(*area_light_of(sides + colour + "\"float power\" 60", disk), 40000),
                 60, 0.03))
          << sides << colour;
    // The sum is constant per pixel, the shape interpolates: the means differ slightly.
    const auto lamp = area_lights_of(sides + "\"string filename\" \"a.exr\" \"float power\" 60",
                                     rectangle(1, 2, 3), nullptr, scratch.path().string());
    EXPECT_NEAR(luminous_flux(*lamp.at(0), 40000).mean(), 60, 0.02 * 60) << sides;
  }
}

TEST_F(LightPower, IlluminanceIsWhatArrives) {
  // At a surface that faces the light, or lies below the sky.
  for (const char* text :
       {"\"distant\" \"point3 from\" [0 0 1] \"point3 to\" [0 0 0]", "\"infinite\""})
    for (const std::string colour : {"", "\"blackbody L\" 3000 "}) {
      const LightPtr light =
          light_of(std::string("LightSource ") + text + colour + " \"float illuminance\" 50");
      TestRandom random(4);
      Mean mean;
      for (int i = 0; i < 40000; ++i) {
        const auto lambda = SampledWavelengths::sample_visible(random.next());
        const auto s = light->sample_towards({0, 0, 0}, random.next2(), lambda);
        ASSERT_TRUE(s);
        double y = 0;
        for (int k = 0; k < kSpectrumSamples; ++k)
          y += s->radiance[k] * cie_xyz(lambda.lambda(k)).y / lambda.pdf()[k] / kSpectrumSamples;
        mean.add(y * std::max(0.0f, s->wi.z) / s->pdf_w);
      }
      EXPECT_TRUE(agrees(mean, 50, 0.03)) << text << colour;
    }
}

TEST_F(LightPower, WarnsOfFluxThatIsNotAboveZero) {
  const auto warnings = [](const std::string& text) {
    Diagnostics found;
    lights_of(text, ".", &found);
    std::string all;
    for (const Warning& w : found.warnings()) all += w.message + '\n';
    return all;
  };
  EXPECT_NE(warnings("LightSource \"point\" \"float power\" 0")
                .find("\"power\" is 0 and so not used, expected a value above 0"),
            std::string::npos);
  EXPECT_NE(warnings("LightSource \"infinite\" \"float illuminance\" -2")
                .find("\"illuminance\" is -2 and so not used"),
            std::string::npos);
  EXPECT_NE(warnings("LightSource \"point\" \"float power\" 1e-60").find("not used"),
            std::string::npos);
  for (const char* value : {"3", "-1"})
    EXPECT_EQ(warnings(std::string("LightSource \"point\" \"float power\" ") + value), "");
  Diagnostics found;
  area_lights_of("\"float power\" 0", rectangle(1, 2, 3), nullptr, ".", &found);
  ASSERT_EQ(found.warnings().size(), 1u);
  EXPECT_NE(found.warnings()[0].message.find("\"power\" is 0 and so not used"), std::string::npos);
}

TEST_F(LightPower, BlackImagesAreBlackWhateverTheirPower) {
  write_square(scratch.file("black.exr"), 2, std::vector<float>(12, 0.0f));
  const auto lamp = area_lights_of("\"string filename\" \"black.exr\" \"float power\" 60",
                                   rectangle(1, 2, 3), nullptr, scratch.path().string());
  EXPECT_EQ(lamp.at(0)->power(), 0.0f);
  EXPECT_EQ(luminous_flux(*lamp.at(0), 10).mean(), 0.0);
}

}  // namespace
}  // namespace nephroid::testing_light
