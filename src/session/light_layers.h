#pragma once
#include <vector>
#include "route/route_set.h"
#include "scene/scene.h"
namespace nephroid {
enum class LayerChoice { kRoutes, kLights, kBoth };
std::vector<AovDefinition> light_layers(const Scene&);
}
