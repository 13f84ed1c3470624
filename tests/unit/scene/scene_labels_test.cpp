// Labels of a scene's things in light path expressions: names, or types with numbers.
#include "scene/scene_labels.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "scene/scene.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using Labels = std::vector<std::string>;

SceneDescription parsed(const std::string& text, const std::string& directory = ".") {
  Diagnostics diagnostics;
  return parse_pbrt_string("WorldBegin\n" + text, "t.pbrt", directory, diagnostics);
}

Labels materials_of(const std::string& text) {
  return material_labels(parsed(text));
}

TEST(MaterialLabels, CountWhatHasNoNameByType) {
  EXPECT_EQ(materials_of("Material \"dielectric\" Material \"diffuse\" Material \"dielectric\""),
            (Labels{"dielectric1", "diffuse1", "dielectric2"}));
  EXPECT_EQ(materials_of("Material \"\" Material \"interface\""),
            (Labels{"interface1", "interface2"}));
}

TEST(MaterialLabels, NamesAreTheFiles) {
  EXPECT_EQ(materials_of("MakeNamedMaterial \"glass\" \"string type\" \"dielectric\"\n"
                         "Material \"dielectric\""),
            (Labels{"glass", "dielectric1"}));
}

TEST(MaterialLabels, NumbersAvoidNames) {
  // Names before and after the numbered material.
  const std::string anonymous = "Material \"dielectric\"\n";
  const std::string named = "MakeNamedMaterial \"dielectric1\" \"string type\" \"diffuse\"\n";
  EXPECT_EQ(materials_of(named + anonymous + anonymous),
            (Labels{"dielectric1", "dielectric2", "dielectric3"}));
  EXPECT_EQ(materials_of(anonymous + named + anonymous),
            (Labels{"dielectric2", "dielectric1", "dielectric3"}));
}

TEST(MaterialLabels, ShapesWithoutMaterialHaveADiffuseOne) {
  EXPECT_EQ(materials_of("Shape \"sphere\" Material \"diffuse\" Shape \"sphere\""),
            (Labels{"diffuse1", "diffuse2"}));
}

TEST(MediumLabels, AreNames) {
  EXPECT_EQ(medium_labels(parsed("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
                                 "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\"")),
            (Labels{"fog", "milk"}));
}

/// Light labels of a built scene, with its warnings.
Labels lights_of(const std::string& text, std::string* warnings = nullptr,
                 const std::string& directory = ".") {
  Diagnostics diagnostics;
  const auto scene = build_scene(parsed(text, directory), {}, diagnostics);
  EXPECT_EQ(scene->light_labels.size(), scene->lights.size());
  if (warnings)
    for (const Warning& w : diagnostics.warnings())
      if (w.where.line > 0) *warnings += located(w.where, w.message) + "\n";
  return scene->light_labels;
}

constexpr const char* kTwoTriangles =
    "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] "
    "\"integer indices\" [ 0 1 2 1 3 2 ]\n";

TEST(LightLabels, NamesAndNumbers) {
  std::string warnings;
  EXPECT_EQ(lights_of("LightSource \"point\"\nLightSource \"infinite\"\n"
                      "LightSource \"point\" \"string name\" \"key\"\nLightSource \"point\"\n"
                      "LightSource \"spot\" \"string name\" \"key\"\nShape \"sphere\"",
                      &warnings),
            (Labels{"point1", "infinite1", "key", "point2", "key"}));
  EXPECT_EQ(warnings, "");
}

TEST(LightLabels, PrimitivesAndShapesOfOneDirectiveShareALabel) {
  std::string warnings;
  EXPECT_EQ(lights_of(std::string("AreaLightSource \"diffuse\"\n") + kTwoTriangles +
                          "Shape \"disk\"\nAreaLightSource \"diffuse\"\nShape \"disk\"\n"
                          "AreaLightSource \"diffuse\" \"string name\" \"lamp\"\n" +
                          kTwoTriangles,
                      &warnings),
            (Labels{"diffuse1", "diffuse1", "diffuse1", "diffuse2", "lamp", "lamp"}));
  EXPECT_EQ(warnings, "");
}

TEST(LightLabels, NumbersAvoidNames) {
  EXPECT_EQ(lights_of("LightSource \"point\"\nAreaLightSource \"diffuse\" \"string name\" "
                      "\"point1\"\nShape \"disk\""),
            (Labels{"point2", "point1"}));
}

TEST(LightLabels, AFileIncludedTwiceHasTwoLights) {
  const testing::TemporaryDirectory files;
  files.write("lamp.pbrt", "AreaLightSource \"diffuse\"\nShape \"disk\"\n");
  EXPECT_EQ(lights_of("Include \"lamp.pbrt\"\nInclude \"lamp.pbrt\"", nullptr, files.path()),
            (Labels{"diffuse1", "diffuse2"}));
}

TEST(LightLabels, ANameIsAString) {
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      lights_of(text);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of("LightSource \"point\" \"float name\" 1").rfind("t.pbrt:2:21: ", 0), 0u)
      << error_of("LightSource \"point\" \"float name\" 1");
  EXPECT_EQ(error_of("AreaLightSource \"diffuse\" \"float name\" 1\nShape \"disk\"")
                .rfind("t.pbrt:2:", 0),
            0u);
}

TEST(SceneLabels, StandAtTheIndicesOfTheScene) {
  Diagnostics diagnostics;
  const auto scene = build_scene(
      parsed("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
             "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\"\n"
             "MakeNamedMaterial \"wall\" \"string type\" \"diffuse\"\nMaterial \"conductor\"\n"
             "Shape \"sphere\""),
      {}, diagnostics);
  EXPECT_EQ(scene->material_labels, (Labels{"wall", "conductor1"}));
  EXPECT_EQ(scene->medium_labels, (Labels{"fog", "milk"}));
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene->materials[i]->index(), static_cast<int>(i));
    EXPECT_EQ(scene->media[i]->index(), static_cast<int>(i));
  }
}

TEST(SceneBand, SaysWhetherThereCanBeCaustics) {
  const auto specular = [](const SpecularBand& band) {
    Diagnostics diagnostics;
    SceneOverrides overrides;
    overrides.specular_band = band;
    const auto scene = build_scene(parsed("Material \"conductor\" \"float roughness\" 0.05 \"bool "
                                          "remaproughness\" false\nShape \"sphere\""),
                                   overrides, diagnostics);
    EXPECT_EQ(scene->specular_band.low, band.low);
    EXPECT_EQ(scene->specular_band.high, band.high);
    return scene->has_specular_material;
  };
  EXPECT_TRUE(specular({}));
  EXPECT_TRUE(specular({0.05f, 0.05f}));
  EXPECT_TRUE(specular({0.0f, 0.06f}));
  EXPECT_FALSE(specular({0.01f, 0.049f}));
}

}  // namespace
}  // namespace nephroid
