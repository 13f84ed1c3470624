// Camera and light for scenes without: a three-quarter view, a neutral sky and a soft key light.
#pragma once

#include "input/scene_description.h"
#include "input/staging/scene_bounds.h"
#include "input/staging/surroundings.h"

namespace nephroid {

/// A perspective camera that shows all of the bounds, from the front right and above; the front is
/// the south. The bounds are not empty.
CameraDescription framed_camera(const Bounds3d& bounds, const Surroundings& surroundings);

/// True if the scene has a light or a shape that emits.
bool has_light(const SceneDescription& scene);

/// Adds a sky of equal luminance in all directions and a lamp above the left of the front. A white
/// surface that faces the lamp gets the value 1 at iso 100. The bounds are not empty.
void add_studio_light(SceneDescription* scene, const Bounds3d& bounds,
                      const Surroundings& surroundings);

/// Adds a matte grey disk just under the lowest point. The bounds are not empty.
void add_floor(SceneDescription* scene, const Bounds3d& bounds, const Surroundings& surroundings);

/// The location of directives that no file has.
SourceLocation not_in_a_file(const char* what);

}  // namespace nephroid
