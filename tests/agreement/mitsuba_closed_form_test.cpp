// Pictures of Mitsuba scenes whose light has a closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/mitsuba_pictures.h"
#include "core/spectra.h"

namespace nephroid {
namespace {

using namespace testing_support;

void expect_estimate(const Estimate& e, double expected) {
  std::printf("off by %+.3f %%, standard error %.3f %%\n", 100 * (e.mean / expected - 1),
              100 * e.error / expected);
  EXPECT_NEAR(e.mean, expected, kT15 * e.error + 1e-4 * expected);
  EXPECT_LT(e.error, max_error(0.01 * expected)) << "too noisy to tell";
}

/// A picture of constant light and nothing else.
std::string sky(const std::string& radiance) {
  return camera("0,0,0", "0,0,-1") + plugin("emitter", "constant", radiance);
}

TEST(MitsubaClosedForm, ConstantLightHasItsColour) {
  Pictures pictures;
  const Rgb found = pictures.color(sky(value("rgb", "radiance", "1 2 4")));
  EXPECT_NEAR(found.r, 1, 0.05);
  EXPECT_NEAR(found.g, 2, 0.05);
  EXPECT_NEAR(found.b, 4, 0.1);
}

TEST(MitsubaClosedForm, SpectraAndBlackBodiesHaveAbsoluteLuminance) {
  Pictures pictures;
  const auto luminance = [&](const std::string& radiance, const char* version = "0.6.0") {
    return RgbColorSpace::srgb().to_xyz(pictures.color(sky(radiance), 1024, version)).y;
  };
  const double peak = spectrum_to_xyz(*piecewise_linear_spectrum({500, 550, 600}, {0, 3, 0})).y;
  EXPECT_NEAR(luminance(value("spectrum", "radiance", "500:0, 550:3, 600:0")), peak, 0.02 * peak);
  // Equal energy of value 2 has luminance 2.
  EXPECT_NEAR(luminance(value("spectrum", "radiance", "2"), "3.0.0"), 2, 0.04);
  // 1.26e4 W / (m^2 sr nm), see the unit test.
  EXPECT_NEAR(luminance("<blackbody name=\"radiance\" temperature=\"5000\"/>"), 1.26e4, 0.03e4);
}

TEST(MitsubaClosedForm, PointDirectionalAndSpotLightsOnAFloor) {
  Pictures pictures;
  const auto expect_light = [&](const std::string& type, const std::string& body, double expected) {
    expect_estimate(pictures.mean(from_above() + floor_of_0_6() + plugin("emitter", type, body)),
                    0.6 / kPi * expected);
  };
  const std::string intensity = value("rgb", "intensity", "8 8 8");
  expect_light("point", value("point", "position", "0 0 2") + intensity, 8.0 / 4);
  expect_light("directional",
               value("vector", "direction", "0 3 -4") + value("rgb", "irradiance", "5 5 5"),
               5 * 0.8);
  expect_light("spot",
               to_world("<lookat origin=\"0,0,2\" target=\"0,0,0\" up=\"0,1,0\"/>") + intensity,
               8.0 / 4);
}

TEST(MitsubaClosedForm, ADiskOverAFloor) {
  // Irradiance pi L R^2 / (R^2 + h^2); the disk faces down.
  Pictures pictures;
  const std::string lamp = plugin(
      "shape", "disk",
      to_world("<rotate x=\"1\" angle=\"180\"/><scale value=\"1.5\"/><translate z=\"3.5\"/>") +
          plugin("emitter", "area", value("rgb", "radiance", "2 2 2")));
  expect_estimate(pictures.mean(from_above() + floor_of_0_6() + lamp, 64),
                  0.6 * 2 * 1.5 * 1.5 / (1.5 * 1.5 + 3.5 * 3.5));
}

TEST(MitsubaClosedForm, AbsorptionInAMedium) {
  Pictures pictures;
  const std::string ball =
      plugin("shape", "sphere",
             plugin("medium", "homogeneous",
                    value("rgb", "sigmaA", "0.5 0.5 0.5") + value("rgb", "sigmaS", "0 0 0"),
                    "name=\"interior\""));
  expect_estimate(pictures.mean(from_above() + ball + plugin("emitter", "constant")),
                  std::exp(-1.0));
}

/// A BSDF on a square under a white sky, looked at from above.
std::string under_sky(const std::string& type, const std::string& body) {
  return from_above() + plugin("emitter", "constant") +
         plugin("shape", "rectangle", plugin("bsdf", type, body));
}

TEST(MitsubaClosedForm, LinearPlasticReflectsFresnelAndTheRestByItsColour) {
  // The sky reflects F, and by the reciprocal diffuse lobe of Mitsuba (1 - F) rho.
  Pictures pictures;
  pictures.folder().write("grey.pfm", pfm(1, 1, {{0.5f, 0.5f, 0.5f}}));
  const std::string indices = value("float", "intIOR", "1.5") + value("float", "extIOR", "1");
  for (const std::string& color :
       {value("spectrum", "diffuseReflectance", "0.5"), bitmap("diffuseReflectance", "grey.pfm")})
    expect_estimate(pictures.mean(under_sky("plastic", indices + color), 64), 0.04 + 0.96 * 0.5);
}

TEST(MitsubaClosedForm, BlendsMasksAndMirrorsUnderASky) {
  Pictures pictures;
  const std::string half = plugin("bsdf", "diffuse", value("spectrum", "reflectance", "0.5"));
  const std::string mirror = plugin("bsdf", "conductor", value("string", "material", "none"));
  const auto expect_bsdf = [&](const std::string& type, const std::string& body, double expected) {
    expect_estimate(pictures.mean(under_sky(type, body), 256), expected);
  };
  expect_bsdf("blendbsdf", value("float", "weight", "0.25") + half + mirror, 0.75 * 0.5 + 0.25);
  // Through the mask the sky below is seen.
  expect_bsdf("mask", value("float", "opacity", "0.25") + half, 0.25 * 0.5 + 0.75);
  expect_bsdf("mixturebsdf", value("string", "weights", "0.5, 0.25") + half + mirror, 0.25 + 0.25);
}

TEST(MitsubaClosedForm, ReflectancesHaveTheirColourUnderAWhiteSky) {
  // Values of <srgb> and of hexadecimal colours are coded: 0x80 / 255 is 0.2159 in linear light.
  Pictures pictures;
  const std::vector<std::pair<std::string, Rgb>> colors = {
      {value("rgb", "reflectance", "0.7, 0.3, 0.1"), {0.7f, 0.3f, 0.1f}},
      {value("rgb", "reflectance", "#ff8080"), {1, 0.2159f, 0.2159f}},
      {value("srgb", "reflectance", "0.5 0.5 1"), {0.2140f, 0.2140f, 1}}};
  for (const auto& [color, expected] : colors) {
    const Rgb found = pictures.color(under_sky("diffuse", color), 1024);
    EXPECT_NEAR(found.r, expected.r, 0.015) << color;
    EXPECT_NEAR(found.g, expected.g, 0.015) << color;
    EXPECT_NEAR(found.b, expected.b, 0.015) << color;
  }
}

}  // namespace
}  // namespace nephroid
