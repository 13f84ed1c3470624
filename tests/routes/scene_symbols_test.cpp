// Symbols that can occur in a scene, from its text: letters follow from materials and shapes.
#include "route/scene_symbols.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "integrator/presets/estimator_table.h"
#include "route/compile.h"

namespace nephroid {
namespace {

std::unique_ptr<Scene> scene_of(const std::string& world) {
  Diagnostics diagnostics;
  const SceneDescription description = parse_pbrt_string(
      "WorldBegin\nLightSource \"infinite\"\n" + world, "t.pbrt", ".", diagnostics);
  return build_scene(description, {}, diagnostics);
}

/// The letters at surfaces that may have the label, as in "DSH"; empty: without any label.
std::string letters(const Scene& scene, const std::string& label = "") {
  std::vector<std::string> labels;
  if (!label.empty()) labels.push_back(label);
  const SceneSymbols symbols(scene, labels);
  const Label number = label.empty() ? Label{0} : Label{1};
  std::string text;
  for (const auto& [c, letter] : {std::pair{EventClass::kDiffuse, 'D'},
                                  {EventClass::kGlossy, 'G'},
                                  {EventClass::kSpecular, 'S'},
                                  {EventClass::kHair, 'H'}})
    if (symbols.present().events[event_symbol(c, false, number)]) text += letter;
  return text;
}

std::vector<std::string> unknown(const Scene& scene, const std::vector<std::string>& labels) {
  return SceneSymbols(scene, labels).unknown_labels();
}

constexpr const char* kSphere = "Shape \"sphere\"\n";
constexpr const char* kCurve =
    "Shape \"curve\" \"point3 P\" [0 0 0  0 0 1  0 1 1  1 1 1] \"float width\" 0.1\n";

std::string named(const std::string& name, const std::string& type) {
  return "MakeNamedMaterial \"" + name + "\" \"string type\" \"" + type + "\"\n";
}
std::string mixed(const std::string& name, const std::string& a, const std::string& b) {
  return named(name, "mix") + "\"string materials\" [\"" + a + "\" \"" + b + "\"]\n";
}
std::string use(const std::string& name) {
  return "NamedMaterial \"" + name + "\"\n";
}

TEST(SceneSymbols, OnlyMaterialsThatShapesHaveScatter) {
  const auto scene = scene_of(named("fur", "hair") + named("glass", "dielectric") + kSphere);
  EXPECT_EQ(letters(*scene), "D");
  EXPECT_EQ(letters(*scene, "fur"), "");
  EXPECT_EQ(letters(*scene, "glass"), "");
  EXPECT_TRUE(unknown(*scene, {"fur", "glass"}).empty());
}

TEST(SceneSymbols, AnUnusedHairMaterialIsNoReasonToRefuseARoute) {
  const auto scene = scene_of(named("fur", "hair") + kSphere);
  const std::vector<RouteDefinition> routes{parse_route("all=.*:lighttrace", estimator_traits())};
  const SceneSymbols symbols(*scene, {});
  const RouteCompilation compiled = compile_routes(routes, {}, &symbols.present());
  for (const RouteFinding& finding : compiled.findings)
    EXPECT_FALSE(finding.is_error) << finding.message;
}

TEST(SceneSymbols, ACurveIsHairForItsOwnMaterialOnly) {
  const auto scene = scene_of(named("wall", "diffuse") + named("thread", "diffuse") + use("wall") +
                              kSphere + use("thread") + kCurve);
  EXPECT_EQ(letters(*scene, "wall"), "D");
  EXPECT_EQ(letters(*scene, "thread"), "H");
  const auto both = scene_of(named("wall", "diffuse") + use("wall") + kSphere + kCurve);
  EXPECT_EQ(letters(*both, "wall"), "DH");
  const auto skin = scene_of(named("skin", "subsurface") + use("skin") + kCurve);
  EXPECT_EQ(letters(*skin, "skin"), "H");
  const auto fur = scene_of(named("fur", "hair") + use("fur") + kSphere);
  EXPECT_EQ(letters(*fur, "fur"), "H");
}

TEST(SceneSymbols, AMixGoesByItsMaterials) {
  const std::string materials = named("wood", "diffuse") + named("glass", "dielectric") +
                                named("fur", "hair") + mixed("inner", "glass", "fur") +
                                mixed("paint", "wood", "inner");
  const auto scene = scene_of(materials + use("paint") + kSphere);
  EXPECT_EQ(letters(*scene, "wood"), "D");
  EXPECT_EQ(letters(*scene, "glass"), "S");
  EXPECT_EQ(letters(*scene, "fur"), "H");
  EXPECT_EQ(letters(*scene, "paint"), "");
  EXPECT_EQ(unknown(*scene, {"paint", "wood"}), std::vector<std::string>{"paint"});
  EXPECT_TRUE(SceneSymbols(*scene, {"paint"}).unknown_is_mix());
  EXPECT_FALSE(SceneSymbols(*scene, {"pain"}).unknown_is_mix());
  const auto curve = scene_of(materials + use("paint") + kCurve);
  for (const char* name : {"wood", "glass", "fur"}) EXPECT_EQ(letters(*curve, name), "H") << name;
  // A light may have the same name as a mix.
  const auto lamp = scene_of(materials + "LightSource \"point\" \"string name\" \"paint\"\n");
  EXPECT_TRUE(unknown(*lamp, {"paint"}).empty());
}

TEST(SceneSymbols, ObjectsAndMovingShapesCount) {
  const std::string glass = named("glass", "dielectric") + use("glass");
  EXPECT_EQ(letters(*scene_of(glass + "ObjectBegin \"o\"\n" + kSphere +
                              "ObjectEnd\nObjectInstance \"o\"\n"),
                    "glass"),
            "S");
  EXPECT_EQ(letters(*scene_of(glass +
                              "ActiveTransform EndTime\nTranslate 1 0 0\n"
                              "ActiveTransform All\n" +
                              kSphere),
                    "glass"),
            "S");
}

}  // namespace
}  // namespace nephroid
