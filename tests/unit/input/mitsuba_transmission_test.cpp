// The colour of light that passes Mitsuba's principled BSDFs.
#include <cmath>

#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

std::string number_element(const std::string& name, const std::string& value) {
  return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}

const std::string kClear = number_element("spec_trans", "1");
const std::string kGreen = "<rgb name=\"base_color\" value=\"0.25 0.64 0\"/>";

/// The parameters of the BSDF of that type on a sphere.
ParameterSet parameters_of(MitsubaScene& scene, const std::string& type, const std::string& body) {
  const SceneDescription d = scene.read(
      "<shape type=\"sphere\"><bsdf type=\"" + type + "\">" + body + "</bsdf></shape>\n", "3.0.0");
  return d.materials.at(0).parameters;
}

void expect_numbers(const ParameterSet& set, const std::vector<double>& expected) {
  const std::vector<double> found = parameter(set, "transmission_color").numbers;
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
}

TEST(MitsubaTransmission, GlassHasTheBaseColourAfterTwoInterfaces) {
  MitsubaScene scene;
  expect_numbers(parameters_of(scene, "principled", kClear + kGreen), {0.5, 0.8, 0});
  const double half = std::sqrt(0.5);
  expect_numbers(parameters_of(scene, "principled", kClear), {half, half, half});
  const ParameterSet spectral = parameters_of(
      scene, "principled", kClear + "<spectrum name=\"base_color\" value=\"400:0.25, 700:0.81\"/>");
  expect_numbers(spectral, {400, 0.5, 700, 0.9});
  EXPECT_EQ(scene.warnings().find("base colour"), std::string::npos) << scene.warnings();
}

TEST(MitsubaTransmission, AThinSheetHasTheBaseColour) {
  MitsubaScene scene;
  expect_numbers(parameters_of(scene, "principledthin", kClear + kGreen), {0.25, 0.64, 0});
}

TEST(MitsubaTransmission, ATexturedBaseColourIsAWarningIfLightPasses) {
  const std::string checks = "<texture type=\"checkerboard\" name=\"base_color\"/>";
  MitsubaScene opaque, clear;
  parameters_of(opaque, "principled", checks + number_element("spec_trans", "0"));
  EXPECT_EQ(opaque.warnings().find("base colour"), std::string::npos) << opaque.warnings();
  const ParameterSet set = parameters_of(clear, "principled", checks + kClear);
  EXPECT_EQ(parameter(set, "transmission_color").type, "texture");
  EXPECT_NE(clear.warnings().find("its base colour tints light once"), std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing
