// The exposure that is chosen for the lights of files that have none.
#include "input/staging/exposure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "input/staging/staging.h"
#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::parse;

/// A small plate around the origin.
const std::string kPlate =
    "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [-.01 0 -.01 .01 0 -.01 .01 0 .01 -.01 0 "
    ".01] \"integer indices\" [0 1 2 0 2 3]\n";

double illuminance(const std::string& lights) {
  return typical_illuminance(parse(kPlate + lights));
}

/// A cube of side 1 that emits, in the middle of its own space.
const std::string kCube =
    "Shape \"trianglemesh\" \"point3 P\" [-.5 -.5 -.5 .5 -.5 -.5 -.5 .5 -.5 .5 .5 -.5 "
    "-.5 -.5 .5 .5 -.5 .5 -.5 .5 .5 .5 .5 .5] \"integer indices\" [0 2 3 0 3 1 4 5 7 4 7 6 "
    "0 4 6 0 6 2 1 3 7 1 7 5 0 1 5 0 5 4 2 6 7 2 7 3]\n";
const std::string kSquare =
    "Shape \"trianglemesh\" \"point3 P\" [-.5 -.5 0 .5 -.5 0 .5 .5 0 -.5 .5 0] "
    "\"integer indices\" [0 1 2 0 2 3]\n";

TEST(TypicalIlluminance, OfLampsFallsWithTheSquare) {
  const double one = illuminance("Translate 0 5 0 LightSource \"point\" \"rgb I\" [100 100 100]\n");
  EXPECT_NEAR(one, 4, 1e-3);
  EXPECT_NEAR(illuminance("LightSource \"point\" \"point3 from\" [0 10 0] \"rgb I\" [50 50 50] "
                          "\"float scale\" 2\n"),
              1, 1e-3);
  EXPECT_EQ(illuminance("LightSource \"point\" \"point3 from\" [0 1 0] \"rgb I\" [0 0 0]\n"), 0);
}

TEST(TypicalIlluminance, OfSpotsIsInTheirCone) {
  const std::string spot = "LightSource \"spot\" \"rgb I\" [4 4 4] \"float coneangle\" 20 ";
  EXPECT_NEAR(illuminance(spot + "\"point3 from\" [0 2 0] \"point3 to\" [0 1 0]\n"), 1, 1e-3);
  EXPECT_EQ(illuminance(spot + "\"point3 from\" [0 2 0] \"point3 to\" [1 2 0]\n"), 0);
}

TEST(TypicalIlluminance, OfLightsAtInfinity) {
  EXPECT_NEAR(illuminance("LightSource \"distant\" \"rgb L\" [3 3 3]\n"), 3, 1e-5);
  EXPECT_NEAR(illuminance("LightSource \"infinite\" \"rgb L\" [3 3 3]\n"), 3 * kPiDouble, 1e-4);
  EXPECT_NEAR(illuminance("LightSource \"infinite\" \"float illuminance\" 7\n"), 7, 1e-5);
}

TEST(TypicalIlluminance, OfMeshesIsThatOfTheAreaSeen) {
  const std::string emits = "Translate 0 20 0 AreaLightSource \"diffuse\" \"rgb L\" [800 800 800] ";
  // A square that looks down, up, and both ways; from this far it is a point.
  EXPECT_NEAR(illuminance(emits + "Rotate 90 1 0 0\n" + kSquare), 2, 0.01);
  EXPECT_NEAR(illuminance(emits + "Rotate -90 1 0 0\n" + kSquare), 0, 1e-6);
  EXPECT_NEAR(illuminance(emits + "\"bool twosided\" true Rotate -90 1 0 0\n" + kSquare), 2, 0.01);
  // The mean area that a convex body shows is a quarter of its surface (Cauchy).
  EXPECT_NEAR(illuminance(emits + "\n" + kCube), 2 * 6 / 4.0, 0.02);
}

/// A square of side `size` at height y, its middle at x.
std::string plate(double x, double y, double size) {
  return fmt::format(
      "AttributeBegin\nTranslate {} {} 0\nScale {} 1 {}\nRotate 90 1 0 0\n{}AttributeEnd\n", x, y,
      size, size, kSquare);
}

TEST(TypicalIlluminance, IsThatOfTheBrightestQuarterAtLeast) {
  // The light has the height 1 above a square of 6 x 6: its brightest quarter is a disk.
  const double radius2 = 36 / 4 / kPiDouble;
  const std::string scene =
      "WorldBegin\nLightSource \"point\" \"point3 from\" [0 1 0] \"rgb I\" [1 1 1]\n";
  EXPECT_NEAR(typical_illuminance(parse(scene + plate(0, 0, 6))), 1 / (1 + radius2), 0.015);
  // A small place near the light does not decide.
  EXPECT_NEAR(typical_illuminance(parse(scene + plate(0, 0, 6) + plate(0, 0.9, 0.1))),
              1 / (1 + radius2), 0.015);
}

TEST(TypicalIlluminance, IsThatOfThePicture) {
  const std::string scene =
      "WorldBegin\nLightSource \"point\" \"point3 from\" [0 2 0] \"rgb I\" [4 4 4]\n" +
      plate(0, 0, 0.1) + plate(30, 0, 9);
  // One camera sees the small plate, another one the large one, and the third none.
  const std::string small = "LookAt 0 1 1 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 30\n";
  const std::string large =
      "LookAt 30 20 1 30 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 90\n";
  const std::string away = "LookAt 0 1 1 0 2 2 0 1 0\nCamera \"perspective\" \"float fov\" 30\n";
  EXPECT_NEAR(typical_illuminance(parse(small + scene)), 1, 0.01);
  EXPECT_LT(typical_illuminance(parse(large + scene)), 0.01);
  EXPECT_LT(typical_illuminance(parse(away + scene)), 0.01);
  const std::string flat =
      "LookAt 0 1 0 0 0 0 0 0 1\nCamera \"orthographic\" \"float screenwindow\" [-1 1 -1 1]\n";
  EXPECT_NEAR(typical_illuminance(parse(flat + scene)), 1, 0.01);
}

TEST(TypicalIlluminance, CountsInstances) {
  EXPECT_NEAR(typical_illuminance(parse(
                  "WorldBegin\nLightSource \"point\" \"rgb I\" [9 9 9]\nObjectBegin \"o\"\nScale "
                  ".01 .01 .01\n" +
                  kSquare + "ObjectEnd\nTranslate 3 0 0\nObjectInstance \"o\"\n")),
              1, 0.01);
}

struct Staged {
  double iso;
  std::vector<Warning> notes;
};

Staged exposed(const std::string& text, const FormatTraits& format = {},
               const ImportOptions& options = {}) {
  SceneDescription scene = parse("Camera \"perspective\"\n" + kPlate + text);
  Diagnostics diagnostics;
  stage_scene(&scene, format, options, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  return {scene.film ? scene.film->parameters.get_float("iso", 100) : 100, diagnostics.notes()};
}

const std::string kSunlight = "LightSource \"distant\" \"rgb L\" [50000 50000 50000]\n";

TEST(ChosenExposure, GivesAWhiteSurfaceTheValueOne) {
  const Staged chosen = exposed(kSunlight);
  EXPECT_NEAR(chosen.iso / 100 * 50000 / kPiDouble, 1, 1e-5);
  ASSERT_EQ(chosen.notes.size(), 1u);
  EXPECT_EQ(chosen.notes[0].message,
            "the exposure is chosen for the file's lights: -14.0 stops (--exposure gives another, "
            "0 keeps the file's units)");
}

TEST(ChosenExposure, YieldsToTheUserTheSunAndTheFilesOwn) {
  ImportOptions given;
  given.exposure = 0;
  EXPECT_EQ(exposed(kSunlight, {}, given).iso, 100);
  given.exposure = 3;
  EXPECT_EQ(exposed(kSunlight, {}, given).iso, 800);
  ImportOptions sun;
  sun.sun = SunDirection{30, 90};
  const std::string lamp = "LightSource \"point\" \"rgb I\" [1 1 1]\n";
  EXPECT_EQ(exposed(lamp, {}, sun).iso, exposed("", {}, sun).iso);
  const Staged own = exposed(kSunlight, {.has_exposure = true});
  EXPECT_EQ(own.iso, 100);
  EXPECT_TRUE(own.notes.empty());
}

TEST(ChosenExposure, LeavesTheStudioLightAlone) {
  EXPECT_EQ(exposed("").iso, 100);
}

TEST(ChosenExposure, IsNotForDisplaysThatGlow) {
  const auto note = [](const std::string& emission) {
    const Staged s =
        exposed("Translate 0 9 0 AreaLightSource \"diffuse\" " + emission + kCube, {.glow = 1});
    EXPECT_EQ(s.notes.size(), 1u);
    return s.notes.at(0).message.substr(0, 25);
  };
  EXPECT_EQ(note("\"rgb L\" [0.2 1 0.2] "), "the file has no light: a ");
  EXPECT_EQ(note("\"rgb L\" [0.2 1.1 0.2] "), "the exposure is chosen fo");
  EXPECT_EQ(note("\"string filename\" \"a.png\" \"rgb factor\" [1 1 1] "),
            "the file has no light: a ");
}

}  // namespace
}  // namespace nephroid
