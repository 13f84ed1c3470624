// Looks at a scene for which of its lights reach the places that the camera sees, directly and by a
// few reflections: a few thousand camera paths with shadow rays to lights. It must not know routes
// or estimators.
#pragma once

#include "core/pass_control.h"
#include "scene/light/light_visibility.h"
#include "scene/scene.h"

namespace nephroid {

/// What LightSampler::learn() takes; empty if there is no choice among lights. Takes a tenth of a
/// second on two cores, or more where rays are slow. It depends on nothing but the scene, its
/// camera and the size of its whole picture, so crops, other numbers of threads and resumed renders
/// learn the same.
LightVisibility survey_lights(const Scene& scene, PassControl& control = unwatched);

}  // namespace nephroid
