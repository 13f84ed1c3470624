// Layers by light: AOVs that divide a scene's light by lamp, so that lamps can be dimmed and tinted
// after rendering (image/mix.h). It must not know films or command lines.
#pragma once

#include <string>
#include <vector>

#include "film/layers_by_light.h"
#include "route/plan.h"
#include "scene/scene.h"

namespace nephroid {

/// How a picture's light is divided into layers, beside the AOVs of the user.
enum class LayerChoice {
  kRoutes,  ///< by route
  kLights,  ///< by route, and by light
  kBoth,    ///< by route, and by route and light together
};

/// Maximum number of layers by light.
inline constexpr size_t kMaxLightLayers = 12;
/// Layer of all lamps without a layer of their own.
inline constexpr const char* kOtherLights = "other-lights";

/// AOVs that divide all light of the scene: one for each label of a lamp, in the scene's order. If
/// there are more than kMaxLightLayers labels, only the strongest keep their layer, by power, and
/// kOtherLights has the rest. Glowing media count as strongest: their power is not known. Lamps
/// whose label no expression can have are in kOtherLights, too. The names are labels with '_' in
/// place of what a layer's name may not have, unique.
std::vector<AovDefinition> light_layers(const Scene& scene);

/// Adds the layers of a choice to a plan. With kBoth a layer is called ROUTE_LIGHT, and those that
/// no path of the scene can be in are left out. Throws UsageError if an AOV of the plan has the
/// name of such a layer.
void add_layers(LayerChoice choice, const Scene& scene, RoutePlan* plan);

/// Those layers of a plan that add_layers() made.
std::vector<LayerByLight> layers_by_light(const RoutePlan& plan);

}  // namespace nephroid
