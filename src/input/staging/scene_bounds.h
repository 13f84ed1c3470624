// The extent of a description's shapes, before they are built. It must not know materials, lights
// and cameras.
#pragma once

#include <ImathBox.h>

#include "input/scene_description.h"

namespace nephroid {

using Bounds3d = Imath::Box3d;

/// World bounds of all shapes and instances, at both ends of their motion. Empty if there is none.
/// Meshes in files are read. Displacement is not counted. Throws SceneError and IoError.
Bounds3d scene_bounds(const SceneDescription& scene);

}  // namespace nephroid
