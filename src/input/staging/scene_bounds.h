// The extent of a description's shapes, before they are built. It must not know materials, lights
// and cameras.
#pragma once

#include <ImathBox.h>

#include <span>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

using Bounds3d = Imath::Box3d;

/// The extent of all shapes and instances in the world, at both ends of their motion.
struct SceneExtent {
  Bounds3d bounds;               ///< empty if there is no shape
  std::vector<double> furthest;  ///< largest dot product of a point with each of the directions
};

/// Meshes in files are read. Displacement is not counted. Of instances and of shapes that are no
/// meshes, the corners of their boxes are taken. Throws SceneError and IoError.
SceneExtent scene_extent(const SceneDescription& scene, std::span<const Vec3d> directions);

}  // namespace nephroid
