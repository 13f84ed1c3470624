// Errors in media: the message names the location, the fault and what was expected.
#include "unit/medium/medium_fixture.h"

namespace nephroid::testing_medium {
namespace {

std::string message_of(const std::string& type, const std::string& parameters,
                       const std::string& transform = "") {
  try {
    medium_of(type, parameters, transform);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(MediumErrors, SayWhereWhatAndWhatWasExpected) {
  const std::string density = "\"float density\" [ 1 2 3 4 ] ";
  const std::string colors = "\"rgb sigma_a\" [ 1 1 1 ] ";
  const struct {
    std::string type, parameters, transform, expected;
  } cases[] = {
      {"homogenous", "", "", "did you mean \"homogeneous\"?"},
      {"fog", "", "", "expected one of \"homogeneous\", \"uniformgrid\""},
      {"homogeneous", "\"string preset\" \"Skin\"", "", "did you mean \"Skin1\"?"},
      {"homogeneous", "\"float g\" 1.5", "", "from -1 to 1"},
      {"homogeneous", "\"float scale\" -1", "", "\"scale\" must be a number that is not negative"},
      {"homogeneous", "\"float Lescale\" -1", "", "\"Lescale\" must be"},
      {"homogeneous", "\"spectrum sigma_a\" [ 400 1 500 -1 ]", "", "\"sigma_a\" is negative"},
      {"homogeneous", "\"rgb sigma_s\" [ 1e38 1e38 0 ] \"float scale\" 10", "",
       "\"sigma_s\" is negative or too large"},
      {"homogeneous", "\"rgb sigma_a\" [ -1 0 0 ]", "", "negative"},
      {"homogeneous", "\"float sigma_a\" 1", "", "expected a parameter of type \"rgb\""},
      {"uniformgrid", "", "", "has no \"density\""},
      {"uniformgrid", density, "", "4 values, expected nx x ny x nz = 1 x 1 x 1 = 1"},
      {"uniformgrid", density + "\"integer nx\" 0", "", "\"nx\" is 0, expected at least 1"},
      {"uniformgrid", density + "\"integer nx\" -4 \"integer ny\" -1", "", "expected at least 1"},
      // 2^16 * 2^16 * 2^32 is 0 for 32-bit and for 64-bit numbers; 65536 * 65537 is 65536.
      {"uniformgrid",
       density + "\"integer nx\" 65536 \"integer ny\" 65536 \"integer nz\" 2147483647", "",
       "4 values, expected nx x ny x nz = 65536 x 65536 x 2147483647"},
      {"uniformgrid", density + "\"integer nx\" 65536 \"integer ny\" 65536 \"integer nz\" 65536",
       "", "expected nx x ny x nz"},
      {"uniformgrid", density + "\"integer nx\" 4 \"float Lescale\" [ 1 2 ]", "",
       "\"Lescale\" has 2 values, expected nx x ny x nz = 4 x 1 x 1 = 4"},
      {"uniformgrid", density + "\"integer nx\" 4 \"float temperature\" [ 1 ]", "",
       "\"temperature\" has 1 value,"},
      {"uniformgrid", "\"float density\" [ 1 -2 ] \"integer nx\" 2", "",
       "value 1 of \"density\" is negative"},
      {"uniformgrid", "\"float density\" 1 \"float temperature\" 1 \"rgb Le\" [ 1 1 1 ]", "",
       "both \"Le\" and \"temperature\""},
      {"uniformgrid", "\"float density\" 1 \"point3 p1\" [ 1 0 1 ]", "", "span no volume"},
      {"rgbgrid", "", "", "neither \"sigma_a\" nor \"sigma_s\""},
      {"rgbgrid", "\"rgb sigma_s\" [ 1 1 1 ] \"rgb Le\" [ 1 1 1 ]", "",
       "\"Le\" without \"sigma_a\""},
      {"rgbgrid", colors + "\"integer nx\" 2", "", "1 value, expected nx x ny x nz = 2 x 1 x 1"},
      {"rgbgrid", "\"rgb sigma_a\" [ 1 1 1 1 -1 1 ] \"integer nx\" 2", "",
       "colour 1 of \"sigma_a\" is negative"},
      {"rgbgrid", "\"float sigma_a\" 1", "", "has type \"float\", expected \"rgb\""},
      {"nanovdb", "", "", "has no \"filename\""},
      {"nanovdb", "\"string filename\" \"no-such-file.nvdb\"", "", "no-such-file.nvdb"},
  };
  for (const auto& c : cases) {
    const std::string message = message_of(c.type, c.parameters, c.transform);
    EXPECT_NE(message.find(c.expected), std::string::npos)
        << c.type << " " << c.parameters << "\nmessage:  " << message
        << "\nexpected: " << c.expected;
    EXPECT_EQ(message.find("t.pbrt:2:"), 0u) << message;
  }
}

TEST(MediumErrors, ATransformWithoutAnInverse) {
  Diagnostics diagnostics;
  SceneDescription scene =
      parse_pbrt_string(named("homogeneous", "") + "\nWorldBegin", "t.pbrt", ".", diagnostics);
  scene.media.at(0).transform.start[1][1] = 0.0;
  EXPECT_THROW(make_media(scene, diagnostics), SceneError);
}

TEST(MediumWarnings, UnknownParametersAndMovingMedia) {
  Diagnostics diagnostics;
  media_of(named("homogeneous", "\"float density\" 1"), ".", &diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_NE(diagnostics.warnings()[0].message.find("unknown parameter \"density\""),
            std::string::npos);

  Diagnostics moving;
  media_of(
      "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All\n" + named("homogeneous", ""),
      ".", &moving);
  ASSERT_EQ(moving.warnings().size(), 1u);
  EXPECT_NE(moving.warnings()[0].message.find("cannot move"), std::string::npos);
}

TEST(MediumTable, KeepsTheOrderOfTheScene) {
  const auto media = media_of(
      "MakeNamedMedium \"b\" \"string type\" \"homogeneous\" \"float g\" 0.1\n"
      "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" \"float g\" 0.2");
  ASSERT_EQ(media.size(), 2u);
  EXPECT_EQ(media[0]->at({0, 0, 0}, test_wavelengths()).phase.g(), 0.1f);
  EXPECT_EQ(media[1]->at({0, 0, 0}, test_wavelengths()).phase.g(), 0.2f);
}

}  // namespace
}  // namespace nephroid::testing_medium
