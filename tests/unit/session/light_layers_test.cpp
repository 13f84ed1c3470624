// Layers by light: their names and groups, and that they add up to the picture whatever the lights.
#include "session/light_layers.h"

#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

std::vector<std::string> names_of(const std::vector<AovDefinition>& layers) {
  std::vector<std::string> names;
  for (const AovDefinition& layer : layers) names.push_back(layer.name);
  return names;
}

/// A point light of that power with a name.
std::string lamp(const std::string& name, int power) {
  return "LightSource \"point\" \"float power\" " + std::to_string(power) + " \"string name\" \"" +
         name + "\"\n";
}

std::vector<AovDefinition> layers_of(const std::string& lamps) {
  return light_layers(*scene_from_text("WorldBegin\n" + lamps));
}

TEST(LightLayers, OneForEachLabelInTheScenesOrder) {
  const std::vector<AovDefinition> layers =
      layers_of(lamp("rim", 1) + lamp("key", 3) + lamp("rim", 2) +
                "LightSource \"infinite\" \"rgb L\" [1 1 1]\n");
  EXPECT_EQ(names_of(layers), (std::vector<std::string>{"rim", "key", "infinite1"}));
  EXPECT_EQ(layers[1].expression, "C.*<L.'key'>");
  EXPECT_EQ(layers[1].light, "key");
  EXPECT_TRUE(layers_of("").empty());
}

TEST(LightLayers, TheStrongestKeepTheirOwn) {
  std::string lamps;
  // Two weak lamps of one name are stronger than each of lamp0 to lamp2.
  for (int i = 0; i < 12; ++i) lamps += lamp("lamp" + std::to_string(i), 10 + i);
  const std::vector<AovDefinition> twelve = layers_of(lamps);
  ASSERT_EQ(twelve.size(), kMaxLightLayers);
  EXPECT_EQ(twelve[11].name, "lamp11");
  const std::vector<AovDefinition> grouped = layers_of(lamp("pair", 7) + lamps + lamp("pair", 6));
  EXPECT_EQ(names_of(grouped),
            (std::vector<std::string>{"pair", "lamp2", "lamp3", "lamp4", "lamp5", "lamp6", "lamp7",
                                      "lamp8", "lamp9", "lamp10", "lamp11", "other-lights"}));
  EXPECT_EQ(grouped[11].expression.substr(0, 24), "C.*[^<L.'pair'><L.'lamp2");
}

TEST(LightLayers, NamesAreValidAndUnique) {
  const std::string lamps = lamp("Lamp.001", 1) + lamp("Lamp 001", 1) + lamp("Z", 1) +
                            lamp("other-lights", 1) + lamp("bob's", 1) +
                            lamp(std::string(99, 'x'), 1);
  const std::vector<AovDefinition> layers = layers_of(lamps);
  EXPECT_EQ(names_of(layers),
            (std::vector<std::string>{"Lamp_001", "Lamp_001-2", "Z-light", "other-lights-2",
                                      std::string(24, 'x'), "other-lights"}));
  EXPECT_EQ(layers[0].expression, "C.*<L.'Lamp.001'>");
  // No expression can have the label with an apostrophe.
  EXPECT_NE(layers[5].expression.find("[^<L.'Lamp.001'>"), std::string::npos);
}

TEST(LightLayers, AnAovOfThatNameIsAnError) {
  const auto scene = scene_from_text("WorldBegin\n" + lamp("key", 1) + lamp("caustic", 1));
  RoutePlan plan = plan_of({"caustic=C.*DS+L:photons", "rest=.*:path"}, {"key=.*"});
  EXPECT_THROW(add_layers(LayerChoice::kLights, *scene, &plan), UsageError);
  plan.aovs.clear();
  add_layers(LayerChoice::kLights, *scene, &plan);
  // A route's name is taken, too, but not by the user.
  EXPECT_EQ(names_of(plan.aovs), (std::vector<std::string>{"key", "caustic-light"}));
  EXPECT_EQ(layers_by_light(plan)[1], (LayerByLight{"caustic-light", "", "caustic"}));
}

TEST(LightLayers, BothLeavesOutWhatNoPathCanBeIn) {
  const auto scene =
      scene_from_text("WorldBegin\n" + lamp("key", 1) + lamp("rim", 1) + "Shape \"sphere\"\n");
  RoutePlan plan =
      plan_of({"emission=C.*M:path", "first=C.*D<L.'key'>:path", "rest=.*:path"}, {"mine=C.*L"});
  add_layers(LayerChoice::kBoth, *scene, &plan);
  EXPECT_EQ(names_of(plan.aovs),
            (std::vector<std::string>{"mine", "first_key", "rest_key", "rest_rim"}));
  EXPECT_EQ(layers_by_light(plan)[0], (LayerByLight{"first_key", "first", "key"}));
}

TEST(LightLayers, NeedNoMemoryForPathsThatTheSceneHasNot) {
  const auto scene =
      scene_from_text("WorldBegin\n" + lamp("key", 1) + lamp("rim", 1) + "Shape \"sphere\"\n");
  RoutePlan plan = plan_named("mixed");
  add_layers(LayerChoice::kLights, *scene, &plan);
  // Not in the group of `emission`, which has neither media nor hair to show.
  const FilmLayout layout = make_estimators(plan, {}, *scene).layout;
  EXPECT_EQ(layout.group_count(), 2);
  EXPECT_EQ(layout.layers_of_groups().size(), 2u);
}

// Lights of every kind: a shape seen directly and in a mirror, a lamp at a point behind glass, a
// sky, a distant light, and a fire in fog.
const char* const kWorld = R"(
  LookAt 0 2 -5  0 0.6 0  0 1 0
  Camera "perspective" "float fov" 50
  Film "rgb" "integer xresolution" 12 "integer yresolution" 10
  WorldBegin
  AttributeBegin
    Translate 0 1.8 1 AreaLightSource "diffuse" "rgb L" [9 8 7] "bool twosided" true
    Shape "disk" "float radius" 0.7
  AttributeEnd
  LightSource "point" "rgb I" [2 3 4] "point3 from" [2 2 -3] "string name" "bulb"
  LightSource "infinite" "rgb L" [0.2 0.3 0.4] "string name" "sky"
  LightSource "distant" "rgb L" [0.5 0.4 0.3] "point3 from" [1 2 -1]
  MakeNamedMedium "fire" "string type" "homogeneous" "rgb sigma_a" [2 1.5 1]
    "rgb sigma_s" [0.5 0.5 0.5] "rgb Le" [1.2 0.7 0.3]
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Material "conductor" "float roughness" 0
  Shape "bilinearmesh" "point3 P" [-3 0 2  3 0 2  -3 3 3  3 3 3]
  Material "dielectric"
  AttributeBegin Translate 1 0.5 -1 Shape "sphere" "float radius" 0.5 AttributeEnd
  AttributeBegin
    MediumInterface "fire" "" Material "interface" Translate -1 0.5 -1
    Shape "sphere" "float radius" 0.5
  AttributeEnd)";

/// Expects that the layers of a list add up to the picture, up to the rounding of each to a float.
void expect_sum(const Film& film, const std::vector<int>& aovs) {
  constexpr double kRounding = 0x1p-24;
  for (int y = 0; y < film.bounds().y1; ++y)
    for (int x = 0; x < film.bounds().x1; ++x)
      for (int c = 0; c < 3; ++c) {
        const double value = double{film.value(x, y)[c]};
        double sum = 0, rounded = std::abs(value);
        for (const int aov : aovs) {
          sum += double{film.aov_value(aov, x, y)[c]};
          rounded += std::abs(double{film.aov_value(aov, x, y)[c]});
        }
        EXPECT_NEAR(sum, value, kRounding * rounded) << x << " " << y << " " << c;
      }
}

IntegratorOptions few_photons() {
  IntegratorOptions options;
  options.max_depth = 6;
  options.photons_per_pass = 2000;
  return options;
}

class LightLayersOf : public ::testing::TestWithParam<const char*> {};

TEST_P(LightLayersOf, AddUpToThePicture) {
  const auto scene = scene_from_text(kWorld);
  RoutePlan plan = plan_named(GetParam());
  add_layers(LayerChoice::kLights, *scene, &plan);
  EXPECT_EQ(names_of(plan.aovs),
            (std::vector<std::string>{"bulb", "sky", "distant1", "diffuse1", "fire"}));
  const Film film = render(*scene, plan, few_photons(), 1, 2);
  expect_sum(film, {0, 1, 2, 3, 4});
  double light[5] = {};
  for (int a = 0; a < 5; ++a)
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 12; ++x) light[a] += double{film.aov_value(a, x, y).g};
  for (const double of_lamp : light) EXPECT_GT(of_lamp, 0);
}

TEST_P(LightLayersOf, AddUpByRoute) {
  const auto scene = scene_from_text(kWorld);
  RoutePlan plan = plan_named(GetParam());
  add_layers(LayerChoice::kBoth, *scene, &plan);
  const Film film = render(*scene, plan, few_photons(), 1, 1);
  std::vector<int> all;
  for (size_t a = 0; a < plan.aovs.size(); ++a) all.push_back(static_cast<int>(a));
  expect_sum(film, all);
  for (size_t r = 0; r < plan.routes.size(); ++r)
    for (int x = 0; x < 12; ++x) {
      double sum = 0;
      for (size_t a = 0; a < plan.aovs.size(); ++a)
        if (plan.aovs[a].route == plan.routes[r].name)
          sum += double{film.aov_value(static_cast<int>(a), x, 5).r};
      const double route = double{film.route_value(static_cast<int>(r), x, 5).r};
      EXPECT_NEAR(sum, route, 1e-6 * route);
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, LightLayersOf, ::testing::Values("path", "mixed", "split"));

}  // namespace
}  // namespace nephroid
