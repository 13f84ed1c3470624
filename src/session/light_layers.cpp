#include "session/light_layers.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "core/errors.h"
#include "route/route_text.h"

namespace nephroid {
namespace {

/// Letters of names that are taken from lights and routes: suffixes fit behind them.
constexpr size_t kMaxNameOfLight = 24, kMaxNameOfRoute = 20;

/// All lights of one label.
struct LampPower {
  std::string label;
  double power = 0;  ///< watts
};

/// Lamps in the scene's order, glowing media last.
std::vector<LampPower> lamps_of(const Scene& scene) {
  std::vector<LampPower> lamps;
  std::set<std::string> known;
  const auto add = [&](const std::string& label, double power) {
    if (known.insert(label).second) lamps.push_back({label, 0});
    std::ranges::find(lamps, label, &LampPower::label)->power += power;
  };
  for (size_t i = 0; i < scene.lights.size(); ++i)
    add(scene.light_labels[i], double{scene.lights[i]->power()});
  for (size_t i = 0; i < scene.media.size(); ++i)
    if (scene.media[i]->is_emissive())
      add(scene.medium_labels[i], std::numeric_limits<double>::infinity());
  return lamps;
}

/// False for labels that would end too early in an expression or in a line of metadata.
bool fits_expressions(const std::string& label) {
  return !label.empty() && std::ranges::none_of(label, [](char c) {
    return c == '\'' || (static_cast<unsigned char>(c) < ' ');
  });
}

/// The labels that get a layer of their own, in the scene's order.
std::vector<std::string> labels_with_layers(std::vector<LampPower> lamps) {
  const size_t all = lamps.size();
  std::erase_if(lamps, [](const LampPower& lamp) { return !fits_expressions(lamp.label); });
  std::vector<std::string> labels;
  for (const LampPower& lamp : lamps) labels.push_back(lamp.label);
  if (lamps.size() == all && all <= kMaxLightLayers) return labels;
  std::ranges::stable_sort(lamps, std::greater<>(), &LampPower::power);
  lamps.resize(std::min(lamps.size(), kMaxLightLayers - 1));
  std::erase_if(labels, [&](const std::string& label) {
    return std::ranges::find(lamps, label, &LampPower::label) == lamps.end();
  });
  return labels;
}

/// "name", else "name-2", "name-3" and so on: the first that is not taken. Takes it.
std::string unique_name(const std::string& name, std::set<std::string>* taken) {
  std::string unique = name;
  for (int i = 2; !taken->insert(unique).second; ++i) unique = name + "-" + std::to_string(i);
  return unique;
}

/// The label with '_' in place of each character that a layer's name may not have.
std::string name_of_light(std::string label) {
  if (label.size() > kMaxNameOfLight) label.resize(kMaxNameOfLight);
  for (char& c : label)
    if (!is_layer_name({'x', c})) c = '_';
  return is_layer_name(label) ? label : label + "-light";
}

std::string bracket(const std::string& label) {
  return "<L.'" + label + "'>";
}

/// All lamps but those.
std::string expression_of_others(const std::vector<std::string>& labels) {
  if (labels.empty()) return "C.*L";
  std::string set;
  for (const std::string& label : labels) set += bracket(label);
  return "C.*[^" + set + "]";
}

AovDefinition layer_of(std::string name, std::string expression) {
  AovDefinition layer;
  layer.light = name;
  layer.name = std::move(name);
  layer.expression = std::move(expression);
  return layer;
}

/// One layer for each route and light.
std::vector<AovDefinition> by_route(const std::vector<AovDefinition>& lights,
                                    const RoutePlan& plan) {
  std::vector<AovDefinition> layers;
  for (const RouteDefinition& route : plan.routes)
    for (const AovDefinition& light : lights) {
      AovDefinition layer = light;
      layer.route = route.name;
      layer.name = route.name.substr(0, kMaxNameOfRoute) + "_" + light.name;
      layers.push_back(std::move(layer));
    }
  return layers;
}

/// Removes layers that no path of the scene can be in.
void drop_empty_layers(const RoutePlan& plan, const Scene& scene,
                       std::vector<AovDefinition>* layers) {
  const std::vector<bool> matches =
      compile_plan({plan.routes, *layers, plan.strict}, scene).compilation.aov_matches;
  std::vector<AovDefinition> kept;
  for (size_t i = 0; i < layers->size(); ++i)
    if (matches[i]) kept.push_back(std::move((*layers)[i]));
  *layers = std::move(kept);
}

void check_names_of_user(const RoutePlan& plan, const std::vector<AovDefinition>& layers) {
  for (const AovDefinition& aov : plan.aovs)
    if (std::ranges::find(layers, aov.name, &AovDefinition::name) != layers.end())
      throw UsageError("--aov: '" + aov.name +
                       "' is the name of a layer by light, which --layers makes, expected another");
}

}  // namespace

std::vector<AovDefinition> light_layers(const Scene& scene) {
  const std::vector<LampPower> lamps = lamps_of(scene);
  const std::vector<std::string> labels = labels_with_layers(lamps);
  std::set<std::string> taken{kOtherLights};
  std::vector<AovDefinition> layers;
  for (const std::string& label : labels)
    layers.push_back(layer_of(unique_name(name_of_light(label), &taken), "C.*" + bracket(label)));
  if (labels.size() < lamps.size())
    layers.push_back(layer_of(kOtherLights, expression_of_others(labels)));
  return layers;
}

void add_layers(LayerChoice choice, const Scene& scene, RoutePlan* plan) {
  if (choice == LayerChoice::kRoutes) return;
  const bool by_light_alone = choice == LayerChoice::kLights;
  std::vector<AovDefinition> layers = light_layers(scene);
  if (!by_light_alone) layers = by_route(layers, *plan);
  std::set<std::string> taken;
  for (const RouteDefinition& route : plan->routes) taken.insert(route.name);
  for (AovDefinition& layer : layers) {
    if (taken.contains(layer.name)) layer.name += "-light";
    layer.name = unique_name(layer.name, &taken);
  }
  if (!by_light_alone) drop_empty_layers(*plan, scene, &layers);
  check_names_of_user(*plan, layers);
  plan->aovs.insert(plan->aovs.end(), layers.begin(), layers.end());
}

std::vector<LayerByLight> layers_by_light(const RoutePlan& plan) {
  std::vector<LayerByLight> layers;
  for (const AovDefinition& aov : plan.aovs)
    if (!aov.light.empty()) layers.push_back({aov.name, aov.route, aov.light});
  return layers;
}

}  // namespace nephroid
