// The directives that make up a scene: what they add, inherit and refuse.
#include <gtest/gtest.h>

#include "input/format_rows.h"
#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::parse;
using testing::parse_error;
using testing::parse_warnings;

TEST(Directives, OptionsBeforeTheWorld) {
  const SceneDescription scene = parse(
      "Film \"rgb\" \"integer xresolution\" 5\nSampler \"zsobol\"\nPixelFilter \"box\"\n"
      "Integrator \"volpath\" \"integer maxdepth\" 3\nAccelerator \"bvh\"\nCamera \"realistic\"\n"
      "WorldBegin");
  EXPECT_EQ(scene.film->type, "rgb");
  EXPECT_EQ(scene.film->parameters.get_int("xresolution", 0), 5);
  EXPECT_EQ(scene.sampler->type, "zsobol");
  EXPECT_EQ(scene.pixel_filter->type, "box");
  EXPECT_EQ(scene.integrator->parameters.get_int("maxdepth", 0), 3);
  EXPECT_EQ(scene.integrator->where.to_string(), "t.pbrt:4:1");
  EXPECT_EQ(scene.integrator->parameters.where.to_string(), "t.pbrt:4:1");
  EXPECT_EQ(scene.accelerator->type, "bvh");
  EXPECT_EQ(scene.camera->type, "realistic");
  EXPECT_EQ(scene.file, "t.pbrt");
  EXPECT_EQ(scene.files->directory(), ".");
}

TEST(Directives, AbsentOptionsAreEmpty) {
  const SceneDescription scene = parse("WorldBegin");
  EXPECT_FALSE(scene.film || scene.sampler || scene.pixel_filter || scene.integrator ||
               scene.accelerator || scene.camera);
  EXPECT_TRUE(scene.materials.empty() && scene.shapes.empty() && scene.options.empty());
  EXPECT_EQ(scene.color_space, "srgb");
}

TEST(Directives, ASecondOptionReplacesTheFirstWithAWarning) {
  EXPECT_EQ(parse("Film \"a\" Film \"b\" WorldBegin").film->type, "b");
  EXPECT_EQ(parse_warnings("Film \"a\"\nFilm \"b\"\nCamera \"a\"\nCamera \"b\"\nWorldBegin"),
            "t.pbrt:2:1: Film was already given at t.pbrt:1:1, the last one counts\n"
            "t.pbrt:4:1: Camera was already given at t.pbrt:3:1, the last one counts\n");
}

TEST(Directives, EveryDirectiveStandsInItsPart) {
  for (const std::string name : {"TransformTimes", "Camera", "Film", "Sampler", "PixelFilter",
                                 "Integrator", "Accelerator", "WorldBegin"})
    EXPECT_EQ(parse_error("WorldBegin\n " + name),
              "t.pbrt:2:2: " + name + " after WorldBegin, expected it before WorldBegin");
  for (const std::string name :
       {"Import", "AttributeBegin", "AttributeEnd", "TransformBegin", "TransformEnd",
        "ReverseOrientation", "ObjectBegin", "ObjectEnd", "ObjectInstance", "Material",
        "NamedMaterial", "MakeNamedMaterial", "Texture", "LightSource", "AreaLightSource", "Shape"})
    EXPECT_EQ(parse_error("\n " + name),
              "t.pbrt:2:2: " + name + " before WorldBegin, expected it after WorldBegin");
  const std::string both =
      "Identity Translate 1 2 3 Scale 1 2 3 Rotate 1 2 3 4 LookAt 0 0 0 1 1 1 0 1 0 "
      "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 "
      "1] "
      "CoordinateSystem \"a\" CoordSysTransform \"a\" ActiveTransform All Option \"seed\" 1 "
      "ColorSpace \"srgb\" Attribute \"shape\" \"float radius\" 2 MediumInterface \"\" ";
  EXPECT_EQ(parse_error(both + "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" WorldBegin " +
                        both + "MakeNamedMedium \"b\" \"string type\" \"homogeneous\""),
            "no error");
}

TEST(Directives, UnknownOnesGetASuggestion) {
  EXPECT_EQ(parse_error("WorldBegin\n  Shap \"sphere\""),
            "t.pbrt:2:3: unknown directive \"Shap\", did you mean \"Shape\"?");
  EXPECT_EQ(parse_error("camera"),
            "t.pbrt:1:1: unknown directive \"camera\", did you mean \"Camera\"?");
  EXPECT_EQ(parse_error("Xyzzy"), "t.pbrt:1:1: unknown directive \"Xyzzy\"");
  EXPECT_EQ(parse_error("WorldEnd"), "t.pbrt:1:1: WorldEnd without WorldBegin");
  EXPECT_EQ(parse_error("WorldBegin WorldEnd Film \"rgb\""),
            "t.pbrt:1:21: expected the end of the scene after WorldEnd, found \"Film\"");
  EXPECT_EQ(parse_error("\"float a\" 1"), "t.pbrt:1:1: expected a directive, found \"float a\"");
  EXPECT_EQ(parse_error("WorldBegin ]"), "t.pbrt:1:12: expected a directive, found ']'");
  EXPECT_EQ(parse_error("WorldBegin 5"), "t.pbrt:1:12: unknown directive \"5\"");
}

TEST(Directives, ArgumentsAreChecked) {
  EXPECT_EQ(parse_error("Film rgb"),
            "t.pbrt:1:6: expected a type as a string in quotes, found \"rgb\"");
  EXPECT_EQ(parse_error("Film"),
            "t.pbrt:1:5: expected a type as a string in quotes, found the end of the file");
  EXPECT_EQ(parse_error("WorldBegin Texture \"a\" \"colour\" \"imagemap\""),
            "t.pbrt:1:24: unknown texture type \"colour\", expected \"float\" or \"spectrum\"");
  EXPECT_EQ(parse_error("ColorSpace \"sRGBB\""),
            "t.pbrt:1:12: unknown colour space \"sRGBB\", expected \"srgb\", \"rec2020\", "
            "\"aces2065-1\" or \"dci-p3\"");
  EXPECT_EQ(parse_error("Attribute \"camera\" \"float fov\" 3"),
            "t.pbrt:1:11: unknown attribute target \"camera\", expected \"shape\", \"light\", "
            "\"material\", \"medium\" or \"texture\"");
}

TEST(Directives, TheSceneMustReachTheWorld) {
  EXPECT_EQ(parse_error("Film \"rgb\"\n"), "t.pbrt:2:1: the scene ends before WorldBegin");
  EXPECT_EQ(parse_error(""), "t.pbrt:1:1: the scene ends before WorldBegin");
}

TEST(Directives, Options) {
  const SceneDescription scene = parse(
      "Option \"seed\" 7 Option \"bool Pixel-Stats\" [true] Option \"msereferenceimage\" \"a.exr\" "
      "Option \"displacementedgescale\" 2 Option \"seed\" 8 WorldBegin");
  ASSERT_EQ(scene.options.size(), 4u);
  EXPECT_EQ(scene.options[0].name, "pixelstats");
  EXPECT_EQ(scene.options[0].bools, std::vector<bool>({true}));
  EXPECT_EQ(scene.options[1].strings, std::vector<std::string>({"a.exr"}));
  EXPECT_EQ(scene.options[2].type, "float");
  EXPECT_EQ(scene.options[3].numbers, std::vector<double>({8}));
  EXPECT_EQ(parse_error("Option \"float seed\" 1"),
            "t.pbrt:1:8: option \"seed\" has type \"float\", expected \"integer\"");
  EXPECT_EQ(parse_error("Option \"seed\" [1 2]"),
            "t.pbrt:1:8: option \"seed\" has several values, expected 1");
  EXPECT_EQ(
      parse_error("Option \"pixelstats\" 1"),
      "t.pbrt:1:21: parameter \"pixelstats\" has type \"bool\", expected true or false, found "
      "\"1\"");
}

TEST(Directives, UnknownOptionsAreWarnedOfAndSkipped) {
  for (const char* value : {"1", "[ 1 2 ]", "\"a\"", "true", "[ true ]"}) {
    Diagnostics diagnostics;
    const SceneDescription scene =
        parse_pbrt_string("Option \"sed\" " + std::string(value) + " Option \"seed\" 2 WorldBegin",
                          "t.pbrt", ".", diagnostics);
    ASSERT_EQ(scene.options.size(), 1u);
    EXPECT_EQ(scene.options[0].name, "seed");
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_EQ(diagnostics.warnings()[0].message, "unknown option \"sed\", did you mean \"seed\"?");
  }
  EXPECT_EQ(parse_error("Option \"sed\" [ 1"),
            "t.pbrt:1:8: this option has no value, expected one");
}

TEST(Directives, Materials) {
  const SceneDescription scene = parse(
      "WorldBegin Shape \"sphere\" Shape \"disk\" Material \"conductor\" Shape \"sphere\" "
      "NamedMaterial \"later\" Shape \"sphere\" AttributeBegin Material \"dielectric\" "
      "Shape \"sphere\" AttributeEnd Shape \"sphere\"\n"
      "MakeNamedMaterial \"later\" \"string type\" \"hair\"");
  ASSERT_EQ(scene.materials.size(), 4u);
  EXPECT_EQ(scene.materials[0].type, "diffuse");
  EXPECT_EQ(scene.materials[1].type, "conductor");
  EXPECT_EQ(scene.materials[2].type, "dielectric");
  EXPECT_EQ(scene.materials[3].type, "hair");
  EXPECT_EQ(scene.materials[3].name, "later");
  ASSERT_EQ(scene.shapes.size(), 6u);
  const int expected[] = {0, 0, 1, -1, 2, -1};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(scene.shapes[i].material.index, expected[i]) << i;
    EXPECT_EQ(scene.shapes[i].material.name, expected[i] < 0 ? "later" : "") << i;
  }
  EXPECT_TRUE(scene.materials[3].parameters.list[0].used);
}

TEST(Directives, MaterialErrors) {
  const std::string make = "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\n";
  EXPECT_EQ(parse_error("WorldBegin\n" + make + " " + make),
            "t.pbrt:3:2: named material \"m\" is already defined at t.pbrt:2:1");
  EXPECT_EQ(parse_error("WorldBegin\nMakeNamedMaterial \"m\" \"float eta\" 1"),
            "t.pbrt:2:1: named material \"m\" has no parameter \"string type\", expected one as in "
            "\"string type\" \"diffuse\"");
  EXPECT_EQ(parse_error("WorldBegin\nMakeNamedMaterial \"m\" \"float type\" 1"),
            "t.pbrt:2:23: parameter \"type\" has type \"float\", expected \"string\"");
  EXPECT_EQ(parse_error("WorldBegin\nMakeNamedMaterial \"\""),
            "t.pbrt:2:1: the name is empty, expected at least one character");
  EXPECT_EQ(parse_error("WorldBegin\n" + make + "  NamedMaterial \"n\" Shape \"sphere\""),
            "t.pbrt:3:3: named material \"n\" is not defined, did you mean \"m\"?");
  EXPECT_EQ(parse_error("WorldBegin NamedMaterial \"unused\""), "no error");
}

TEST(Directives, Textures) {
  const SceneDescription scene = parse(
      "WorldBegin Translate 1 2 3\nTexture \"t\" \"float\" \"constant\" \"float value\" 2\n"
      "Texture \"t\" \"spectrum\" \"imagemap\"");
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[0].name, "t");
  EXPECT_EQ(scene.textures[0].type, "constant");
  EXPECT_EQ(scene.textures[0].value_type, "float");
  EXPECT_EQ(scene.textures[0].parameters.get_float("value", 0), 2);
  EXPECT_EQ(scene.textures[0].transform.start[3][1], 2);
  EXPECT_EQ(scene.textures[1].value_type, "spectrum");
  EXPECT_EQ(parse_error("WorldBegin Texture \"t\" \"float\" \"a\"\nTexture \"t\" \"float\" \"b\""),
            "t.pbrt:2:1: float texture \"t\" is already defined at t.pbrt:1:12");
  EXPECT_EQ(
      parse_error("WorldBegin Texture \"t\" \"spectrum\" \"a\"\nTexture \"t\" \"spectrum\" \"b\""),
      "t.pbrt:2:1: spectrum texture \"t\" is already defined at t.pbrt:1:12");
}

TEST(Directives, Media) {
  const SceneDescription scene = parse(
      "MakeNamedMedium \"air\" \"string type\" \"homogeneous\" MediumInterface \"\" \"air\" "
      "Camera \"perspective\" WorldBegin Translate 0 0 7 MakeNamedMedium \"fog\" "
      "\"string type\" [ \"cloud\" ] MediumInterface \"fog\" \"air\" Shape \"sphere\" "
      "LightSource \"point\" MediumInterface \"fog\" Shape \"sphere\" MediumInterface \"\" \"\" "
      "Shape \"sphere\"");
  ASSERT_EQ(scene.media.size(), 2u);
  EXPECT_EQ(scene.media[1].name, "fog");
  EXPECT_EQ(scene.media[1].type, "cloud");
  EXPECT_EQ(scene.media[1].transform.start[3][2], 7);
  EXPECT_EQ(scene.camera->medium, "air");
  EXPECT_EQ(scene.lights[0].medium, "air");
  EXPECT_EQ(scene.shapes[0].inside_medium, "fog");
  EXPECT_EQ(scene.shapes[0].outside_medium, "air");
  EXPECT_EQ(scene.shapes[1].inside_medium, "fog");
  EXPECT_EQ(scene.shapes[1].outside_medium, "fog");
  EXPECT_EQ(scene.shapes[2].inside_medium, "");
  const std::string make = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n";
  EXPECT_EQ(parse_error(make + make), "t.pbrt:2:1: medium \"m\" is already defined at t.pbrt:1:1");
  EXPECT_EQ(parse_error("MakeNamedMedium \"m\""),
            "t.pbrt:1:1: medium \"m\" has no parameter \"string type\", expected one as in "
            "\"string type\" \"diffuse\"");
  EXPECT_EQ(parse_error("WorldBegin MediumInterface \"a\" \"\"\nShape \"sphere\""),
            "t.pbrt:2:1: medium \"a\" is not defined");
  EXPECT_EQ(parse_error("WorldBegin MediumInterface \"\" \"a\"\nLightSource \"point\""),
            "t.pbrt:2:1: medium \"a\" is not defined");
  EXPECT_EQ(parse_error("MediumInterface \"\" \"a\" Camera \"perspective\" WorldBegin"),
            "t.pbrt:1:24: medium \"a\" is not defined");
}

TEST(Directives, LightsAndAreaLights) {
  const SceneDescription scene = parse(
      "WorldBegin Translate 1 2 3 LightSource \"point\" \"rgb I\" [1 2 3] AttributeBegin "
      "AreaLightSource \"diffuse\" \"rgb L\" [4 5 6] Shape \"sphere\" AreaLightSource \"\" "
      "Shape \"sphere\" AttributeEnd Shape \"sphere\"");
  EXPECT_EQ(scene.lights.at(0).type, "point");
  EXPECT_EQ(scene.lights[0].transform.start[3][0], 1);
  EXPECT_EQ(scene.shapes.at(0).area_light->type, "diffuse");
  EXPECT_EQ(scene.shapes[0].area_light->parameters.find("L")->numbers[0], 4);
  EXPECT_FALSE(scene.shapes[1].area_light);
  EXPECT_FALSE(scene.shapes.at(2).area_light);
}

TEST(Directives, ReverseOrientationToggles) {
  const SceneDescription scene = parse(
      "WorldBegin ReverseOrientation Shape \"sphere\" ReverseOrientation Shape \"sphere\" "
      "AttributeBegin ReverseOrientation Shape \"sphere\" AttributeEnd Shape \"sphere\"");
  const bool expected[] = {true, false, true, false};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.shapes.at(i).reverse_orientation, expected[i]);
}

TEST(Directives, ColorSpacesAreScopedAndGoWithParameters) {
  const SceneDescription scene = parse(
      "ColorSpace \"rec2020\" Film \"rgb\" ColorSpace \"ACES2065-1\" WorldBegin "
      "Material \"diffuse\" \"rgb reflectance\" [1 1 1] AttributeBegin ColorSpace \"dci-p3\" "
      "Material \"diffuse\" \"rgb reflectance\" [1 1 1] AttributeEnd "
      "Material \"diffuse\" \"rgb reflectance\" [1 1 1]");
  EXPECT_EQ(scene.color_space, "rec2020");
  EXPECT_EQ(scene.materials.at(0).parameters.list[0].color_space, "aces2065-1");
  EXPECT_EQ(scene.materials.at(1).parameters.list[0].color_space, "dci-p3");
  EXPECT_EQ(scene.materials.at(2).parameters.list[0].color_space, "aces2065-1");
}

TEST(Directives, AttributesAreDefaults) {
  const SceneDescription scene = parse(
      "WorldBegin Attribute \"shape\" \"float radius\" 5 \"float zmin\" -1 AttributeBegin "
      "Attribute \"shape\" \"float radius\" 6 Shape \"sphere\" Shape \"sphere\" \"float radius\" 7 "
      "AttributeEnd Shape \"sphere\"");
  EXPECT_EQ(scene.shapes.at(0).parameters.get_float("radius", 0), 6);
  EXPECT_EQ(scene.shapes[0].parameters.get_float("zmin", 0), -1);
  EXPECT_EQ(scene.shapes[1].parameters.get_float("radius", 0), 7);
  EXPECT_EQ(scene.shapes[1].parameters.list.size(), 2u);
  EXPECT_EQ(scene.shapes[2].parameters.get_float("radius", 0), 5);
}

TEST(Directives, AttributesReachEachTargetAndAreNeverUnknown) {
  const SceneDescription scene = parse(
      "WorldBegin Attribute \"light\" \"float a\" 1 Attribute \"material\" \"float b\" 2 "
      "Attribute \"medium\" \"float c\" 3 ColorSpace \"rec2020\" Attribute \"texture\" \"float d\" "
      "4 "
      "ColorSpace \"srgb\" LightSource \"point\" Material \"diffuse\" "
      "MakeNamedMaterial \"n\" \"string type\" \"diffuse\" "
      "MakeNamedMedium \"m\" \"string type\" \"cloud\" Texture \"t\" \"float\" \"constant\" "
      "AreaLightSource \"diffuse\" Shape \"sphere\"");
  EXPECT_EQ(scene.lights.at(0).parameters.list.at(0).name, "a");
  EXPECT_EQ(scene.materials.at(0).parameters.list.at(0).name, "b");
  EXPECT_EQ(scene.materials.at(1).parameters.list.at(1).name, "b");
  EXPECT_EQ(scene.media.at(0).parameters.list.at(1).name, "c");
  EXPECT_EQ(scene.textures.at(0).parameters.list.at(0).name, "d");
  EXPECT_EQ(scene.textures[0].parameters.list[0].color_space, "rec2020");
  EXPECT_EQ(scene.shapes.at(0).area_light->parameters.list.at(0).name, "a");
  EXPECT_TRUE(scene.shapes[0].parameters.list.empty());
  Diagnostics diagnostics;
  const FormatType knows_nothing{"x", {}};
  scene.lights[0].parameters.report_unused("light", knows_nothing, diagnostics);
  scene.media[0].parameters.report_unused("medium", knows_nothing, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

}  // namespace
}  // namespace nephroid
